/* Plans judged on a head of blocks, where every bound is known: the right limit decides, within 0.05 mm. */
#include "tests/check.h"
#include "tests/unit/block_head.h"
#include "app/planner/judge/judgement_record.h"
#include "app/planner/patient/prepared_report.h"
#include "geometry/vec.h"

static const double pi = 3.14159265358979323846;

/* The amount at which `set` is first stopped, and by what. */
static double bound(void (*set)(plan_file *, double), double low, double high, limit_id *by)
{
    judgement j;
    while (high - low > 1e-3) {
        double middle = (low + high) / 2;
        plan_file p = still();
        set(&p, middle);
        judged(&p, &j);
        if (j.worst == LIMIT_STOP) {
            high = middle;
            *by = j.finding[j.reason].limit;
        } else {
            low = middle;
        }
    }
    return high;
}

static void at_rest_nothing_stops_and_nothing_is_fine_in_silence(void **state)
{
    (void)state;
    judgement j;
    plan_file p = still();
    judged(&p, &j);
    assert_true(j.worst < LIMIT_STOP);
    assert_near(find(&j, LIMIT_LE_FORT_GAP)->value, 0.5, 1e-9);
    assert_near(find(&j, LIMIT_LE_FORT_STEP)->value, 0, 1e-9);
    assert_near(find(&j, LIMIT_LE_FORT_CONTACT)->value, 60 * 70, 1e-6);
    assert_near(find(&j, LIMIT_TOOTH_OVERLAP)->value, -0.8, 0.05); /* apart by the gap */
    assert_near(find(&j, LIMIT_OVERJET)->value, 10, 1e-9);
    bool known[LIMIT_COUNT] = {0};
    for (int i = 0; i < j.count; i++) {
        const finding *f = &j.finding[i];
        known[f->limit] = true;
        assert_true(f->level != LIMIT_NOT_JUDGED || (isnan(f->value) && f->note));
    }
    for (int l = 0; l < LIMIT_SOLVED; l++) assert_true(known[l] || l == LIMIT_INTERFERENCE);
    assert_int_equal(find(&j, LIMIT_BSSO_CONTACT)->level, LIMIT_NOT_JUDGED); /* no such cut here */
    assert_int_equal(find(&j, LIMIT_CHIN_ADVANCE)->level, LIMIT_NOT_JUDGED);
}

static void both_down(plan_file *p, double mm)
{
    p->segment[SEGMENT_MAXILLA].move.translate_mm[2] = p->segment[SEGMENT_DISTAL].move.translate_mm[2] = -mm;
}

static void a_gap_stops_where_it_needs_a_graft(void **state)
{
    (void)state;
    limit_id by = LIMIT_COUNT;
    assert_near(bound(both_down, 0, 4.9, &by), 4.5, 0.05); /* and 0.5 of saw */
    assert_int_equal(by, LIMIT_LE_FORT_GAP);
}

static void lower_up(plan_file *p, double mm) { p->segment[SEGMENT_DISTAL].move.translate_mm[2] = mm; }

static void teeth_stop_the_mandible(void **state)
{
    (void)state;
    limit_id by = LIMIT_COUNT;
    assert_near(bound(lower_up, 0, 8, &by), 0.8 + 3, 0.05);
    assert_int_equal(by, LIMIT_TOOTH_OVERLAP);
}

static void lower_closes(plan_file *p, double deg)
{
    plan_segment *s = &p->segment[SEGMENT_DISTAL];
    s->move.pitch_deg = -deg;
    s->has_pivot_point = true;
    s->move.pivot_mm[1] = -20;
    s->move.pivot_mm[2] = -20.8;
}

static void closing_stops_where_the_front_teeth_meet(void **state)
{
    (void)state;
    limit_id by = LIMIT_COUNT;
    patient.limits[LIMIT_OVERJET].stop[1] = 12; /* it is 10 at rest and grows a little */
    double deg = bound(lower_closes, 0, 8, &by);
    patient.limits[LIMIT_OVERJET] = limit_default[LIMIT_OVERJET].range;
    assert_near(60 * sin(deg * pi / 180), 0.8 + 3, 0.05);
    assert_int_equal(by, LIMIT_TOOTH_OVERLAP);
}

static void upper_up(plan_file *p, double mm) { p->segment[SEGMENT_MAXILLA].move.translate_mm[2] = mm; }

static void bone_to_be_trimmed_is_measured(void **state)
{
    (void)state;
    limit_id by = LIMIT_COUNT;
    judgement j;
    plan_file p = still();
    upper_up(&p, 4);
    judged(&p, &j);
    assert_near(find(&j, LIMIT_TRIM_DEPTH)->value, 3.5, 0.05);
    assert_near(find(&j, LIMIT_TRIM_VOLUME)->value, 60 * 70 * 3.5, 0.01 * 60 * 70 * 3.5);
    assert_true(find(&j, LIMIT_TRIM_DEPTH)->has_place);
    assert_int_equal(find(&j, LIMIT_TRIM_VOLUME)->level, LIMIT_CAUTION); /* as it stands, nothing stops there */
    patient.limits[LIMIT_TRIM_VOLUME].stop[1] = 1000;
    judged(&p, &j);
    assert_int_equal(find(&j, LIMIT_TRIM_VOLUME)->level, LIMIT_STOP);
    const judgement_record told = judgement_record_of(&j, &patient, "");
    json_t *written = record_part(&judgement_table, &told), *one;
    size_t i;
    int seen = 0;
    json_array_foreach(json_object_get(written, "limits"), i, one)
    {
        const char *name = json_string_value(json_object_get(one, "limit"));
        const json_t *stop = json_object_get(one, "stop");
        if (strcmp(name, "trim_volume_mm3")) continue;
        assert_true(json_is_null(json_array_get(stop, 0)));
        assert_near(json_number_value(json_array_get(stop, 1)), 1000, 0);
        seen++;
    }
    assert_true(seen > 0);
    json_decref(written);
    patient.limits[LIMIT_TRIM_VOLUME] = limit_default[LIMIT_TRIM_VOLUME].range;
    assert_near(bound(upper_up, 0, 14, &by), 10, 0.05);
    assert_int_equal(by, LIMIT_MAXILLA_IMPACTION);
    patient.limits[LIMIT_MAXILLA_IMPACTION].stop[1] = 30;
    assert_near(bound(upper_up, 0, 14, &by), 10.5, 0.05);
    assert_int_equal(by, LIMIT_TRIM_DEPTH);
    patient.limits[LIMIT_MAXILLA_IMPACTION] = limit_default[LIMIT_MAXILLA_IMPACTION].range;
}

static void roll(plan_file *p, double deg)
{
    p->segment[SEGMENT_MAXILLA].move.roll_deg = p->segment[SEGMENT_DISTAL].move.roll_deg = deg;
}

static void a_canted_bite_is_told(void **state)
{
    (void)state;
    judgement j;
    for (int k = -4; k <= 4; k += 2) {
        plan_file p = still();
        roll(&p, k);
        judged(&p, &j);
        assert_near(find(&j, LIMIT_OCCLUSAL_CANT)->value, k, 1e-9);
        assert_int_equal(find(&j, LIMIT_OCCLUSAL_CANT)->level, abs(k) > 2 ? LIMIT_CAUTION : LIMIT_FINE);
        assert_null(find(&j, LIMIT_OCCLUSAL_CANT)->note);
    }
    /* without molars the canines tell; without both, nothing is fine in silence */
    plan_file p = still();
    roll(&p, 3);
    landmark kept[4];
    static const char *const label[] = {"U6_L", "U6_R", "U3_L", "U3_R"};
    for (int i = 0; i < 4; i++) kept[i] = *landmarks_find(&head.points, label[i]);
    landmark *molar = (landmark *)landmarks_find(&head.points, "U6_L");
    molar->label[0] = 'x';
    judged(&p, &j);
    assert_near(find(&j, LIMIT_OCCLUSAL_CANT)->value, 3, 1e-9);
    assert_non_null(find(&j, LIMIT_OCCLUSAL_CANT)->note);
    landmark *canine = (landmark *)landmarks_find(&head.points, "U3_R");
    canine->label[0] = 'x';
    judged(&p, &j);
    assert_int_equal(find(&j, LIMIT_OCCLUSAL_CANT)->level, LIMIT_NOT_JUDGED);
    *molar = kept[0];
    *canine = kept[3];
}

static void lower_forward(plan_file *p, double mm) { p->segment[SEGMENT_DISTAL].move.translate_mm[1] = -mm; }

static void a_bite_that_does_not_fit_stops(void **state)
{
    (void)state;
    limit_id by = LIMIT_COUNT;
    judgement j;
    patient.limits[LIMIT_MANDIBLE_ADVANCE].stop[1] = 30;
    assert_near(bound(lower_forward, 0, 29, &by), 20, 0.01); /* the overjet is 10 at rest */
    assert_int_equal(by, LIMIT_OVERJET);
    patient.limits[LIMIT_MANDIBLE_ADVANCE] = limit_default[LIMIT_MANDIBLE_ADVANCE].range;
    plan_file p = still();
    lower_forward(&p, -0.1);
    judged(&p, &j);
    assert_int_equal(j.worst, LIMIT_STOP);
    assert_int_equal(j.finding[j.reason].limit, LIMIT_OVERJET);
}

static void an_overjet_of_the_scan_cautions_until_the_plan_worsens_it(void **state)
{
    (void)state;
    const struct {
        double forward_mm, overjet_mm;
        limit_level level;
    } rows[] = {{0, 10, LIMIT_CAUTION},
                {1, 9, LIMIT_CAUTION},
                {-0.1, 10.1, LIMIT_STOP},
                {19, -9, LIMIT_STOP},
                /* turned round */ {4, 6, LIMIT_CAUTION}};
    patient.limits[LIMIT_OVERJET].stop[0] = -8;
    patient.limits[LIMIT_OVERJET].stop[1] = 8;
    patient.limits[LIMIT_MANDIBLE_ADVANCE].stop[1] = 30;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        judgement j;
        plan_file p = still();
        lower_forward(&p, rows[i].forward_mm);
        judged(&p, &j);
        const finding *f = find(&j, LIMIT_OVERJET);
        assert_near(f->value, rows[i].overjet_mm, 1e-9);
        assert_near(f->scan, 10, 1e-9);
        assert_int_equal(f->level, rows[i].level);
        assert_int_equal(f->note != NULL, f->level == LIMIT_CAUTION && f->value > 8);
        assert_false(f->estimated);
    }
    patient.limits[LIMIT_OVERJET] = limit_default[LIMIT_OVERJET].range;
    patient.limits[LIMIT_MANDIBLE_ADVANCE] = limit_default[LIMIT_MANDIBLE_ADVANCE].range;
}

static void warnings_of_the_case_are_findings_of_every_plan(void **state)
{
    (void)state;
    judgement j;
    plan_file p = still();
    judged(&p, &j);
    assert_int_equal(find(&j, LIMIT_CASE_WARNINGS)->level, LIMIT_FINE);
    head.report = json_pack("{s[{ssss}{ssssss}]}", "warnings", "part", "cuts", "text", "Pog lies on the cranium",
                            "part", "landmarks", "field", "U1", "text", "lies 6.0 mm from the skull");
    judged(&p, &j);
    const finding *f = find(&j, LIMIT_CASE_WARNINGS);
    assert_string_equal(f[0].where, "cuts");
    assert_string_equal(f[0].note, "Pog lies on the cranium");
    assert_string_equal(f[1].where, "U1");
    assert_string_equal(f[1].note, "lies 6.0 mm from the skull");
    for (int i = 0; i < 2; i++) assert_int_equal(f[i].level, LIMIT_CAUTION);
    assert_int_not_equal(j.finding[j.reason].limit, LIMIT_CASE_WARNINGS); /* what has a margin decides */
    issue_list told = prepared_warnings(&head, &patient);
    assert_int_equal(told.count, 2);
    assert_string_equal(told.item[0].field, "cuts");
    assert_string_equal(told.item[1].field, "U1");
    issue_list_free(&told);
    json_t *many = json_array(), *one = json_pack("{ssss}", "part", "skull", "text", "doubtful");
    for (int i = 0; i < 1000; i++) json_array_append(many, one);
    json_decref(one);
    json_object_set_new(head.report, "warnings", many);
    judged(&p, &j); /* and none is lost without a word */
    assert_near(j.finding[j.count - 1].value, 960, 0);
    json_decref(head.report);
    head.report = NULL;
}

/* A second head whose teeth touch: apart they lead what is said of the plan. */
static void teeth_that_no_longer_meet_lead(void **state)
{
    (void)state;
    prepared touching = head;
    judge *own = NULL;
    judgement j;
    plan_moves m;
    err e = {0};
    issue_list issues = {0};
    touching.segments.part[SEGMENT_DISTAL] = body_box(-30, -80, -60, 30, -20, -20.1);
    assert_ok(judge_create(&patient, &touching, &own, &e));
    for (int down = 0; down <= 2; down += 2) {
        plan_file p = still();
        p.segment[SEGMENT_DISTAL].move.translate_mm[2] = -down;
        assert_true(plan_moves_set(&p, &patient, &head.points, &m, &issues));
        judge_plan(own, &m, &j);
        assert_true((find(&j, LIMIT_BITE_CONTACTS)->value > 0) == !down);
        assert_int_equal(j.worst, LIMIT_CAUTION);
        assert_int_equal(j.finding[j.reason].limit == LIMIT_BITE_CONTACTS, down > 0);
    }
    assert_string_equal(find(&j, LIMIT_BITE_CONTACTS)->note,
                        "no tooth meets another, as they do in the scan: the bite does not fit");
    judge_free(&own);
    surface_free(&touching.segments.part[SEGMENT_DISTAL]);
    issue_list_free(&issues);
}

static void levels_and_margins_follow_the_ranges(void **state)
{
    (void)state;
    const limit_range gap = {{-LIMIT_OPEN, 3}, {-LIMIT_OPEN, 5}}, depth = {{0, 1}, {0, 3}},
                      room = {{5, LIMIT_OPEN}, {1, LIMIT_OPEN}};
    assert_int_equal(limit_judge(&gap, 3), LIMIT_FINE);
    assert_int_equal(limit_judge(&gap, 3.01), LIMIT_CAUTION);
    assert_int_equal(limit_judge(&gap, 5.01), LIMIT_STOP);
    assert_int_equal(limit_judge(&gap, -4000), LIMIT_FINE);
    assert_int_equal(limit_judge(&gap, (double)NAN), LIMIT_NOT_JUDGED);
    assert_near(limit_margin(&gap, 4), 1, 1e-12);
    assert_near(limit_margin(&depth, 0), 3, 1e-12); /* 0 is no breach in the making */
    assert_near(limit_margin(&room, 0.5), -0.5, 1e-12);
    assert_int_equal(limit_judge(&room, 0.5), LIMIT_STOP);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_and_margins_follow_the_ranges),
        cmocka_unit_test(at_rest_nothing_stops_and_nothing_is_fine_in_silence),
        cmocka_unit_test(a_gap_stops_where_it_needs_a_graft),
        cmocka_unit_test(teeth_stop_the_mandible),
        cmocka_unit_test(closing_stops_where_the_front_teeth_meet),
        cmocka_unit_test(bone_to_be_trimmed_is_measured),
        cmocka_unit_test(a_canted_bite_is_told),
        cmocka_unit_test(a_bite_that_does_not_fit_stops),
        cmocka_unit_test(an_overjet_of_the_scan_cautions_until_the_plan_worsens_it),
        cmocka_unit_test(warnings_of_the_case_are_findings_of_every_plan),
        cmocka_unit_test(teeth_that_no_longer_meet_lead),
    };
    return cmocka_run_group_tests(tests, make_head, drop_head);
}
