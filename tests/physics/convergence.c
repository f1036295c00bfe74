/* Order of convergence on a manufactured large deformation: 2 in L2 for linear tets. */
#include "tests/physics/evidence.h"
#include "tests/physics/manufactured.h"

static double order_of(double poisson, bool average)
{
    int iterations[3], cells = average ? 3 : 4; /* averages make a far denser matrix */
    double error[3];
    for (int k = 0; k < 3; k++) error[k] = manufactured_error(cells << k, poisson, average, &iterations[k]);
    double order = log2(error[1] / error[2]);
    print_message("nu %.2f, %s: L2 error %.3g, %.3g, %.3g mm with %d, %d, %d cells, order %.2f then %.2f, "
                  "%d Newton steps\n",
                  poisson, average ? "averaged" : "plain", error[0], error[1], error[2], cells, 2 * cells,
                  4 * cells, log2(error[0] / error[1]), order, iterations[2]);
    char what[96];
    snprintf(what, sizeof what, "manufactured large deformation, Poisson %.2f, %s: order in L2", poisson,
             average ? "averaged volumes" : "plain tets");
    evidence(what, order, "-");
    return order;
}

static void linear_tets_are_of_second_order(void **state)
{
    (void)state;
    assert_true(order_of(0.3, false) > 1.9);
    assert_true(order_of(0.45, false) > 1.9);
    assert_true(order_of(0.49, false) > 1.7); /* locking holds it up: it gets there later */
}

static void averaged_tets_are_of_second_order(void **state)
{
    (void)state;
    assert_true(order_of(0.45, true) > 1.9);
    assert_true(order_of(0.49, true) > 1.9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_tets_are_of_second_order),
        cmocka_unit_test(averaged_tets_are_of_second_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
