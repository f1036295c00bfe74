#include "tests/check.h"
#include "tests/unit/sphere.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/sdf_grid.h"
#include <string.h>

static const double centre[3] = {1.3, -2.1, 0.7};
static const double low[3] = {-20, -20, -20}, high[3] = {20, 20, 20};

static void the_distance_to_a_sphere_is_right(void **state)
{
    (void)state;
    err e = {0};
    surface s = sphere(centre, 12, 60);
    sdf_grid g;
    assert_ok(sdf_grid_make(&s, low, high, 1, 4, &g, &e));
    for (int i = 0; i < 200; i++) {
        double direction[3] = {sin(i * 1.7), cos(i * 2.3), sin(i * 0.9 + 1)}, p[3], n[3];
        double r = 9 + 6.0 * i / 200;
        vec_normalize(direction);
        vec_axpy(centre, r, direction, p);
        assert_near(sdf_grid_at(&g, p), r - 12, 0.06);
        sdf_grid_normal(&g, p, n);
        assert_near(vec_dot(n, direction), 1, 0.01);
    }
    assert_near(sdf_grid_at(&g, centre), -4, 1e-6); /* cut at the band */
    sdf_grid_free(&g);
    surface_free(&s);
}

static void shells_that_overlap_count_as_their_union(void **state)
{
    (void)state;
    err e = {0};
    const double other[3] = {8, -2.1, 0.7};
    surface a = sphere(centre, 8, 30), b = sphere(other, 8, 30), both = surface_joined(&a, &b);
    sdf_grid g;
    assert_ok(sdf_grid_make(&both, low, high, 1, 2, &g, &e));
    const double inside_both[3] = {4.5, -2.1, 0.7}, only_b[3] = {13, -2, 1}, outside[3] = {18.5, -2, 1};
    assert_true(sdf_grid_at(&g, inside_both) < 0);
    assert_true(sdf_grid_at(&g, only_b) < 0);
    assert_true(sdf_grid_at(&g, outside) > 0);
    sdf_grid_free(&g);
    surface_free(&a);
    surface_free(&b);
    surface_free(&both);
}

static void the_grid_does_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    err e = {0};
    surface s = sphere(centre, 12, 20);
    sdf_grid one, three;
    parallel_set_threads(1);
    assert_ok(sdf_grid_make(&s, low, high, 1.5, 4, &one, &e));
    parallel_set_threads(3);
    assert_ok(sdf_grid_make(&s, low, high, 1.5, 4, &three, &e));
    parallel_set_threads(0);
    size_t count = (size_t)one.size[0] * (size_t)one.size[1] * (size_t)one.size[2];
    assert_memory_equal(one.value, three.value, count * sizeof *one.value);
    sdf_grid_free(&one);
    sdf_grid_free(&three);
    surface_free(&s);
}

static void closest_points_rays_and_sides_of_a_sphere_are_right(void **state)
{
    (void)state;
    err e = {0};
    surface s = sphere(centre, 10, 80);
    nearest *n = NULL;
    assert_ok(nearest_create(&s, &n, &e));
    for (int i = 0; i < 100; i++) {
        double direction[3] = {sin(i * 1.1), cos(i * 0.7), sin(i * 2.9 + 1)}, p[3], at[3], hit[3];
        vec_normalize(direction);
        double r = 2 + 0.15 * i;
        vec_axpy(centre, r, direction, p);
        assert_near(nearest_point(n, p, at, NULL), fabs(r - 10), 0.02);
        assert_near(vec_distance(at, centre), 10, 0.02);
        assert_int_equal(nearest_inside(n, p), r < 10);
        assert_true(nearest_ray(n, centre, direction, hit, NULL));
        assert_near(vec_distance(hit, centre), 10, 0.02);
    }
    nearest_destroy(&n);
    assert_null(n);
    surface empty = {0};
    assert_refused(nearest_create(&empty, &n, &e), ERR_GEOMETRY);
    surface_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_distance_to_a_sphere_is_right),
        cmocka_unit_test(shells_that_overlap_count_as_their_union),
        cmocka_unit_test(the_grid_does_not_depend_on_the_number_of_threads),
        cmocka_unit_test(closest_points_rays_and_sides_of_a_sphere_are_right),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
