/* Smooth distances: as exact as they claim, and as smooth. */
#include "geometry/distance_field.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "tests/check.h"
#include "tests/unit/sphere.h"
#include <math.h>
#include <string.h>

static const double centre[3] = {3, -2, 7}, radius = 6;

static distance_field *make(nearest **tree, double step)
{
    err e = {0};
    surface s = sphere(centre, radius, 60);
    double low[3], high[3];
    surface_bounds(&s, low, high);
    assert_ok(nearest_create(&s, tree, &e));
    surface_free(&s);
    return distance_field_create(*tree, low, high, step, 3);
}

static void random_point(uint64_t *seed, double off, double x[3])
{
    for (int c = 0; c < 3; c++) {
        *seed = *seed * 6364136223846793005u + 1442695040888963407u;
        x[c] = (double)(*seed >> 11) / 4503599627370496.0 - 1;
    }
    vec_normalize(x);
    vec_axpy(centre, radius + off, x, x);
}

static void distance_to_a_sphere_is_off_by_its_bend(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int half = 0; half < 2; half++) {
        nearest *tree;
        double step = half ? 0.25 : 0.5, worst = 0;
        distance_field *f = make(&tree, step);
        for (int k = 0; k < 300; k++) {
            double off = -2 + 4 * (k / 300.0), x[3], n[3];
            distance_value v;
            random_point(&seed, off, x);
            distance_field_at(f, x, true, &v);
            double bend = step * step / 6 * 2 / (radius + off);
            worst = fmax(worst, fabs(v.d - off - bend));
            vec_sub(x, centre, n);
            vec_normalize(n);
            assert_true(vec_dot(n, v.grad) > 0.99 && fabs(vec_norm(v.grad) - 1) < 0.02);
        }
        printf("step %.2f mm: %.4f mm beyond its bend\n", step, worst);
        assert_true(worst < 0.012); /* the sphere is a polyhedron, 0.008 mm inside */
        distance_field_destroy(&f);
        nearest_destroy(&tree);
    }
}

/* Kept samples are those that a field finds by itself, and what was not kept is found. */
static void what_was_kept_is_what_is_found(void **state)
{
    (void)state;
    nearest *tree[3];
    distance_field *asked = make(&tree[0], 0.5), *finder = make(&tree[1], 0.5), *lent = make(&tree[2], 0.5);
    const double place[6] = {3, -2, 7 + radius, (double)NAN, 0, 0};
    distance_samples kept = distance_field_find(finder, place, 2, 2);
    distance_field_destroy(&finder);
    surface s = sphere(centre, radius, 60);
    double low[3], high[3];
    surface_bounds(&s, low, high);
    surface_free(&s);
    assert_true(kept.count > 20 && kept.count < 400);
    assert_true(distance_samples_sound(&kept, low, high, 0.5, 3));
    for (size_t i = 0; i < 64 * (size_t)kept.count; i++) kept.value[i] += 1; /* so that it shows whose they are */
    distance_field_lend(lent, &kept);
    uint64_t seed = 5;
    int raised = 0;
    for (int k = 0; k < 3000; k++) {
        double x[3];
        distance_value a, b;
        random_point(&seed, -2 + 4 * (k / 3000.0), x);
        bool near = fabs(x[0] - 3) < 2 && fabs(x[1] + 2) < 2 && fabs(x[2] - 7 - radius) < 2;
        distance_field_at(asked, x, true, &a);
        distance_field_at(lent, x, true, &b);
        if (near) assert_near(b.d, a.d + 1, 1e-6);
        if (x[2] < 7) assert_true(b.d == a.d && !memcmp(b.grad, a.grad, sizeof b.grad));
        raised += near;
    }
    assert_true(raised > 10);
    distance_field_destroy(&asked);
    distance_field_destroy(&lent);
    distance_samples_free(&kept);
    for (int i = 0; i < 3; i++) nearest_destroy(&tree[i]);
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    nearest *tree;
    distance_field *f = make(&tree, 0.5);
    uint64_t seed = 2;
    for (int k = 0; k < 100; k++) {
        double x[3], h = 1e-5;
        distance_value v, up, down;
        random_point(&seed, -5.9 + 0.08 * k, x); /* from the very middle, where the distance itself has no derivative */
        distance_field_at(f, x, true, &v);
        for (int c = 0; c < 3; c++) {
            double at[3];
            vec_copy(x, at);
            at[c] += h;
            distance_field_at(f, at, false, &up);
            at[c] -= 2 * h;
            distance_field_at(f, at, false, &down);
            assert_near((up.d - down.d) / (2 * h), v.grad[c], 1e-6);
            for (int r = 0; r < 3; r++) assert_near((up.grad[r] - down.grad[r]) / (2 * h), v.hess[3 * r + c], 1e-4);
        }
    }
    distance_field_destroy(&f);
    nearest_destroy(&tree);
}

static void far_outside_it_says_so_and_inside_it_never_does(void **state)
{
    (void)state;
    nearest *tree;
    distance_field *f = make(&tree, 0.5);
    distance_value v;
    distance_field_at(f, (double[]){3, -2, 7}, false, &v);
    assert_near(v.d, -radius, 0.6); /* where all ways out are equal it is rounded off, by about a step */
    distance_field_at(f, (double[]){3, -2, 7 + radius + 2.9}, false, &v);
    assert_near(v.d, 2.9, 0.02);
    distance_field_at(f, (double[]){3, -2, 7 + radius + 8}, false, &v);
    assert_true(v.d == HUGE_VAL);
    distance_field_at(f, (double[]){1e6, -1e9, (double)NAN}, false, &v);
    assert_true(v.d == HUGE_VAL);
    double hit[3], normal[3];
    assert_true(distance_field_leave(f, (double[]){3, -2, 9}, (double[]){0, 0, 1}, 8, hit, normal));
    assert_near(hit[2], 7 + radius, 0.01);
    assert_near(normal[2], 1, 1e-3);
    assert_false(distance_field_leave(f, (double[]){3, -2, 20}, (double[]){0, 0, 1}, 50, hit, normal));
    assert_false(
        distance_field_leave(f, (double[]){3, -2, 9}, (double[]){0, 0, 1}, 3, hit, normal)); /* not within 3 mm */
    assert_true(
        distance_field_leave(f, (double[]){3, -2, 0}, (double[]){0, 0, 1}, 20, hit, normal)); /* in and out again */
    assert_near(hit[2], 7 + radius, 0.01);
    distance_field_destroy(&f);
    nearest_destroy(&tree);
}

typedef struct ask {
    const distance_field *f;
    double *d;
} ask;

static void ask_body(int64_t begin, int64_t end, void *context)
{
    ask *a = context;
    for (int64_t i = begin; i < end; i++) {
        uint64_t seed = (uint64_t)i;
        double x[3];
        distance_value v;
        random_point(&seed, -1 + 0.001 * (double)i, x);
        distance_field_at(a->f, x, false, &v);
        a->d[i] = v.d;
    }
}

static void threads_that_ask_at_once_get_the_same_bits(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    static double d[2][COUNT];
    for (int k = 0; k < 2; k++) {
        nearest *tree;
        distance_field *f = make(&tree, 0.5);
        parallel_set_threads(k ? 8 : 1);
        parallel_for(COUNT, 7, ask_body, &(ask){f, d[k]});
        distance_field_destroy(&f);
        nearest_destroy(&tree);
    }
    parallel_set_threads(0);
    assert_memory_equal(d[0], d[1], sizeof d[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_to_a_sphere_is_off_by_its_bend),
        cmocka_unit_test(what_was_kept_is_what_is_found),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(far_outside_it_says_so_and_inside_it_never_does),
        cmocka_unit_test(threads_that_ask_at_once_get_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
