#include "app/bound.h"

const bound bound_default[BOUND_COUNT] = {
#define X(id, field, low, high, source) [BOUND_##id] = {#field, low, high, source},
    BOUNDS(X)
#undef X
};
