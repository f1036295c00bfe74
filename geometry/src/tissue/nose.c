#include "geometry/nose.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>

nose_params nose_params_default(void) { return (nose_params){.dorsum_mm = 4, .tip_mm = 8, .foot_mm = 5}; }

static const double opening_mm = 12; /* the rim of the nasal opening lies so far behind the spine, at most */

/* The midplane through N, ANS and Pn, the line from the spine to the septal angle, and what lies around. */
typedef struct place {
    double spine[3], nasion[3];
    double left[3];  /* unit, across the midplane */
    double angle[3]; /* septal angle */
    const nearest *skin, *maxilla;
    rigid back; /* undoes the maxilla's move */
} place;

static bool find_place(const landmarks *l, const nose_params *p, place *w)
{
    const landmark *n = landmarks_find(l, "N"), *ans = landmarks_find(l, "ANS"), *pn = landmarks_find(l, "Pn");
    if (!n || !ans || !pn) return false;
    double up[3], forward[3], middle[3], in[3];
    vec_copy(ans->xyz, w->spine);
    vec_copy(n->xyz, w->nasion);
    vec_sub(n->xyz, ans->xyz, up);
    vec_sub(pn->xyz, ans->xyz, forward);
    vec_cross(up, forward, w->left); /* up x forward = left */
    if (!(vec_normalize(w->left) > 0)) return false;
    for (int c = 0; c < 3; c++) middle[c] = (n->xyz[c] + ans->xyz[c]) / 2;
    vec_sub(middle, pn->xyz, in);
    vec_normalize(in);
    vec_axpy(pn->xyz, p->tip_mm, in, w->angle);
    return true;
}

/* How far above the line from the spine to the septal angle, in the midplane. */
static double above_base(const place *w, const double x[3])
{
    double along[3], normal[3], d[3];
    vec_sub(w->angle, w->spine, along);
    vec_cross(along, w->left, normal); /* forward x left = up */
    vec_normalize(normal);
    vec_sub(x, w->spine, d);
    return vec_dot(d, normal);
}

/* Below the nasion, above the base and in the nose: not behind it, in nasal cavity or mouth. */
static bool in_borders(const place *w, const double x[3])
{
    double axis[3], forward[3], d[3];
    vec_sub(w->nasion, w->spine, axis);
    double length = vec_normalize(axis);
    vec_cross(w->left, axis, forward); /* left x up = forward */
    vec_sub(x, w->spine, d);
    return above_base(w, x) > 0 && vec_dot(d, axis) < length && vec_dot(d, forward) > -opening_mm;
}

/* To the maxilla where it was and where the plan puts it: the septum's foot is trimmed to make room for it.
 */
static double gap_to_maxilla(const place *w, const double x[3])
{
    double before[3];
    if (!w->maxilla) return HUGE_VAL;
    rigid_apply(&w->back, x, before);
    return fmin(nearest_point(w->maxilla, x, NULL, NULL), nearest_point(w->maxilla, before, NULL, NULL));
}

/* The midplane cuts the tet within the septum's borders. */
static bool in_septum(const place *w, const tetmesh *m, int32_t t, const nose_params *p)
{
    double centre[3] = {0}, low = HUGE_VAL, high = -HUGE_VAL, gap = HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        double d[3];
        const double *x = m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)k];
        vec_axpy(centre, 0.25, x, centre);
        vec_sub(x, w->spine, d);
        low = fmin(low, vec_dot(d, w->left));
        high = fmax(high, vec_dot(d, w->left));
    }
    if (low > 0 || high < 0 || !in_borders(w, centre)) return false;
    if (!(nearest_point(w->skin, centre, NULL, NULL) > p->dorsum_mm)) return false;
    for (int k = 0; k < 4; k++)
        gap = fmin(gap, gap_to_maxilla(w, m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)k]));
    return gap > p->foot_mm;
}

static void mark(const tissue *t, const place *w, const nose_params *p, nose *n)
{
    const tetmesh *m = &t->mesh;
    uint8_t *septum = NEW_ARRAY(uint8_t, m->vertex_count);
    for (int32_t i = 0; i < m->tet_count; i++) {
        if (!in_septum(w, m, i, p)) continue;
        n->region[i] = REGION_SEPTUM;
        n->septum_tets++;
        for (int k = 0; k < 4; k++) septum[m->tet[4 * (size_t)i + (size_t)k]] = 1;
    }
    for (int32_t i = 0; i < 2 * t->attach.pair_count; i++) septum[t->attach.pair[i]] = 0; /* lips hang on no bone */
    n->anchor = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (septum[v] && t->side[v] == SIDE_HOLE && gap_to_maxilla(w, m->xyz + 3 * (size_t)v) > 2 * p->foot_mm)
            n->anchor[n->anchors++] = v;
    free(septum);
}

bool nose_make(const tissue *t, const segment_trees *at_rest, const rigid *maxilla_move, const landmarks *l,
               const nose_params *p, nose *out)
{
    place w = {.back = rigid_inverse(maxilla_move), .skin = at_rest->skin, .maxilla = at_rest->part[SEGMENT_MAXILLA]};
    if (!find_place(l, p, &w)) return false;
    nose n = {.region = COPY_ARRAY(int32_t, t->mesh.region, t->mesh.tet_count)};
    mark(t, &w, p, &n);
    bool found = n.septum_tets > 0 && n.anchors > 0;
    if (found)
        *out = n;
    else
        nose_free(&n);
    return found;
}

void nose_free(nose *n)
{
    free(n->region);
    free(n->anchor);
    *n = (nose){0};
}
