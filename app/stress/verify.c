/* Is what is called solved an equilibrium? Forces, volumes and places anew from the returned positions, with
 * nothing of the solver's but the materials' stress, the numbering of unknowns and (for one more Newton step)
 * the matrix. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/linear.h"
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

typedef struct check {
    const stress_case *c;
    const stress_scene *s;
    const equilibrium *q;
    stress_result *r;
    attach_map attach; /* with contact: what slides or is paired counts as free */
    uint8_t *touching; /* [nodes] such a node, with contact */
    boundary b;
    double size, moved; /* mm: of the body; longest displacement of a node */
} check;

static void fail(check *k, const char *fmt, ...) PRINTF_LIKE(2, 3);
static void fail(check *k, const char *fmt, ...)
{
    if (k->r->wrong[0]) return;
    va_list args;
    va_start(args, fmt);
    vsnprintf(k->r->wrong, sizeof k->r->wrong, fmt, args);
    va_end(args);
}

static bool take_boundary(check *k)
{
    err e = {0};
    const attach_map *a = &k->s->attach;
    k->attach = attach_map_new(a->node_count, k->s->touches ? 0 : a->pair_count);
    k->touching = NEW_ARRAY(uint8_t, a->node_count);
    memcpy(k->attach.kind, a->kind, (size_t)a->node_count);
    memcpy(k->attach.segment, a->segment, (size_t)a->node_count * sizeof *a->segment);
    memcpy(k->attach.normal, a->normal, 3 * (size_t)a->node_count * sizeof *a->normal);
    for (int32_t v = 0; k->s->touches && v < a->node_count; v++)
        if (a->kind[v] == NODE_SLIDING) {
            k->attach.kind[v] = NODE_FREE;
            k->attach.segment[v] = -1;
            k->touching[v] = 1;
        }
    for (int32_t i = 0; i < k->s->contact.extra_count; i++) k->touching[k->s->contact.extra[i]] = 1;
    for (int32_t i = 0; i < 2 * a->pair_count; i++)
        if (k->s->touches)
            k->touching[a->pair[i]] = 1;
        else
            k->attach.pair[i] = a->pair[i];
    if (!k->s->touches) memcpy(k->attach.pair_normal, a->pair_normal, 3 * (size_t)a->pair_count * sizeof(double));
    if (!boundary_make(&k->s->mesh, &k->attach, &k->b, &e)) {
        fail(k, "solved, but its boundary is refused: %.150s", e.text);
        return false;
    }
    boundary_move(&k->b, &k->s->mesh, &k->attach, k->s->motion);
    return true;
}

static void check_places(check *k)
{
    const double *x = k->q->xyz;
    double off = 0, *z = NEW_ARRAY(double, k->b.unknown_count), *at = NEW_ARRAY(double, 3 * (size_t)k->b.node_count);
    boundary_project(&k->b, x, z);
    boundary_place(&k->b, z, at);
    for (int32_t v = 0; v < k->b.node_count; v++) off = fmax(off, vec_distance(x + 3 * (size_t)v, at + 3 * (size_t)v));
    if (!(off <= 1e-9 * (k->size + fabs(k->c->shift_mm)))) fail(k, "a node is %.2g mm off its bone", off);
    free(z);
    free(at);
}

static void check_volumes(check *k)
{
    double least = HUGE_VAL;
    int32_t inverted = 0;
    for (int32_t t = 0; t < k->s->mesh.tet_count; t++) {
        double F[9], g[12], volume, J;
        stress_deformation(&k->s->mesh, k->q->xyz, t, F, g, &volume);
        J = mat_det(F);
        least = fmin(least, J);
        inverted += !(J > 0);
    }
    double noise = 1e-6 * (1 + fabs(least));
    if (!(fabs(least - k->q->extremes.min_j) <= noise))
        fail(k, "smallest J is %.9g, not %.9g as it says", least, k->q->extremes.min_j);
    if (inverted != k->q->extremes.inverted_count && fabs(least) > noise)
        fail(k, "%d tets are inverted, not %d as it says", inverted, k->q->extremes.inverted_count);
    if (k->c->check & CHECK_UPRIGHT && inverted) fail(k, "%d tets turned inside out", inverted);
}

/* Norm of the force on the unknowns that nothing touches. */
static double residual(const check *k, double *force)
{
    double sum = 0, *g = NEW_ARRAY(double, k->b.unknown_count);
    for (int32_t v = 0; v < k->b.node_count; v++)
        if (k->touching[v]) memset(force + 3 * (size_t)v, 0, 3 * sizeof *force);
    boundary_reduce(&k->b, force, g);
    for (int32_t i = 0; i < k->b.unknown_count; i++) sum += g[i] * g[i];
    free(g);
    return sqrt(sum);
}

/* The residual that coordinates rounded once more would have, from what rounding does to the forces. */
static double rounding(const check *k, const double *force)
{
    size_t n = 3 * (size_t)k->b.node_count;
    double *x = COPY_ARRAY(double, k->q->xyz, n), *other = NEW_ARRAY(double, n);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        x[i] += DBL_EPSILON * (fabs(x[i]) + 1e-3 * k->size) * ((double)(state >> 11) / 4503599627370496.0 - 1);
    }
    stress_forces(k->s, x, other);
    for (size_t i = 0; i < n; i++) other[i] -= force[i];
    double noise = residual(k, other);
    free(x);
    free(other);
    return noise;
}

/* Frictionless contact can only push: on what touches, elasticity alone would move the surface outward. */
static void check_pressure(check *k, const double *force)
{
    int32_t *face, count = tetmesh_boundary(&k->s->mesh, &face, NULL);
    surface s = {.vertex_count = k->b.node_count, .triangle_count = count, .xyz = k->q->xyz, .tri = face};
    double *normal = surface_vertex_normals(&s), pull = 0, push = 0;
    static const double down[3] = {0, 0, -1};
    for (int32_t v = 0; v < k->b.node_count; v++) {
        if (!k->touching[v]) continue;
        const double *n = k->s->upper ? normal + 3 * (size_t)v : down; /* our bones are height fields */
        double out = vec_dot(force + 3 * (size_t)v, n);
        pull = fmax(pull, out);
        push = fmax(push, -out);
    }
    if (pull > 1e-3 * push + 2 * k->q->tolerance_mn) fail(k, "a contact pulls with %.3g mN", pull);
    free(normal);
    free(face);
}

static void check_forces(check *k)
{
    size_t n = 3 * (size_t)k->b.node_count;
    double *force = NEW_ARRAY(double, n), energy = stress_forces(k->s, k->q->xyz, force), noise = rounding(k, force);
    bool kept = k->s->contact.held && !k->s->contact.extra_count; /* what keeps in touch may be pulled */
    if (k->s->touches && !kept) check_pressure(k, force);
    k->r->checked_mn = residual(k, force);
    if (!(k->r->checked_mn <= 1.01 * k->q->tolerance_mn + 16 * noise))
        fail(k, "residual is %.3g mN, above the tolerance of %.3g", k->r->checked_mn, k->q->tolerance_mn);
    if (!k->s->touches && !(fabs(energy - k->q->energy_uj) <= 1e-6 * (fabs(energy) + noise * k->size)))
        fail(k, "energy is %.12g uJ, not %.12g as it says", energy, k->q->energy_uj);
    free(force);
}

/* A residual is small only against something: how far would one more Newton step go? */
static bool newton_step(check *k, double *longest, err *e)
{
    elements el = {0};
    assembly a = {0};
    linear *l = NULL;
    bool positive = false;
    size_t n = 3 * (size_t)k->b.node_count;
    double *force = NEW_ARRAY(double, n), *g = NEW_ARRAY(double, k->b.unknown_count);
    bool ok = elements_make(&k->s->mesh, k->s->material, k->s->material_count, &el, e) &&
              assembly_make(&k->s->mesh, &el, &k->b, NULL, 0, &a, e) &&
              linear_create(k->b.unknown_count, a.column_start, a.row, 1, &l, e);
    if (ok) {
        assembly_stiffness(&a, k->q->xyz, PROJECTION_NONE);
        assembly_matrix(&a, &k->b);
        stress_forces(k->s, k->q->xyz, force);
        boundary_reduce(&k->b, force, g);
        ok = linear_factor(l, a.value, 0, &positive, e) && (!positive || linear_solve(l, g, g, e));
    }
    *longest = positive ? 0 : (double)NAN;
    for (int32_t i = 0; positive && i < k->b.unknown_count; i++) *longest = fmax(*longest, fabs(g[i]));
    linear_destroy(&l);
    assembly_free(&a);
    elements_free(&el);
    free(force);
    free(g);
    return ok;
}

static void check_correction(check *k)
{
    err e = {0};
    if (k->s->touches || k->b.unknown_count == 0) return;
    if (!newton_step(k, &k->r->correction_mm, &e)) {
        fail(k, "no Newton step from the result: %.150s", e.text);
        return;
    }
    if (isnan(k->r->correction_mm)) { /* a saddle, or flat: an equilibrium all the same, but say so */
        snprintf(k->r->text, sizeof k->r->text, "solved (not a minimum)");
        return;
    }
    double allowed = fmax(1e-4, 100 * k->s->params.rel_tol) * k->moved + 1e-9 * (k->size + fabs(k->c->shift_mm));
    if (!(k->r->correction_mm <= allowed))
        fail(k, "one more Newton step goes %.3g mm, at %.3g mm of displacement", k->r->correction_mm, k->moved);
}

static void check_rigid(check *k)
{
    double off = 0;
    for (int32_t v = 0; v < k->b.node_count; v++) {
        double at[3];
        rigid_apply(&k->s->motion[SEGMENT_MAXILLA], k->s->mesh.xyz + 3 * (size_t)v, at);
        off = fmax(off, vec_distance(at, k->q->xyz + 3 * (size_t)v));
    }
    if (!(off <= 1e-9 * (k->size + fabs(k->c->shift_mm) + k->moved))) fail(k, "%.3g mm off the rigid motion", off);
}

static void check_scaled(check *k)
{
    stress_scene s;
    stress_case plain = *k->c;
    plain.young = 0;
    stress_scene_make(&plain, 1, &s);
    equilibrium_problem problem = stress_problem(&s);
    equilibrium q;
    err e = {0};
    double scale = k->c->scale > 0 ? k->c->scale : 1, off = 0, moved = 0;
    if (!equilibrium_solve(&problem, &s.params, &q, &e) || q.outcome != SOLVED) {
        fail(k, "solved, but not at scale 1");
    } else {
        for (int32_t i = 0; i < 3 * q.node_count; i++) {
            double u = q.xyz[i] - s.mesh.xyz[i], U = (k->q->xyz[i] - k->s->mesh.xyz[i]) / scale;
            off = fmax(off, fabs(U - u));
            moved = fmax(moved, fabs(u));
        }
        if (!(off <= 1e-6 * moved)) fail(k, "differs by %.3g of its moves from scale 1", off / moved);
        equilibrium_free(&q);
    }
    stress_scene_free(&s);
}

static void check_above(check *k)
{
    double deepest = -HUGE_VAL, limit = k->s->contact.params.depth_limit_mm + k->c->slack_mm;
    for (int32_t v = 0; v < k->b.node_count; v++)
        if (k->touching[v]) deepest = fmax(deepest, stress_depth(&k->s->bone, k->q->xyz + 3 * (size_t)v));
    if (deepest > limit) fail(k, "a node is %.3g mm below the surface, %.3g allowed", deepest, limit);
}

void stress_verify(const stress_case *c, const stress_scene *s, const equilibrium *q, stress_result *r)
{
    double low[3], high[3];
    surface cloud = {.vertex_count = s->mesh.vertex_count, .xyz = s->mesh.xyz};
    surface_bounds(&cloud, low, high);
    check k = {.c = c, .s = s, .q = q, .r = r, .size = vec_distance(low, high)};
    for (int32_t i = 0; i < 3 * q->node_count; i++)
        if (!isfinite(q->xyz[i])) fail(&k, "coordinate %d of node %d is not a number", i % 3, i / 3);
    if (isnan(q->energy_uj) || isnan(q->residual_mn) || (q->outcome == SOLVED && isinf(q->energy_uj)))
        fail(&k, "energy or residual is not a number");
    for (int32_t v = 0; v < q->node_count; v++)
        k.moved = fmax(k.moved, vec_distance(q->xyz + 3 * (size_t)v, s->mesh.xyz + 3 * (size_t)v));
    r->moved_mm = k.moved;
    if (q->outcome == SOLVED && !r->wrong[0]) {
        if (q->load_reached < 1 || q->residual_mn > q->tolerance_mn) fail(&k, "its own record contradicts it");
        if (take_boundary(&k)) {
            check_places(&k);
            check_volumes(&k);
            check_forces(&k);
            check_correction(&k);
            if (c->check & CHECK_STILL && k.moved > 0) fail(&k, "a node moved by %.3g mm", k.moved);
            if (c->check & CHECK_RIGID) check_rigid(&k);
            if (c->check & CHECK_SCALED) check_scaled(&k);
            if (c->check & CHECK_ABOVE) check_above(&k);
            boundary_free(&k.b);
        }
    }
    attach_map_free(&k.attach);
    free(k.touching);
}
