#include "geometry/src/tissue/tissue_domain.h"
#include "geometry/repair.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double grid_step_mm = 1;     /* half the finest element: trilinear error under 0.1 mm on skin */
static const double wrap_offset_mm = 0.2; /* keeps the tight wrap free of the bone's own self-touches */

static const double *need(const landmarks *l, const char *label, err *e)
{
    const landmark *p = landmarks_find(l, label);
    if (!p) err_set(e, ERR_INPUT, "landmark %s is missing: the tissue mesh needs it", label);
    return p ? p->xyz : NULL;
}

/* Stomion, or halfway between the lips of an open mouth. */
static bool find_stomion(const landmarks *l, double out[3], err *e)
{
    const landmark *closed = landmarks_find(l, "Stm"), *upper = landmarks_find(l, "Stms"),
                   *lower = landmarks_find(l, "Stmi");
    if (closed)
        vec_copy(closed->xyz, out);
    else if (upper && lower)
        for (int c = 0; c < 3; c++) out[c] = (upper->xyz[c] + lower->xyz[c]) / 2;
    else
        return err_set(e, ERR_INPUT, "landmark Stm is missing (or Stms and Stmi): the lips cannot be told apart");
    return true;
}

static void add_attractor(tissue_domain *d, const landmarks *l, const char *a, const char *b)
{
    const landmark *p = landmarks_find(l, a), *q = landmarks_find(l, b);
    if (!p || !q || d->attractors == MAX_ATTRACTORS) return;
    vec_copy(p->xyz, d->attract[d->attractors][0]);
    vec_copy(q->xyz, d->attract[d->attractors++][1]);
}

static bool place_planes_and_lips(const tissue_input *in, tissue_domain *d, err *e)
{
    const landmarks *l = in->landmarks;
    const double *nasion = need(l, "N", e), *menton = need(l, "Me", e), *corner_l = need(l, "Ch_L", e),
                 *corner_r = need(l, "Ch_R", e);
    double stomion[3], local[3];
    if (!nasion || !menton || !corner_l || !corner_r || !find_stomion(l, stomion, e)) return false;
    head_frame_to_local(&d->frame, nasion, local);
    d->brow = local[2] + d->params->brow_mm;
    head_frame_to_local(&d->frame, menton, local);
    d->neck = local[2] - d->params->neck_mm;
    d->coronal = d->params->coronal_mm;
    const double *lip[3] = {corner_r, stomion, corner_l};
    for (int k = 0; k < 3; k++) {
        head_frame_to_local(&d->frame, lip[k], local);
        d->lips.x[k] = local[0];
        d->lips.z[k] = local[2];
    }
    if (!(d->lips.x[0] + 5 < d->lips.x[1] && d->lips.x[1] + 5 < d->lips.x[2]))
        return err_set(e, ERR_INPUT, "stomion does not lie between the mouth corners Ch_R and Ch_L");
    static const char *const pairs[][2] = {
        {"Pn", "Sn"},        {"Sn", "Ls"},        {"Ls", "Stm"},       {"Stm", "Li_soft"}, {"Ls", "Stms"},
        {"Stmi", "Li_soft"}, {"Li_soft", "B'"},   {"B'", "Pg'"},       {"Pg'", "Me'"},     {"Ch_L", "Ls"},
        {"Ls", "Ch_R"},      {"Ch_L", "Li_soft"}, {"Li_soft", "Ch_R"}, {"Al_L", "Sn"},     {"Sn", "Al_R"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) add_attractor(d, l, pairs[i][0], pairs[i][1]);
    if (!d->attractors) return err_set(e, ERR_INPUT, "no landmarks of lips, nose and chin: nowhere to refine the mesh");
    return true;
}

static void find_box(const tissue_input *in, tissue_domain *d)
{
    for (int c = 0; c < 3; c++) {
        d->low[c] = HUGE_VAL;
        d->high[c] = -HUGE_VAL;
    }
    for (int32_t v = 0; v < in->skin->vertex_count; v++) {
        const double *p = in->skin->xyz + 3 * (size_t)v;
        double local[3];
        head_frame_to_local(&d->frame, p, local);
        if (local[1] > d->coronal + 5 || local[2] < d->neck - 5 || local[2] > d->brow + 5) continue;
        for (int c = 0; c < 3; c++) {
            d->low[c] = fmin(d->low[c], p[c] - 4);
            d->high[c] = fmax(d->high[c], p[c] + 4);
        }
    }
}

/* The skeleton with lids over the open underside and back of the jaw: what lies inside (tongue, floor of the mouth,
 * pharynx) is left out of the tissue. */
static surface bones_with_lids(const tissue_input *in)
{
    static const char *const rim[] = {"Me", "Go_L", "Go_R", "Co_L", "Co_R"};
    static const int32_t lid[] = {0, 2, 1, 1, 2, 4, 1, 4, 3};
    surface lids = surface_new(5, 3);
    for (int k = 0; k < 5; k++) {
        const landmark *p = landmarks_find(in->landmarks, rim[k]);
        if (!p) {
            surface_free(&lids);
            return surface_copy(in->bones);
        }
        vec_copy(p->xyz, lids.xyz + 3 * (size_t)k);
    }
    for (int i = 0; i < 9; i++) lids.tri[i] = lid[i];
    surface joined = surface_joined(in->bones, &lids);
    surface_free(&lids);
    return joined;
}

static bool make_grids(const tissue_input *in, tissue_domain *d, err *e)
{
    const tissue_params *p = d->params;
    surface lidded = bones_with_lids(in), tight = {0}, wide = {0};
    bool ok = repair_wrap(in->bones, p->detail_mm / 2, wrap_offset_mm, &tight, e) &&
              repair_wrap(&lidded, p->hole_mm / 2, 0.5, &wide, e) &&
              sdf_grid_make(in->skin, d->low, d->high, grid_step_mm, 4, &d->skin, e) &&
              sdf_grid_make(&tight, d->low, d->high, grid_step_mm, 4, &d->wrap, e) &&
              sdf_grid_make(&wide, d->low, d->high, grid_step_mm, p->collar_mm + 3, &d->span, e);
    surface_free(&lidded);
    surface_free(&tight);
    surface_free(&wide);
    return ok;
}

bool tissue_domain_make(const tissue_input *in, const tissue_params *p, tissue_domain *out, err *e)
{
    tissue_domain d = {.params = p, .frame = *in->frame, .lips.frame = *in->frame};
    if (!place_planes_and_lips(in, &d, e)) return false;
    find_box(in, &d);
    if (!(d.high[0] > d.low[0] + 20)) return err_set(e, ERR_GEOMETRY, "no skin in front of the coronal cut");
    if (!make_grids(in, &d, e)) {
        tissue_domain_free(&d);
        return false;
    }
    *out = d;
    return true;
}

void tissue_domain_free(tissue_domain *d)
{
    sdf_grid_free(&d->skin);
    sdf_grid_free(&d->wrap);
    sdf_grid_free(&d->span);
}

int tissue_domain_label(const double p[3], void *domain)
{
    const tissue_domain *d = domain;
    double local[3];
    head_frame_to_local(&d->frame, p, local);
    if (local[1] >= d->coronal || local[2] <= d->neck || local[2] >= d->brow) return 0;
    if (sdf_grid_at(&d->skin, p) >= 0 || sdf_grid_at(&d->wrap, p) <= 0) return 0;
    if (sdf_grid_at(&d->span, p) <= -d->params->collar_mm) return 0;
    return local[2] > lip_sheet_height(&d->lips, local[0]) ? REGION_UPPER : REGION_LOWER;
}

double tissue_domain_size(const double p[3], int region, void *domain)
{
    (void)region;
    const tissue_domain *d = domain;
    double nearest = HUGE_VAL;
    for (int i = 0; i < d->attractors; i++) {
        const double *a = d->attract[i][0], *b = d->attract[i][1];
        double ab[3], ap[3], at[3];
        vec_sub(b, a, ab);
        vec_sub(p, a, ap);
        double l = vec_dot(ab, ab), s = l > 0 ? fmax(0, fmin(1, vec_dot(ap, ab) / l)) : 0;
        vec_axpy(a, s, ab, at);
        nearest = fmin(nearest, vec_distance(p, at));
    }
    const double fine_reach_mm = 8; /* through the lip to the teeth */
    return fmin(d->params->coarse_mm, d->params->element_mm + d->params->growth * fmax(0, nearest - fine_reach_mm));
}

node_side tissue_domain_side(const tissue_domain *d, const double p[3])
{
    double local[3], distance[5];
    head_frame_to_local(&d->frame, p, local);
    distance[SIDE_INSIDE] = HUGE_VAL;
    distance[SIDE_SKIN] = fabs(sdf_grid_at(&d->skin, p));
    distance[SIDE_BONE] = fabs(sdf_grid_at(&d->wrap, p));
    distance[SIDE_HOLE] = fabs(sdf_grid_at(&d->span, p) + d->params->collar_mm);
    distance[SIDE_CUT] = fmin(fabs(local[1] - d->coronal), fmin(fabs(local[2] - d->neck), fabs(local[2] - d->brow)));
    int best = SIDE_SKIN;
    for (int k = SIDE_SKIN; k <= SIDE_CUT; k++)
        if (distance[k] < distance[best]) best = k;
    return (node_side)best;
}
