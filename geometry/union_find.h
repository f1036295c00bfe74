/* union_find: what belongs together, as a forest in which parent[root] is the root. */
#pragma once
#include <stdint.h>

/* Shortens the way there for the next time. */
static inline int32_t union_root(int32_t *parent, int32_t v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}
