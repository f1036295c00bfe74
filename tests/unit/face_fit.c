/* Faces that are one face in one system of axes are laid onto each other; others are refused by name. */
#include "tests/check.h"
#include "tests/unit/sphere.h"
#include "geometry/face_fit.h"
#include "geometry/vec.h"
#include <string.h>

static surface face;
static face_map map;
static const double posterior[3] = {0, 1, 0};

/* An egg with a nose, brows and a chin, no two sides of which are alike. */
static int make_face(void **state)
{
    (void)state;
    err e = {0};
    static const double bump[][4] = {
        /* left, up, width, forwards */ {0, -5, 11, 28}, {22, 45, 12, 7}, {-24, 47, 10, 6}, {3, -65, 14, 12}};
    static const landmark all[] = {
        {"Po_L", {60, 0, 20}, 0},     {"Po_R", {-60, 0, 20}, 0},   {"Or_L", {30, -60, 20}, 0},
        {"Or_R", {-30, -60, 20}, 0},  {"N", {0, -70, 30}, 0},      {"Sn", {0, -75, -10}, 0},
        {"Al_L", {16, -70, -8}, 0},   {"Al_R", {-16, -70, -8}, 0}, {"Ch_L", {25, -66, -30}, 0},
        {"Ch_R", {-25, -66, -30}, 0}, {"Stm", {0, -72, -30}, 0},   {"B'", {0, -68, -45}, 0},
        {"Me'", {0, -50, -75}, 0}};
    landmarks l = {0};
    face = sphere((const double[3]){0, 0, 0}, 1, 60);
    for (int32_t v = 0; v < face.vertex_count; v++) {
        double *p = face.xyz + 3 * (size_t)v;
        p[0] *= 62 * (1 + 0.1 * p[1]);
        p[1] *= 80;
        p[2] *= 100;
        for (size_t k = 0; k < sizeof bump / sizeof *bump && p[1] < 0; k++)
            p[1] -=
                bump[k][3] * exp(-(pow(p[0] - bump[k][0], 2) + pow(p[2] - bump[k][1], 2)) / (2 * pow(bump[k][2], 2)));
    }
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) landmarks_set(&l, all[i].label, all[i].xyz);
    assert_ok(face_map_make(&face, &l, &map, &e));
    landmarks_free(&l);
    return 0;
}

static int drop_face(void **state)
{
    (void)state;
    face_map_free(&map);
    surface_free(&face);
    return 0;
}

/* The face with its coordinates renamed: new[c] = sign[c] * old[from[c]]. */
static surface renamed(const int from[3], const int sign[3])
{
    surface s = surface_copy(&face);
    for (int32_t v = 0; v < s.vertex_count; v++)
        for (int c = 0; c < 3; c++)
            s.xyz[3 * (size_t)v + (size_t)c] = sign[c] * face.xyz[3 * (size_t)v + (size_t)from[c]];
    return s;
}

static void other_axes_are_refused_with_the_change_that_mends_them(void **state)
{
    (void)state;
    static const struct {
        int from[3], sign[3];
        const char *mend;
    } way[] = {{{0, 1, 2}, {-1, -1, 1}, "(-x, -y, z):"},           /* RAS */
               {{0, 2, 1}, {1, 1, -1}, "(x, -z, y):"},             /* y up */
               {{1, 2, 0}, {1, 1, 1}, "(z, x, y):"},               /* named in a circle */
               {{0, 1, 2}, {1, -1, 1}, "(x, -y, z), mirrored,:"}}; /* one axis the other way */
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
        err e = {0};
        surface_fit fit;
        surface s = renamed(way[i].from, way[i].sign);
        assert_false(face_fit(&s, &face, &map, &fit, &e));
        assert_int_equal(e.code, ERR_GEOMETRY);
        if (!strstr(e.text, way[i].mend)) fail_msg("%s, want %s", e.text, way[i].mend);
        surface_free(&s);
    }
}

static void a_face_that_is_merely_turned_or_was_operated_is_aligned(void **state)
{
    (void)state;
    for (int deg = -40; deg <= 40; deg += 20) {
        err e = {0};
        surface_fit fit;
        surface s = surface_copy(&face);
        for (int32_t v = 0; v < s.vertex_count; v++) { /* a jaw 10 mm farther back */
            double *p = s.xyz + 3 * (size_t)v;
            if (p[2] < -15) p[1] += 10 * fmin(1, (-15 - p[2]) / 20);
        }
        rigid turn = rigid_rotation((const double[3]){0, 0, 0}, (const double[3]){0, 0, 1}, deg * acos(-1.0) / 180);
        surface_transform(&s, &turn);
        assert_ok(face_fit(&s, &face, &map, &fit, &e));
        rigid left = rigid_compose(&fit.move, &turn);
        assert_near(rigid_angle(&left), 0, 1e-4);
        surface_free(&s);
    }
}

static void another_head_is_refused(void **state)
{
    (void)state;
    err e = {0};
    surface_fit fit;
    surface ball = sphere((const double[3]){0, 0, 0}, 85, 40);
    for (int32_t v = 0; v < ball.vertex_count; v++) ball.xyz[3 * (size_t)v] *= 1.2;
    assert_refused(face_fit(&ball, &face, &map, &fit, &e), ERR_GEOMETRY);
    surface_free(&ball);
}

/* An open front, so that no volume tells which side is out. */
static void triangles_that_face_inwards_are_turned_once(void **state)
{
    (void)state;
    surface open = surface_copy(&face);
    open.triangle_count = 0;
    for (int32_t t = 0; t < face.triangle_count; t++) {
        const int32_t *v = face.tri + 3 * (size_t)t;
        if (face.xyz[3 * (size_t)v[0] + 1] > -20) continue;
        memcpy(open.tri + 3 * (size_t)open.triangle_count++, v, 3 * sizeof *v);
    }
    assert_false(face_outward(&open, &map, posterior));
    surface_flip(&open);
    assert_true(face_outward(&open, &map, posterior));
    assert_false(face_outward(&open, &map, posterior));
    surface_free(&open);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_axes_are_refused_with_the_change_that_mends_them),
        cmocka_unit_test(a_face_that_is_merely_turned_or_was_operated_is_aligned),
        cmocka_unit_test(another_head_is_refused),
        cmocka_unit_test(triangles_that_face_inwards_are_turned_once),
    };
    return cmocka_run_group_tests(tests, make_face, drop_face);
}
