/* The template laid onto scans: exact where the scan is the template itself, found from any turn where it is partial,
 * and refused by name where it is no head in mm. The template here is a coarse norm head. */
#include "tests/check.h"
#include "app/planner/identity/head_place.h"
#include "cases/norm_head/norm_head.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

enum { PARTS = 3, TURNS = 3 };
static head_template model;
static norm_head mean, other;

static int build(void **state)
{
    (void)state;
    err e = {0};
    norm_mean *coarse;
    norm_head_params p = norm_head_params_default();
    if (!norm_mean_build(3, false, &coarse, &e)) return 1;
    bool ok = norm_head_shape(coarse, &p, &mean, &e);
    p.seed = 7;
    p.sex = NORM_MALE;
    p.skeletal_class = 3;
    ok = ok && norm_head_shape(coarse, &p, &other, &e);
    norm_mean_free(coarse);
    model.part[CASE_SKIN] = mean.skin;
    model.part[CASE_SKULL] = mean.skull;
    model.part[CASE_MANDIBLE] = mean.mandible;
    model.point_count = mean.points.count;
    model.point = NEW_ARRAY(head_point, mean.points.count);
    for (int32_t i = 0; i < mean.points.count; i++) {
        memcpy(model.point[i].label, mean.points.point[i].label, LANDMARK_LABEL_SIZE);
        vec_copy(mean.points.point[i].xyz, model.point[i].at);
    }
    return !ok;
}

static int drop(void **state)
{
    (void)state;
    free(model.point);
    norm_head_free(&mean);
    norm_head_free(&other);
    return 0;
}

static head_scan scan_of(const norm_head *h, bool points)
{
    head_scan s = {0};
    s.part[CASE_SKIN] = surface_copy(&h->skin);
    s.part[CASE_SKULL] = surface_copy(&h->skull);
    s.part[CASE_MANDIBLE] = surface_copy(&h->mandible);
    if (points) s.points = landmarks_copy(&h->points);
    return s;
}

static void move_scan(head_scan *s, const similarity *way)
{
    for (int i = 0; i < PARTS; i++)
        for (int32_t v = 0; v < s->part[i].vertex_count; v++)
            similarity_apply(way, s->part[i].xyz + 3 * (size_t)v, s->part[i].xyz + 3 * (size_t)v);
    for (int32_t i = 0; i < s->points.count; i++) similarity_apply(way, s->points.point[i].xyz, s->points.point[i].xyz);
}

static double random_unit(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static similarity random_way(uint64_t *seed, double scale)
{
    const double zero[3] = {0};
    double axis[3], n;
    do {
        for (int c = 0; c < 3; c++) axis[c] = 2 * random_unit(seed) - 1;
        n = vec_norm(axis);
    } while (n > 1 || n < 0.1);
    vec_scale(axis, 1 / n, axis);
    similarity way = {scale, rigid_rotation(zero, axis, M_PI * random_unit(seed))};
    for (int c = 0; c < 3; c++) way.motion.t[c] = 400 * (random_unit(seed) - 0.5);
    return way;
}

/* Crown and neck cut away, 0.5 mm of noise at each vertex. */
static void spoil(head_scan *s, const norm_head *h, uint64_t *seed)
{
    const double crown = landmarks_find(&h->points, "N")->xyz[2] + 30,
                 neck = landmarks_find(&h->points, "Me")->xyz[2] - 10;
    for (int i = 0; i < PARTS; i++) {
        surface *mesh = &s->part[i];
        uint8_t *keep = NEW_ARRAY(uint8_t, mesh->triangle_count);
        for (int32_t t = 0; t < mesh->triangle_count; t++) {
            double z = mesh->xyz[3 * (size_t)mesh->tri[3 * t] + 2];
            keep[t] = z < crown && z > neck;
        }
        surface left = surface_select(mesh, keep);
        free(keep);
        surface_free(mesh);
        *mesh = left;
        for (int32_t k = 0; k < 3 * left.vertex_count; k++) left.xyz[k] += 0.5 * (2 * random_unit(seed) - 1);
    }
}

/* Largest distance between where two ways put the template's landmarks. */
static double apart(const head_place *p, const similarity *way)
{
    double most = 0;
    for (int32_t i = 0; i < model.point_count; i++) {
        double a[3], b[3];
        head_place_apply(p, model.point[i].at, 1, a);
        similarity_apply(way, model.point[i].at, b);
        most = fmax(most, vec_distance(a, b));
    }
    return most;
}

static void a_moved_and_scaled_template_is_recovered_exactly(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int points = 0; points < 2; points++) {
        err e = {0};
        char told[256];
        head_place p;
        head_scan s = scan_of(&mean, points);
        similarity way = random_way(&seed, points ? 1.17 : 0.86);
        move_scan(&s, &way);
        assert_ok(head_place_find(&model, &s, NULL, &p, told, &e));
        assert_int_equal(p.by_landmarks, points);
        assert_near(p.scale, way.scale, 1e-9);
        assert_near(apart(&p, &way), 0, 1e-6);
        head_scan_free(&s);
    }
}

static void another_head_without_crown_and_neck_is_found_from_any_turn(void **state)
{
    (void)state;
    err e = {0};
    char told[256];
    uint64_t seed = 5;
    head_place still;
    head_scan s = scan_of(&other, false);
    spoil(&s, &other, &seed);
    assert_ok(head_place_find(&model, &s, NULL, &still, told, &e));
    assert_string_equal(told, "");
    const similarity first = {still.scale, still.motion};
    double most = 0;
    for (int32_t i = 0; i < model.point_count; i++) { /* where it should be, by its landmarks */
        double at[3];
        head_place_apply(&still, model.point[i].at, 1, at);
        most = fmax(most, vec_distance(at, landmarks_find(&other.points, model.point[i].label)->xyz));
    }
    assert_true(most < 20);
    head_scan_free(&s);
    for (int i = 0; i < TURNS; i++) {
        head_place p;
        s = scan_of(&other, false);
        spoil(&s, &other, &seed);
        similarity way = random_way(&seed, 1), want;
        move_scan(&s, &way);
        want = (similarity){first.scale, rigid_compose(&way.motion, &first.motion)};
        assert_ok(head_place_find(&model, &s, NULL, &p, told, &e));
        assert_true(apart(&p, &want) < 2);
        head_scan_free(&s);
    }
}

static void axes_are_told(void **state)
{
    (void)state;
    static const struct {
        double axis[3], angle;
        const char *words;
    } row[] = {
        {{1, 0, 0}, M_PI, "upside down"}, {{0, 0, 1}, M_PI, "in RAS, turned by 18"}, {{1, 0, 0}, -M_PI / 2, "y up"}};
    for (int i = 0; i < 3; i++) {
        const double zero[3] = {0};
        err e = {0};
        char told[256];
        head_place p;
        head_scan s = scan_of(&other, false);
        similarity way = {1, rigid_rotation(zero, row[i].axis, row[i].angle)};
        move_scan(&s, &way);
        assert_ok(head_place_find(&model, &s, NULL, &p, told, &e));
        if (!strstr(told, row[i].words)) fail_msg("told \"%s\", not \"%s\"", told, row[i].words);
        head_scan_free(&s);
    }
}

static void refuses_metres_mirrors_and_what_is_no_head(void **state)
{
    (void)state;
    enum { METRES, INCHES, MIRRORED, MIRRORED_POINTS, SKIN_INWARDS, BALL };
    static const char *const words[] = {"a head in metres", "a head in inches",       "is mirrored, left for right",
                                        "its landmarks",    "the skin faces inwards", "no head that is known"};
    for (int k = METRES; k <= BALL; k++) {
        err e = {0};
        head_place p = {.scale = -1};
        head_scan s = scan_of(&other, k == MIRRORED_POINTS);
        similarity way = {k == METRES ? 0.001 : k == INCHES ? 1 / 25.4 : 1, rigid_identity()};
        move_scan(&s, &way);
        for (int i = 0; i < PARTS && (k == MIRRORED || k == MIRRORED_POINTS); i++)
            for (int32_t v = 0; v < s.part[i].vertex_count; v++) s.part[i].xyz[3 * (size_t)v] *= -1;
        for (int32_t i = 0; i < s.points.count; i++) s.points.point[i].xyz[0] *= -1;
        if (k == SKIN_INWARDS) surface_flip(&s.part[CASE_SKIN]);
        for (int32_t v = 0; k == BALL && v < s.part[CASE_SKIN].vertex_count; v++) {
            vec_normalize(s.part[CASE_SKIN].xyz + 3 * (size_t)v);
            vec_scale(s.part[CASE_SKIN].xyz + 3 * (size_t)v, 90, s.part[CASE_SKIN].xyz + 3 * (size_t)v);
        }
        if (k == BALL) surface_free(&s.part[CASE_SKULL]);
        if (k == BALL) surface_free(&s.part[CASE_MANDIBLE]);
        if (head_place_find(&model, &s, NULL, &p, NULL, &e))
            fail_msg("not refused: it should say \"%s\"; %.2f mm, %.2f", words[k], p.median_mm, p.scale);
        assert_int_equal(e.code, ERR_GEOMETRY);
        if (!strstr(e.text, words[k])) fail_msg("\"%s\" does not say \"%s\"", e.text, words[k]);
        assert_near(p.scale, -1, 0);
        head_scan_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moved_and_scaled_template_is_recovered_exactly),
        cmocka_unit_test(another_head_without_crown_and_neck_is_found_from_any_turn),
        cmocka_unit_test(axes_are_told),
        cmocka_unit_test(refuses_metres_mirrors_and_what_is_no_head),
    };
    return cmocka_run_group_tests(tests, build, drop);
}
