/* Where a landmark is sought when others tell more of its place than the template does. */
#include "tests/check.h"
#include "app/planner/identity/point_carry.h"
#include <math.h>

static landmarks row(double ramus_y)
{
    landmarks l = {0};
    landmarks_set(&l, "L1", (double[]){1, -100, -50});
    landmarks_set(&l, "L6_L", (double[]){21, -75, -50});
    landmarks_set(&l, "L6_R", (double[]){-19, -75, -50});
    landmarks_set(&l, "RA_L", (double[]){45, ramus_y, -48});
    landmarks_set(&l, "RA_R", (double[]){-43, ramus_y, -48});
    return l;
}

static void a_row_ends_where_the_ramus_rises(void **state)
{
    (void)state;
    landmarks l = row(-44);
    double left[3] = {25, -60, -49}, right[3] = {-24, -60, -49};
    point_carry_to_ramus(&l, 1, left);
    point_carry_to_ramus(&l, -1, right);
    assert_near(left[0], 1 + 20 * sqrt(56.0 / 25), 1e-12);
    assert_near(right[0], 1 - 20 * sqrt(56.0 / 25), 1e-12);
    assert_near(left[1], -44, 0);
    assert_near(left[2], -49, 0);
    landmarks_free(&l);
}

/* A ramus in front of the molar, or a hand's breadth behind it, was not found. */
static void a_ramus_that_cannot_be_is_not_asked(void **state)
{
    (void)state;
    static const double wrong[] = {-80, 0};
    for (int k = 0; k < 2; k++) {
        landmarks l = row(wrong[k]);
        double x[3] = {25, -60, -49};
        point_carry_to_ramus(&l, 1, x);
        assert_near(x[0], 25, 0);
        assert_near(x[1], -60, 0);
        landmarks_free(&l);
    }
}

static void an_open_mouth_has_the_height_of_its_lower_row(void **state)
{
    (void)state;
    landmarks l = row(-44);
    double x[3] = {40, -44, -48};
    point_carry_to_occlusion(&l, x); /* no upper incisor: nobody knows */
    assert_near(x[2], -48, 0);
    landmarks_set(&l, "U1", (double[]){1, -102, -49});
    point_carry_to_occlusion(&l, x); /* closed */
    assert_near(x[2], -48, 0);
    landmarks_set(&l, "U1", (double[]){1, -102, -40});
    point_carry_to_occlusion(&l, x);
    assert_near(x[2], -50, 1e-12);
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_ends_where_the_ramus_rises),
        cmocka_unit_test(a_ramus_that_cannot_be_is_not_asked),
        cmocka_unit_test(an_open_mouth_has_the_height_of_its_lower_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
