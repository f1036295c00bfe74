/* The judge of the stress suite must itself be able to say no: equilibria that were tampered with are all
 * found out. */
#include "tests/check.h"
#include "app/stress/stress.h"
#include <string.h>

static const stress_case quiet = {.name = "test",
                                  .what = "",
                                  .body = specimen_block,
                                  .cells = {4, 4, 4},
                                  .size = {20, 20, 16},
                                  .move = {2, 1, 3},
                                  .check = CHECK_UPRIGHT};

typedef enum tampering {
    NOTHING,
    FREE_NODE,
    TIED_NODE,
    NOT_A_NUMBER,
    ENERGY,
    VOLUMES,
    HALF_WAY,
    LOOSE_TOLERANCE,
    INSIDE_OUT
} tampering;

static void judge(tampering how, bool fine)
{
    err e = {0};
    stress_scene s;
    stress_scene_make(&quiet, 0, &s);
    equilibrium_problem problem = stress_problem(&s);
    if (how == LOOSE_TOLERANCE) s.params.rel_tol = 0.3;
    equilibrium q;
    assert_ok(equilibrium_solve(&problem, &s.params, &q, &e));
    s.params.rel_tol = solve_params_default().rel_tol;
    assert_int_equal(q.outcome, SOLVED);
    int32_t inner = stress_node(quiet.cells, 2, 2, 2);
    switch (how) {
    case FREE_NODE: q.xyz[3 * inner] += 1e-4; break;
    case TIED_NODE: q.xyz[0] += 1e-6; break;
    case NOT_A_NUMBER: q.xyz[3 * inner] = (double)NAN; break;
    case ENERGY: q.energy_uj *= 1.001; break;
    case VOLUMES: q.extremes.min_j += 0.01; break;
    case HALF_WAY: q.load_reached = 0.5; break;
    case INSIDE_OUT: q.xyz[3 * inner + 2] += 30; break;
    default: break;
    }
    stress_result r = {0};
    stress_verify(&quiet, &s, &q, &r);
    if (fine)
        assert_string_equal(r.wrong, "");
    else
        print_message("found out: %s\n", r.wrong);
    assert_int_equal(r.wrong[0] == 0, fine);
    equilibrium_free(&q);
    stress_scene_free(&s);
}

static void a_true_equilibrium_passes(void **state)
{
    (void)state;
    judge(NOTHING, true);
}

static void whatever_is_tampered_with_is_found_out(void **state)
{
    (void)state;
    for (int how = FREE_NODE; how <= INSIDE_OUT; how++) judge((tampering)how, false);
}

static void a_node_in_the_bone_is_found_out(void **state)
{
    (void)state;
    static void (*const body[4])(const stress_case *, stress_scene *) = {specimen_on_plane, specimen_on_teeth,
                                                                         specimen_on_ball, specimen_on_rim};
    static const double size[4] = {0, 2, 20, 0};
    for (int k = 0; k < 4; k++) {
        err e = {0};
        stress_case c = quiet;
        c.body = body[k];
        c.p = size[k];
        c.check = CHECK_ABOVE;
        c.slack_mm = 0.14;
        memcpy(c.move, (double[]){0, 0, -2}, sizeof c.move);
        stress_scene s;
        stress_scene_make(&c, 0, &s);
        equilibrium_problem problem = stress_problem(&s);
        equilibrium q;
        assert_ok(equilibrium_solve(&problem, &s.params, &q, &e));
        assert_int_equal(q.outcome, SOLVED);
        for (int raised = 0; raised < 2; raised++) {
            stress_result r = {0};
            s.bone.at[2] += raised ? 0.5 : 0;
            stress_verify(&c, &s, &q, &r);
            assert_int_equal(strstr(r.wrong, "below the surface") != NULL, raised);
            assert_int_equal(r.wrong[0] != 0, raised);
            if (raised) print_message("found out: %s\n", r.wrong);
        }
        equilibrium_free(&q);
        stress_scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_true_equilibrium_passes),
        cmocka_unit_test(whatever_is_tampered_with_is_found_out),
        cmocka_unit_test(a_node_in_the_bone_is_found_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
