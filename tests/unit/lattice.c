/* Lattices of tetrahedra around surfaces. */
#include "tests/check.h"
#include "geometry/embed.h"
#include "geometry/lattice.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "tests/unit/sphere.h"
#include <string.h>

static void every_tet_has_the_shape_of_the_lattice(void **state)
{
    (void)state;
    err e = {0};
    tetmesh m;
    surface s = sphere((double[]){3, -40, 7.3}, 20, 16);
    const surface *list[] = {&s};
    assert_ok(lattice_cover(list, 1, 5, 0, &m, &e));
    assert_ok(tetmesh_check(&m, &e));
    for (int32_t t = 0; t < m.tet_count; t++) {
        const double *x[4];
        int longer = 0, shorter = 0;
        for (int k = 0; k < 4; k++) x[k] = m.xyz + 3 * (size_t)m.tet[4 * (size_t)t + (size_t)k];
        assert_near(vec_six_volume(x[0], x[1], x[2], x[3]) / 6, 125.0 / 12, 1e-9);
        for (int k = 0; k < 4; k++)
            for (int l = k + 1; l < 4; l++) {
                double edge = vec_distance(x[k], x[l]);
                longer += fabs(edge - 5) < 1e-9;
                shorter += fabs(edge - 5 * sqrt(3) / 2) < 1e-9;
            }
        assert_true(longer == 2 && shorter == 4);
    }
    tetmesh_quality q = tetmesh_measure(&m);
    assert_near(q.min_dihedral_deg, 60, 1e-6);
    assert_near(q.max_dihedral_deg, 90, 1e-6);
    tetmesh_free(&m);
    surface_free(&s);
}

/* A margin larger than the body: twelve tets per cube of what lies within it. */
static void a_wide_margin_fills_the_ball_around_a_body(void **state)
{
    (void)state;
    err e = {0};
    tetmesh m;
    surface s = sphere((double[]){0, 0, 0}, 1, 8);
    const surface *list[] = {&s};
    assert_ok(lattice_cover(list, 1, 2, 30, &m, &e));
    double ball = 4.0 / 3 * 3.14159265358979 * pow(31 + 0.559 * 2, 3);
    assert_near(m.tet_count * 8.0 / 12, ball, 0.01 * ball);
    int32_t *face, count = tetmesh_boundary(&m, &face, NULL); /* one piece without holes: V - E + F of its skin is 2 */
    surface skin = {.vertex_count = m.vertex_count, .triangle_count = count, .xyz = m.xyz, .tri = face};
    int32_t open, branched;
    surface_edge_census(&skin, &open, &branched);
    assert_int_equal(open, 0);
    assert_int_equal(branched, 0);
    free(face);
    tetmesh_free(&m);
    surface_free(&s);
}

static void every_point_of_the_surfaces_lies_in_a_tet(void **state)
{
    (void)state;
    err e = {0};
    tetmesh m;
    surface s[2] = {sphere((double[]){0, 0, 0}, 30, 24), sphere((double[]){50, 10, -8}, 12, 10)};
    const surface *list[] = {&s[0], &s[1]};
    assert_ok(lattice_cover(list, 2, 4, 0, &m, &e));
    for (int k = 0; k < 2; k++) {
        double *at = NEW_ARRAY(double, 6 * (size_t)s[k].triangle_count); /* inside of triangles and of their sides */
        for (size_t t = 0; t < (size_t)s[k].triangle_count; t++)
            for (size_t c = 0; c < 3; c++) {
                const double *a = s[k].xyz + 3 * s[k].tri[3 * t], *b = s[k].xyz + 3 * s[k].tri[3 * t + 1],
                             *d = s[k].xyz + 3 * s[k].tri[3 * t + 2];
                at[6 * t + c] = (a[c] + b[c] + d[c]) / 3;
                at[6 * t + 3 + c] = 0.3 * a[c] + 0.7 * b[c];
            }
        embedding in = embed_points(&m, at, 2 * s[k].triangle_count, 4, NULL, NULL);
        assert_near(in.max_gap_mm, 0, 1e-9);
        for (int32_t i = 0; i < in.point_count; i++) assert_true(in.tet[i] >= 0);
        embedding_free(&in);
        free(at);
    }
    assert_true(m.tet_count * 64.0 / 12 < 0.8 * surface_volume(&s[0])); /* and the middle stays empty */
    tetmesh_free(&m);
    surface_free(&s[0]);
    surface_free(&s[1]);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    err e = {0};
    tetmesh m;
    surface s = sphere((double[]){0, 0, 0}, 30, 8), none = surface_new(0, 0);
    const surface *list[] = {&s}, *empty[] = {&none};
    assert_refused(lattice_cover(list, 1, 0, 0, &m, &e), ERR_INPUT);
    assert_refused(lattice_cover(list, 1, (double)NAN, 0, &m, &e), ERR_INPUT);
    assert_refused(lattice_cover(list, 1, 4, -1, &m, &e), ERR_INPUT);
    assert_refused(lattice_cover(empty, 1, 4, 0, &m, &e), ERR_GEOMETRY);
    assert_refused(lattice_cover(list, 1, 0.05, 0, &m, &e), ERR_RESOURCE);
    surface_free(&s);
    surface_free(&none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tet_has_the_shape_of_the_lattice),
        cmocka_unit_test(a_wide_margin_fills_the_ball_around_a_body),
        cmocka_unit_test(every_point_of_the_surfaces_lies_in_a_tet),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
