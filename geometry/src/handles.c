#include "geometry/handles.h"
#include "geometry/mem.h"
#include <stdlib.h>

int32_t surface_handles(const surface *s)
{
    int32_t *component, pieces = surface_components(s, &component), used = 0;
    uint8_t *seen = NEW_ARRAY(uint8_t, s->vertex_count);
    for (size_t i = 0; i < 3 * (size_t)s->triangle_count; i++) {
        used += !seen[s->tri[i]];
        seen[s->tri[i]] = 1;
    }
    free(component);
    free(seen);
    return pieces - (used - s->triangle_count / 2) / 2; /* three halves of the triangles are edges */
}
