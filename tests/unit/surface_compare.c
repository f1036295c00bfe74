/* Comparing skins: distances, alignment, the regions of the face and the trivial prediction. */
#include "tests/check.h"
#include "tests/unit/sphere.h"
#include "geometry/face_regions.h"
#include "geometry/mesh_file.h"
#include "geometry/smoothed_motion.h"
#include "geometry/surface_compare.h"
#include <string.h>

static const double centre[3] = {3, -2, 1};

/* A square of 21 x 21 points, 2 mm apart, at height z; its normal is +z. */
static surface flat(double z)
{
    enum { SIDE = 21 };
    surface s = surface_new(SIDE * SIDE, 2 * (SIDE - 1) * (SIDE - 1));
    int32_t *t = s.tri;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            int32_t v = y * SIDE + x;
            vec_copy((const double[3]){2 * x, 2 * y, z}, s.xyz + 3 * (size_t)v);
            if (x == SIDE - 1 || y == SIDE - 1) continue;
            const int32_t two[6] = {v, v + 1, v + SIDE + 1, v, v + SIDE + 1, v + SIDE};
            memcpy(t, two, sizeof two);
            t += 6;
        }
    return s;
}

/* A closed, bulging body whose rotation can be told: half axes 62, 80 and 100 mm. */
static surface egg(void)
{
    surface s = sphere((const double[3]){0, 0, 0}, 1, 40);
    for (int32_t v = 0; v < s.vertex_count; v++) {
        double *p = s.xyz + 3 * (size_t)v;
        p[0] *= 62 * (1 + 0.1 * p[1]);
        p[1] *= 80;
        p[2] *= 100;
    }
    return s;
}

static void a_flat_skin_in_front_lies_exactly_its_shift_away(void **state)
{
    (void)state;
    err e = {0};
    surface from = flat(0), to = flat(3.25);
    double *d = NEW_ARRAY(double, from.vertex_count);
    uint8_t *all = NEW_ARRAY(uint8_t, from.vertex_count);
    assert_ok(surface_signed_distance(&from, &to, d, &e));
    distance_stats s = distance_summary(d, all, 0, from.vertex_count);
    assert_true(s.left_out >= 4 * 20); /* the other one ends above the border */
    assert_int_equal(s.count + s.left_out, from.vertex_count);
    assert_near(s.mean, 3.25, 1e-12);
    assert_near(s.rms, 3.25, 1e-12);
    assert_near(s.p90, 3.25, 1e-12);
    assert_ok(surface_signed_distance(&to, &from, d, &e));
    s = distance_summary(d, all, 0, from.vertex_count);
    assert_near(s.mean, -3.25, 1e-12);
    assert_near(s.mean_abs, 3.25, 1e-12);
    free(d);
    free(all);
    surface_free(&from);
    surface_free(&to);
}

static void equal_skins_are_zero_apart(void **state)
{
    (void)state;
    err e = {0};
    surface s = egg();
    double *d = NEW_ARRAY(double, s.vertex_count);
    assert_ok(surface_signed_distance(&s, &s, d, &e));
    for (int32_t v = 0; v < s.vertex_count; v++) assert_near(d[v], 0, 1e-12);
    free(d);
    surface_free(&s);
}

static void a_larger_sphere_lies_in_front_and_a_smaller_behind(void **state)
{
    (void)state;
    err e = {0};
    surface inner = sphere(centre, 50, 40), outer = sphere(centre, 52, 40);
    double *d = NEW_ARRAY(double, inner.vertex_count);
    assert_ok(surface_signed_distance(&inner, &outer, d, &e));
    for (int32_t v = 0; v < inner.vertex_count; v++) assert_near(d[v], 2, 0.1); /* sag of the facets: 0.08 */
    assert_ok(surface_signed_distance(&outer, &inner, d, &e));
    for (int32_t v = 0; v < inner.vertex_count; v++) assert_near(d[v], -2, 0.1);
    free(d);
    surface_free(&inner);
    surface_free(&outer);
}

static void the_summary_counts_what_is_selected(void **state)
{
    (void)state;
    const double d[] = {-3, 1.5, 0.5, (double)NAN, 100, 0.25, -0.75, 1, 2, -4, 0.1, 0.2};
    const uint8_t in[] = {1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1};
    distance_stats s = distance_summary(d, in, 1, 12);
    assert_int_equal(s.count, 10);
    assert_int_equal(s.left_out, 1);
    assert_near(s.mean, -0.22, 1e-12);
    assert_near(s.mean_abs, 1.33, 1e-12);
    assert_near(s.rms, sqrt((9 + 2.25 + 0.25 + 0.0625 + 0.5625 + 1 + 4 + 16 + 0.01 + 0.04) / 10), 1e-12);
    assert_near(s.p90, 3, 0);
    assert_near(s.p95, 4, 0);
    assert_near(s.under_1, 0.5, 1e-12); /* 1 itself is not under 1 */
    assert_near(s.under_2, 0.7, 1e-12);
    s = distance_summary(d, in, 7, 12);
    assert_int_equal(s.count, 0);
    assert_true(isnan(s.mean) && isnan(s.p90));
}

static void alignment_finds_the_motion_and_ignores_what_changed(void **state)
{
    (void)state;
    err e = {0};
    surface still = egg(), moving = egg();
    uint8_t *top = NEW_ARRAY(uint8_t, still.vertex_count);
    for (int32_t v = 0; v < still.vertex_count; v++) {
        double *p = moving.xyz + 3 * (size_t)v;
        top[v] = p[2] > 0;
        if (p[2] < -20) p[1] -= 6;            /* the jaw was moved: below, not part of the fit */
        if (p[2] > 0 && p[0] > 45) p[0] += 4; /* a swelling in it: is trimmed away */
    }
    rigid turn = rigid_rotation((const double[3]){10, 0, 0}, (const double[3]){0, 0.6, 0.8}, 0.08),
          shift = rigid_translation((const double[3]){3, -4, 2}), away = rigid_compose(&shift, &turn);
    surface_transform(&moving, &away);
    surface_fit fit;
    assert_ok(surface_fit_rigid(&moving, &still, top, &fit, &e));
    rigid left = rigid_compose(&fit.move, &away);
    assert_true(fit.rms_before_mm > 1);
    assert_near(fit.rms_after_mm, 0, 1e-6);
    assert_near(rigid_angle(&left), 0, 1e-6);
    assert_near(vec_norm(left.t), 0, 1e-5);
    free(top);
    surface_free(&still);
    surface_free(&moving);
}

static void alignment_refuses_what_leaves_the_motion_open(void **state)
{
    (void)state;
    err e = {0};
    surface ball = sphere(centre, 80, 40), plate = flat(0), few = sphere(centre, 50, 4), far = egg(), near = egg();
    uint8_t all[4000];
    surface_fit fit;
    memset(all, 1, sizeof all);
    assert_true(ball.vertex_count < 4000 && far.vertex_count < 4000);
    assert_refused(surface_fit_rigid(&plate, &plate, all, &fit, &e), ERR_GEOMETRY);
    assert_refused(surface_fit_rigid(&few, &few, all, &fit, &e), ERR_GEOMETRY);
    for (int32_t v = 0; v < far.vertex_count; v++) far.xyz[3 * (size_t)v] += 500;
    assert_false(surface_fit_rigid(&far, &near, all, &fit, &e));
    assert_non_null(strstr(e.text, "20 mm"));
    surface_free(&ball);
    surface_free(&plate);
    surface_free(&few);
    surface_free(&far);
    surface_free(&near);
}

static landmarks face_of_the_egg(void)
{
    static const landmark all[] = {
        {"Po_L", {60, 0, 20}, 0},     {"Po_R", {-60, 0, 20}, 0},   {"Or_L", {30, -60, 20}, 0},
        {"Or_R", {-30, -60, 20}, 0},  {"N", {0, -70, 30}, 0},      {"Sn", {0, -75, -10}, 0},
        {"Al_L", {16, -70, -8}, 0},   {"Al_R", {-16, -70, -8}, 0}, {"Ch_L", {25, -66, -30}, 0},
        {"Ch_R", {-25, -66, -30}, 0}, {"Stm", {0, -72, -30}, 0},   {"B'", {0, -68, -45}, 0},
        {"Me'", {0, -50, -75}, 0}};
    landmarks l = {0};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) landmarks_set(&l, all[i].label, all[i].xyz);
    return l;
}

static void the_regions_part_the_face_and_lie_where_their_names_say(void **state)
{
    (void)state;
    err e = {0};
    surface s = egg();
    landmarks l = face_of_the_egg();
    face_map m;
    assert_ok(face_map_make(&s, &l, &m, &e));
    int32_t count[FACE_REGION_COUNT] = {0}, lower = 0, stable = 0, part[2] = {0};
    for (int32_t v = 0; v < m.vertex_count; v++) {
        const double *p = s.xyz + 3 * (size_t)v;
        assert_true(m.region[v] < FACE_REGION_COUNT);
        count[m.region[v]]++;
        lower += m.lower[v];
        stable += m.stable[v];
        if (m.region[v] != FACE_OUTSIDE) assert_true(p[1] <= -30 && p[2] <= 30 && p[2] > -75);
        if (m.lower[v]) assert_true(p[2] <= -10 && m.region[v] != FACE_NOSE);
        if (m.region[v] == FACE_UPPER_LIP) assert_true(p[2] > -30 && p[2] <= -10 && fabs(p[0]) < 25);
        if (m.region[v] == FACE_LOWER_LIP) assert_true(p[2] > -45 && p[2] <= -30 && fabs(p[0]) < 25);
        if (m.region[v] == FACE_CHEEK_LEFT) assert_true(p[0] > 0 && p[2] <= 20);
        if (m.region[v] == FACE_CHIN) assert_true(p[1] + 50 <= p[2] + 75); /* not the skin below it */
        if (m.stable[v] && p[2] <= 30) {                                   /* below the forehead */
            bool dorsum = fabs(p[0]) < 8 && p[2] > 30 - 40 / 3.0 && p[1]<-62, rim = fabs(p[0])> 40 && p[2] > 20;
            assert_true(dorsum || rim);
            part[dorsum]++;
        }
        if (m.stable[v]) assert_true(p[1] < -30 && p[2] <= 90);
    }
    for (int r = 0; r < FACE_REGION_COUNT; r++) assert_true(count[r] > 0);
    assert_int_equal(count[FACE_CHEEK_LEFT], count[FACE_CHEEK_RIGHT]);
    assert_true(part[0] > 0 && part[1] > 0); /* sides of the orbits, dorsum */
    assert_true(lower > count[FACE_UPPER_LIP] + count[FACE_LOWER_LIP] + count[FACE_CHIN] && stable > 0);
    face_map_free(&m);
    surface_free(&s);
    landmarks_free(&l);
}

static void regions_refuse_missing_and_disordered_landmarks_by_name(void **state)
{
    (void)state;
    err e = {0};
    surface s = egg();
    landmarks l = face_of_the_egg();
    face_map m;
    landmark *stm = (landmark *)landmarks_find(&l, "Stm");
    strcpy(stm->label, "Stms");
    assert_false(face_map_make(&s, &l, &m, &e));
    assert_non_null(strstr(e.text, "Stmi"));
    e = (err){0};
    strcpy(stm->label, "other");
    assert_false(face_map_make(&s, &l, &m, &e));
    assert_non_null(strstr(e.text, "landmark Stm or Stms is missing"));
    e = (err){0};
    landmarks_set(&l, "Stm", (const double[3]){0, -72, -50});
    assert_refused(face_map_make(&s, &l, &m, &e), ERR_INPUT);
    surface_free(&s);
    landmarks_free(&l);
}

static void skin_over_bone_that_shifts_as_one_follows_by_85_percent(void **state)
{
    (void)state;
    err e = {0};
    surface skin = sphere(centre, 60, 12);
    segments bones = {0};
    rigid move[SEGMENT_COUNT];
    bones.part[SEGMENT_MAXILLA] = sphere(centre, 50, 20);
    bones.part[SEGMENT_CRANIUM] = sphere((const double[3]){500, 0, 0}, 30, 8);
    for (int s = 0; s < SEGMENT_COUNT; s++) move[s] = rigid_identity();
    move[SEGMENT_MAXILLA] = rigid_translation((const double[3]){1, -4, 2});
    uint8_t *chosen = NEW_ARRAY(uint8_t, skin.vertex_count);
    double *after = NEW_ARRAY(double, 3 * (size_t)skin.vertex_count);
    for (int32_t v = 1; v < skin.vertex_count; v++) chosen[v] = 1;
    assert_ok(smoothed_motion(&skin, chosen, &bones, move, after, &e));
    assert_near(after[1], skin.xyz[1], 0);
    for (int32_t v = 1; v < skin.vertex_count; v++) {
        assert_near(after[3 * (size_t)v] - skin.xyz[3 * (size_t)v], 0.85, 1e-12);
        assert_near(after[3 * (size_t)v + 1] - skin.xyz[3 * (size_t)v + 1], -3.4, 1e-12);
    }
    /* the same from all pairs, where the motion differs from vertex to vertex */
    move[SEGMENT_MAXILLA] = rigid_rotation(centre, (const double[3]){0, 0, 1}, 0.2);
    assert_ok(smoothed_motion(&skin, chosen, &bones, move, after, &e));
    const surface *b = &bones.part[SEGMENT_MAXILLA];
    const double *p = skin.xyz + 3 * (size_t)37;
    uint8_t *taken = NEW_ARRAY(uint8_t, b->vertex_count);
    double sum = 0, moved[3] = {0};
    for (int i = 0; i < 40; i++) {
        int32_t best = -1;
        for (int32_t v = 0; v < b->vertex_count; v++)
            if (!taken[v] &&
                (best < 0 || vec_distance(p, b->xyz + 3 * (size_t)v) < vec_distance(p, b->xyz + 3 * (size_t)best)))
                best = v;
        const double *q = b->xyz + 3 * (size_t)best;
        double to[3], w = exp(-pow(vec_distance(p, q) / 12, 2) / 2);
        rigid_apply(&move[SEGMENT_MAXILLA], q, to);
        vec_sub(to, q, to);
        vec_axpy(moved, w, to, moved);
        sum += w;
        taken[best] = 1;
    }
    for (int c = 0; c < 3; c++)
        assert_near(after[3 * 37 + c] - p[c], 0.85 * moved[c] / sum, 0.02); /* ties at the rim */
    free(taken);
    segments_free(&bones);
    assert_refused(smoothed_motion(&skin, chosen, &bones, move, after, &e), ERR_GEOMETRY);
    free(after);
    free(chosen);
    surface_free(&skin);
}

static void a_surface_with_numbers_is_written_whole(void **state)
{
    (void)state;
    err e = {0};
    surface s = flat(1);
    double *d = NEW_ARRAY(double, s.vertex_count);
    for (int32_t v = 0; v < s.vertex_count; v++) d[v] = v + 0.5;
    point_array a = {"Signed", 1, d};
    assert_refused(mesh_write_surface_arrays(&s, &a, 1, "x.ply", &e), ERR_USAGE);
    assert_ok(mesh_write_surface_arrays(&s, &a, 1, "x.vtp", &e));
    char *text = NEW_ARRAY(char, 1 << 20);
    FILE *f = fopen("x.vtp", "rb");
    size_t size = fread(text, 1, 1 << 20, f);
    fclose(f);
    assert_non_null(strstr(text, "Name=\"Signed\""));
    const char *data = strstr(text, "encoding=\"raw\">\n_");
    assert_non_null(data);
    data += strlen("encoding=\"raw\">\n_");
    uint64_t n = (uint64_t)s.vertex_count, cells = (uint64_t)s.triangle_count, bytes;
    memcpy(&bytes, data, 8);
    assert_int_equal(bytes, 8 * n);
    assert_memory_equal(data + 8, d, 8 * n);
    assert_memory_equal(data + 8 + 8 * n + 8, s.xyz, 24 * n);
    assert_memory_equal(data + 8 + 8 * n + 8 + 24 * n + 8, s.tri, 12 * cells);
    size_t end = (size_t)(data - text) + 32 + 8 * n + 24 * n + 20 * cells;
    assert_int_equal(strncmp(text + end, "\n</AppendedData>\n</VTKFile>\n", size - end), 0);
    free(text);
    free(d);
    surface_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_skin_in_front_lies_exactly_its_shift_away),
        cmocka_unit_test(equal_skins_are_zero_apart),
        cmocka_unit_test(a_larger_sphere_lies_in_front_and_a_smaller_behind),
        cmocka_unit_test(the_summary_counts_what_is_selected),
        cmocka_unit_test(alignment_finds_the_motion_and_ignores_what_changed),
        cmocka_unit_test(alignment_refuses_what_leaves_the_motion_open),
        cmocka_unit_test(the_regions_part_the_face_and_lie_where_their_names_say),
        cmocka_unit_test(regions_refuse_missing_and_disordered_landmarks_by_name),
        cmocka_unit_test(skin_over_bone_that_shifts_as_one_follows_by_85_percent),
        cmocka_unit_test(a_surface_with_numbers_is_written_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
