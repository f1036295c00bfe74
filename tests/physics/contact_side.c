/* Tissue that hangs on no bone, and a thin bone that comes to it: it stays on its own side. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "tests/physics/touching.h"

static void no_tissue_passes_a_thin_bone(void **state)
{
    (void)state;
    static const double thick[] = {0.8, 2, 5}, rise[] = {2, 3, 5};
    for (int t = 0; t < 3; t++)
        for (int k = 0; k < 3; k++) {
            touching s;
            block_over_plate(&s, thick[t]);
            s.body.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, rise[k]});
            equilibrium q = solve_touching(&s, "plate"), again;
            double lowest = HUGE_VAL;
            for (int32_t i = 0; i < s.setup.extra_count; i++) lowest = fmin(lowest, q.xyz[3 * s.setup.extra[i] + 2]);
            printf("%.1f mm thick, risen %.0f mm: lowest node %.3f mm over it, %d guards, %d passed\n", thick[t],
                   rise[k], lowest - rise[k] + 0.2, q.contact.guards, q.contact.passed);
            assert_true(lowest > rise[k] - 0.2 - 0.1);
            assert_int_equal(q.contact.passed, 0);
            assert_int_equal(q.contact.guards, rise[k] > thick[t] + 0.5 ? s.setup.extra_count : 0);
            assert_true(q.contact.depth_mm < 0.1 && q.imbalance < 1e-6);
            parallel_set_threads(3);
            again = solve_touching(&s, "three threads");
            assert_memory_equal(q.xyz, again.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
            parallel_set_threads(1);
            equilibrium_free(&again);
            equilibrium_free(&q);
            touching_free(&s);
        }
}

/* Down, and to the side of an edge: nothing comes near, so nothing is pushed. */
static void tissue_that_no_bone_passes_is_left_where_it_is(void **state)
{
    (void)state;
    static const double move[2][3] = {{0, 0, -3}, {0, 0, 3}};
    for (int beside = 0; beside < 2; beside++) {
        touching s;
        block_over_plate(&s, 0.8);
        if (beside) s.bone = (known_bone){KNOWN_EDGE, {25, 0, -0.2}, 0, 0.1};
        s.body.problem.motion[SEGMENT_DISTAL] = rigid_translation(move[beside]);
        equilibrium q = solve_touching(&s, beside ? "edge beside it" : "plate that sinks");
        for (size_t i = 0; i < 3 * (size_t)q.node_count; i++) assert_near(q.xyz[i], s.body.mesh.xyz[i], 1e-9);
        assert_int_equal(q.contact.guards + q.contact.passed, 0);
        equilibrium_free(&q);
        touching_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_tissue_passes_a_thin_bone),
                                       cmocka_unit_test(tissue_that_no_bone_passes_is_left_where_it_is)};
    parallel_set_threads(1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
