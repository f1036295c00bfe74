#include "tests/check.h"
#include "geometry/surface_stretch.h"
#include <string.h>

/* A flat square of n x n cells in the plane z = 0, 1 mm a cell. */
static surface sheet(int n)
{
    surface s = surface_new((n + 1) * (n + 1), 2 * n * n);
    int32_t t = 0;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            double *p = s.xyz + 3 * (i * (n + 1) + j);
            p[0] = i;
            p[1] = j;
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            int32_t a = i * (n + 1) + j, b = a + n + 1, quad[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(s.tri + 3 * t, quad, sizeof quad);
            t += 2;
        }
    return s;
}

/* Moves every point by the matrix and checks that all vertices show the stretch. */
static void check(const double m[9], double want_percent)
{
    enum { N = 5 };
    surface rest = sheet(N), moved = surface_copy(&rest);
    double out[(N + 1) * (N + 1)];
    for (int32_t v = 0; v < rest.vertex_count; v++)
        for (int r = 0; r < 3; r++) {
            const double *p = rest.xyz + 3 * v;
            moved.xyz[3 * v + r] = m[3 * r] * p[0] + m[3 * r + 1] * p[1] + m[3 * r + 2] * p[2];
        }
    surface_stretch(&rest, &moved, out);
    for (int32_t v = 0; v < rest.vertex_count; v++) assert_near(out[v], want_percent, 1e-9);
    surface_free(&rest);
    surface_free(&moved);
}

static void uniform_deformations_have_their_largest_singular_value(void **state)
{
    (void)state;
    check((const double[9]){1.2, 0, 0, 0, 1.05, 0, 0, 0, 1}, 20);
    check((const double[9]){0.9, 0, 0, 0, 0.7, 0, 0, 0, 1}, -10);
    check((const double[9]){0, -1, 0, 0, 0, 1, -1, 0, 0}, 0); /* turned out of its plane */
    /* simple shear by 0.5: singular values of [1 .5; 0 1] are (sqrt(17) +- 1) / 4 */
    check((const double[9]){1, 0.5, 0, 0, 1, 0, 0, 0, 1}, 100 * ((sqrt(17) + 1) / 4 - 1));
}

static void a_vertex_without_area_has_no_stretch(void **state)
{
    (void)state;
    surface s = sheet(2);
    double out[9];
    for (int32_t v = 0; v < 9; v++) s.xyz[3 * v] = 0; /* a line */
    surface_stretch(&s, &s, out);
    for (int v = 0; v < 9; v++) assert_true(isnan(out[v]));
    surface_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_deformations_have_their_largest_singular_value),
        cmocka_unit_test(a_vertex_without_area_has_no_stretch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
