/* Leaving tissue out: what it costs is what it says, and nothing is left out where nothing may be. */
#include "tests/check.h"
#include "sim/scene.h"
#include "tests/physics/block.h"
#include <string.h>

typedef struct setting {
    tetmesh mesh;
    attach_map attach;
    region_material table;
    equilibrium_problem problem;
} setting;

static void plate_setting(setting *s, double poisson)
{
    err e = {0};
    s->mesh = plate_mesh(30, 20, 2, &s->attach);
    s->table = (region_material){REGION_ANY, {0}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &s->table.material, &e));
    assert_ok(element_choose(&s->table.material, ELEMENT_AUTO, &e));
    s->problem =
        (equilibrium_problem){.mesh = &s->mesh, .attach = &s->attach, .materials = &s->table, .material_count = 1};
    rest_motions(s->problem.motion);
    s->problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
}

static void tear_down(setting *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
}

static equilibrium solve(const setting *s, const scene_params *scene, scene_report *r)
{
    err e = {0};
    equilibrium q;
    solve_params p = solve_params_default();
    assert_ok(scene_solve(&s->problem, scene, &p, &q, r, &e));
    assert_int_equal(q.outcome, SOLVED);
    assert_int_equal(q.node_count, s->mesh.vertex_count);
    return q;
}

static double apart(const double *a, const double *b, int32_t nodes)
{
    double worst = 0;
    for (int32_t v = 0; v < nodes; v++) worst = fmax(worst, vec_distance(a + 3 * (size_t)v, b + 3 * (size_t)v));
    return worst;
}

static void check_pruned(double poisson)
{
    setting s;
    plate_setting(&s, poisson);
    scene_params all = scene_params_default();
    all.full = true;
    scene_report r;
    equilibrium full = solve(&s, &all, &r);
    assert_true(r.full && r.left_out_tets == 0 && r.error_mm == 0);
    scene_report_free(&r);
    int32_t before = 0;
    for (double tolerance = 0.01; tolerance < 1; tolerance *= 5) {
        scene_params part = {.tolerance_mm = tolerance, .max_rounds = 3};
        equilibrium q = solve(&s, &part, &r);
        double error = apart(q.xyz, full.xyz, s.mesh.vertex_count);
        assert_true(error <= tolerance);
        assert_true(r.full || r.error_mm <= tolerance);
        if (!r.full) assert_true(fabs(error - r.error_mm) < 0.3 * error); /* says what it costs */
        assert_true(r.left_out_tets >= before); /* the more is allowed, the more is left out */
        before = r.left_out_tets;
        equilibrium_free(&q);
        scene_report_free(&r);
    }
    assert_true(before > s.mesh.tet_count / 2);
    equilibrium_free(&full);
    tear_down(&s);
}

static void pruned_and_full_agree_within_the_tolerance(void **state)
{
    (void)state;
    check_pruned(0.45);
    check_pruned(0.49); /* of averaged volume changes */
}

static void full_is_the_plain_solve(void **state)
{
    (void)state;
    setting s;
    plate_setting(&s, 0.45);
    scene_params all = scene_params_default();
    all.full = true;
    scene_report r;
    equilibrium a = solve(&s, &all, &r), b;
    err e = {0};
    solve_params p = solve_params_default();
    assert_ok(equilibrium_solve(&s.problem, &p, &b, &e));
    assert_memory_equal(a.xyz, b.xyz, 3 * (size_t)s.mesh.vertex_count * sizeof *a.xyz);
    equilibrium_free(&a);
    equilibrium_free(&b);
    scene_report_free(&r);
    tear_down(&s);
}

static void a_head_that_turns_as_a_whole_is_turned(void **state)
{
    (void)state;
    setting s;
    plate_setting(&s, 0.45);
    rigid turn = rigid_rotation((double[]){5, 6, 7}, (double[]){0, 0.6, 0.8}, 0.7);
    for (int k = 0; k < SEGMENT_COUNT; k++) s.problem.motion[k] = turn;
    scene_params part = scene_params_default();
    scene_report r;
    equilibrium q = solve(&s, &part, &r);
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
        double at[3];
        rigid_apply(&turn, s.mesh.xyz + 3 * (size_t)v, at);
        assert_true(vec_distance(at, q.xyz + 3 * (size_t)v) < 1e-9);
    }
    /* and one that turns and advances its maxilla gives the turned face */
    scene_report_free(&r);
    rigid still[SEGMENT_COUNT];
    rest_motions(still);
    rigid advance = rigid_translation((double[]){0, 2, 6});
    s.problem.motion[SEGMENT_MAXILLA] = rigid_compose(&turn, &advance);
    equilibrium moved = solve(&s, &part, &r);
    assert_false(r.full);
    memcpy(s.problem.motion, still, sizeof still);
    s.problem.motion[SEGMENT_MAXILLA] = advance;
    scene_report_free(&r);
    equilibrium plain = solve(&s, &part, &r);
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
        double at[3];
        rigid_apply(&turn, plain.xyz + 3 * (size_t)v, at);
        assert_true(vec_distance(at, moved.xyz + 3 * (size_t)v) < 1e-5);
    }
    equilibrium_free(&q);
    equilibrium_free(&moved);
    equilibrium_free(&plain);
    scene_report_free(&r);
    tear_down(&s);
}

/* Nodes that would move far are held on purpose: the check must say how far. */
static void what_was_held_wrongly_is_found(void **state)
{
    (void)state;
    setting s;
    plate_setting(&s, 0.45);
    err e = {0};
    solve_params p = solve_params_default();
    equilibrium full, part;
    assert_ok(equilibrium_solve(&s.problem, &p, &full, &e));
    attach_map own = s.attach;
    size_t n = (size_t)s.mesh.vertex_count;
    uint8_t *held = NEW_ARRAY(uint8_t, n);
    own.kind = COPY_ARRAY(uint8_t, s.attach.kind, n);
    own.segment = COPY_ARRAY(int32_t, s.attach.segment, n);
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
        double moved = vec_distance(full.xyz + 3 * (size_t)v, s.mesh.xyz + 3 * (size_t)v);
        if (own.kind[v] != NODE_FREE || moved > 0.8) continue;
        held[v] = 1;
        tie(&own, v, SEGMENT_CRANIUM);
    }
    equilibrium_problem bound = s.problem;
    bound.attach = &own;
    assert_ok(equilibrium_solve(&bound, &p, &part, &e));
    double *error = NEW_ARRAY(double, 3 * n), worst = 0, rest = 0;
    assert_ok(scene_check(&s.problem, held, part.xyz, error, &e));
    for (size_t v = 0; v < n; v++) {
        double truth[3], left[3];
        vec_sub(full.xyz + 3 * v, part.xyz + 3 * v, truth);
        vec_sub(truth, error + 3 * v, left);
        worst = fmax(worst, vec_norm(truth));
        rest = fmax(rest, vec_norm(left));
    }
    assert_true(worst > 0.3);
    assert_true(rest < 0.35 * worst);
    free(error);
    free(held);
    free(own.kind);
    free(own.segment);
    equilibrium_free(&full);
    equilibrium_free(&part);
    tear_down(&s);
}

static void parameters_out_of_range_are_refused(void **state)
{
    (void)state;
    setting s;
    plate_setting(&s, 0.45);
    solve_params p = solve_params_default();
    equilibrium q;
    scene_report r;
    err e = {0};
    scene_params scene = {.tolerance_mm = 0, .max_rounds = 3};
    assert_false(scene_solve(&s.problem, &scene, &p, &q, &r, &e));
    assert_string_equal(e.text, "scene tolerance_mm must be > 0, got 0");
    scene = (scene_params){.tolerance_mm = 0.1, .max_rounds = 0};
    e = (err){0};
    assert_false(scene_solve(&s.problem, &scene, &p, &q, &r, &e));
    assert_string_equal(e.text, "scene max_rounds must be >= 1, got 0");
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pruned_and_full_agree_within_the_tolerance), cmocka_unit_test(full_is_the_plain_solve),
        cmocka_unit_test(a_head_that_turns_as_a_whole_is_turned),     cmocka_unit_test(what_was_held_wrongly_is_found),
        cmocka_unit_test(parameters_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
