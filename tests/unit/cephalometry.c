/* Cephalometry: points placed so that each measure is known by construction, and the phantom's table. */
#include "tests/check.h"
#include "geometry/cephalometry.h"
#include <string.h>

/* Frame: Frankfort through the porions, axes of the file. Points are given as forward and up from the porions. */
static void put(landmarks *l, const char *label, double forward, double up)
{
    landmarks_set(l, label, (const double[3]){7, -forward, up}); /* off the midplane: must not matter */
}

static void put_pair(landmarks *l, const char *label, double forward, double up)
{
    char name[LANDMARK_LABEL_SIZE];
    for (int side = -1; side <= 1; side += 2) { /* the mean of the two counts */
        snprintf(name, sizeof name, "%s_%c", label, side > 0 ? 'L' : 'R');
        landmarks_set(l, name, (const double[3]){40.0 * side, -forward - 2 * side, up + 3 * side});
    }
}

static head_frame file_frame(void) { return (head_frame){.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}}; }

static const ceph_value *value_of(const ceph_value *v, const char *name)
{
    for (int i = 0; i < ceph_measure_count; i++)
        if (!strcmp(ceph_measures[i].name, name)) return v + i;
    fail_msg("no measure %s", name);
    return NULL;
}

static const double pi = 3.14159265358979323846;

static void measures_of_constructed_points_have_their_constructed_values(void **state)
{
    (void)state;
    landmarks l = {0};
    head_frame f = file_frame();
    ceph_value v[CEPH_MEASURES_MAX];
    put(&l, "S", 0, 0); /* S-N along Frankfort: angles at N are read from straight back */
    put(&l, "N", 70, 0);
    double a = 82 * pi / 180, b = 78.5 * pi / 180;
    put(&l, "A", 70 - 60 * cos(a), -60 * sin(a));
    put(&l, "B", 70 - 100 * cos(b), -100 * sin(b));
    put(&l, "Pog", 64, -110);
    put(&l, "Gn", 60, -114);
    put(&l, "Me", 20 + 60 * cos(pi / 6), -80 - 60 * sin(pi / 6));
    put_pair(&l, "Go", 20, -80);
    put_pair(&l, "Co", 10, 0);
    put(&l, "ANS", 75, -50);
    put(&l, "PNS", 25, -50);
    put(&l, "U1_apex", 60, -60);
    put(&l, "U1", 60 + 20 * sin(pi / 9), -60 - 20 * cos(pi / 9)); /* 20 degrees off the vertical */
    put(&l, "L1", 63, -77);
    put(&l, "L1_apex", 63 - 20 * sin(pi / 6), -77 - 20 * cos(pi / 6)); /* at right angles to Go-Me */
    put_pair(&l, "U3", 55, -78);
    put_pair(&l, "L3", 55, -78);
    put_pair(&l, "U6", 35, -78);
    put_pair(&l, "L6", 35, -78);
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "SNA")->value, 82, 1e-9);
    assert_near(value_of(v, "SNB")->value, 78.5, 1e-9);
    assert_near(value_of(v, "ANB")->value, 3.5, 1e-9);
    assert_near(value_of(v, "SN-MP")->value, 30, 1e-9);
    assert_near(value_of(v, "FMA")->value, 30, 1e-9);
    assert_near(value_of(v, "U1-SN")->value, 110, 1e-9);
    assert_near(value_of(v, "U1-FH")->value, 110, 1e-9);
    assert_near(value_of(v, "IMPA")->value, 90, 1e-9);
    assert_near(value_of(v, "N-Pog")->value, -6, 1e-9);
    assert_near(value_of(v, "N-A")->value, -60 * cos(a), 1e-9);
    assert_near(value_of(v, "palatal plane")->value, 0, 1e-9);
    assert_near(value_of(v, "overjet")->value, 60 + 20 * sin(pi / 9) - 63, 1e-9);
    assert_near(value_of(v, "overbite")->value, -77 + 60 + 20 * cos(pi / 9), 1e-9);
    assert_near(value_of(v, "Wits")->value, 100 * cos(b) - 60 * cos(a), 1e-9);
    assert_near(value_of(v, "Co-Gn")->value, hypot(50, 114), 1e-9);
    assert_near(value_of(v, "Ar-Go")->value, hypot(10, 80), 1e-9);
    assert_string_equal(value_of(v, "Ar-Go")->note, "Co stands for Ar");
    /* COGS: along and across S-N turned by 7 degrees, front down */
    double c = cos(7 * pi / 180), s = sin(7 * pi / 180);
    assert_near(value_of(v, "ANS-PNS")->value, 50 * c, 1e-9);
    assert_near(value_of(v, "N-ANS")->value, 50 * c - 5 * s, 1e-9);
    assert_near(value_of(v, "PNS-N")->value, 50 * c + 45 * s, 1e-9);
    assert_near(value_of(v, "SN-PP")->value, 0, 1e-9);
    assert_near(value_of(v, "PP-MP")->value, 30, 1e-9);
    assert_near(value_of(v, "OP-FH")->value, 0, 1e-9);
    assert_near(value_of(v, "interincisal")->value, 180 - 20 - 30, 1e-9); /* 20 and 30 degrees off the vertical */
    assert_near(value_of(v, "N-A (HP)")->value, -60 * cos(a) * c + 60 * sin(a) * s, 1e-9);
    assert_near(value_of(v, "N-B (HP)")->value, -100 * cos(b) * c + 100 * sin(b) * s, 1e-9);
    assert_near(value_of(v, "N-Pg (HP)")->value, -6 * c + 110 * s, 1e-9);
    assert_near(value_of(v, "U1-NF")->value, 10 + 20 * cos(pi / 9), 1e-9);
    assert_near(value_of(v, "U6-NF")->value, 28, 1e-9);
    /* Go-Gn runs 40 forward and 34 down: unit vector (40, -34) / 52.497619 */
    assert_near(value_of(v, "B-Pg")->value,
                ((64 - 70 + 100 * cos(b)) * 40 + (110 - 100 * sin(b)) * 34) / 52.49761899362675, 1e-9);
    assert_near(value_of(v, "L1-MP")->value, (3 * 40 + 43 * 34) / 52.49761899362675, 1e-9);
    assert_near(value_of(v, "L6-MP")->value, (2 * 40 + 15 * 34) / 52.49761899362675, 1e-9);
    put_pair(&l, "Ar", 8, -10);
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "Ar-Go")->value, hypot(12, 70), 1e-9);
    assert_string_equal(value_of(v, "Ar-Go")->note, "");
    landmarks_free(&l);
}

static void transverse_measures_are_taken_across(void **state)
{
    (void)state;
    landmarks l = {0};
    head_frame f = file_frame();
    ceph_value v[CEPH_MEASURES_MAX];
    const struct {
        const char *label;
        double x[3];
    } point[] = {{"N", {1, -70, 0}},       {"U1", {3, -75, -75}},     {"L1", {2, -70, -74}},
                 {"Me", {-4, -60, -110}},  {"U3_L", {18, -60, -77}},  {"U3_R", {-16, -60, -77}},
                 {"U6_L", {26, -40, -80}}, {"U6_R", {-26, -40, -76}}, {"L6_L", {22, -42, -79}},
                 {"L6_R", {-22, -42, -76}}};
    for (size_t i = 0; i < sizeof point / sizeof *point; i++) landmarks_set(&l, point[i].label, point[i].x);
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "cant U3")->value, 0, 1e-12);
    assert_near(value_of(v, "cant U6")->value, atan(4.0 / 52) * 180 / pi, 1e-12); /* the left one is lower */
    assert_near(value_of(v, "U3 width")->value, 34, 1e-12);
    assert_near(value_of(v, "U6 width")->value, hypot(52, 4), 1e-12);
    assert_near(value_of(v, "L6 width")->value, hypot(44, 3), 1e-12);
    assert_near(value_of(v, "upper midline")->value, 2, 1e-12);
    assert_near(value_of(v, "lower midline")->value, 1, 1e-12);
    assert_near(value_of(v, "midline shift")->value, -1, 1e-12);
    assert_near(value_of(v, "chin midline")->value, -5, 1e-12);
    landmarks_free(&l);
}

static void profile_measures_carry_their_signs(void **state)
{
    (void)state;
    landmarks l = {0};
    head_frame f = file_frame();
    ceph_value v[CEPH_MEASURES_MAX];
    put(&l, "G'", 80, 40);
    put(&l, "Pn", 110, 0);
    put(&l, "Sn", 90, -20);
    put(&l, "Ls", 94, -35);
    put(&l, "Stm", 90, -40);
    put(&l, "Li_soft", 91, -45);
    put(&l, "B'", 86, -60);
    put(&l, "Pg'", 80, -80); /* as far below Sn as G' above: a symmetric, convex profile */
    put(&l, "Me'", 70, -95);
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "facial convexity")->value, 180 - 2 * atan(6) * 180 / pi, 1e-9);
    assert_near(value_of(v, "TVL Pn")->value, 20, 1e-12);
    assert_near(value_of(v, "TVL Ls")->value, 4, 1e-12);
    assert_near(value_of(v, "TVL Li")->value, 1, 1e-12);
    assert_near(value_of(v, "TVL B'")->value, -4, 1e-12);
    assert_near(value_of(v, "TVL Pg'")->value, -10, 1e-12);
    assert_near(value_of(v, "upper lip length")->value, 20, 1e-12);
    assert_near(value_of(v, "lower lip length")->value, 55, 1e-12);
    /* the E-line runs 30 forward over 80 up: at Ls 45 above Pg' it stands at 96.875 */
    assert_near(value_of(v, "Ls to E-line")->value, (94 - 96.875) * 80 / hypot(30, 80), 1e-9);
    assert_true(isnan(value_of(v, "interlabial gap")->value));
    put(&l, "N'", 82, 20);
    put(&l, "Pog", 68, -79);
    put(&l, "Me", 60, -87);
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "chin thickness")->value, 12, 1e-12);
    assert_near(value_of(v, "menton thickness")->value, 8, 1e-12);
    assert_near(value_of(v, "facial length")->value, 115, 1e-12);
    assert_near(value_of(v, "lower third")->value, 75, 1e-12);
    assert_near(value_of(v, "lower face share")->value, 100 * 75 / 135.0, 1e-9);
    assert_near(value_of(v, "upper lip share")->value, 100 * 20 / 75.0, 1e-9);
    /* from N', G' lies 2 back and 20 up, Pn 28 forward and 20 down */
    assert_near(value_of(v, "nasofrontal angle")->value, 180 - (atan2(28, 20) - atan2(2, 20)) * 180 / pi, 1e-9);
    /* from B', the lip lies 5 forward and 15 up, the chin 6 back and 20 down */
    assert_near(value_of(v, "mentolabial angle")->value, 180 - (atan2(5, 15) - atan2(6, 20)) * 180 / pi, 1e-9);
    put(&l, "Sn", 70, -20); /* behind G'-Pg': concave */
    ceph_evaluate(&l, &f, v);
    assert_near(value_of(v, "facial convexity")->value, -(180 - 2 * atan(6) * 180 / pi), 1e-9);
    landmarks_free(&l);
}

static void what_cannot_be_measured_says_which_landmark_it_needs(void **state)
{
    (void)state;
    landmarks l = {0};
    head_frame f = file_frame();
    ceph_value v[CEPH_MEASURES_MAX];
    put(&l, "S", 0, 0);
    put(&l, "N", 70, 0);
    landmarks_set(&l, "Go_L", (const double[3]){40, 0, -80});
    ceph_evaluate(&l, &f, v);
    for (int i = 0; i < ceph_measure_count; i++) {
        assert_true(isnan(v[i].value));
        assert_int_equal(strncmp(v[i].note, "needs ", 6), 0);
    }
    assert_string_equal(value_of(v, "SNA")->note, "needs A");
    assert_string_equal(value_of(v, "FMA")->note, "needs Go_R");
    assert_string_equal(value_of(v, "Ar-Go")->note, "needs Ar_L or Co_L");
    landmarks_free(&l);
}

static void norms_are_complete_and_say_where_they_come_from(void **state)
{
    (void)state;
    for (int i = 0; i < ceph_measure_count; i++) {
        const ceph_measure *m = ceph_measures + i;
        assert_int_equal(isnan(m->men.mean), m->source == NULL);
        assert_int_equal(isnan(m->women.mean), m->source == NULL);
        assert_true(!m->source || (m->men.sd > 0 && m->women.sd > 0));
        for (int k = 0; k < i; k++) assert_string_not_equal(m->name, ceph_measures[k].name);
    }
}

/* The table was taken in the mirror plane of the midface, 2 degrees off the frame of porions and orbitales. */
static void the_phantom_measures_as_in_its_table(void **state)
{
    (void)state;
    const char *data = getenv("GNATHOS_DATA");
    char path[1024];
    snprintf(path, sizeof path, "%s/phantom_head_ct/landmarks.mrk.json", data ? data : "../shared/data");
    FILE *there = fopen(path, "rb");
    if (!there) {
        print_message("skipped: %s is not here\n", path);
        skip();
    }
    fclose(there);
    static const struct {
        const char *name;
        double want;
    } table[] = {{"SNA", 86.7},
                 {"SNB", 77.6},
                 {"ANB", 9.2},
                 {"SN-MP", 30.8},
                 {"FMA", 23.4},
                 {"palatal plane", 3.2},
                 {"facial angle", 85.5},
                 {"U1-FH", 103.3},
                 {"overjet", 6.8},
                 {"overbite", 2.8},
                 {"LAFH", 65.1},
                 {"facial convexity", 17.8},
                 {"nasolabial angle", 122.0}};
    err e = {0};
    landmarks l = {0};
    head_frame f;
    ceph_value v[CEPH_MEASURES_MAX];
    assert_ok(landmarks_read(path, &l, NULL, &e));
    assert_ok(head_frame_from_landmarks(&l, &f, &e));
    ceph_evaluate(&l, &f, v);
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        print_message("%-18s %8.2f, table %8.1f\n", table[i].name, value_of(v, table[i].name)->value, table[i].want);
        assert_near(value_of(v, table[i].name)->value, table[i].want, 0.3);
    }
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_of_constructed_points_have_their_constructed_values),
        cmocka_unit_test(transverse_measures_are_taken_across),
        cmocka_unit_test(profile_measures_carry_their_signs),
        cmocka_unit_test(what_cannot_be_measured_says_which_landmark_it_needs),
        cmocka_unit_test(norms_are_complete_and_say_where_they_come_from),
        cmocka_unit_test(the_phantom_measures_as_in_its_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
