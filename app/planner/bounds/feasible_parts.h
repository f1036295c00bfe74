/* feasible_parts: what the files of feasible_map share. */
#pragma once
#include "app/planner/bounds/feasible_map.h"

static inline int64_t node_at(const feasible_map *m, const int32_t i[3])
{
    return ((int64_t)i[2] * m->count[1] + i[1]) * m->count[0] + i[0];
}

static inline void node_index(const feasible_map *m, int64_t node, int32_t i[3])
{
    i[0] = (int32_t)(node % m->count[0]);
    i[1] = (int32_t)(node / m->count[0] % m->count[1]);
    i[2] = (int32_t)(node / m->count[0] / m->count[1]);
}

/* Marks the nodes that are behind; after all nodes have their verdict. */
bool feasible_map_look_behind(sample_set *s, feasible_map *m, err *e) MUST_CHECK;
