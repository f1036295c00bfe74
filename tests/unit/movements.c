/* The table of moves says what the plan said. */
#include "tests/check.h"
#include "app/planner/plan/movements.h"
#include "geometry/vec.h"

static const head_frame straight = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};

static void a_move_is_told_at_the_landmark_of_its_segment(void **state)
{
    (void)state;
    landmarks l = {0};
    landmarks_set(&l, "U1", (double[]){1, -80, -40});
    rigid move[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) move[s] = rigid_identity();
    segment_move m = {.kind = MOVE_ANGLES, .translate_mm = {-1.5, -5, 2}, .pitch_deg = 4, .yaw_deg = -2, .roll_deg = 1};
    vec_copy(l.point[0].xyz, m.pivot_mm);
    move[SEGMENT_MAXILLA] = rig_segment_motion(&m, &straight);
    move[SEGMENT_CHIN] = rigid_translation((double[]){0, -6, 0});
    movement told[SEGMENT_COUNT];
    assert_int_equal(movements_make(move, &l, &straight, told), 2); /* the others stay */
    assert_int_equal(told[0].segment, SEGMENT_MAXILLA);
    assert_string_equal(told[0].at, "U1");
    assert_near(told[0].left_mm, -1.5, 1e-12);
    assert_near(told[0].anterior_mm, 5, 1e-12);
    assert_near(told[0].up_mm, 2, 1e-12);
    assert_near(told[0].pitch_deg, 4, 1e-12);
    assert_near(told[0].yaw_deg, -2, 1e-12);
    assert_near(told[0].roll_deg, 1, 1e-12);
    assert_int_equal(told[1].segment, SEGMENT_CHIN);
    json_t *chin = record_part(&movement_table, &told[1]);
    assert_string_equal(json_string_value(json_object_get(chin, "segment")), "chin");
    assert_true(json_is_null(json_object_get(chin, "at"))); /* no landmark says where */
    assert_true(json_is_null(json_object_get(chin, "anterior_mm")));
    json_decref(chin);
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_move_is_told_at_the_landmark_of_its_segment)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
