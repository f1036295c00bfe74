/* Landmarks: Slicer markups and fcsv, both sides, what is skipped and what is refused. */
#include "tests/check.h"
#include "geometry/landmarks.h"
#include "geometry/write_whole.h"
#include <string.h>

static void write_text(const char *path, const char *text)
{
    err e = {0};
    assert_ok(write_whole(path, text, strlen(text), &e));
}

static void markups_round_trip_keeps_every_bit_and_the_order(void **state)
{
    (void)state;
    err e = {0};
    landmarks l = {0}, back = {0};
    landmarks_set(&l, "N", (const double[3]){0.1, -80.123456789012345, 1.0 / 3});
    landmarks_set(&l, "Pg'", (const double[3]){1, 2, 3});
    landmarks_set(&l, "Stm\xC3\xA9", (const double[3]){-1, 1e-17, 0});
    landmarks_set(&l, "Pg'", (const double[3]){4, 5, 6});
    assert_int_equal(l.count, 3);
    assert_ok(landmarks_write(&l, "a.mrk.json", &e));
    int32_t skipped = -1;
    assert_ok(landmarks_read("a.mrk.json", &back, &skipped, &e));
    assert_int_equal(skipped, 0);
    assert_int_equal(back.count, 3);
    assert_memory_equal(back.point, l.point, 3 * sizeof *l.point);
    char head[301] = "";
    FILE *f = fopen("a.mrk.json", "rb");
    assert_true(fread(head, 1, 300, f) > 200);
    fclose(f);
    assert_non_null(strstr(head, "/markups-schema-v1.")); /* how Slicer knows the file */
    landmarks copy = landmarks_copy(&back);
    assert_near(landmarks_find(&copy, "Pg'")->xyz[1], 5, 0);
    assert_null(landmarks_find(&copy, "Pg"));
    landmarks_free(&copy);
    landmarks_free(&back);
    landmarks_free(&l);
}

#define POINT(label, x, status) "{\"label\":\"" label "\",\"position\":[" x "],\"positionStatus\":\"" status "\"}"

static void ras_reads_as_lps_and_undefined_points_are_skipped(void **state)
{
    (void)state;
    err e = {0};
    landmarks l = {0};
    int32_t skipped = 0;
    write_text(
        "ras.mrk.json",
        "{\"markups\":[{\"type\":\"Fiducial\",\"coordinateSystem\":\"RAS\","
        "\"coordinateUnits\":[\"mm\",\"UCUM\",\"millimeter\"],\"controlPoints\":[" POINT(
            "N", "1,2,3", "defined") "," POINT("A", "0,0,0",
                                               "undefined") ",{\"label\":\"B\",\"positionStatus\":\"preview\"}]}]}");
    assert_ok(landmarks_read("ras.mrk.json", &l, &skipped, &e));
    assert_int_equal(l.count, 1);
    assert_int_equal(skipped, 2);
    assert_near(l.point[0].xyz[0], -1, 0);
    assert_near(l.point[0].xyz[1], -2, 0);
    assert_near(l.point[0].xyz[2], 3, 0);
    landmarks_free(&l);
}

static void fcsv_is_read_with_quotes_columns_and_sides(void **state)
{
    (void)state;
    err e = {0};
    landmarks l = {0};
    int32_t skipped = 0;
    write_text("a.fcsv", "# Markups fiducial file version = 5.0\n# CoordinateSystem = LPS\r\n"
                         "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                         "1,1.5,-2,3e1,0,0,0,1,1,1,0,\"Pg\"\"x, y\",,,2,0\n2,9,9,9,0,0,0,1,1,1,0,A,,,0,0\n");
    assert_ok(landmarks_read("a.fcsv", &l, &skipped, &e));
    assert_int_equal(l.count, 1);
    assert_int_equal(skipped, 1);
    assert_string_equal(l.point[0].label, "Pg\"x, y");
    assert_near(l.point[0].xyz[0], 1.5, 0);
    assert_near(l.point[0].xyz[2], 30, 0);
    landmarks_free(&l);
    write_text("b.fcsv", "# CoordinateSystem = 0\n1,1,2,3,0,0,0,1,1,1,0,N,,\n");
    assert_ok(landmarks_read("b.fcsv", &l, &skipped, &e));
    assert_near(l.point[0].xyz[0], -1, 0);
    assert_near(l.point[0].xyz[1], -2, 0);
    landmarks_free(&l);
}

static void wrong_files_are_refused_with_file_and_line(void **state)
{
    (void)state;
    static const struct {
        const char *path, *text, *says;
    } bad[] = {
        {"twice.mrk.json",
         "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n" POINT("N", "1,2,3", "defined") ",\n" POINT(
             "N", "1,2,3", "defined") "]}]}",
         "twice.mrk.json:3: "},
        {"numbers.mrk.json",
         "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n" POINT("N", "1,2", "defined") "]}]}",
         "numbers.mrk.json:2: "},
        {"missing.mrk.json", "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n{\"label\":\"N\"}]}]}",
         "missing.mrk.json:2: "},
        {"text.mrk.json",
         "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n" POINT("N", "1,2,\"3\"", "defined") "]}]}",
         "text.mrk.json:2: "},
        {"units.mrk.json", "{\"markups\":[{\"type\":\"Fiducial\",\n\"coordinateUnits\":\"um\",\"controlPoints\":[]}]}",
         "units.mrk.json:2: "},
        {"side.mrk.json", "{\"markups\":[{\"type\":\"Fiducial\",\n\"coordinateSystem\":\"LAS\",\"controlPoints\":[]}]}",
         "side.mrk.json:2: "},
        {"plane.mrk.json", "{\"markups\":[\n{\"type\":\"Plane\",\"controlPoints\":[]}]}", "plane.mrk.json:2: "},
        {"status.mrk.json",
         "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n" POINT("N", "1,2,3", "moving") "]}]}",
         "status.mrk.json:2: "},
        {"label.mrk.json",
         "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[\n" POINT("a label of more than thirty-one bytes",
                                                                            "1,2,3", "defined") "]}]}",
         "label.mrk.json:2: "},
        {"none.mrk.json", "{\"markups\":[{\"type\":\"Fiducial\",\"controlPoints\":[]}]}", "none.mrk.json: "},
        {"other.mrk.json", "{\"points\":[]}", "other.mrk.json:1: "},
        {"list.mrk.json", "[]", "list.mrk.json:1: "},
        {"cut.mrk.json", "{\"markups\":[\n{\"type\":", "cut.mrk.json:2: "},
        {"side.fcsv", "1,1,2,3,0,0,0,1,1,1,0,N,,\n", "side.fcsv:1: "},
        {"number.fcsv", "# CoordinateSystem = LPS\n1,1,x,3,0,0,0,1,1,1,0,N,,\n", "number.fcsv:2: "},
        {"nan.fcsv", "# CoordinateSystem = LPS\n1,1,nan,3,0,0,0,1,1,1,0,N,,\n", "nan.fcsv:2: "},
        {"short.fcsv", "# CoordinateSystem = LPS\n1,1,2\n", "short.fcsv:2: "},
        {"twice.fcsv", "# CoordinateSystem = LPS\n1,1,2,3,0,0,0,1,1,1,0,N,,\n1,1,2,3,0,0,0,1,1,1,0,N,,\n",
         "twice.fcsv:3: "},
        {"system.fcsv", "# CoordinateSystem = LAS\n", "system.fcsv:1: "},
        {"points.csv", "x", "points.csv: unknown kind"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        landmarks l = {0};
        write_text(bad[i].path, bad[i].text);
        bool read = landmarks_read(bad[i].path, &l, NULL, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].path, read, e.text);
        assert_null(l.point);
    }
    err e = {0};
    landmarks l = {0};
    assert_refused(landmarks_read("absent.fcsv", &l, NULL, &e), ERR_INPUT);
    assert_refused(landmarks_read("absent.mrk.json", &l, NULL, &e), ERR_INPUT);
    assert_refused(landmarks_write(&l, "a.fcsv", &e), ERR_USAGE);
}

static void names_of_an_automatic_tool_become_ours(void **state)
{
    (void)state;
    err e = {0};
    landmarks l = {0}, back;
    const double right[3] = {-4, -80, 2}, left[3] = {4, -82, 3}, porion[3] = {-55, 10, 20}, ours[3] = {50, 60, 70};
    landmarks_set(&l, "UR1O", right);
    landmarks_set(&l, "UL1O", left);
    landmarks_set(&l, "RPo", porion);
    landmarks_set(&l, "LR1O", right); /* one of two is not the middle */
    landmarks_set(&l, "Go_L", ours);  /* ours stays where both are there */
    landmarks_set(&l, "LGo", left);
    assert_ok(landmarks_write(&l, "ali.mrk.json", &e));
    landmarks_free(&l);
    assert_ok(landmarks_read("ali.mrk.json", &back, NULL, &e));
    assert_int_equal(back.count, 5);
    for (int c = 0; c < 3; c++) {
        assert_near(landmarks_find(&back, "U1")->xyz[c], (right[c] + left[c]) / 2, 0);
        assert_near(landmarks_find(&back, "Po_R")->xyz[c], porion[c], 0);
        assert_near(landmarks_find(&back, "Go_L")->xyz[c], ours[c], 0);
    }
    assert_null(landmarks_find(&back, "UR1O"));
    assert_null(landmarks_find(&back, "L1"));
    assert_non_null(landmarks_find(&back, "LR1O"));
    landmarks_free(&back);
}

static void doubts_are_told_and_what_is_too_doubtful_is_not_placed(void **state)
{
    (void)state;
    err e = {0};
    landmarks l = {0}, got;
    int32_t skipped = 0;
    char names[64];
    const double at[3] = {1, 2, 3};
    landmarks_set(&l, "by_hand", at);
    landmarks_set(&l, "sure", at);
    landmarks_set(&l, "doubtful", at);
    l.point[1].doubt_mm = 1.3;
    l.point[2].doubt_mm = 7;
    assert_ok(landmarks_write_sure(&l, 5, "doubts.mrk.json", &e));
    assert_ok(landmarks_read("doubts.mrk.json", &got, &skipped, &e));
    assert_int_equal(got.count, 2);
    assert_int_equal(skipped, 1);
    assert_null(landmarks_find(&got, "doubtful"));
    assert_near(landmarks_find(&got, "by_hand")->doubt_mm, 0, 0);
    assert_near(landmarks_find(&got, "sure")->doubt_mm, 1.3, 1e-12);
    assert_int_equal(landmarks_automatic(&got, names, sizeof names), 1);
    assert_string_equal(names, "sure");
    landmarks_free(&l);
    landmarks_free(&got);
    remove("doubts.mrk.json");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(markups_round_trip_keeps_every_bit_and_the_order),
        cmocka_unit_test(ras_reads_as_lps_and_undefined_points_are_skipped),
        cmocka_unit_test(fcsv_is_read_with_quotes_columns_and_sides),
        cmocka_unit_test(names_of_an_automatic_tool_become_ours),
        cmocka_unit_test(wrong_files_are_refused_with_file_and_line),
        cmocka_unit_test(doubts_are_told_and_what_is_too_doubtful_is_not_placed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
