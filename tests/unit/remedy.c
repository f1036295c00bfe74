/* Plans that are stopped, on a head of blocks: the nearest one that nothing stops, or what contradicts. */
#include "tests/check.h"
#include "tests/unit/block_head.h"
#include "app/planner/judge/judgement_record.h"
#include "app/planner/judge/nearest_move.h"

static remedy found;

static void seek(const plan_file *p)
{
    judgement now;
    judged(p, &now);
    remedy_find(all, &patient, &head, p, &now, &found);
    if (!found.found) return;
    judgement again;
    judged(&found.plan, &again);
    assert_int_not_equal(again.worst, LIMIT_STOP);
    assert_int_equal(again.count, found.after.count);
    for (int i = 0; i < again.count; i++) assert_int_equal(again.finding[i].level, found.after.finding[i].level);
}

static double proposed(const char *name, double else_wanted)
{
    for (int i = 0; i < found.change_count; i++)
        if (!strcmp(found.change[i].control, name)) return found.change[i].proposed;
    return else_wanted;
}

static void one_limit_is_met_by_the_least_change(void **state)
{
    (void)state;
    plan_file p = still();
    seek(&p);
    assert_true(!found.sought && !found.found);
    p.segment[SEGMENT_MAXILLA].move.translate_mm[0] = 8;
    seek(&p);
    assert_true(found.sought && found.found);
    assert_int_equal(found.change_count, 1);
    assert_near(proposed("maxilla_lateral_mm", 8), 6, 0.1);
    assert_near(found.change[0].wanted, 8, 1e-12);
    assert_near(found.change[0].by, found.change[0].proposed - 8, 1e-12);
}

/* The overjet is 10 mm at rest, and may be 10 at most: both jaws give way alike, beyond what each alone may do. */
static void limits_of_both_jaws_are_met_together(void **state)
{
    (void)state;
    plan_file p = still();
    p.segment[SEGMENT_MAXILLA].move.translate_mm[1] = -9;
    p.segment[SEGMENT_DISTAL].move.translate_mm[1] = 11;
    seek(&p);
    assert_true(found.found);
    assert_int_equal(found.change_count, 2);
    assert_near(proposed("maxilla_advance_mm", 9), -1, 0.15);
    assert_near(proposed("mandible_advance_mm", -11), -1, 0.15);
}

static void a_turn_only_becomes_less(void **state)
{
    (void)state;
    plan_file p = still();
    p.segment[SEGMENT_DISTAL].move.yaw_deg = 20;
    seek(&p);
    assert_true(found.found);
    double deg = proposed("mandible_yaw_deg", 20);
    assert_true(deg > 0 && deg <= 15);
}

/* A matrix is shifted as a whole. */
static void a_matrix_is_moved_along(void **state)
{
    (void)state;
    plan_file p = still();
    segment_move *m = &p.segment[SEGMENT_MAXILLA].move;
    m->kind = MOVE_RIGID;
    m->motion = rigid_identity();
    m->motion.t[0] = 8;
    seek(&p);
    assert_true(found.found);
    assert_int_equal(found.change_count, 1);
    assert_near(found.change[0].by, -2, 0.1);
    assert_true(isnan(found.change[0].wanted));
}

static void limits_that_contradict_are_named(void **state)
{
    (void)state;
    plan_file p = plan_file_default();
    p.segment[SEGMENT_MAXILLA].move.kind = MOVE_ANGLES;
    p.segment[SEGMENT_MAXILLA].move.translate_mm[1] = -7;
    patient.limits[LIMIT_MAXILLA_ADVANCE].stop[0] = 5; /* and the overjet of 10 mm may not grow */
    judgement now;
    judged(&p, &now);
    plan_audit *a = test_malloc(sizeof *a);
    *a = (plan_audit){.patient = &patient, .plan = &p, .judgement = now};
    remedy_find(all, &patient, &head, &p, &now, &a->remedy);
    assert_true(a->remedy.sought && !a->remedy.found);
    json_t *record = plan_audit_json(a), *names = json_object_get(json_object_get(record, "remedy"), "contradict");
    assert_int_equal(json_array_size(names), 2);
    assert_string_equal(json_string_value(json_array_get(names, 0)), "maxilla_advance_mm");
    assert_string_equal(json_string_value(json_array_get(names, 1)), "overjet_mm");
    json_decref(record);
    test_free(a);
    patient.limits[LIMIT_MAXILLA_ADVANCE] = limit_default[LIMIT_MAXILLA_ADVANCE].range;
}

static void the_nearest_move_has_all_limits_or_the_middle(void **state)
{
    (void)state;
    double x[2];
    const move_limit both[] = {{{1, 0}, 3}, {{0, 1}, -2}, {{0.6, 0.8}, 5}};
    nearest_move(both, 3, 2, x); /* the third is met where it is nearest, 3 along x and 4 along y */
    assert_near(x[0], 3, 0.01);
    assert_near(x[1], 4, 0.02);
    const move_limit against[] = {{{1, 0}, 4}, {{-1, 0}, -1}}; /* at least 4, at most 1 */
    nearest_move(against, 2, 2, x);
    assert_near(x[0], 2.5, 0.01);
    assert_near(x[1], 0, 0);
    nearest_move(NULL, 0, 2, x);
    assert_near(x[0], 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_move_has_all_limits_or_the_middle),
        cmocka_unit_test(one_limit_is_met_by_the_least_change),
        cmocka_unit_test(limits_of_both_jaws_are_met_together),
        cmocka_unit_test(a_turn_only_becomes_less),
        cmocka_unit_test(a_matrix_is_moved_along),
        cmocka_unit_test(limits_that_contradict_are_named),
    };
    return cmocka_run_group_tests(tests, make_head, drop_head);
}
