/* Orders, errors and the front of a study, from skins made up to have them. */
#include "tests/check.h"
#include "app/study/measures.h"
#include "app/study/record.h"
#include <string.h>
#include "geometry/mem.h"

enum { SKIN = 100 };

/* The front half of the skin moves by 5 mm and is off by `off` mm; the rest does not move. */
static study_run made_up(int i, double off, double wall_s)
{
    study_run r = {.rung = &study_rungs[i], .skin_count = SKIN, .skin_mm = NEW_ARRAY(double, 3 * SKIN)};
    for (int v = 0; v < SKIN / 2; v++) {
        r.skin_mm[3 * v] = 5;
        r.skin_mm[3 * v + 1] = off;
    }
    r.result = (study_result){.solved = true, .wall_s = wall_s, .size_mm = 1};
    return r;
}

static void an_order_is_found_again(void **state)
{
    (void)state;
    for (double p = 0.5; p < 3.1; p += 0.5) { /* errors 1, 2^-p, 4^-p */
        double d[2] = {1 - exp2(-2 * p), exp2(-p) - exp2(-2 * p)};
        assert_near(study_order(d), p, 1e-9);
    }
    assert_true(isnan(study_order((double[]){1, 1.1})));
    double h[4] = {4, 2, 1, 0.5}, e[4] = {32, 8, 2, 0.5};
    assert_near(study_slope(h, e, 4), 2, 1e-9);
    assert_true(isnan(study_slope(h, e, 1)));
}

static void only_skin_that_moves_counts(void **state)
{
    (void)state;
    study_run a = made_up(0, 0.3, 1), b = made_up(1, 0, 1);
    a.skin_mm[3 * (SKIN - 1)] = 9; /* still in b */
    study_error e = study_compare(&a, &b);
    assert_int_equal(e.vertices, SKIN / 2);
    assert_near(e.mean_mm, 0.3, 1e-12);
    assert_near(e.max_mm, 0.3, 1e-12);
    study_run none = {0};
    assert_true(isnan(study_compare(&none, &b).mean_mm));
    study_run_free(&a);
    study_run_free(&b);
}

static void the_soonest_is_near_enough_with_the_references_own_error(void **state)
{
    (void)state;
    study_table t = {.count = study_rung_count, .run = NEW_ARRAY(study_run, study_rung_count)};
    for (int i = 0; i < study_rung_count; i++) t.run[i] = made_up(i, 1, 50);
    const double off[4] = {0.40, 0.15, 0.04, 0};
    const int which[4] = {study_family[0], study_family[1], study_default, study_reference};
    const double wall[4] = {1, 4, 8, 60};
    for (int k = 0; k < 4; k++) {
        study_run_free(&t.run[which[k]]);
        t.run[which[k]] = made_up(which[k], off[k], wall[k]);
    }
    study_run_free(&t.run[study_family[2]]);
    t.run[study_family[2]] = made_up(study_family[2], 0.0667, 30);
    study_table_make(&t);
    assert_near(t.order, log2((0.40 - 0.0667) / (0.15 - 0.0667) - 1), 1e-9);
    assert_near(t.reference_error_mm, 0.04 / (exp2(t.order) - 1), 1e-9);
    assert_true(t.best[study_family[0]] && t.best[study_family[1]] && t.best[study_default]);
    assert_false(t.best[study_family[2]]); /* slower and farther than the default */
    assert_int_equal(study_soonest(&t, 0.1, false, t.reference_error_mm), study_default);
    assert_int_equal(study_soonest(&t, 0.5, false, t.reference_error_mm), study_family[0]);
    assert_int_equal(study_soonest(&t, 0.04, false, t.reference_error_mm), -1);
    assert_int_equal(study_soonest(&t, 0.05, false, 0), study_default);
    study_table_free(&t);
}

/* What programs read of a study: every setting and tube, null where there is no answer. */
static void the_record_has_every_setting(void **state)
{
    (void)state;
    static case_file patient;
    const study_task work = {.patient = &patient};
    study_table t = {
        .task = &work, .plan_name = "plan", .count = study_rung_count, .run = NEW_ARRAY(study_run, study_rung_count)};
    for (int i = 0; i < study_rung_count; i++) t.run[i] = made_up(i, 0.1, 50);
    t.run[study_default].result.unknowns = 5000000000;
    study_table_make(&t);
    json_t *o = study_json(&t), *runs = json_object_get(o, "runs"), *own = json_array_get(runs, (size_t)study_default);
    assert_string_equal(record_kind_of(o), "study");
    assert_int_equal(json_array_size(runs), study_rung_count);
    assert_int_equal(json_array_size(json_object_get(o, "tubes")), STUDY_TUBES);
    assert_string_equal(json_string_value(json_object_get(own, "setting")), study_rungs[study_default].name);
    assert_int_equal(json_integer_value(json_object_get(own, "unknowns")), 5000000000);
    assert_true(json_is_null(json_object_get(own, "meshing_s"))); /* not known */
    assert_near(json_number_value(json_object_get(own, "mean_error_mm")), t.error[study_default].mean_mm, 1e-15);
    json_decref(o);
    study_table_free(&t);
}

/* The value of the measure of that name in a run that moves each named point by mm (forward, up, left). */
static double measured(const prepared *p, const char *name, const char *const *label, double mm[][3], int count)
{
    study_run r = {.point_count = p->points.count, .point_mm = NEW_ARRAY(double, 3 * (size_t)p->points.count)};
    double value = (double)NAN;
    for (int i = 0; i < count; i++) {
        double *d = r.point_mm + 3 * (landmarks_find(&p->points, label[i]) - p->points.point);
        d[0] = mm[i][2];
        d[1] = -mm[i][0];
        d[2] = mm[i][1];
    }
    for (int i = 0; i < STUDY_MEASURES; i++) {
        char own[96];
        study_measure_name(&study_measures[i], own, sizeof own);
        if (strcmp(own, name)) continue;
        value = study_measure_value(&study_measures[i], p, &r);
        break;
    }
    free(r.point_mm);
    return value;
}

static void published_measures_are_taken_from_landmarks(void **state)
{
    (void)state;
    static const struct {
        const char *label;
        double xyz[3];
    } at[] = {{"U1", {0, 0, 0}},      {"Ls", {0, -10, 5}},     {"Sn", {0, -10, 20}},     {"Pn", {0, -25, 20}},
              {"Al_L", {18, -5, 22}}, {"Al_R", {-18, -5, 22}}, {"Li_soft", {0, -9, -5}}, {"L1", {0, 1, -2}}};
    prepared p = {.frame = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) landmarks_set(&p.points, at[i].label, at[i].xyz);
    const char *const lip[2] = {"U1", "Ls"}, *const wing[2] = {"Al_L", "Al_R"}, *const lower[2] = {"L1", "Li_soft"};
    double both[2][3] = {{5, 0, 0}, {4, 1, 0}}, wide[2][3] = {{0, 0, 1.5}, {0, 0, -0.5}},
           thin[2][3] = {{6, 0, 0}, {4, 0, 0}};
    assert_near(measured(&p, "Ls : U1, forward", lip, both, 2), 0.8, 1e-12);
    assert_near(measured(&p, "Ls up : U1 forward", lip, both, 2), 0.2, 1e-12);
    assert_near(measured(&p, "Al_L to Al_R, wider by mm", wing, wide, 2), 2, 1e-12);
    assert_near(measured(&p, "Li_soft before L1, thicker by mm", lower, thin, 2), -2, 1e-12);
    /* a right angle at Sn, level nose over upright lip: the lip goes 4 mm forward and 1 up, 14 below Sn then */
    assert_near(measured(&p, "nasolabial angle, degrees per mm of U1 forward", lip, both, 2),
                -atan2(4, 14) * 180 / M_PI / 5, 1e-9);
    double still[2][3] = {{0.4, 0, 0}, {4, 0, 0}}; /* the bone hardly moves */
    assert_true(isnan(measured(&p, "Ls : U1, forward", lip, still, 2)));
    assert_true(isnan(measured(&p, "Stms up : U1 forward", lip, both, 2)));
    for (int i = 0; i < STUDY_MEASURES; i++) {
        const study_measure *m = &study_measures[i];
        assert_true(m->move >= 0 && m->move < study_move_count && m->low < m->high);
        if (!strcmp(m->soft, "Stms")) assert_string_equal(study_measure_lacks(m, &p), "Stms");
        if (!strcmp(m->soft, "Ls") && !strcmp(m->hard, "U1")) assert_null(study_measure_lacks(m, &p));
    }
    landmarks_free(&p.points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_order_is_found_again),
        cmocka_unit_test(only_skin_that_moves_counts),
        cmocka_unit_test(the_record_has_every_setting),
        cmocka_unit_test(published_measures_are_taken_from_landmarks),
        cmocka_unit_test(the_soonest_is_near_enough_with_the_references_own_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
