/* The norm head: what was asked is what is there, on the meshes. */
#include "cases/norm_head/norm_head.h"
#include "cases/norm_head/teeth.h"
#include "cases/norm_head/warp.h"
#include "geometry/frame.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include "tests/check.h"
#include <string.h>

/* Built once: a man of class III with a chin to the left, and the same with other measures. */
static norm_head head;

static norm_head_params params(void)
{
    norm_head_params p = norm_head_params_default();
    p.sex = NORM_MALE;
    p.skeletal_class = 3;
    p.seed = 5;
    p.coarseness = 1; /* depths feel the chords of coarser meshes */
    p.is_set[NOSE_MM] = true;
    p.set[NOSE_MM] = 23;
    return p;
}

static int build(void **state)
{
    (void)state;
    err e = {0};
    norm_head_params p = params();
    return norm_head_build(&p, &head, &e) ? 0 : -1;
}

static int clean(void **state)
{
    (void)state;
    norm_head_free(&head);
    return 0;
}

static const double *at(const char *label)
{
    const landmark *l = landmarks_find(&head.points, label);
    assert_non_null(l);
    return l->xyz;
}

static void surfaces_are_closed_and_outward(void **state)
{
    (void)state;
    const surface *all[] = {&head.skin, &head.skull, &head.mandible, &head.upper_teeth, &head.lower_teeth};
    for (int i = 0; i < 5; i++) {
        err e = {0};
        int32_t open, crowded;
        assert_ok(surface_check(all[i], &e));
        surface_edge_census(all[i], &open, &crowded);
        assert_int_equal(open, 0);
        assert_int_equal(crowded, 0);
        assert_true(surface_volume(all[i]) > 0);
    }
    /* no handle: V - E + F = 2 */
    assert_int_equal(head.skin.vertex_count - head.skin.triangle_count / 2, 2);
    int32_t *component, teeth = surface_components(&head.upper_teeth, &component);
    free(component);
    assert_int_equal(teeth, 2 * TEETH_PER_SIDE);
}

static void measures_come_out_as_asked(void **state)
{
    (void)state;
    assert_near(head.asked[NOSE_MM], 23, 0);
    for (int i = 0; i < MEASURE_COUNT; i++) {
        double within = i < GLABELLA_SOFT_MM ? 0.5 : 0.7;
        if (fabs(head.obtained[i] - head.asked[i]) > within) print_error("%s\n", measures[i].name);
        assert_near(head.obtained[i], head.asked[i], within);
    }
}

static void landmarks_lie_on_the_meshes(void **state)
{
    (void)state;
    static const struct {
        const char *label;
        const surface *on;
    } rows[] = {{"N", &head.skull},       {"A", &head.skull},          {"Zy_L", &head.skull},
                {"Or_R", &head.skull},    {"Pog", &head.mandible},     {"Go_R", &head.mandible},
                {"Co_L", &head.mandible}, {"Pn", &head.skin},          {"Stm", &head.skin},
                {"Pg'", &head.skin},      {"U6_L", &head.upper_teeth}, {"L6_R", &head.lower_teeth}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        err e = {0};
        nearest *tree;
        assert_ok(nearest_create(rows[i].on, &tree, &e));
        assert_near(nearest_point(tree, at(rows[i].label), NULL, NULL), 0, 1e-6);
        nearest_destroy(&tree);
    }
}

static void extremes_of_the_mesh_are_the_landmarks(void **state)
{
    (void)state;
    double nose = 0, chin = 0;
    for (int i = 0; i < head.skin.vertex_count; i++) nose = fmin(nose, head.skin.xyz[3 * i + 1]);
    for (int i = 0; i < head.mandible.vertex_count; i++) chin = fmin(chin, head.mandible.xyz[3 * i + 2]);
    assert_near(nose, at("Pn")[1], 0.5);
    assert_near(chin, at("Me")[2], 1.0);
}

static void frankfort_plane_is_level(void **state)
{
    (void)state;
    err e = {0};
    head_frame f;
    assert_ok(head_frame_from_landmarks(&head.points, &f, &e));
    assert_near(f.up[2], 1, 1e-3);
    assert_near(f.left[0], 1, 1e-6);
}

static void bone_and_teeth_stay_under_the_skin(void **state)
{
    (void)state;
    err e = {0};
    nearest *tree;
    assert_ok(nearest_create(&head.skin, &tree, &e));
    const surface *bones[] = {&head.skull, &head.mandible, &head.upper_teeth, &head.lower_teeth};
    for (int b = 0; b < 4; b++)
        for (int i = 0; i < bones[b]->vertex_count; i += 3) assert_true(nearest_inside(tree, bones[b]->xyz + 3 * i));
    nearest_destroy(&tree);
    assert_true(head.thinnest_mm > 2);
}

static void class_three_has_the_lower_incisors_in_front(void **state)
{
    (void)state;
    assert_true(at("L1")[1] < at("U1")[1]);
    assert_true(head.obtained[SNB_DEG] > head.obtained[SNA_DEG]);
}

/* Behind the incisors no lower tooth reaches into an upper one, and most touch one. */
static void side_teeth_are_in_occlusion(void **state)
{
    (void)state;
    err e = {0};
    nearest *upper;
    assert_ok(nearest_create(&head.upper_teeth, &upper, &e));
    int32_t size = head.lower_teeth.vertex_count / (2 * TEETH_PER_SIDE), touching = 0;
    for (int32_t number = 0; number < 2 * TEETH_PER_SIDE; number++) {
        if (number % TEETH_PER_SIDE < 2) continue;
        double least = HUGE_VAL;
        for (int32_t i = number * size; i < (number + 1) * size; i++) {
            const double *p = head.lower_teeth.xyz + 3 * i;
            double d = nearest_point(upper, p, NULL, NULL);
            if (d < 2 && nearest_inside(upper, p)) d = -d;
            least = fmin(least, d);
        }
        assert_true(least > -0.05);
        touching += least < 0.2;
    }
    nearest_destroy(&upper);
    assert_true(touching >= 7); /* of 10 */
}

static void the_same_seed_gives_the_same_measures_and_another_seed_others(void **state)
{
    (void)state;
    double a[MEASURE_COUNT], b[MEASURE_COUNT], c[MEASURE_COUNT];
    norms_draw(NORM_FEMALE, 1, 7, a);
    norms_draw(NORM_FEMALE, 1, 7, b);
    norms_draw(NORM_FEMALE, 1, 8, c);
    assert_memory_equal(a, b, sizeof a);
    int differ = 0;
    for (int i = 0; i < MEASURE_COUNT; i++) {
        differ += a[i] != c[i];
        assert_true(fabs(a[i] - measures[i].mean[NORM_FEMALE]) <= 2 * measures[i].sd[NORM_FEMALE]);
    }
    assert_true(differ > MEASURE_COUNT / 2);
}

static void depths_that_go_together_are_drawn_together(void **state)
{
    (void)state;
    static const struct {
        measure_id a, b;
        double r;
    } rows[] = {{UPPER_LIP_SOFT_MM, LOWER_LIP_SOFT_MM, 0.763},
                {POGONION_SOFT_MM, MENTON_SOFT_MM, 0.784},
                {GLABELLA_SOFT_MM, GONION_SOFT_MM, 0}};
    enum { DRAWS = 4000 };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        double sum[5] = {0};
        for (uint64_t seed = 1; seed <= DRAWS; seed++) {
            double v[MEASURE_COUNT];
            norms_draw(NORM_FEMALE, 1, seed, v);
            double x = v[rows[k].a] - measures[rows[k].a].mean[NORM_FEMALE],
                   y = v[rows[k].b] - measures[rows[k].b].mean[NORM_FEMALE];
            double term[5] = {x, y, x * x, y * y, x * y};
            for (int c = 0; c < 5; c++) sum[c] += term[c] / DRAWS;
        }
        double r = (sum[4] - sum[0] * sum[1]) / sqrt((sum[2] - sum[0] * sum[0]) * (sum[3] - sum[1] * sum[1]));
        assert_near(r, rows[k].r, 0.05);
    }
}

static void warps_take_points_exactly_and_keep_affine_maps(void **state)
{
    (void)state;
    warp_pairs pairs = {0};
    static const double corner[5][3] = {{0, 0, 0}, {30, 0, 0}, {0, 40, 0}, {0, 0, 50}, {20, 20, 20}};
    for (int i = 0; i < 5; i++) {
        double to[3] = {1.1 * corner[i][0] + 2, corner[i][1] - 3, 0.9 * corner[i][2] + 0.1 * corner[i][0]};
        warp_add(&pairs, corner[i], to);
    }
    warp w = warp_through(&pairs);
    double x[3] = {11, -7, 33}, y[3];
    warp_apply(&w, x, y);
    assert_near(y[0], 1.1 * 11 + 2, 1e-9);
    assert_near(y[1], -10, 1e-9);
    assert_near(y[2], 0.9 * 33 + 1.1, 1e-9);
    warp_free(&w);
    pairs.to[13] += 5; /* no longer affine: still through the points */
    w = warp_through(&pairs);
    warp_apply(&w, corner[4], y);
    assert_near(y[1], 20 - 3 + 5, 1e-9);
    warp_free(&w);
    warp_pairs_free(&pairs);
}

static void refuses_what_it_cannot_build(void **state)
{
    (void)state;
    err e = {0};
    norm_head_params p = norm_head_params_default();
    p.skeletal_class = 4;
    assert_refused(norm_head_params_check(&p, &e), ERR_USAGE);
    p.skeletal_class = 1;
    p.is_set[SNA_DEG] = true;
    p.set[SNA_DEG] = 120;
    assert_refused(norm_head_params_check(&p, &e), ERR_USAGE);
    p.set[SNA_DEG] = (double)NAN;
    assert_refused(norm_head_params_check(&p, &e), ERR_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(surfaces_are_closed_and_outward),
                                       cmocka_unit_test(measures_come_out_as_asked),
                                       cmocka_unit_test(landmarks_lie_on_the_meshes),
                                       cmocka_unit_test(extremes_of_the_mesh_are_the_landmarks),
                                       cmocka_unit_test(frankfort_plane_is_level),
                                       cmocka_unit_test(bone_and_teeth_stay_under_the_skin),
                                       cmocka_unit_test(class_three_has_the_lower_incisors_in_front),
                                       cmocka_unit_test(side_teeth_are_in_occlusion),
                                       cmocka_unit_test(the_same_seed_gives_the_same_measures_and_another_seed_others),
                                       cmocka_unit_test(depths_that_go_together_are_drawn_together),
                                       cmocka_unit_test(warps_take_points_exactly_and_keep_affine_maps),
                                       cmocka_unit_test(refuses_what_it_cannot_build)};
    return cmocka_run_group_tests(tests, build, clean);
}
