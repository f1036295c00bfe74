/* Main directions of long vectors: against closed forms, known low rank, and the same with less known. */
#include "sim/principal.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "tests/check.h"
#include <string.h>

enum { LENGTH = 9001, COUNT = 12 };

static double *sample[COUNT], *weight;
static uint64_t state = 1;

static double random_number(void) /* -1 to 1 */
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / (double)(1ull << 52) - 1;
}

/* Samples of `rank` smooth directions, falling in size, and noise. */
static void draw(int rank, double noise)
{
    state = 7;
    for (int s = 0; s < COUNT; s++) {
        double share[COUNT];
        for (int k = 0; k < COUNT; k++) share[k] = 3 * random_number() / (k + 1);
        for (int i = 0; i < LENGTH; i++) {
            sample[s][i] = 50 + noise * random_number();
            for (int k = 0; k < rank; k++) sample[s][i] += share[k] * cos((k + 1) * (i + 0.5) * M_PI / LENGTH);
        }
    }
    for (int i = 0; i < LENGTH; i++) weight[i] = (1 + 0.5 * sin(i)) / LENGTH;
}

static int setup(void **unused)
{
    (void)unused;
    for (int s = 0; s < COUNT; s++) sample[s] = NEW_ARRAY(double, LENGTH);
    weight = NEW_ARRAY(double, LENGTH);
    return 0;
}

static int teardown(void **unused)
{
    (void)unused;
    for (int s = 0; s < COUNT; s++) free(sample[s]);
    free(weight);
    return 0;
}

static principal learnt(int most)
{
    err e = {0};
    principal m;
    assert_ok(principal_learn((const double *const *)sample, COUNT, LENGTH, weight, most, &m, &e));
    return m;
}

static double product(const principal *m, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < LENGTH; i++) sum += m->weight[i] * a[i] * b[i];
    return sum;
}

static double largest_difference(const double *a, const double *b)
{
    double largest = 0;
    for (int i = 0; i < LENGTH; i++) largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

static void modes_are_of_unit_length_and_across_each_other(void **unused)
{
    (void)unused;
    draw(COUNT, 0.1);
    principal m = learnt(40);
    assert_int_equal(m.mode_count, COUNT - 1);
    for (int k = 0; k < m.mode_count; k++)
        for (int j = 0; j <= k; j++)
            assert_near(product(&m, m.mode + (size_t)k * LENGTH, m.mode + (size_t)j * LENGTH), j == k, 1e-10);
    double share = 0;
    for (int k = 0; k < m.mode_count; k++) {
        share += principal_share(&m, k);
        assert_true(k == 0 || m.sd[k] <= m.sd[k - 1]);
    }
    assert_near(share, 1, 1e-12);
    principal_free(&m);
}

static void with_all_modes_the_samples_come_back(void **unused)
{
    (void)unused;
    draw(COUNT, 0.1);
    principal m = learnt(40);
    double p[COUNT], square[COUNT] = {0}, *x = NEW_ARRAY(double, LENGTH);
    for (int s = 0; s < COUNT; s++) {
        principal_project(&m, sample[s], p);
        principal_make(&m, p, m.mode_count, x);
        assert_near(largest_difference(x, sample[s]), 0, 1e-9);
        for (int k = 0; k < m.mode_count; k++) square[k] += p[k] * p[k];
    }
    for (int k = 0; k < m.mode_count; k++) assert_near(square[k] / (COUNT - 1), 1, 1e-9); /* in standard deviations */
    free(x);
    principal_free(&m);
}

static void three_directions_are_found_to_be_three(void **unused)
{
    (void)unused;
    draw(3, 0);
    principal m = learnt(40);
    assert_int_equal(m.mode_count, 3);
    /* each of the directions lies in the modes: what is left of it is nothing */
    for (int k = 0; k < 3; k++) {
        double *x = NEW_ARRAY(double, LENGTH), *back = NEW_ARRAY(double, LENGTH), p[3];
        for (int i = 0; i < LENGTH; i++) x[i] = m.mean[i] + 5 * cos((k + 1) * (i + 0.5) * M_PI / LENGTH);
        principal_project(&m, x, p);
        principal_make(&m, p, 3, back);
        assert_near(largest_difference(x, back), 0, 1e-9);
        free(x);
        free(back);
    }
    principal_left_out l;
    err e = {0};
    assert_ok(principal_leave_out((const double *const *)sample, COUNT, LENGTH, weight, 40, &l, &e));
    assert_true(l.rms[2] > 0.01);
    assert_near(l.rms[3], 0, 1e-6);
    principal_left_out_free(&l);
    principal_free(&m);
}

/* Half of the coordinates move by one unit in one direction, the others by two in another: weights decide which is the
 * first. A coordinate that is repeated ten times with a tenth of the weight counts as it did. */
static void weights_decide_what_counts(void **unused)
{
    (void)unused;
    for (int s = 0; s < COUNT; s++)
        for (int i = 0; i < LENGTH; i++) sample[s][i] = i < LENGTH / 2 ? (s % 2 ? 1 : -1) : (s / 2 % 2 ? 2 : -2);
    for (int i = 0; i < LENGTH; i++) weight[i] = 1;
    principal even = learnt(2);
    assert_true(fabs(even.mode[LENGTH - 1]) > 100 * fabs(even.mode[0]));
    for (int i = 0; i < LENGTH / 2; i++) weight[i] = 100;
    principal uneven = learnt(2);
    assert_true(fabs(uneven.mode[0]) > 100 * fabs(uneven.mode[LENGTH - 1]));
    principal_free(&even);
    principal_free(&uneven);
    draw(4, 0);
    for (int i = 0; i < LENGTH; i++)
        weight[i] = i % 9 ? 0.125 : 1; /* eight more after each, which weigh as much as it */
    for (int s = 0; s < COUNT; s++)
        for (int i = 0; i < LENGTH; i++) sample[s][i] = sample[s][i / 9 * 9];
    principal dense = learnt(4);
    for (int i = 0; i < LENGTH; i++) weight[i] = i % 9 ? 0 : 2;
    weight[LENGTH - 1] = 1; /* the last has none after it */
    principal sparse = learnt(4);
    for (int k = 0; k < 4; k++) assert_near(dense.sd[k] / sparse.sd[k], 1, 1e-9);
    principal_free(&dense);
    principal_free(&sparse);
}

static void threads_do_not_change_a_bit(void **unused)
{
    (void)unused;
    draw(COUNT, 0.1);
    double p[4][COUNT], *x[4];
    for (int t = 0; t < 4; t++) {
        parallel_set_threads((const int[]){1, 2, 3, 8}[t]);
        principal m = learnt(6);
        x[t] = NEW_ARRAY(double, LENGTH);
        principal_project(&m, sample[3], p[t]);
        principal_make(&m, p[t], 6, x[t]);
        assert_memory_equal(p[t], p[0], 6 * sizeof(double));
        assert_memory_equal(x[t], x[0], LENGTH * sizeof(double));
        principal_free(&m);
    }
    parallel_set_threads(0);
    for (int t = 0; t < 4; t++) free(x[t]);
}

static void the_order_of_the_samples_changes_nothing(void **unused)
{
    (void)unused;
    draw(COUNT, 0.1);
    principal m = learnt(6);
    double *turned[COUNT];
    for (int s = 0; s < COUNT; s++) turned[s] = sample[(s * 5 + 3) % COUNT];
    err e = {0};
    principal other;
    assert_ok(principal_learn((const double *const *)turned, COUNT, LENGTH, weight, 6, &other, &e));
    assert_near(largest_difference(m.mean, other.mean), 0, 1e-12);
    for (int k = 0; k < 6; k++) {
        assert_near(m.sd[k], other.sd[k], 1e-11);
        assert_near(largest_difference(m.mode + (size_t)k * LENGTH, other.mode + (size_t)k * LENGTH), 0, 1e-6);
    }
    principal_left_out a, b;
    assert_ok(principal_leave_out((const double *const *)sample, COUNT, LENGTH, weight, 6, &a, &e));
    assert_ok(principal_leave_out((const double *const *)turned, COUNT, LENGTH, weight, 6, &b, &e));
    for (int s = 0; s < COUNT; s++)
        for (int t = 0; t < COUNT; t++)
            assert_near(b.mixture[s * COUNT + t], a.mixture[(s * 5 + 3) % COUNT * COUNT + (t * 5 + 3) % COUNT], 1e-9);
    principal_left_out_free(&a);
    principal_left_out_free(&b);
    principal_free(&m);
    principal_free(&other);
}

/* Against the plain way: modes learnt anew without the sample, which is projected and made again. */
static void leaving_one_out_is_what_learning_without_it_gives(void **unused)
{
    (void)unused;
    draw(COUNT, 0.3);
    err e = {0};
    principal_left_out l;
    assert_ok(principal_leave_out((const double *const *)sample, COUNT, LENGTH, weight, 5, &l, &e));
    double square[6] = {0}, p[5], *x = NEW_ARRAY(double, LENGTH), *quick = NEW_ARRAY(double, LENGTH);
    for (int s = 0; s < COUNT; s++) {
        const double *others[COUNT];
        for (int i = 0; i < COUNT - 1; i++) others[i] = sample[i < s ? i : i + 1];
        principal m;
        assert_ok(principal_learn(others, COUNT - 1, LENGTH, weight, 5, &m, &e));
        principal_project(&m, sample[s], p);
        for (int k = 0; k <= 5; k++) {
            principal_make(&m, p, k, x);
            for (int i = 0; i < LENGTH; i++) square[k] += weight[i] * pow(x[i] - sample[s][i], 2) / COUNT;
        }
        principal_left_out_make(&l, (const double *const *)sample, LENGTH, s, quick);
        assert_near(largest_difference(x, quick), 0, 1e-9);
        principal_free(&m);
    }
    for (int k = 0; k <= 5; k++) assert_near(l.rms[k], sqrt(square[k]), 1e-9);
    free(x);
    free(quick);
    principal_left_out_free(&l);
}

static void what_is_missing_is_completed(void **unused)
{
    (void)unused;
    draw(3, 0);
    err e = {0};
    principal m = learnt(3);
    double p[3], whole[3], *known = NEW_ARRAY(double, LENGTH), *x = COPY_ARRAY(double, sample[2], LENGTH),
                           *back = NEW_ARRAY(double, LENGTH);
    principal_project(&m, x, whole);
    for (int i = 0; i < LENGTH; i++) known[i] = i < LENGTH / 3;
    for (int i = LENGTH / 3; i < LENGTH; i++) x[i] = 1e6; /* never looked at */
    assert_ok(principal_complete(&m, x, known, 1e-6, p, &e));
    principal_make(&m, p, 3, back);
    assert_near(largest_difference(back, sample[2]), 0, 1e-6);
    for (int k = 0; k < 3; k++) assert_near(p[k], whole[k], 1e-6);
    assert_ok(principal_complete(&m, x, known, 1e6, p, &e)); /* numbers that say nothing: the mean is likeliest */
    for (int k = 0; k < 3; k++) assert_near(p[k], 0, 1e-3);
    memset(known, 0, LENGTH * sizeof *known);
    assert_refused(principal_complete(&m, x, known, 1, p, &e), ERR_GEOMETRY);
    free(known);
    free(x);
    free(back);
    principal_free(&m);
}

static void refuses_one_sample_numbers_that_are_none_and_samples_all_alike(void **unused)
{
    (void)unused;
    err e = {0};
    principal m = {0};
    principal_left_out l = {0};
    const double *const *const all = (const double *const *)sample;
    draw(3, 0);
    assert_refused(principal_learn(all, 1, LENGTH, weight, 5, &m, &e), ERR_GEOMETRY);
    assert_refused(principal_leave_out(all, 2, LENGTH, weight, 5, &l, &e), ERR_GEOMETRY);
    sample[4][100] = (double)NAN;
    assert_false(principal_learn(all, COUNT, LENGTH, weight, 5, &m, &e));
    assert_string_equal(e.text, "coordinate 100 of sample 4 is not a finite number");
    e = (err){0};
    for (int s = 0; s < COUNT; s++) memcpy(sample[s], sample[0], LENGTH * sizeof(double));
    assert_refused(principal_learn(all, COUNT, LENGTH, weight, 5, &m, &e), ERR_GEOMETRY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes_are_of_unit_length_and_across_each_other),
        cmocka_unit_test(with_all_modes_the_samples_come_back),
        cmocka_unit_test(three_directions_are_found_to_be_three),
        cmocka_unit_test(weights_decide_what_counts),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(the_order_of_the_samples_changes_nothing),
        cmocka_unit_test(leaving_one_out_is_what_learning_without_it_gives),
        cmocka_unit_test(what_is_missing_is_completed),
        cmocka_unit_test(refuses_one_sample_numbers_that_are_none_and_samples_all_alike),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
