#include "app/planner/identity/head_jaw.h"
#include "app/planner/identity/fit_state.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/similarity.h"
#include "geometry/tet_volume.h"
#include "geometry/vec.h"
#include "sim/equilibrium.h"
#include <stdlib.h>
#include <string.h>

static const double young_kpa = 15, poisson = 0.45; /* as of a case */
static const double lip_reach_mm = 6, lip_stiffness_mn_mm = 100;
static const double thin_j = 0.1; /* of a tet's volume */
enum { GIVE_MOST = 6 };

static bool is_jaw(int32_t segment)
{
    return segment == SEGMENT_DISTAL || segment == SEGMENT_PROXIMAL_LEFT || segment == SEGMENT_PROXIMAL_RIGHT ||
           segment == SEGMENT_CHIN;
}

/* As in the template, turned with the head; lips are free. */
static attach_map attached(const head_template *t, const head_shape *s)
{
    const attach_map *from = &t->tissue.attach;
    size_t nodes = (size_t)t->tissue.mesh.vertex_count;
    attach_map a = attach_map_new((int32_t)nodes, 0);
    similarity way;
    similarity_of_pairs(t->tissue.mesh.xyz, s->neutral, NULL, (int32_t)nodes, true, &way);
    memcpy(a.kind, from->kind, nodes * sizeof *a.kind);
    memcpy(a.segment, from->segment, nodes * sizeof *a.segment);
    for (size_t v = 0; v < nodes; v++) rigid_rotate(&way.motion, from->normal + 3 * v, a.normal + 3 * v);
    return a;
}

/* Draws both nodes of each facing pair that is near to its middle. */
static targets lips_together(const head_template *t, const double *x)
{
    const tetmesh *m = &t->tissue.mesh;
    const attach_map *a = &t->tissue.attach;
    targets out = targets_new(2 * a->pair_count);
    int32_t *tet = NEW_ARRAY(int32_t, m->vertex_count);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) tet[m->tet[i]] = (int32_t)(i / 4);
    for (size_t i = 0; i < 2 * (size_t)a->pair_count; i++) {
        size_t v = (size_t)a->pair[i], other = (size_t)a->pair[i ^ 1];
        out.tet[i] = tet[v];
        for (size_t k = 0; k < 4; k++) out.weight[4 * i + k] = m->tet[4 * (size_t)tet[v] + k] == (int32_t)v;
        for (size_t k = 0; k < 3; k++) out.place[3 * i + k] = 0.5 * (x[3 * v + k] + x[3 * other + k]);
        out.normal[3 * i] = out.across[i] = 1;
        out.stiffness[i] = vec_distance(x + 3 * v, x + 3 * other) < lip_reach_mm ? lip_stiffness_mn_mm : 0;
    }
    free(tet);
    return out;
}

/* Tets of less than least_j of their volume let go of the bones, and of the other lip; returns how many are. */
static int32_t let_go(const tetmesh *m, const double *x, double least_j, attach_map *a, targets *lips)
{
    int32_t count = 0;
    uint8_t *thin = NEW_ARRAY(uint8_t, m->vertex_count);
    for (size_t i = 0; i < (size_t)m->tet_count; i++) {
        const int32_t *v = m->tet + 4 * i;
        if (tet_j(m, x, (int32_t)i) > least_j) continue;
        count++;
        for (int k = 0; k < 4; k++) thin[v[k]] = 1;
    }
    for (size_t v = 0; v < (size_t)m->vertex_count; v++) {
        if (!thin[v]) continue;
        a->kind[v] = NODE_FREE;
        a->segment[v] = -1;
    }
    for (size_t i = 0; lips && i < (size_t)lips->count; i++)
        for (size_t k = 0; k < 4; k++)
            if (lips->weight[4 * i + k] > 0 && thin[m->tet[4 * (size_t)lips->tet[i] + k]]) lips->stiffness[i] = 0;
    free(thin);
    return count;
}

/* Into x. Where tissue between two bones, or lips, would be pressed flat it gives way and all is solved again. */
static bool solve(equilibrium_problem *p, attach_map *a, targets *lips, double *x, err *e)
{
    p->targets = lips;
    for (int k = 0; k <= GIVE_MOST; k++) {
        solve_params params = solve_params_default();
        equilibrium q = {0};
        if (!equilibrium_solve(p, &params, &q, e)) return false;
        solve_outcome outcome = q.outcome;
        memcpy(x, q.xyz, 3 * (size_t)q.node_count * sizeof *x);
        equilibrium_free(&q);
        if (outcome != SOLVED) return err_set(e, ERR_NOT_CONVERGED, "%s", solve_outcome_text(outcome));
        if (!let_go(p->mesh, x, thin_j, a, lips)) return true;
    }
    int32_t inverted = let_go(p->mesh, x, 0, a, lips);
    return !inverted || err_set(e, ERR_NOT_CONVERGED, "%d tets of the tissue are turned inside out", inverted);
}

static bool move_tissue(const head_template *t, const rigid *motion, const head_shape *s, double *x, err *e)
{
    region_material flesh = {.region = REGION_ANY};
    if (!material_make(MATERIAL_SNH_LOG, young_kpa, poisson, &flesh.material, e) ||
        !element_choose(&flesh.material, ELEMENT_AUTO, e))
        return false;
    tetmesh m = t->tissue.mesh; /* its tets, at the shape's places */
    m.xyz = s->neutral;
    attach_map a = attached(t, s);
    equilibrium_problem problem = {.mesh = &m, .attach = &a, .materials = &flesh, .material_count = 1};
    for (int k = 0; k < SEGMENT_COUNT; k++) problem.motion[k] = is_jaw(k) ? *motion : rigid_identity();
    bool ok = solve(&problem, &a, NULL, x, e);
    if (ok) {
        targets lips = lips_together(t, x);
        problem.start_xyz = x;
        ok = solve(&problem, &a, &lips, x, e);
        targets_free(&lips);
    }
    attach_map_free(&a);
    return ok || err_prefix(e, "turning the mandible");
}

/* known[3*vertices] where the skin goes: what hangs on the tissue goes with it; of the rest, what lies nearer to the
 * skull stays, and what lies nearer to the mandible is not known, NAN. */
static void know_skin(const head_template *t, const head_shape *s, const double *after, double *known)
{
    size_t n = 3 * (size_t)t->tissue.mesh.vertex_count;
    const double *xyz = s->part[CASE_SKIN];
    double *u = NEW_ARRAY(double, n);
    distance_tree *bone[2];
    for (int k = 0; k < 2; k++) {
        surface one = head_part(t, s, k ? CASE_MANDIBLE : CASE_SKULL);
        bone[k] = distance_tree_make(&one);
        surface_free(&one);
    }
    for (size_t i = 0; i < n; i++) u[i] = after[i] - s->neutral[i];
    embedding_apply(&t->skin_on_tissue, &t->tissue.mesh, u, xyz, known);
    for (size_t v = 0; v < (size_t)t->part[CASE_SKIN].vertex_count; v++) {
        if (t->skin_on_tissue.tet[v] >= 0) continue;
        bool stays = distance_tree_to(bone[0], xyz + 3 * v, NULL) < distance_tree_to(bone[1], xyz + 3 * v, NULL);
        for (size_t k = 3 * v; k < 3 * v + 3; k++) known[k] = stays ? xyz[k] : (double)NAN;
    }
    for (int k = 0; k < 2; k++) distance_tree_free(&bone[k]);
    free(u);
}

/* What is not known follows as an elastic body. */
static bool move_skin(const head_template *t, const double *after, head_shape *s, err *e)
{
    surface skin = head_part(t, s, CASE_SKIN);
    size_t count = 3 * (size_t)skin.vertex_count;
    double *known = NEW_ARRAY(double, count), *xyz = s->part[CASE_SKIN];
    fit_cost cost = {0};
    know_skin(t, s, after, known);
    fit_lattice l = {.edge_mm = 12,
                     .how = registration_params_default(),
                     .part_count = 1,
                     .moved = {&skin},
                     .weight = {1},
                     .fixed = known};
    bool ok = fit_lattice_draw(&l, &cost, e);
    for (size_t i = 0; ok && i < count; i++) xyz[i] = isnan(known[i]) ? skin.xyz[i] : known[i];
    surface_free(&skin);
    free(known);
    return ok;
}

bool head_jaw_turn(const head_template *t, const rigid *motion, head_shape *s, err *e)
{
    size_t nodes = 3 * (size_t)t->tissue.mesh.vertex_count;
    double *x = COPY_ARRAY(double, s->neutral, nodes);
    bool ok = move_tissue(t, motion, s, x, e) && move_skin(t, x, s, e);
    if (ok) {
        memcpy(s->neutral, x, nodes * sizeof *x);
        fit_rest(t, s->neutral, s->rest);
        static const case_surface moved[] = {CASE_MANDIBLE, CASE_LOWER_TEETH};
        for (int k = 0; k < 2; k++)
            for (size_t v = 0; v < (size_t)t->part[moved[k]].vertex_count; v++)
                rigid_apply(motion, s->part[moved[k]] + 3 * v, s->part[moved[k]] + 3 * v);
    }
    free(x);
    return ok;
}
