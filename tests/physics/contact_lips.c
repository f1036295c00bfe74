/* Lips that press each other, and part. */
#include "tests/check.h"
#include "sim/src/contact_state.h"
#include "tests/physics/touching.h"

static void lips_press_each_other_and_part(void **state)
{
    (void)state;
    touching s;
    two_lips(&s);
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){3, 0, -2});
    equilibrium q = solve_touching(&s, "lips pressed and shifted");
    assert_true(q.contact.depth_mm > 0 && q.contact.depth_mm < 0.1);
    assert_near(q.segment_force_mn[SEGMENT_MAXILLA][2], -q.segment_force_mn[SEGMENT_DISTAL][2],
                1e-6 * fabs(q.segment_force_mn[SEGMENT_DISTAL][2]));
    assert_true(q.segment_force_mn[SEGMENT_MAXILLA][2] < -100);
    assert_true(q.contact.lip_area_mm2 > 0.6 * 20 * 16);
    double gap = 0;
    for (int32_t i = 0; i < s.body.attach.pair_count; i++)
        gap += (q.xyz[3 * s.body.attach.pair[2 * i] + 2] - q.xyz[3 * s.body.attach.pair[2 * i + 1] + 2]) /
               s.body.attach.pair_count;
    assert_true(fabs(gap) < 0.3);
    equilibrium_free(&q);
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){1, 0, 4});
    q = solve_touching(&s, "lips parted");
    for (int32_t i = 0; i < s.body.attach.pair_count; i++)
        assert_near(q.xyz[3 * s.body.attach.pair[2 * i] + 2] - q.xyz[3 * s.body.attach.pair[2 * i + 1] + 2], 4, 1e-6);
    assert_int_equal(q.contact.active_nodes, 0);
    equilibrium_free(&q);
    touching_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lips_press_each_other_and_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
