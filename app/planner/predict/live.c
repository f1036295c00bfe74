#include "app/planner/predict/live.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/solver.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double near_mm = 5;       /* a plan whose bones are nearer to the last one's goes on from there */
static const double watch_more_mm = 2; /* contacts are made for bones that go on by half of it */

/* What the solver stands on. */
typedef struct ground {
    tetmesh mesh;    /* the prepared one, with `region` */
    int32_t *region; /* [tets] */
    attach_map attach;
    region_material material[2];
    int32_t material_count;
    plan_contact touch;
    plan_moves moves; /* for which touch was made */
} ground;

struct live {
    const case_file *patient;
    const prepared *prepared;
    const bone_shapes *shapes;
    bone_shapes own_shapes;
    prediction_options options;
    bool repeatable;
    ground *ground;
    solver *t;        /* NULL: no plan yet */
    double *xyz;      /* [3*nodes] the last solution, NULL: none */
    plan_moves moves; /* its */
};

bool live_create(const case_file *c, const prepared *p, const bone_shapes *shapes, const prediction_options *options,
                 bool repeatable, live **out, err *e)
{
    live *l = NEW_ARRAY(live, 1);
    l->patient = c;
    l->prepared = p;
    l->options = *options;
    l->options.full = true;
    l->options.watch_more_mm = watch_more_mm;
    l->repeatable = repeatable;
    l->shapes = shapes;
    if (!shapes) {
        if (!bone_shapes_make(p, &l->own_shapes, e)) {
            free(l);
            return false;
        }
        l->shapes = &l->own_shapes;
    }
    *out = l;
    return true;
}

static void ground_free(ground **g)
{
    if (!*g) return;
    plan_contact_free(&(*g)->touch);
    attach_map_free(&(*g)->attach);
    free((*g)->region);
    free(*g);
    *g = NULL;
}

void live_free(live **l)
{
    if (!*l) return;
    solver_destroy(&(*l)->t);
    ground_free(&(*l)->ground);
    bone_shapes_free(&(*l)->own_shapes);
    free((*l)->xyz);
    free(*l);
    *l = NULL;
}

/* Of the flesh as the plan meets it; touch is taken over from the setup. */
static ground *ground_new(const plan_tissue *flesh, const plan_moves *moves, prediction_setup *setup)
{
    const attach_map *a = &flesh->attach;
    size_t n = (size_t)a->node_count, pairs = (size_t)a->pair_count;
    ground *g = NEW_ARRAY(ground, 1);
    g->region = COPY_ARRAY(int32_t, flesh->mesh.region, flesh->mesh.tet_count);
    g->mesh = flesh->mesh;
    g->mesh.region = g->region;
    g->attach = attach_map_new(a->node_count, a->pair_count);
    memcpy(g->attach.kind, a->kind, n * sizeof *a->kind);
    memcpy(g->attach.segment, a->segment, n * sizeof *a->segment);
    memcpy(g->attach.normal, a->normal, 3 * n * sizeof *a->normal);
    if (a->shift_mm) g->attach.shift_mm = COPY_ARRAY(double, a->shift_mm, n);
    memcpy(g->attach.pair, a->pair, 2 * pairs * sizeof *a->pair);
    memcpy(g->attach.pair_normal, a->pair_normal, 3 * pairs * sizeof *a->pair_normal);
    memcpy(g->material, flesh->material, sizeof g->material);
    g->material_count = flesh->material_count;
    g->moves = *moves;
    g->touch = setup->touch;
    setup->touch = (plan_contact){0};
    return g;
}

/* The farthest that a bone goes from one plan to the other, where the tissue is. */
static double way_between(const prepared *p, const plan_moves *a, const plan_moves *b)
{
    double farthest = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        for (int32_t v = 0; v < p->segments.part[s].vertex_count; v++) {
            double from[3], to[3];
            rigid_apply(&a->move[s], p->segments.part[s].xyz + 3 * (size_t)v, from);
            rigid_apply(&b->move[s], p->segments.part[s].xyz + 3 * (size_t)v, to);
            farthest = fmax(farthest, vec_distance(from, to));
        }
    return farthest;
}

/* Would its solver be the same? How far sliding nodes lie off their places is read anew for each plan. */
static bool ground_fits(const ground *g, const plan_tissue *flesh)
{
    const attach_map *a = &g->attach, *b = &flesh->attach;
    size_t n = (size_t)a->node_count, pairs = (size_t)a->pair_count;
    return a->pair_count == b->pair_count && g->material_count == flesh->material_count &&
           !a->shift_mm == !b->shift_mm && !memcmp(a->kind, b->kind, n * sizeof *a->kind) &&
           !memcmp(a->segment, b->segment, n * sizeof *a->segment) &&
           !memcmp(a->normal, b->normal, 3 * n * sizeof *a->normal) &&
           !memcmp(a->pair, b->pair, 2 * pairs * sizeof *a->pair) &&
           !memcmp(a->pair_normal, b->pair_normal, 3 * pairs * sizeof *a->pair_normal) &&
           !memcmp(g->region, flesh->mesh.region, (size_t)g->mesh.tet_count * sizeof *g->region);
}

/* The solver for this flesh. */
static bool get_solver(live *l, const plan_tissue *flesh, const plan_moves *moves, prediction_setup *setup, err *e)
{
    bool touch = l->options.contact != CONTACT_OFF;
    if (l->t && ground_fits(l->ground, flesh) &&
        !(touch && way_between(l->prepared, &l->ground->moves, moves) > watch_more_mm / 2)) {
        if (flesh->attach.shift_mm)
            memcpy(l->ground->attach.shift_mm, flesh->attach.shift_mm,
                   (size_t)flesh->attach.node_count * sizeof(double));
        return true;
    }
    solver *t = NULL;
    ground *g = ground_new(flesh, moves, setup);
    equilibrium_problem problem = {.mesh = &g->mesh,
                                   .attach = &g->attach,
                                   .materials = g->material,
                                   .material_count = g->material_count,
                                   .contact = touch ? &g->touch.setup : NULL};
    if (!solver_create(&problem, setup->params.blas_threads, &t, e)) {
        ground_free(&g);
        return false;
    }
    if (l->t && !l->repeatable) solver_inherit(t, l->t);
    solver_destroy(&l->t);
    ground_free(&l->ground);
    l->t = t;
    l->ground = g;
    return true;
}

static bool solve(live *l, const plan_moves *moves, const double *start_xyz, const prediction_setup *setup,
                  equilibrium *out, err *e)
{
    if (l->repeatable) solver_forget(l->t);
    if (!start_xyz && l->xyz && way_between(l->prepared, &l->moves, moves) <= near_mm)
        return solver_follow(l->t, l->moves.move, moves->move, l->xyz, &setup->params, out, e);
    return solver_solve(l->t, moves->move, start_xyz, &setup->params, out, e);
}

static void keep_solution(live *l, const plan_moves *moves, const equilibrium *q)
{
    free(l->xyz);
    l->xyz = COPY_ARRAY(double, q->xyz, 3 * (size_t)q->node_count);
    l->moves = *moves;
}

/* Nothing is left out. */
static scene_report report_all(const prepared *p, double tolerance_mm)
{
    return (scene_report){.full = true,
                          .tolerance_mm = tolerance_mm,
                          .rounds = 1,
                          .nodes = p->tissue.mesh.vertex_count,
                          .tets = p->tissue.mesh.tet_count,
                          .error = NEW_ARRAY(double, 3 * (size_t)p->tissue.mesh.vertex_count)};
}

bool live_predict(live *l, const plan_moves *moves, const double *start_xyz, const judgement *bones, const task *watch,
                  prediction *out, err *e)
{
    prediction_setup setup;
    prediction_options options = l->options;
    options.bones = bones;
    bool ok = prediction_begin(l->patient, l->prepared, l->shapes, moves, &options, watch, out, &setup, e) &&
              get_solver(l, &out->flesh, moves, &setup, e);
    clock_span begin = clock_now();
    ok = ok && solve(l, moves, start_xyz, &setup, &out->solve, e);
    out->solve_span = clock_lap(&begin);
    prediction_setup_free(&setup);
    if (ok) {
        out->scene = report_all(l->prepared, options.scene_mm);
        ok = prediction_end(l->patient, l->prepared, l->shapes, moves, &options, out, e);
    }
    if (ok && out->solve.outcome == SOLVED && !l->repeatable) keep_solution(l, moves, &out->solve);
    if (!ok) prediction_free(out);
    return ok;
}
