/* The way of each step: conjugate gradients, or factors. */
#include "sim/src/solve/descent.h"

enum {
    GRADIENTS_FROM = 30000, /* unknowns; measured: on irregular meshes below, factors are no slower */
    FACTORS_UP_TO = 400000  /* unknowns: 6 GB */
};

step_way step_first_way(const descent *d)
{
    linear_kind kind = d->params->linear;
    if (kind == LINEAR_AUTO) return d->t->b.unknown_count >= GRADIENTS_FROM ? BY_GRADIENTS : BY_FACTORS;
    return kind == LINEAR_GRADIENTS ? BY_GRADIENTS : BY_FACTORS;
}

void step_expect_contact(descent *d)
{
    /* contact changes the matrix too much from step to step for a preconditioner to last */
    if (d->params->linear == LINEAR_AUTO && d->t->b.unknown_count <= FACTORS_UP_TO) d->load.way = BY_FACTORS;
}

/* Where tissue buckles, gradients crawl, and factors, though each costs n/500 iterations, are the way on. */
static bool have_crawled(const descent *d)
{
    int64_t n = d->t->b.unknown_count;
    return n <= FACTORS_UP_TO && d->load.cg_iterations > 300 + n / 50;
}

/* With the true matrix, then with the projected one, unless that has no preconditioner. */
static bool by_gradients(descent *d, step_taken *s, err *e)
{
    static const hessian_kind kind[] = {HESSIAN_TRUE, HESSIAN_PROJECTED};
    for (int i = 0; i < 2; i++) {
        bool ok = true;
        s->kind = kind[i];
        if (!inexact_direction(d, s, &ok, e)) return false;
        s->length = ok ? point_line_search(d) : 0;
        d->load.was_cut = s->length < 1;
        if (s->length > 0 || !ok || s->kind != HESSIAN_TRUE) return true;
    }
    return true;
}

static hessian_kind safer(hessian_kind kind)
{
    switch (kind) {
    case HESSIAN_REUSED: return HESSIAN_TRUE;
    case HESSIAN_TRUE:
    case HESSIAN_BLENDED: return HESSIAN_PROJECTED;
    case HESSIAN_PROJECTED:
    case HESSIAN_SHIFTED: break;
    }
    return HESSIAN_SHIFTED;
}

/* A direction that leads nowhere is tried again with a safer matrix. */
static bool by_factors(descent *d, step_taken *s, bool *ok, err *e)
{
    *ok = true;
    for (s->kind = direct_reusable(d) ? HESSIAN_REUSED : HESSIAN_TRUE;; s->kind = safer(s->kind)) {
        if (s->kind != HESSIAN_REUSED && !direct_factorise(d, d->here.x, &s->kind, ok, &s->factor_s, e)) return false;
        if (!*ok) return true;
        if (!direct_direction(d, e)) return false;
        s->length = point_line_search(d);
        if (s->length > 0 || s->kind == HESSIAN_SHIFTED) return true;
    }
}

bool step_take(descent *d, step_taken *s, bool *ok, err *e)
{
    if (have_crawled(d)) d->load.way = BY_FACTORS;
    if (d->load.way == BY_GRADIENTS) {
        if (!by_gradients(d, s, e)) return false;
        *ok = true;
        if (s->length > 0) return true;
        d->load.way = BY_FACTORS; /* gradients get nowhere */
        if (d->t->b.unknown_count > FACTORS_UP_TO) {
            *ok = false;
            return true;
        }
    }
    return by_factors(d, s, ok, e);
}
