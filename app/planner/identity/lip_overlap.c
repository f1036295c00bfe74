#include "app/planner/identity/lip_overlap.h"
#include "geometry/mem.h"
#include "sim/equilibrium.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The specification says "slight" and gives no number. Chosen: 0.2 mm of each lip, 2 % of its height of some 10 mm. */
const double lip_overlap_mm = 0.4;

static double bump(double far) { return far < 1 ? (1 - far * far) * (1 - far * far) : 0; }

/* 1 in the middle of the mouth in front, 0 at its corners and as far behind, flat at both: tissue also faces tissue
 * behind the teeth, where no lip is. */
static double share(const lip_sheet *s, const double p[3], double front_mm)
{
    double local[3], middle = s->x[1];
    head_frame_to_local(&s->frame, p, local);
    double half = local[0] > middle ? s->x[2] - middle : middle - s->x[0];
    return bump(fabs(local[0] - middle) / half) * bump((local[1] - front_mm) / half);
}

static double foremost(const tissue *t)
{
    double front = HUGE_VAL, local[3];
    for (size_t i = 0; i < 2 * (size_t)t->attach.pair_count; i++) {
        head_frame_to_local(&t->lips.frame, t->mesh.xyz + 3 * (size_t)t->attach.pair[i], local);
        front = fmin(front, local[1]);
    }
    return front;
}

/* The facing nodes slide in planes across their normal, moved by half the overlap. */
static attach_map pressed(const tissue *t)
{
    attach_map a = attach_map_new(t->mesh.vertex_count, 0);
    const attach_map *from = &t->attach;
    size_t nodes = (size_t)t->mesh.vertex_count;
    memcpy(a.kind, from->kind, nodes);
    memcpy(a.segment, from->segment, nodes * sizeof *a.segment);
    memcpy(a.normal, from->normal, 3 * nodes * sizeof *a.normal);
    a.shift_mm = NEW_ARRAY(double, nodes);
    double front = foremost(t);
    for (int32_t i = 0; i < from->pair_count; i++)
        for (int low = 0; low < 2; low++) {
            size_t v = (size_t)from->pair[2 * i + low];
            a.kind[v] = NODE_SLIDING;
            a.segment[v] = SEGMENT_CRANIUM;
            memcpy(a.normal + 3 * v, from->pair_normal + 3 * (size_t)i, 3 * sizeof *a.normal);
            a.shift_mm[v] = (low ? 0.5 : -0.5) * lip_overlap_mm * share(&t->lips, t->mesh.xyz + 3 * v, front);
        }
    return a;
}

bool lip_overlap(const tissue *t, double young_kpa, double poisson, double *rest, err *e)
{
    if (!t->attach.pair_count) return err_set(e, ERR_INPUT, "the tissue has no lips that face each other");
    region_material flesh = {.region = REGION_ANY};
    if (!material_make(MATERIAL_SNH_LOG, young_kpa, poisson, &flesh.material, e) ||
        !element_choose(&flesh.material, ELEMENT_AUTO, e))
        return false;
    attach_map a = pressed(t);
    equilibrium_problem problem = {.mesh = &t->mesh, .attach = &a, .materials = &flesh, .material_count = 1};
    for (int s = 0; s < SEGMENT_COUNT; s++) problem.motion[s] = rigid_identity();
    solve_params params = solve_params_default();
    equilibrium q = {0};
    bool ok = equilibrium_solve(&problem, &params, &q, e);
    attach_map_free(&a);
    if (!ok) return false;
    if (q.outcome != SOLVED)
        ok = err_set(e, ERR_NOT_CONVERGED, "lips pressed one into the other: %s", solve_outcome_text(q.outcome));
    else if (q.extremes.inverted_count)
        ok = err_set(e, ERR_GEOMETRY, "lips pressed one into the other turn %d tets inside out",
                     q.extremes.inverted_count);
    else
        memcpy(rest, q.xyz, 3 * (size_t)q.node_count * sizeof *rest);
    equilibrium_free(&q);
    return ok;
}
