/* The table of controls and what reads it. */
#include "tests/check.h"
#include "app/planner/plan/plan_vary.h"
#include "geometry/vec.h"
#include <string.h>

static const head_frame straight = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};

static void every_name_is_found_and_stands_for_one_control(void **state)
{
    (void)state;
    control x, piece;
    for (int i = 0; i < CONTROL_COUNT; i++) {
        assert_true(control_named(controls[i].name, &x));
        assert_true(x.kind == controls[i].kind && x.segment == controls[i].segment && x.axis == controls[i].axis);
        assert_string_equal(x.name, controls[i].name);
        assert_true(controls[i].low <= controls[i].usual && controls[i].usual <= controls[i].high);
    }
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control_of_piece(i, &piece);
        assert_true(control_named(piece.name, &x));
        assert_true(x.segment == piece.segment && x.axis == piece.axis && x.kind == CONTROL_OF_SEGMENT);
    }
    assert_false(control_named("nose_advance_mm", &x));
}

static void a_shift_and_its_limit_have_one_name(void **state)
{
    (void)state;
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control x;
        control_of_piece(i, &x);
        limit_id l = control_limit(x.segment, x.axis);
        if (x.axis < RIG_PITCH && l != LIMIT_CONDYLE_SHIFT) assert_string_equal(x.name, limit_default[l].name);
        assert_string_equal(x.unit, limit_default[l].unit);
    }
}

static void a_control_does_what_its_row_says(void **state)
{
    (void)state;
    rig_controls q = rig_controls_default();
    control x;
    control_apply(&controls[CONTROL_MAXILLA_ADVANCE], 3, &straight, &q);
    control_apply(&controls[CONTROL_MAXILLA_IMPACTION], 2, &straight, &q);
    assert_true(control_named("maxilla_yaw_deg", &x));
    control_apply(&x, -4, &straight, &q);
    const segment_move *m = &q.move[SEGMENT_MAXILLA];
    assert_true(m->kind == MOVE_ANGLES && m->yaw_deg == -4 && m->pitch_deg == 0 && m->roll_deg == 0);
    assert_true(m->translate_mm[0] == 0 && m->translate_mm[1] == -3 && m->translate_mm[2] == 2);
    assert_true(q.move[SEGMENT_DISTAL].kind == MOVE_NONE);
    control_apply(&controls[CONTROL_JAW_PITCH], 10, &straight, &q);
    control_apply(&controls[CONTROL_JAW_PROTRUDE], 2, &straight, &q);
    assert_true(q.jaw.open_deg == 10 && q.jaw.protrude_mm == 2 && q.jaw.yaw_deg == 0 && q.jaw.roll_deg == 0);
}

static void the_short_form_opens_into_the_same_move(void **state)
{
    (void)state;
    plan_file p = plan_file_default();
    p.segment[SEGMENT_MAXILLA].short_form = p.segment[SEGMENT_CHIN].short_form = true;
    p.value[CONTROL_MAXILLA_ADVANCE] = 5;
    p.value[CONTROL_MAXILLA_IMPACTION] = -1;
    plan_vary_open(&p, &straight);
    const plan_segment *s = p.segment;
    assert_true(s[SEGMENT_MAXILLA].move.kind == MOVE_ANGLES && !s[SEGMENT_MAXILLA].short_form);
    assert_true(s[SEGMENT_MAXILLA].move.translate_mm[1] == -5 && s[SEGMENT_MAXILLA].move.translate_mm[2] == -1);
    assert_true(s[SEGMENT_CHIN].move.kind == MOVE_ANGLES && vec_norm(s[SEGMENT_CHIN].move.translate_mm) == 0);
    assert_true(s[SEGMENT_DISTAL].move.kind == MOVE_NONE);
    for (int i = 0; i < CONTROL_COUNT; i++) assert_true(p.value[i] == 0);
}

static void a_control_is_read_and_set_alone(void **state)
{
    (void)state;
    err e = {0};
    control x, other;
    case_file c = case_file_default();
    plan_file p = plan_file_default();
    p.segment[SEGMENT_DISTAL].short_form = true;
    p.value[CONTROL_MANDIBLE_ADVANCE] = 3;
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control_of_piece(i, &other);
        if (other.segment != SEGMENT_DISTAL) continue;
        assert_ok(control_find(other.name, &c, &x, &e));
        assert_ok(plan_vary_open_for(&x, &straight, &p, &e));
        assert_near(plan_vary_value(&x, &straight, &p), x.axis == RIG_FORWARD ? 3 : 0, 1e-12);
    }
    assert_ok(control_find("mandible_lateral_mm", &c, &x, &e));
    plan_vary_set(&x, &straight, 2, &p);
    assert_ok(control_find("mandible_roll_deg", &c, &other, &e));
    plan_vary_set(&other, &straight, -7, &p);
    const segment_move *m = &p.segment[SEGMENT_DISTAL].move;
    assert_true(m->translate_mm[0] == 2 && m->translate_mm[1] == -3 && m->translate_mm[2] == 0 && m->roll_deg == -7);
    p.segment[SEGMENT_CHIN].move.kind = MOVE_RIGID; /* of another piece: stays whole */
    assert_ok(plan_vary_open_for(&other, &straight, &p, &e));
    assert_true(p.segment[SEGMENT_CHIN].move.kind == MOVE_RIGID);
    p.segment[SEGMENT_DISTAL].move.kind = MOVE_RIGID;
    assert_refused(plan_vary_open_for(&x, &straight, &p, &e), ERR_INPUT);
    c.osteotomy_count = 0;
    assert_refused(control_find("mandible_lateral_mm", &c, &x, &e), ERR_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_name_is_found_and_stands_for_one_control),
        cmocka_unit_test(a_shift_and_its_limit_have_one_name), cmocka_unit_test(a_control_does_what_its_row_says),
        cmocka_unit_test(the_short_form_opens_into_the_same_move), cmocka_unit_test(a_control_is_read_and_set_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
