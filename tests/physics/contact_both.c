/* What holds for a body on bone and for lips alike. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/src/contact/contact_state.h"
#include "tests/physics/touching.h"

static void a_plan_that_moves_nothing_moves_nothing(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        touching s;
        block_or_lips(&s, n);
        equilibrium q = solve_touching(&s, n ? "lips" : "block");
        assert_int_equal(q.iterations, 0);
        assert_memory_equal(q.xyz, s.body.mesh.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
        assert_true(q.contact.energy_uj == 0);
        equilibrium_free(&q);
        touching_free(&s);
    }
}

static void a_rigid_motion_of_all_bones_moves_all_tissue_rigidly(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        touching s;
        block_or_lips(&s, n);
        rigid turn = rigid_rotation((double[]){100, -30, 60}, (double[]){0.36, 0.48, 0.8}, 2.1);
        for (int k = 0; k < SEGMENT_COUNT; k++) s.body.problem.motion[k] = turn;
        equilibrium q = solve_touching(&s, n ? "lips" : "block");
        for (int32_t v = 0; v < q.node_count; v++) {
            double want[3];
            rigid_apply(&turn, s.body.mesh.xyz + 3 * (size_t)v, want);
            assert_near(vec_distance(want, q.xyz + 3 * (size_t)v), 0, 1e-9);
        }
        equilibrium_free(&q);
        touching_free(&s);
    }
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        touching s;
        block_or_lips(&s, n);
        s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){2, 1, -1});
        equilibrium first = {0};
        for (int threads = 1; threads <= 3; threads++) {
            parallel_set_threads(threads);
            equilibrium q = solve_touching(&s, n ? "lips" : "block");
            if (threads == 1) {
                first = q;
                continue;
            }
            assert_memory_equal(first.xyz, q.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
            assert_true(first.energy_uj == q.energy_uj && first.contact.depth_mm == q.contact.depth_mm);
            equilibrium_free(&q);
        }
        parallel_set_threads(0);
        equilibrium_free(&first);
        touching_free(&s);
    }
}

static void refused(touching *s, bool lips)
{
    err e = {0};
    contact *c = NULL;
    assert_refused(contact_make(&s->body.mesh, &s->body.attach, &s->setup, 15, &c, &e), ERR_INPUT);
    touching_free(s);
    block_or_lips(s, lips);
}

static void what_cannot_touch_is_refused(void **state)
{
    (void)state;
    touching s;
    two_lips(&s);
    s.setup.upper_count--;
    s.setup.lower_count = 0;
    refused(&s, true);
    s.setup.params.depth_limit_mm = 3; /* deeper than the support sees */
    refused(&s, false);
    s.setup.shape[SEGMENT_DISTAL] = NULL;
    refused(&s, false);
    s.setup.params.depth_mm = 0;
    refused(&s, false);
    s.setup.extra = (int32_t[]){s.body.mesh.vertex_count - 1}; /* tied */
    s.setup.extra_count = 1;
    refused(&s, false);
    touching_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plan_that_moves_nothing_moves_nothing),
        cmocka_unit_test(a_rigid_motion_of_all_bones_moves_all_tissue_rigidly),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
        cmocka_unit_test(what_cannot_touch_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
