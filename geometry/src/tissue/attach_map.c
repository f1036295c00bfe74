#include "geometry/attach_map.h"
#include "geometry/mem.h"
#include <stdlib.h>

attach_map attach_map_new(int32_t node_count, int32_t pair_count)
{
    attach_map a = {.node_count = node_count,
                    .kind = NEW_ARRAY(uint8_t, node_count),
                    .segment = NEW_ARRAY(int32_t, node_count),
                    .normal = NEW_ARRAY(double, 3 * (size_t)node_count),
                    .pair_count = pair_count,
                    .pair = NEW_ARRAY(int32_t, 2 * (size_t)pair_count),
                    .pair_normal = NEW_ARRAY(double, 3 * (size_t)pair_count)};
    for (int32_t v = 0; v < node_count; v++) a.segment[v] = -1;
    return a;
}

void attach_map_free(attach_map *a)
{
    free(a->kind);
    free(a->segment);
    free(a->normal);
    free(a->shift_mm);
    free(a->pair);
    free(a->pair_normal);
    *a = (attach_map){0};
}
