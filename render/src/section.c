#include "render/src/section.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

double *section_of(const surface *s, const rigid *move, const double point[3], const double normal[3],
                   int32_t **triangle, int *count)
{
    double *placed = NEW_ARRAY(double, 3 * (size_t)s->vertex_count), *height = NEW_ARRAY(double, s->vertex_count);
    for (size_t v = 0; v < (size_t)s->vertex_count; v++) {
        double from[3];
        rigid_apply(move, s->xyz + 3 * v, placed + 3 * v);
        vec_sub(placed + 3 * v, point, from);
        height[v] = vec_dot(from, normal);
    }
    int capacity = 256, found = 0;
    double *out = NEW_ARRAY(double, 6 * capacity);
    int32_t *from_triangle = NEW_ARRAY(int32_t, capacity);
    for (size_t t = 0; t < (size_t)s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * t;
        double end[2][3];
        int ends = 0;
        /* zero counts as above: a plane through vertices makes no piece twice */
        for (int k = 0; k < 3; k++) {
            int32_t a = v[k], b = v[(k + 1) % 3];
            if ((height[a] < 0) == (height[b] < 0)) continue;
            double share = height[a] / (height[a] - height[b]), along[3];
            vec_sub(placed + 3 * (size_t)b, placed + 3 * (size_t)a, along);
            vec_axpy(placed + 3 * (size_t)a, share, along, end[ends++]);
        }
        if (ends != 2) continue;
        if (found == capacity) {
            out = GROW_ARRAY(double, out, 6 * (size_t)(capacity *= 2));
            from_triangle = GROW_ARRAY(int32_t, from_triangle, capacity);
        }
        vec_copy(end[0], out + 6 * (size_t)found);
        vec_copy(end[1], out + 6 * (size_t)found + 3);
        from_triangle[found++] = (int32_t)t;
    }
    free(placed);
    free(height);
    *triangle = from_triangle;
    *count = found;
    return out;
}
