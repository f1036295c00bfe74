/* Order of convergence on a manufactured large deformation: 2 in L2 for linear tets. */
#include "tests/physics/evidence.h"
#include "tests/physics/manufactured.h"

static double order_of(double poisson, element_kind kind)
{
    int iterations[3], cells = kind == ELEMENT_AVERAGED ? 3 : 4; /* averages make a far denser matrix */
    double error[3];
    for (int k = 0; k < 3; k++) error[k] = manufactured_error(cells << k, poisson, kind, &iterations[k]);
    double order = log2(error[1] / error[2]);
    print_message("nu %.3f, %s: L2 error %.3g, %.3g, %.3g mm with %d, %d, %d cells, order %.2f then %.2f, "
                  "%d Newton steps\n",
                  poisson, kind == ELEMENT_AVERAGED ? "averaged" : "linear", error[0], error[1], error[2], cells,
                  2 * cells, 4 * cells, log2(error[0] / error[1]), order, iterations[2]);
    char what[96];
    snprintf(what, sizeof what, "manufactured large deformation, Poisson %.3g, %s: order in L2", poisson,
             kind == ELEMENT_AVERAGED ? "averaged volumes" : "linear tets");
    evidence(what, order, "-");
    return order;
}

static void linear_tets_are_of_second_order(void **state)
{
    (void)state;
    assert_true(order_of(0.3, ELEMENT_LINEAR) > 1.98);
    assert_true(order_of(0.45, ELEMENT_LINEAR) > 1.98);
    assert_true(order_of(0.49, ELEMENT_LINEAR) > 1.97);
}

static void averaged_tets_are_of_second_order(void **state)
{
    (void)state;
    assert_true(order_of(0.45, ELEMENT_AVERAGED) > 1.97);
    assert_true(order_of(0.49, ELEMENT_AVERAGED) > 1.97);
    assert_true(order_of(0.499, ELEMENT_AVERAGED) > 1.97);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_tets_are_of_second_order),
        cmocka_unit_test(averaged_tets_are_of_second_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
