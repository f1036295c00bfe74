/* Orders, errors and the front of a study, from skins made up to have them. */
#include "tests/check.h"
#include "app/study/study.h"
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_order_is_found_again),
        cmocka_unit_test(only_skin_that_moves_counts),
        cmocka_unit_test(the_soonest_is_near_enough_with_the_references_own_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
