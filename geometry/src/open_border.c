#include "geometry/src/open_border.h"
#include "geometry/mem.h"
#include <stdlib.h>

typedef struct half_edge {
    int32_t low, high;
} half_edge;

static int by_ends(const void *a, const void *b)
{
    const half_edge *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return (x->high > y->high) - (x->high < y->high);
}

uint8_t *open_border_triangles(const surface *s)
{
    size_t count = 3 * (size_t)s->triangle_count;
    uint8_t *border = NEW_ARRAY(uint8_t, s->triangle_count), *at = NEW_ARRAY(uint8_t, s->vertex_count);
    half_edge *edge = NEW_ARRAY(half_edge, count);
    for (size_t i = 0; i < count; i++) {
        int32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        edge[i] = (half_edge){a < b ? a : b, a < b ? b : a};
    }
    qsort(edge, count, sizeof *edge, by_ends);
    for (size_t i = 0, k; i < count; i = k) {
        for (k = i + 1; k < count && edge[k].low == edge[i].low && edge[k].high == edge[i].high; k++) {}
        if (k == i + 1) at[edge[i].low] = at[edge[i].high] = 1;
    }
    for (size_t i = 0; i < count; i++) border[i / 3] |= at[s->tri[i]];
    free(at);
    free(edge);
    return border;
}
