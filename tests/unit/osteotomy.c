#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "tests/unit/box_mandible.h"
#include "geometry/boolean.h"
#include "geometry/mesh_file.h"
#include "geometry/nearest.h"
#include "geometry/osteotomy.h"
#include "geometry/repair.h"

static cut_plane plane(const char *label, double x, double y, double z, double nx, double ny, double nz)
{
    cut_plane p = {.point = {x, y, z}, .normal = {nx, ny, nz}};
    snprintf(p.label, sizeof p.label, "%s", label);
    return p;
}

static double balance(const segments *s)
{
    double sum = surface_volume(&s->kerf);
    for (int i = 0; i < SEGMENT_COUNT; i++) sum += surface_volume(&s->part[i]);
    return sum;
}

static void check_closed(const segments *s)
{
    for (int i = 0; i < SEGMENT_COUNT; i++) {
        int32_t open, crowded;
        if (!s->part[i].triangle_count) continue;
        surface_edge_census(&s->part[i], &open, &crowded);
        assert_int_equal(open, 0);
        assert_int_equal(crowded, 0);
        assert_true(surface_volume(&s->part[i]) > 0);
    }
}

static void a_plane_takes_exactly_its_kerf(void **state)
{
    (void)state;
    err e = {0};
    landmarks none = {0};
    surface box = body_box(0, 0, 0, 40, 30, 20), hole = body_box(5, 5, 5, 35, 25, 15);
    surface_flip(&hole);
    surface tube = body_with(box, hole);
    cut_plane p = plane("maxilla", 10, 0, 0, -1, 0, 0);
    osteotomy_input in = {.skull = &tube, .points = &none, .plane = &p, .plane_count = 1};
    osteotomy_params params = osteotomy_params_default();
    params.kerf_mm = 1;
    segments s;
    cut_report r;
    assert_ok(osteotomy_cut(&in, &params, &s, &r, &e));
    assert_near(surface_volume(&s.part[SEGMENT_MAXILLA]), 9.5 * 600 - 4.5 * 200, 1e-6);
    assert_near(surface_volume(&s.kerf), 600 - 200, 1e-6);
    assert_near(surface_volume(&s.part[SEGMENT_CRANIUM]), 29.5 * 600 - 24.5 * 200, 1e-6);
    assert_int_equal(r.balance_count, 1);
    assert_true(r.balance[0].error_share < 1e-12);
    assert_near(r.volume_mm3[SEGMENT_MAXILLA], 4800, 1e-6);
    check_closed(&s);
    segments_free(&s);
    cut_report_free(&r);
    surface_free(&tube);
}

static void planes_of_one_segment_cut_a_wedge(void **state)
{
    (void)state;
    err e = {0};
    landmarks none = {0};
    surface box = body_box(0, 0, 0, 40, 30, 20);
    cut_plane p[2] = {plane("chin", 10, 0, 0, -1, 0, 0), plane("chin", 0, 0, 8, 0, 0, -1)};
    osteotomy_input in = {.mandible = &box, .points = &none, .plane = p, .plane_count = 2};
    osteotomy_params params = osteotomy_params_default();
    segments s;
    assert_ok(osteotomy_cut(&in, &params, &s, NULL, &e));
    assert_near(surface_volume(&s.part[SEGMENT_CHIN]), 9.75 * 30 * 7.75, 1e-6);
    assert_near(surface_volume(&s.kerf), 30 * (10.25 * 8.25 - 9.75 * 7.75), 1e-6);
    assert_near(balance(&s), 24000, 1e-6);
    check_closed(&s);
    segments_free(&s);
    surface_free(&box);
}

/* A roof on a long foot, with a peg that reaches 2 mm below the cut. */
static void an_island_goes_back_to_where_it_hung(void **state)
{
    (void)state;
    err e = {0};
    landmarks none = {0};
    surface part[4] = {body_box(0, 0, 10, 60, 20, 20), body_box(0.5, 0.5, -30, 10, 19, 12),
                       body_box(1, 1, -30.5, 30, 18, -20), body_box(50, 8, -2, 54, 12, 12)},
            bone;
    assert_ok(boolean_unite(part, 4, &bone, &e));
    cut_plane p = plane("maxilla", 0, 0, 0, 0, 0, -1);
    osteotomy_input in = {.skull = &bone, .points = &none, .plane = &p, .plane_count = 1};
    osteotomy_params params = osteotomy_params_default();
    segments s;
    cut_report r;
    assert_ok(osteotomy_cut(&in, &params, &s, &r, &e));
    assert_int_equal(r.fragment_count, 1);
    assert_int_equal(r.fragment[0].from, SEGMENT_MAXILLA);
    assert_int_equal(r.fragment[0].to, SEGMENT_CRANIUM);
    assert_near(r.fragment[0].volume_mm3, 16 * 1.75, 1e-6);
    assert_near(r.fragment[0].gap_mm, 0.5, 1e-6);
    int32_t *number;
    assert_int_equal(surface_components(&s.part[SEGMENT_MAXILLA], &number), 1);
    free(number);
    assert_int_equal(surface_components(&s.part[SEGMENT_CRANIUM], &number), 2);
    free(number);
    assert_near(balance(&s), surface_volume(&bone), 1e-6);
    segments_free(&s);
    cut_report_free(&r);
    params.fragment_mm3 = 1; /* larger islands stay where the saw left them, and are reported */
    assert_ok(osteotomy_cut(&in, &params, &s, &r, &e));
    assert_int_equal(r.fragment_count, 1);
    assert_int_equal(r.fragment[0].to, SEGMENT_MAXILLA);
    segments_free(&s);
    cut_report_free(&r);
    surface_free(&bone);
    for (int i = 0; i < 4; i++) surface_free(&part[i]);
}

static bool holds(const surface *s, const landmarks *l, const char *label)
{
    err e = {0};
    nearest *n;
    assert_ok(nearest_create(s, &n, &e));
    double d = nearest_point(n, landmarks_find(l, label)->xyz, NULL, NULL);
    nearest_destroy(&n);
    return d < 0.01;
}

static void the_sagittal_split_parts_condyle_from_teeth(void **state)
{
    (void)state;
    err e = {0};
    model m = box_mandible();
    osteotomy_input in = {.mandible = &m.mandible, .points = &m.points, .kinds = OSTEOTOMY_BSSO};
    osteotomy_params p = osteotomy_params_default();
    segments s;
    cut_report r;
    assert_ok(osteotomy_cut(&in, &p, &s, &r, &e));
    check_closed(&s);
    static const char *const proximal[] = {"Co_L", "Cor_L", "Go_L", "RP_L"}, *const distal[] = {"L1",   "L3_L", "L6_L",
                                                                                                "L7_L", "Li_L", "Li_R",
                                                                                                "MF_L", "Me"};
    for (int i = 0; i < 4; i++) assert_true(holds(&s.part[SEGMENT_PROXIMAL_LEFT], &m.points, proximal[i]));
    for (int i = 0; i < 8; i++) assert_true(holds(&s.part[SEGMENT_DISTAL], &m.points, distal[i]));
    for (int i = SEGMENT_DISTAL; i <= SEGMENT_PROXIMAL_RIGHT; i++) {
        int32_t *number;
        assert_int_equal(surface_components(&s.part[i], &number), 1);
        free(number);
    }
    double left = surface_volume(&s.part[SEGMENT_PROXIMAL_LEFT]),
           right = surface_volume(&s.part[SEGMENT_PROXIMAL_RIGHT]), whole = surface_volume(&m.mandible);
    assert_near(left, right, 1e-3 * left);
    assert_near(balance(&s), whole, 1e-6 * whole);
    /* Lateral plate: a point just inside the outer surface beside the canal, in front of the lingula. */
    nearest *n;
    assert_ok(nearest_create(&s.part[SEGMENT_PROXIMAL_LEFT], &n, &e));
    assert_true(nearest_inside(n, (double[3]){33.5, -20, 5}));
    assert_false(nearest_inside(n, (double[3]){25, -20, 5}));   /* lingual plate */
    assert_true(nearest_inside(n, (double[3]){25, -20, 32}));   /* above the medial cut */
    assert_true(nearest_inside(n, (double[3]){25, 5, 20}));     /* behind the lingula */
    assert_false(nearest_inside(n, (double[3]){33.5, -48, 5})); /* in front of the buccal cut */
    nearest_destroy(&n);
    for (int i = 0; i < r.clearance_count; i++) assert_true(r.clearance[i].ok);
    segments_free(&s);
    cut_report_free(&r);
    model_free(&m);
}

static void the_split_follows_an_opened_mandible(void **state)
{
    (void)state;
    err e = {0};
    model m = box_mandible();
    osteotomy_input in = {
        .mandible = &m.mandible, .points = &m.points, .kinds = OSTEOTOMY_BSSO | OSTEOTOMY_GENIOPLASTY};
    osteotomy_params p = osteotomy_params_default();
    segments closed, open;
    assert_ok(osteotomy_cut(&in, &p, &closed, NULL, &e));
    const double pivot[3] = {0, 2, 52}, axis[3] = {1, 0, 0};
    rigid turn = rigid_rotation(pivot, axis, 0.5);
    surface_transform(&m.mandible, &turn);
    for (int32_t i = 0; i < m.points.count; i++) rigid_apply(&turn, m.points.point[i].xyz, m.points.point[i].xyz);
    assert_ok(osteotomy_cut(&in, &p, &open, NULL, &e));
    for (int i = SEGMENT_DISTAL; i < SEGMENT_COUNT; i++)
        assert_near(surface_volume(&open.part[i]), surface_volume(&closed.part[i]),
                    2e-3 * surface_volume(&closed.part[i]));
    assert_true(holds(&open.part[SEGMENT_CHIN], &m.points, "Me"));
    segments_free(&closed);
    segments_free(&open);
    model_free(&m);
}

static void without_a_lingula_the_rule_is_used_and_named(void **state)
{
    (void)state;
    err e = {0};
    model m = box_mandible();
    for (int32_t i = 0; i < m.points.count; i++)
        if (!strncmp(m.points.point[i].label, "Li_", 3)) m.points.point[i].label[0] = 'x';
    osteotomy_input in = {.mandible = &m.mandible, .points = &m.points, .kinds = OSTEOTOMY_BSSO};
    osteotomy_params p = osteotomy_params_default();
    segments s;
    cut_report r;
    assert_ok(osteotomy_cut(&in, &p, &s, &r, &e));
    int named = 0;
    for (int i = 0; i < r.warning_count; i++) named += strstr(r.warning[i], "Li_L is missing") != NULL;
    assert_int_equal(named, 1);
    segments_free(&s);
    cut_report_free(&r);
    model_free(&m);
}

static void refusals_say_what_is_wrong(void **state)
{
    (void)state;
    err e = {0};
    landmarks none = {0};
    surface box = body_box(0, 0, 0, 40, 30, 20);
    osteotomy_params p = osteotomy_params_default();
    osteotomy_input in = {.skull = &box, .points = &none};
    segments s;
    cut_plane bad[] = {plane("maxilla", 100, 0, 0, 1, 0, 0), plane("nose", 10, 0, 0, 1, 0, 0),
                       plane("distal", 10, 0, 0, 1, 0, 0), plane("maxilla", 10, 0, 0, 2, 0, 0),
                       plane("chin", 1, 0, 0, 1, 0, 0)};
    static const char *const text[] = {"misses the bone", "must name the segment", "name the piece",
                                       "not a unit vector", "the case has none"};
    for (int i = 0; i < 5; i++) {
        in.plane = bad + i;
        in.plane_count = 1;
        assert_false(osteotomy_cut(&in, &p, &s, NULL, &e));
        if (!strstr(e.text, text[i])) print_error("%s\n", e.text);
        assert_non_null(strstr(e.text, text[i]));
        e = (err){0};
    }
    in.plane_count = 0;
    in.kinds = OSTEOTOMY_LE_FORT_1;
    assert_false(osteotomy_cut(&in, &p, &s, NULL, &e));
    assert_int_equal(e.code, ERR_INPUT);
    static const char *const labels[] = {"PR_L", "ZB_R", "PM_L", "PNS", "U1"};
    for (int i = 0; i < 5; i++) assert_non_null(strstr(e.text, labels[i]));
    e = (err){0};
    in = (osteotomy_input){.mandible = &box, .points = &none, .kinds = OSTEOTOMY_BSSO};
    assert_false(osteotomy_cut(&in, &p, &s, NULL, &e));
    assert_non_null(strstr(e.text, "Go_L"));
    e = (err){0};
    p.kerf_mm = 0;
    assert_refused(osteotomy_cut(&in, &p, &s, NULL, &e), ERR_INPUT);
    p = osteotomy_params_default();
    surface open = surface_copy(&box);
    open.triangle_count--;
    in = (osteotomy_input){.skull = &open, .points = &none, .plane = bad + 0, .plane_count = 1};
    assert_false(osteotomy_cut(&in, &p, &s, NULL, &e));
    assert_non_null(strstr(e.text, "is not closed"));
    surface_free(&open);
    surface_free(&box);
}

/* Both heads: every landmark on its own piece, volumes add up, one piece each. */
static void scanned_jaws_are_cut(void **state)
{
    (void)state;
    static const char *const heads[] = {"phantom_head_ct", "vtk_fullhead_ct"};
    const char *data = getenv("GNATHOS_DATA") ? getenv("GNATHOS_DATA") : "../shared/data";
    for (int h = 0; h < 2; h++) {
        err e = {0};
        char path[512];
        surface raw[2], solid[2];
        landmarks points;
        repair_params rp = repair_params_default();
        snprintf(path, sizeof path, "%s/%s/landmarks.mrk.json", data, heads[h]);
        FILE *there = fopen(path, "rb");
        if (!there) {
            print_message("skipped: %s is not there\n", path);
            skip();
        }
        fclose(there);
        assert_ok(landmarks_read(path, &points, NULL, &e));
        for (int k = 0; k < 2; k++) {
            snprintf(path, sizeof path, "%s/%s/%s.ply", data, heads[h], k ? "mandible" : "skull");
            assert_ok(mesh_read_surface(path, MESH_SPACE_FROM_FILE, raw + k, NULL, &e));
            assert_ok(repair_solid(raw + k, &rp, solid + k, NULL, &e));
            surface_free(raw + k);
        }
        osteotomy_input in = {.skull = solid,
                              .mandible = solid + 1,
                              .points = &points,
                              .kinds = OSTEOTOMY_LE_FORT_1 | OSTEOTOMY_BSSO | OSTEOTOMY_GENIOPLASTY};
        osteotomy_params p = osteotomy_params_default();
        segments s;
        cut_report r;
        assert_ok(osteotomy_cut(&in, &p, &s, &r, &e));
        check_closed(&s);
        for (int i = 0; i < r.balance_count; i++) assert_true(r.balance[i].error_share < 1e-6);
        for (int i = 0; i < r.warning_count; i++) assert_null(strstr(r.warning[i], "lies on the"));
        assert_true(r.volume_mm3[SEGMENT_MAXILLA] > 25000 && r.volume_mm3[SEGMENT_MAXILLA] < 45000);
        segments_free(&s);
        cut_report_free(&r);
        landmarks_free(&points);
        for (int k = 0; k < 2; k++) surface_free(solid + k);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_takes_exactly_its_kerf),
        cmocka_unit_test(planes_of_one_segment_cut_a_wedge),
        cmocka_unit_test(an_island_goes_back_to_where_it_hung),
        cmocka_unit_test(the_sagittal_split_parts_condyle_from_teeth),
        cmocka_unit_test(the_split_follows_an_opened_mandible),
        cmocka_unit_test(without_a_lingula_the_rule_is_used_and_named),
        cmocka_unit_test(refusals_say_what_is_wrong),
        cmocka_unit_test(scanned_jaws_are_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
