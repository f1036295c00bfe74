/* First molars that are missing: what stands for them, and that nothing is measured between different teeth. */
#include "tests/check.h"
#include "geometry/molar.h"
#include "geometry/vec.h"

static landmarks arch(void)
{
    static const landmark all[] = {{"U1", {0, -90, -20}, 0},
                                   {"U3_L", {17, -82, -20}, 0},
                                   {"U3_R", {-17, -82, -20}, 0},
                                   {"U6_L", {25, -62, -20}, 0},
                                   {"U7_R", {-27, -52, -19}, 0}};
    landmarks l = {0};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) landmarks_set(&l, all[i].label, all[i].xyz);
    return l;
}

static void its_own_cusp_tells_first(void **state)
{
    (void)state;
    landmarks l = arch();
    molar m;
    landmarks_set(&l, "U5_L", (const double[3]){23, -68, -20});
    assert_true(molar_find(&l, true, 1, &m));
    assert_true(!m.stands_in);
    assert_string_equal(m.by, "U6_L");
    assert_near(vec_distance(m.xyz, (const double[3]){25, -62, -20}), 0, 0);
    landmarks_free(&l);
}

static void the_next_tooth_stands_for_a_missing_one(void **state)
{
    (void)state;
    landmarks l = arch();
    molar m;
    double back;
    assert_true(molar_find(&l, true, -1, &m) && m.stands_in);
    assert_string_equal(m.by, "U7_R");
    assert_near(vec_distance(m.xyz, (const double[3]){-27, -52, -19}), 10, 1e-9); /* a crown's width forwards */
    assert_true(m.xyz[1] < -60 && m.xyz[1] > -63);
    assert_false(molar_find(&l, false, 1, &m)); /* the lower jaw has none */
    landmarks_set(&l, "L1", (const double[3]){0, -87, -20});
    landmarks_set(&l, "L7_L", (const double[3]){28, -40, -20}); /* a corner, no cusp */
    assert_false(molar_find(&l, false, 1, &m));
    landmarks_set(&l, "L5_L", (const double[3]){22, -68, -20});
    assert_true(molar_find(&l, false, 1, &m) && m.stands_in);
    back = m.xyz[1] + 68;
    assert_true(back > 3 && back < 6.01); /* behind the premolar, along the arch */
    landmarks_free(&l);
}

static void sides_are_compared_by_the_same_tooth_only(void **state)
{
    (void)state;
    landmarks l = arch();
    const landmark *pair[2];
    assert_false(molar_pair(&l, true, pair)); /* a first one left, a second one right */
    landmarks_set(&l, "U7_L", (const double[3]){27, -52, -20});
    assert_true(molar_pair(&l, true, pair));
    assert_string_equal(pair[0]->label, "U7_L");
    assert_string_equal(pair[1]->label, "U7_R");
    landmarks_set(&l, "U6_R", (const double[3]){-25, -62, -20});
    assert_true(molar_pair(&l, true, pair));
    assert_string_equal(pair[0]->label, "U6_L");
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_own_cusp_tells_first),
        cmocka_unit_test(the_next_tooth_stands_for_a_missing_one),
        cmocka_unit_test(sides_are_compared_by_the_same_tooth_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
