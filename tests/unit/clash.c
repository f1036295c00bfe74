/* Two bodies with known gaps, overlaps and depths. */
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "geometry/boolean.h"
#include "geometry/clash.h"
#include "geometry/cut_face.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"

static const double mm = 0.05, share = 0.01; /* what is promised */

static clash_body *body(const surface *s)
{
    err e = {0};
    clash_body *b;
    clash_params p = clash_params_default();
    assert_ok(clash_body_make(s, NULL, &p, &b, &e));
    return b;
}

static rigid shift(double x, double y, double z)
{
    const double t[3] = {x, y, z};
    return rigid_translation(t);
}

/* A cone standing on its tip at the origin. */
static surface cone(double radius, double height, int around)
{
    surface s = surface_new(around + 2, 2 * around);
    s.xyz[5] = height;
    for (int k = 0; k < around; k++) {
        double *p = s.xyz + 3 * (2 + k);
        int n = 2 + (k + 1) % around;
        p[0] = radius * cos(2 * M_PI * k / around);
        p[1] = radius * sin(2 * M_PI * k / around);
        p[2] = height;
        const int32_t tri[6] = {0, n, 2 + k, 1, 2 + k, n};
        memcpy(s.tri + 6 * k, tri, sizeof tri);
    }
    return s;
}

static void inside_is_exact(void **state)
{
    (void)state;
    err e = {0};
    surface ball = body_ball(3, -2, 5, 7, 24);
    nearest *tree;
    solid_grid *g;
    assert_ok(nearest_create(&ball, &tree, &e));
    assert_ok(solid_grid_make(&ball, 1, NULL, &g, &e));
    unsigned seed = 1;
    for (int i = 0; i < 20000; i++) {
        double p[3];
        for (int c = 0; c < 3; c++) {
            seed = seed * 1664525u + 1013904223u;
            p[c] = (c == 2 ? 5 : c ? -2 : 3) + 20 * ((seed >> 8) / 16777216.0 - 0.5);
        }
        assert_int_equal(solid_grid_inside(g, p), nearest_inside(tree, p));
        double clear, d = nearest_point(tree, p, NULL, NULL);
        assert_true(solid_grid_clear(g, p) <= d + 1e-12);
        assert_int_equal(solid_grid_look(g, p, &clear), solid_grid_inside(g, p));
        assert_true(clear == solid_grid_clear(g, p));
    }
    const double box[6] = {1, -4, 0, 5, 8, 9}; /* part of it */
    solid_grid *part;
    assert_ok(solid_grid_make(&ball, 0.6, box, &part, &e));
    for (int i = 0; i < 5000; i++) {
        double p[3];
        for (int c = 0; c < 3; c++) {
            seed = seed * 1664525u + 1013904223u;
            p[c] = box[c] + (box[3 + c] - box[c]) * (seed >> 8) / 16777216.0;
        }
        assert_int_equal(solid_grid_inside(part, p), nearest_inside(tree, p));
    }
    solid_grid_free(&part);
    surface lid = body_box(0, 0, 0, 5, 5, 5);
    solid_grid *open;
    lid.triangle_count -= 2; /* the side at x = 0 */
    assert_refused(solid_grid_make(&lid, 1, NULL, &open, &e), ERR_GEOMETRY);
    surface_free(&lid);
    solid_grid_free(&g);
    nearest_destroy(&tree);
    surface_free(&ball);
}

/* Against CGAL's tree, near the surface and far from it; within its bounds exact, beyond them on the right side. */
static void distances_are_those_of_cgal_between_their_bounds(void **state)
{
    (void)state;
    err e = {0};
    surface s = body_with(body_ball(103, -2, 5, 7, 24), body_box(90, 0, 0, 97, 20, 3)), nothing = {0};
    distance_tree *tree = distance_tree_make(&s), *empty = distance_tree_make(&nothing);
    nearest *cgal;
    assert_ok(nearest_create(&s, &cgal, &e));
    unsigned seed = 7;
    for (int i = 0; i < 3000; i++) {
        double p[3], at[3];
        distance_hit hit;
        for (int c = 0; c < 3; c++) {
            seed = seed * 1664525u + 1013904223u;
            p[c] = (c ? 0 : 100) + (i % 3 ? 30 : 3000) * ((seed >> 8) / 16777216.0 - 0.5);
        }
        double d = nearest_point(cgal, p, at, NULL);
        assert_near(distance_tree_to(tree, p, &hit), d, 1e-9);
        assert_near(vec_distance(p, hit.at), d, 1e-9);
        assert_near(distance_tree_between(tree, p, 0.9 * d, 1.1 * d, NULL), d, 1e-9);
        assert_true(distance_tree_between(tree, p, 1.1 * d, HUGE_VAL, NULL) <= 1.1 * d);
        assert_true(distance_tree_between(tree, p, 0, 0.9 * d, NULL) == 0.9 * d);
        assert_true(distance_tree_within(tree, p, 1.001 * d) && !distance_tree_within(tree, p, 0.999 * d));
        assert_true(distance_tree_between(empty, p, 0, 5, NULL) == 5);
    }
    nearest_destroy(&cgal);
    distance_tree_free(&tree);
    distance_tree_free(&empty);
    surface_free(&s);
}

static void a_known_gap_is_found(void **state)
{
    (void)state;
    surface a = body_box(0, 0, 0, 40, 30, 20), b = body_box(5, 5, 20, 25, 20, 32);
    clash_body *still = body(&a), *moved = body(&b);
    const double origin[3] = {0}, axis[3] = {0, 0, 1};
    for (int i = 1; i < 8; i++) {
        double gap = 0.37 * i;
        rigid up = shift(3.3, -2.1, gap), turn = rigid_rotation(origin, axis, 0.2), rel = rigid_compose(&up, &turn);
        clash_spot s = clash_distance(still, moved, &rel, 1, 10);
        assert_true(s.found);
        assert_near(s.mm, gap, mm);
        assert_near(clash_volume(still, moved, &rel), 0, 0);
        assert_near(clash_depth(still, moved, &rel, 1).mm, 0, 0);
    }
    rigid far = shift(0, 0, 11);
    assert_false(clash_distance(still, moved, &far, 1, 10).found);
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&a);
    surface_free(&b);
}

static void a_known_overlap_is_measured(void **state)
{
    (void)state;
    surface a = body_box(0, 0, 0, 40, 30, 20), b = body_box(5, 5, 20, 25, 20, 32);
    clash_body *still = body(&a), *moved = body(&b);
    for (int i = 1; i < 8; i++) {
        double depth = 0.43 * i;
        rigid rel = shift(3.3, -2.1, -depth);
        assert_near(clash_volume(still, moved, &rel), 300 * depth, share * 300 * depth);
        assert_near(clash_depth(still, moved, &rel, 1).mm, depth, mm);
        assert_near(clash_distance(still, moved, &rel, 1, 10).mm, 0, 0);
        rigid back = rigid_inverse(&rel);
        assert_near(clash_volume(moved, still, &back), 300 * depth, share * 300 * depth);
    }
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&a);
    surface_free(&b);
}

static void overlap_of_turned_bodies_is_that_of_corefinement(void **state)
{
    (void)state;
    surface a = body_box(0, 0, 0, 40, 30, 20), b = body_ball(0, 0, 0, 9, 20);
    clash_body *still = body(&a), *moved = body(&b);
    const double pivot[3] = {1, 2, 3}, axis[3] = {0.6, 0, 0.8},
                 way[4][3] = {{20, 15, 25}, {38, 28, 18}, {42, 15, 10}, {20, 15, 15}};
    for (int i = 0; i < 4; i++) {
        rigid turn = rigid_rotation(pivot, axis, 0.7 + i), go = rigid_translation(way[i]),
              rel = rigid_compose(&go, &turn);
        surface there = surface_copy(&b), both;
        err e = {0};
        surface_transform(&there, &rel);
        assert_ok(boolean_apply(&a, &there, BOOLEAN_INTERSECTION, &both, NULL, &e));
        double want = surface_volume(&both);
        assert_true(want > 50);
        assert_near(clash_volume(still, moved, &rel), want, share * want);
        surface_free(&there);
        surface_free(&both);
    }
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&a);
    surface_free(&b);
}

static void a_cone_hits_a_plane_with_its_tip(void **state)
{
    (void)state;
    surface table = body_box(-20, -20, -10, 20, 20, 0), tip = cone(4, 8, 48);
    clash_body *still = body(&table), *moved = body(&tip);
    rigid above = shift(1.3, 0.7, 0.62), below = shift(1.3, 0.7, -1.37);
    assert_near(clash_distance(still, moved, &above, 1, 10).mm, 0.62, mm);
    clash_spot s = clash_depth(still, moved, &below, 1);
    assert_near(s.mm, 1.37, mm);
    assert_near(s.place[0], 1.3, 0.1);
    assert_near(s.place[1], 0.7, 0.1);
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&table);
    surface_free(&tip);
}

static void turning_until_contact_finds_the_angle(void **state)
{
    (void)state;
    /* A bar pivoted at its end turns about x until its far lower edge, 50 mm away, meets the table 5 mm below. */
    surface table = body_box(-10, 0, -15, 10, 80, -5), bar = body_box(-3, 0, 0, 3, 50, 4);
    clash_body *still = body(&table), *moved = body(&bar);
    const double origin[3] = {0}, axis[3] = {-1, 0, 0};
    double low = 0, high = 0.3;
    while (high - low > 1e-6) {
        double mid = (low + high) / 2;
        rigid rel = rigid_rotation(origin, axis, mid);
        if (clash_depth(still, moved, &rel, 1).mm > 0)
            high = mid;
        else
            low = mid;
    }
    assert_near(50 * sin(high), 5, mm);
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&table);
    surface_free(&bar);
}

static void sets_of_triangles_are_told_apart(void **state)
{
    (void)state;
    err e = {0};
    surface table = body_box(-20, -20, -10, 20, 20, 0),
            pair = body_with(body_box(-10, -2, 1, -6, 2, 5), body_box(6, -2, 2, 10, 2, 6));
    uint8_t kind[24];
    for (int t = 0; t < 24; t++) kind[t] = t < 12 ? 1 : 2;
    clash_params p = clash_params_default();
    clash_body *still, *moved;
    assert_ok(clash_body_make(&table, NULL, &p, &still, &e));
    assert_ok(clash_body_make(&pair, kind, &p, &moved, &e));
    rigid down = shift(0, 0, -1.5);
    assert_near(clash_distance(still, moved, &down, 2, 10).mm, 0.5, mm);
    assert_near(clash_distance(still, moved, &down, 1, 10).mm, 0, 0);
    clash_body_free(&still);
    clash_body_free(&moved);
    surface_free(&table);
    surface_free(&pair);
}

/* ---- a saw cut: a block above, one below, half a millimetre between them ---- */

static void faces_of_a_cut_open_step_and_overlap(void **state)
{
    (void)state;
    segments s = {0};
    s.part[SEGMENT_CRANIUM] = body_box(0, 0, 0.25, 30, 20, 20);
    s.part[SEGMENT_MAXILLA] = body_box(0, 0, -15, 30, 20, -0.25);
    s.kerf = body_box(0, 0, -0.25, 30, 20, 0.25);
    clash_body *still = body(&s.part[SEGMENT_CRANIUM]), *moved = body(&s.part[SEGMENT_MAXILLA]);
    distance_tree *saw = distance_tree_make(&s.kerf);
    cut_bones bones = {.bones = &s, .kerf = saw};
    bones.part[SEGMENT_CRANIUM] = clash_body_tree(still);
    bones.part[SEGMENT_MAXILLA] = clash_body_tree(moved);
    cut_face upper = cut_face_make(&bones, SEGMENT_CRANIUM, SEGMENT_MAXILLA, 1.2),
             lower = cut_face_make(&bones, SEGMENT_MAXILLA, SEGMENT_CRANIUM, 1.2);
    distance_tree_free(&saw);
    assert_near(lower.mm2, 600, 1e-9);
    assert_near(upper.mm2, 600, 1e-9);
    assert_int_equal(lower.shell.triangle_count, 2);
    distance_tree *tree = distance_tree_make(&upper.shell);
    cut_place at;
    const double corner[3] = {0, 0, 0};
    double step;
    assert_true(cut_place_make(&lower, corner, 0.5, &at));

    rigid rest = rigid_identity();
    cut_contact c = cut_contact_measure(&lower, still, tree, &rest, 1);
    assert_near(c.mm2, 600, 1e-9);
    assert_near(c.gap_mm, 0.5, 1e-6);
    assert_false(cut_face_trim(&lower, still, tree, &rest).found);
    assert_near(cut_place_gap(&at, &rest, &step), 0.5, 1e-9);
    assert_near(step, 0, 1e-9);

    rigid open = shift(0, 0, -4); /* down-graft */
    c = cut_contact_measure(&lower, still, tree, &open, 1);
    assert_near(c.mm2, 0, 0);
    assert_near(c.gap_mm, 4.5, 1e-6);
    assert_false(cut_face_trim(&lower, still, tree, &open).found);
    assert_near(cut_place_gap(&at, &open, &step), 4.5, 1e-9);

    rigid up = shift(0, 0, 3); /* impaction: half a millimetre of it the saw took */
    assert_near(cut_face_trim(&lower, still, tree, &up).mm, 2.5, 1e-6);
    assert_near(cut_place_gap(&at, &up, &step), -2.5, 1e-9);

    rigid slide = shift(12, 0, 0); /* 18 of 30 mm stay above each other, and 1 mm beyond is near enough */
    c = cut_contact_measure(&lower, still, tree, &slide, 1);
    assert_near(c.mm2, 18 * 20 + 0.87 * 20, 25);
    (void)cut_place_gap(&at, &slide, &step);
    assert_near(step, 12, 1e-9);

    distance_tree_free(&tree);
    clash_body_free(&still);
    clash_body_free(&moved);
    cut_face_free(&upper);
    cut_face_free(&lower);
    segments_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inside_is_exact),
        cmocka_unit_test(distances_are_those_of_cgal_between_their_bounds),
        cmocka_unit_test(a_known_gap_is_found),
        cmocka_unit_test(a_known_overlap_is_measured),
        cmocka_unit_test(overlap_of_turned_bodies_is_that_of_corefinement),
        cmocka_unit_test(a_cone_hits_a_plane_with_its_tip),
        cmocka_unit_test(turning_until_contact_finds_the_angle),
        cmocka_unit_test(sets_of_triangles_are_told_apart),
        cmocka_unit_test(faces_of_a_cut_open_step_and_overlap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
