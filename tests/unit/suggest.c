#include "tests/check.h"
#include "geometry/suggest.h"

static const char *const names[] = {"check", "prepare", "predict", "maxilla_advance_mm", "maxilla_impaction_mm"};
enum { COUNT = sizeof names / sizeof names[0] };

static void one_slip_finds_the_name(void **state)
{
    (void)state;
    assert_int_equal(suggest_nearest("chekc", names, COUNT), 0);    /* swapped neighbours */
    assert_int_equal(suggest_nearest("prepar", names, COUNT), 1);   /* left out */
    assert_int_equal(suggest_nearest("preddict", names, COUNT), 2); /* doubled */
    assert_int_equal(suggest_nearest("Check", names, COUNT), 0);    /* upper case */
    assert_int_equal(suggest_nearest("maxila_advance_mm", names, COUNT), 3);
    assert_int_equal(suggest_nearest("maxilla_impact_mm", names, COUNT), 4);
}

static void something_else_finds_nothing(void **state)
{
    (void)state;
    assert_int_equal(suggest_nearest("render", names, COUNT), -1);
    assert_int_equal(suggest_nearest("", names, COUNT), -1);
    assert_int_equal(suggest_nearest("check", names, 0), -1);
    char longest[200];
    for (int i = 0; i < 199; i++) longest[i] = 'a';
    longest[199] = 0;
    assert_int_equal(suggest_nearest(longest, names, COUNT), -1);
}

static void the_first_of_equals_is_named(void **state)
{
    (void)state;
    static const char *const twins[] = {"abcd", "abce"};
    assert_int_equal(suggest_nearest("abcf", twins, 2), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_slip_finds_the_name),
        cmocka_unit_test(something_else_finds_nothing),
        cmocka_unit_test(the_first_of_equals_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
