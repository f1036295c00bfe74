/* Points that definitions ask for, on shapes whose answer is known. */
#include "tests/check.h"
#include "app/planner/identity/point_rules.h"
#include "app/planner/identity/point_seek.h"
#include "geometry/vec.h"
#include <string.h>

/* z = height(x, y) over a square of 2 * half mm, facing up. */
static surface sheet(double half, int n, double (*height)(double x, double y))
{
    surface s = surface_new((n + 1) * (n + 1), 2 * n * n);
    int32_t t = 0;
    for (int i = 0; i <= n; i++)
        for (int k = 0; k <= n; k++) {
            double *p = s.xyz + 3 * (size_t)(i * (n + 1) + k);
            p[0] = half * (2.0 * k / n - 1);
            p[1] = half * (2.0 * i / n - 1);
            p[2] = height(p[0], p[1]);
        }
    for (int32_t i = 0; i < n; i++)
        for (int32_t k = 0; k < n; k++) {
            int32_t a = i * (n + 1) + k, b = a + 1, c = a + n + 1, d = c + 1;
            const int32_t two[6] = {a, b, d, a, d, c};
            memcpy(s.tri + 3 * (size_t)t, two, sizeof two);
            t += 2;
        }
    return s;
}

static double bump(double x, double y) { return -((x - 1) * (x - 1) + (y + 2) * (y + 2)) / 20; }
static double pass(double x, double y) { return (y - 1) * (y - 1) / 20 - x * x / 20; }

static void a_tip_is_found_and_a_pull_holds_back_from_it(void **state)
{
    (void)state;
    surface s = sheet(12, 48, bump);
    double x[3];
    point_seek k = {.from = {4, 0, -0.5}, .direction = {0, 0, 1}, .facing = 1, .reach_mm = 8};
    assert_true(point_seek_on(&s, &k, x));
    assert_near(x[0], 1, 0.3);
    assert_near(x[1], -2, 0.3);
    /* height -(x-1)^2/20 against pull (x-4)^2/2: at x = 4 - 3 / (1 + 10 pull) */
    k.pull[0] = 0.1;
    assert_true(point_seek_on(&s, &k, x));
    assert_near(x[0], 2.5, 0.3);
    assert_near(x[1], -2, 0.3);
    k.facing = -1; /* nothing looks away from above */
    assert_false(point_seek_on(&s, &k, x));
    surface_free(&s);
}

static void without_a_direction_the_nearest_place_is_found(void **state)
{
    (void)state;
    surface s = sheet(12, 48, bump);
    double x[3];
    const point_seek k = {.from = {1, -2, 3}, .pull = {1, 1, 1}, .reach_mm = 8};
    assert_true(point_seek_on(&s, &k, x));
    assert_near(vec_distance(x, (const double[3]){1, -2, 0}), 0, 0.3);
    surface_free(&s);
}

static void a_saddle_is_found_along_its_axis(void **state)
{
    (void)state;
    surface s = sheet(12, 48, pass);
    double x[3];
    const point_seek k = {
        .from = {2, -2, 0}, .direction = {0, 0, 1}, .pull = {0.05, 1, 0.02}, .facing = 1, .reach_mm = 8};
    assert_true(point_seek_saddle(&s, &k, 1, x));
    assert_near(x[1], 1, 1);
    surface_free(&s);
}

static void every_rule_is_of_a_label_that_is_known_and_hangs_on_earlier_ones(void **state)
{
    (void)state;
    for (int i = 0; i < point_rule_count; i++) {
        int side;
        const point_rule *r = point_rules + i;
        char label[40];
        snprintf(label, sizeof label, "%s%s", r->label, r->both ? "_R" : "");
        assert_ptr_equal(point_rule_find(label, &side), r);
        assert_int_equal(side, r->both ? -1 : 0);
        const char *needs[3] = {r->chord[0], r->chord[1], r->anchor};
        for (int k = 0; k < 3; k++) {
            bool before = !needs[k];
            for (int j = 0; j < i; j++) before |= needs[k] && !strcmp(point_rules[j].label, needs[k]);
            if (!before) fail_msg("%s asks for %s, which comes later", r->label, needs[k]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tip_is_found_and_a_pull_holds_back_from_it),
        cmocka_unit_test(without_a_direction_the_nearest_place_is_found),
        cmocka_unit_test(a_saddle_is_found_along_its_axis),
        cmocka_unit_test(every_rule_is_of_a_label_that_is_known_and_hangs_on_earlier_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
