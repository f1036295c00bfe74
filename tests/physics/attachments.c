/* How bones carry the tissue: tied, sliding and paired nodes, rigid motions, refusals. */
#include "tests/check.h"
#include "sim/motion.h"
#include "sim/equilibrium.h"
#include "tests/physics/evidence.h"
#include "tests/physics/lips.h"
#include <string.h>

static region_material tissue_material(void)
{
    err e = {0};
    region_material table = {REGION_ANY, {0}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, 0.47, &table.material, &e));
    return table;
}

static equilibrium solve(const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT])
{
    err e = {0};
    region_material table = tissue_material();
    equilibrium_problem problem = {.mesh = m, .attach = a, .materials = &table, .material_count = 1};
    memcpy(problem.motion, motion, sizeof problem.motion);
    solve_params params = solve_params_default();
    equilibrium q;
    assert_ok(equilibrium_solve(&problem, &params, &q, &e));
    assert_int_equal(q.outcome, SOLVED);
    assert_true(q.load_reached == 1);
    return q;
}

static const block small = {5, 4, 6, {20, 15, 24}, 5, 0.2};

static void a_plan_that_moves_nothing_moves_nothing(void **state)
{
    (void)state;
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, true, &a);
    rigid motion[SEGMENT_COUNT];
    rest_motions(motion);
    equilibrium q = solve(&m, &a, motion);
    assert_int_equal(q.iterations, 0);
    assert_int_equal(q.factorisations, 0);
    assert_memory_equal(q.xyz, m.xyz, 3 * (size_t)m.vertex_count * sizeof *m.xyz);
    equilibrium_free(&q);
    tetmesh_free(&m);
    attach_map_free(&a);
}

static double worst_distance(const tetmesh *m, const equilibrium *q, const rigid *t)
{
    double worst = 0;
    for (int32_t v = 0; v < m->vertex_count; v++) {
        double want[3];
        rigid_apply(t, m->xyz + 3 * (size_t)v, want);
        worst = fmax(worst, vec_distance(want, q->xyz + 3 * (size_t)v));
    }
    return worst;
}

static void a_rigid_motion_of_all_bones_moves_all_tissue_rigidly(void **state)
{
    (void)state;
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, true, &a);
    rigid shift = rigid_translation((double[]){3, -40, 7});
    rigid turn = rigid_rotation((double[]){100, -30, 60}, (double[]){1, 0.4, -2}, 2.5);
    rigid both = rigid_compose(&turn, &shift);
    const rigid *cases[] = {&shift, &turn, &both};
    double worst = 0;
    for (int n = 0; n < 3; n++) {
        rigid motion[SEGMENT_COUNT];
        for (int s = 0; s < SEGMENT_COUNT; s++) motion[s] = *cases[n];
        equilibrium q = solve(&m, &a, motion);
        assert_true(keep_worst(&worst, worst_distance(&m, &q, cases[n])) < 1e-9);
        equilibrium_free(&q);
        /* the same motions but for the last digits, so that the guide is a fit */
        motion[SEGMENT_MAXILLA].t[0] += 1e-13;
        rigid back = rigid_inverse(&turn), there = rigid_compose(&turn, &back);
        motion[SEGMENT_CRANIUM] = rigid_compose(&there, cases[n]);
        q = solve(&m, &a, motion);
        assert_true(keep_worst(&worst, worst_distance(&m, &q, cases[n])) < 1e-9);
        equilibrium_free(&q);
    }
    evidence("all bones move rigidly (143 degrees, 40 mm): worst node", worst, "mm");
    tetmesh_free(&m);
    attach_map_free(&a);
}

static void the_result_turns_with_the_head(void **state)
{
    (void)state;
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, true, &a);
    rigid motion[SEGMENT_COUNT], turned[SEGMENT_COUNT];
    rest_motions(motion);
    motion[SEGMENT_MAXILLA] = rigid_rotation((double[]){10, 7, 24}, (double[]){0, 0.3, 1}, 0.3);
    motion[SEGMENT_MAXILLA].t[2] -= 3;
    rigid turn = rigid_rotation((double[]){100, -30, 60}, (double[]){1, 0.4, -2}, 2.5);
    for (int s = 0; s < SEGMENT_COUNT; s++) turned[s] = rigid_compose(&turn, &motion[s]);
    equilibrium q = solve(&m, &a, motion), r = solve(&m, &a, turned);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double want[3];
        rigid_apply(&turn, q.xyz + 3 * (size_t)v, want);
        assert_true(vec_distance(want, r.xyz + 3 * (size_t)v) < 1e-6);
    }
    equilibrium_free(&q);
    equilibrium_free(&r);
    tetmesh_free(&m);
    attach_map_free(&a);
}

static void tied_nodes_take_the_motion_of_their_bone_exactly(void **state)
{
    (void)state;
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, false, &a);
    rigid motion[SEGMENT_COUNT];
    rest_motions(motion);
    motion[SEGMENT_MAXILLA] = rigid_rotation((double[]){10, 7, 24}, (double[]){0, 0, 1}, 0.2);
    motion[SEGMENT_MAXILLA].t[2] += 3;
    equilibrium q = solve(&m, &a, motion);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double want[3];
        if (a.kind[v] != NODE_TIED) continue;
        rigid_apply(&motion[a.segment[v]], m.xyz + 3 * (size_t)v, want);
        assert_memory_equal(want, q.xyz + 3 * (size_t)v, sizeof want);
    }
    assert_true(q.imbalance < 1e-6);
    assert_true(q.segment_force_mn[SEGMENT_MAXILLA][2] > 1); /* pulled up by the bone */
    assert_near(q.segment_force_mn[SEGMENT_MAXILLA][2], -q.segment_force_mn[SEGMENT_DISTAL][2], 1e-3);
    equilibrium_free(&q);
    tetmesh_free(&m);
    attach_map_free(&a);
}

static void sliding_nodes_stay_on_their_moved_plane_and_slide(void **state)
{
    (void)state;
    block b = {6, 5, 4, {24, 20, 12}, 6, 0.15};
    tetmesh m = block_mesh(&b);
    attach_map a = attach_map_new(m.vertex_count, 0);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        const double *x = m.xyz + 3 * (size_t)v;
        if (x[2] == 12) tie(&a, v, SEGMENT_MAXILLA);
        if (x[2] != 0) continue;
        a.kind[v] = NODE_SLIDING;
        a.segment[v] = SEGMENT_DISTAL;
        a.normal[3 * (size_t)v + 2] = 1;
    }
    rigid motion[SEGMENT_COUNT];
    rest_motions(motion);
    motion[SEGMENT_MAXILLA] = rigid_translation((double[]){4, 0, 0});
    motion[SEGMENT_DISTAL] = rigid_rotation((double[]){12, 10, 0}, (double[]){0, 1, 0}, 0.15);
    a.shift_mm = NEW_ARRAY(double, m.vertex_count); /* some at a distance from it */
    for (int32_t v = 0; v < m.vertex_count; v++)
        if (a.kind[v] == NODE_SLIDING && m.xyz[3 * (size_t)v] > 12) a.shift_mm[v] = 0.5;
    equilibrium q = solve(&m, &a, motion);
    double off_plane = 0, slid = 0;
    int32_t count = 0;
    for (int32_t v = 0; v < m.vertex_count; v++) {
        if (a.kind[v] != NODE_SLIDING) continue;
        double n[3], moved[3], d[3];
        rigid_rotate(&motion[SEGMENT_DISTAL], a.normal + 3 * (size_t)v, n);
        rigid_apply(&motion[SEGMENT_DISTAL], m.xyz + 3 * (size_t)v, moved);
        vec_sub(q.xyz + 3 * (size_t)v, moved, d);
        off_plane = fmax(off_plane, fabs(vec_dot(d, n) - a.shift_mm[v]));
        slid += vec_norm(d);
        count++;
    }
    assert_true(off_plane < 1e-12);
    assert_true(slid / count > 3); /* the tissue follows the maxilla, as nothing holds it back */
    equilibrium_free(&q);
    tetmesh_free(&m);
    attach_map_free(&a);
}

static void lips_keep_in_touch_while_they_slide(void **state)
{
    (void)state;
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, false, &a);
    rigid motion[SEGMENT_COUNT];
    rest_motions(motion);
    motion[SEGMENT_MAXILLA] = rigid_translation((double[]){5, 0, -2});
    equilibrium q = solve(&m, &a, motion);
    for (int32_t i = 0; i < a.pair_count; i++) {
        double gap[3];
        vec_sub(q.xyz + 3 * (size_t)a.pair[2 * i], q.xyz + 3 * (size_t)a.pair[2 * i + 1], gap);
        assert_near(vec_dot(gap, a.pair_normal + 3 * (size_t)i), 0, 1e-12 + fabs(gap[0]) * 0.2);
        assert_true(gap[0] > 4);
    }
    assert_true(q.segment_force_mn[SEGMENT_MAXILLA][2] < -1); /* pressed together */
    equilibrium_free(&q);
    tetmesh_free(&m);
    attach_map_free(&a);
}

static void maps_that_contradict_themselves_are_refused(void **state)
{
    (void)state;
    err e = {0};
    attach_map a;
    tetmesh m = lips_mesh(&small, 3, true, &a);
    boundary b;
    attach_map short_map = attach_map_new(3, 0);
    assert_refused(boundary_make(&m, &short_map, &b, &e), ERR_INPUT);
    a.segment[0] = SEGMENT_COUNT;
    assert_refused(boundary_make(&m, &a, &b, &e), ERR_INPUT);
    a.segment[0] = SEGMENT_DISTAL;
    a.pair_normal[2] = 0.9;
    assert_refused(boundary_make(&m, &a, &b, &e), ERR_INPUT);
    a.pair_normal[2] = 1;
    int32_t keep = a.pair[3];
    a.pair[3] = a.pair[1];
    assert_refused(boundary_make(&m, &a, &b, &e), ERR_INPUT);
    a.pair[3] = 0; /* tied */
    assert_refused(boundary_make(&m, &a, &b, &e), ERR_INPUT);
    a.pair[3] = keep;
    assert_ok(boundary_make(&m, &a, &b, &e));
    boundary_free(&b);
    attach_map_free(&short_map);
    attach_map_free(&a);
    tetmesh_free(&m);
}

static void tissue_that_no_bone_holds_is_refused(void **state)
{
    (void)state;
    err e = {0};
    attach_map a;
    boundary b;
    tetmesh m = lips_mesh(&small, 3, false, &a);
    assert_ok(boundary_make(&m, &a, &b, &e));
    boundary_free(&b);
    for (int32_t v = 0; v < m.vertex_count; v++)
        if (a.kind[v] == NODE_TIED && a.segment[v] == SEGMENT_DISTAL) a.kind[v] = NODE_FREE;
    assert_false(boundary_make(&m, &a, &b, &e)); /* the lower half hangs on its pairs only */
    assert_int_equal(e.code, ERR_GEOMETRY);
    assert_non_null(strstr(e.text, "6 of its 6 rigid motions"));
    assert_non_null(strstr(e.text, "120 of 240 nodes"));
    e = (err){0};
    tie(&a, 0, SEGMENT_DISTAL); /* one node leaves the three rotations */
    assert_false(boundary_make(&m, &a, &b, &e));
    assert_non_null(strstr(e.text, "3 of its 6 rigid motions"));
    e = (err){0};
    tie(&a, 3, SEGMENT_DISTAL);
    tie(&a, 15, SEGMENT_DISTAL);
    assert_ok(boundary_make(&m, &a, &b, &e));
    boundary_free(&b);
    for (int32_t v = 0; v < m.vertex_count; v++)
        if (a.segment[v] == SEGMENT_DISTAL && a.kind[v] == NODE_TIED) {
            a.kind[v] = NODE_SLIDING;
            a.normal[3 * (size_t)v + 2] = 1;
        }
    assert_false(boundary_make(&m, &a, &b, &e)); /* a plane leaves two shifts and a turn */
    assert_non_null(strstr(e.text, "3 of its 6 rigid motions"));
    attach_map_free(&a);
    tetmesh_free(&m);
}

static void part_of_a_motion_runs_along_its_screw(void **state)
{
    (void)state;
    double angles[] = {0, 1e-10, 1e-7, 5e-4, 2e-3, 0.4, 2.9, 3.05, M_PI - 1e-9};
    for (size_t n = 0; n < sizeof angles / sizeof *angles; n++) {
        rigid whole = rigid_rotation((double[]){40, -80, 20}, (double[]){0.2, -1, 0.7}, angles[n]);
        vec_add(whole.t, (double[]){1, 5, -3}, whole.t);
        rigid one = motion_part(&whole, 1), none = motion_part(&whole, 0);
        assert_memory_equal(&one, &whole, sizeof one);
        assert_true(rigid_is_identity(&none));
        /* three parts of 0.2, 0.3, 0.5 make the whole, in any order */
        rigid a = motion_part(&whole, 0.2), b = motion_part(&whole, 0.3), c = motion_part(&whole, 0.5);
        rigid ab = rigid_compose(&a, &b), abc = rigid_compose(&c, &ab);
        for (int i = 0; i < 9; i++) assert_near(abc.r[i], whole.r[i], 1e-12);
        for (int i = 0; i < 3; i++) assert_near(abc.t[i], whole.t[i], 1e-9);
        assert_near(rigid_angle(&c), angles[n] / 2, 1e-12);
    }
}

static void best_fit_finds_a_rigid_motion(void **state)
{
    (void)state;
    uint64_t seed = 4;
    double from[60], to[60];
    rigid turn = rigid_rotation((double[]){40, -80, 20}, (double[]){0.2, -1, 0.7}, 2.8);
    for (int k = 0; k < 20; k++) {
        for (int c = 0; c < 3; c++) from[3 * k + c] = 50 * block_random(&seed) * (c == 2 ? 0 : 1); /* in a plane */
        rigid_apply(&turn, from + 3 * k, to + 3 * k);
    }
    rigid fit = motion_fit(from, to, 20);
    for (int i = 0; i < 9; i++) assert_near(fit.r[i], turn.r[i], 1e-12);
    for (int i = 0; i < 3; i++) assert_near(fit.t[i], turn.t[i], 1e-10);
    fit = motion_fit(from, to, 1);
    rigid_apply(&fit, from, from);
    assert_near(vec_distance(from, to), 0, 1e-12);
    fit = motion_fit(NULL, NULL, 0);
    assert_true(rigid_is_identity(&fit));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plan_that_moves_nothing_moves_nothing),
        cmocka_unit_test(a_rigid_motion_of_all_bones_moves_all_tissue_rigidly),
        cmocka_unit_test(the_result_turns_with_the_head),
        cmocka_unit_test(tied_nodes_take_the_motion_of_their_bone_exactly),
        cmocka_unit_test(sliding_nodes_stay_on_their_moved_plane_and_slide),
        cmocka_unit_test(lips_keep_in_touch_while_they_slide),
        cmocka_unit_test(maps_that_contradict_themselves_are_refused),
        cmocka_unit_test(tissue_that_no_bone_holds_is_refused),
        cmocka_unit_test(part_of_a_motion_runs_along_its_screw),
        cmocka_unit_test(best_fit_finds_a_rigid_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
