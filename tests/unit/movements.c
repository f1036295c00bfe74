/* The table of moves says what the plan said. */
#include "tests/check.h"
#include "app/planner/plan/movements.h"
#include "geometry/vec.h"

static const head_frame straight = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};

static double value(const json_t *row, const char *key) { return json_number_value(json_object_get(row, key)); }

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
    json_t *list = movements_json(move, &l, &straight), *maxilla = json_array_get(list, 0),
           *chin = json_array_get(list, 1);
    assert_int_equal(json_array_size(list), 2); /* the others stay */
    assert_string_equal(json_string_value(json_object_get(maxilla, "segment")), "maxilla");
    assert_string_equal(json_string_value(json_object_get(maxilla, "at")), "U1");
    assert_near(value(maxilla, "left_mm"), -1.5, 1e-12);
    assert_near(value(maxilla, "anterior_mm"), 5, 1e-12);
    assert_near(value(maxilla, "up_mm"), 2, 1e-12);
    assert_near(value(maxilla, "pitch_deg"), 4, 1e-12);
    assert_near(value(maxilla, "yaw_deg"), -2, 1e-12);
    assert_near(value(maxilla, "roll_deg"), 1, 1e-12);
    assert_string_equal(json_string_value(json_object_get(chin, "segment")), "chin");
    assert_true(json_is_null(json_object_get(chin, "at"))); /* no landmark says where */
    assert_true(json_is_null(json_object_get(chin, "anterior_mm")));
    json_decref(list);
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_move_is_told_at_the_landmark_of_its_segment)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
