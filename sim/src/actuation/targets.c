#include "sim/targets.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

targets targets_new(int32_t count)
{
    size_t n = (size_t)count;
    return (targets){.count = count,
                     .tet = NEW_ARRAY(int32_t, n),
                     .weight = NEW_ARRAY(double, 4 * n),
                     .place = NEW_ARRAY(double, 3 * n),
                     .normal = NEW_ARRAY(double, 3 * n),
                     .stiffness = NEW_ARRAY(double, n),
                     .across = NEW_ARRAY(double, n)};
}

void targets_free(targets *t)
{
    free(t->tet);
    free(t->weight);
    free(t->place);
    free(t->normal);
    free(t->stiffness);
    free(t->across);
    *t = (targets){0};
}

static bool check_one(const targets *t, const tetmesh *m, int32_t k, err *e)
{
    const double *w = t->weight + 4 * (size_t)k, *p = t->place + 3 * (size_t)k;
    if (t->tet[k] < 0 || t->tet[k] >= m->tet_count)
        return err_set(e, ERR_INPUT, "target %d lies in tet %d, which does not exist", k, t->tet[k]);
    if (!(fabs(w[0] + w[1] + w[2] + w[3] - 1) < 1e-6))
        return err_set(e, ERR_INPUT, "the weights of target %d do not sum to 1", k);
    if (!isfinite(p[0] + p[1] + p[2])) return err_set(e, ERR_INPUT, "the place of target %d is not finite", k);
    if (!(t->stiffness[k] >= 0 && isfinite(t->stiffness[k])))
        return err_set(e, ERR_INPUT, "the stiffness of target %d must be 0 or more, got %g", k, t->stiffness[k]);
    if (!(t->across[k] >= 0 && t->across[k] <= 1))
        return err_set(e, ERR_INPUT, "the share of target %d across its normal must lie between 0 and 1, got %g", k,
                       t->across[k]);
    if (t->stiffness[k] > 0 && !(fabs(vec_norm(t->normal + 3 * (size_t)k) - 1) < 1e-6))
        return err_set(e, ERR_INPUT, "the normal of target %d is not of length 1", k);
    return true;
}

bool targets_check(const targets *t, const tetmesh *m, err *e)
{
    for (int32_t k = 0; k < t->count; k++)
        if (!check_one(t, m, k, e)) return false;
    return true;
}

void targets_point(const targets *t, const tetmesh *m, const double *x, int32_t k, double out[3])
{
    const int32_t *tet = m->tet + 4 * (size_t)t->tet[k];
    vec_scale(x + 3 * (size_t)tet[0], t->weight[4 * (size_t)k], out);
    for (int a = 1; a < 4; a++) vec_axpy(out, t->weight[4 * (size_t)k + (size_t)a], x + 3 * (size_t)tet[a], out);
}
