#include "app/planner/identity/fit_state.h"
#include "app/planner/identity/fit_teeth.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>

static const struct {
    double edge_mm, margin_mm, soft_mm, stiff_mm, reach_first_mm, reach_mm;
    int stages, rounds;
} whole = {16, 8, 300, 8, 30, 12, 4, 4}, bone = {8, 0, 30, 0.5, 14, 6, 4, 3};

static bool is_stopped(void *watch) { return task_interrupted(watch); }

static registration_params stages(const fit_state *f, int count, int rounds, double soft_mm, double stiff_mm)
{
    registration_params p = registration_params_default();
    p.stages = count;
    p.rounds = rounds;
    p.soft_mm = soft_mm;
    p.stiff_mm = stiff_mm;
    p.interrupted = is_stopped;
    p.context = (void *)f->watch;
    return p;
}

bool fit_bend(fit_state *f, err *e)
{
    fit_lattice l = {.edge_mm = whole.edge_mm,
                     .margin_mm = whole.margin_mm,
                     .how = stages(f, whole.stages, whole.rounds, whole.soft_mm, whole.stiff_mm),
                     .points = f->nodes,
                     .point_count = f->t->tissue.mesh.vertex_count};
    l.how.reach_first_mm = whole.reach_first_mm;
    l.how.reach_mm = whole.reach_mm;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        if (!f->at[p].triangle_count) continue;
        l.moved[l.part_count] = &f->at[p];
        l.target[l.part_count] = f->target[p];
        l.weight[l.part_count++] = 1;
    }
    return fit_lattice_draw(&l, &f->cost, e);
}

static bool fit_bone(fit_state *f, case_surface which, case_surface teeth, err *e)
{
    /* crowns that are no part of their own are part of the bone's surface */
    const target_surface *crowns = f->target[teeth] ? f->target[teeth] : f->target[which];
    fit_lattice l = {.edge_mm = bone.edge_mm,
                     .margin_mm = bone.margin_mm,
                     .how = stages(f, bone.stages, bone.rounds, bone.soft_mm, bone.stiff_mm),
                     .part_count = 2,
                     .moved = {&f->at[which], &f->at[teeth]},
                     .target = {f->target[which], crowns},
                     .weight = {1, 1},
                     .mute = {NULL, f->buried[teeth]}};
    l.how.reach_first_mm = bone.reach_first_mm;
    l.how.reach_mm = bone.reach_mm;
    if (f->target[which] && !fit_lattice_draw(&l, &f->cost, e)) return false;
    fit_teeth(&f->t->part[teeth], f->t->tooth[teeth], f->buried[teeth], crowns, &f->at[teeth]);
    return true;
}

uint8_t *fit_buried(const surface *teeth, const surface *jaw)
{
    static const double cover_mm = 0.5; /* above the bone's surface, gum or socket */
    static const target_rules any = {HUGE_VAL, -2};
    uint8_t *buried = NEW_ARRAY(uint8_t, teeth->vertex_count);
    target_surface *near = target_surface_make(jaw);
    for (size_t v = 0; v < (size_t)teeth->vertex_count; v++) {
        target_point hit;
        double off[3];
        if (target_surface_ask(near, teeth->xyz + 3 * v, NULL, &any, &hit) == HUGE_VAL) continue;
        vec_sub(teeth->xyz + 3 * v, hit.at, off);
        buried[v] = vec_dot(off, hit.normal) < cover_mm;
    }
    target_surface_free(&near);
    return buried;
}

bool fit_bones(fit_state *f, err *e)
{
    return fit_bone(f, CASE_SKULL, CASE_UPPER_TEETH, e) && fit_bone(f, CASE_MANDIBLE, CASE_LOWER_TEETH, e);
}
