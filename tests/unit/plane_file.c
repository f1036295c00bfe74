/* Cut planes as Slicer stores them: three points, matrices, both sides. */
#include "tests/check.h"
#include "geometry/plane_file.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <string.h>

static void write_text(const char *path, const char *text)
{
    err e = {0};
    assert_ok(write_whole(path, text, strlen(text), &e));
}

static void planes_come_back_where_they_were(void **state)
{
    (void)state;
    err e = {0};
    cut_plane p[3] = {{.label = "le_fort_1", .point = {1, -80, 12}, .normal = {0, 0.6, 0.8}},
                      {.label = "sagittal", .point = {0.25, 0, 0}, .normal = {-1, 0, 0}},
                      {.label = "tilted", .point = {7, 8, 9}, .normal = {2 / 7.0, -3 / 7.0, 6 / 7.0}}};
    assert_ok(planes_write(p, 3, "planes.mrk.json", &e));
    cut_plane *back = NULL;
    int count = 0;
    assert_ok(planes_read("planes.mrk.json", &back, &count, &e));
    assert_int_equal(count, 3);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(back[i].label, p[i].label);
        for (int c = 0; c < 3; c++) {
            assert_near(back[i].point[c], p[i].point[c], 0);
            assert_near(back[i].normal[c], p[i].normal[c], 1e-14);
        }
    }
    free(back);
}

static void a_three_point_plane_means_the_same_in_ras_and_lps(void **state)
{
    (void)state;
    err e = {0};
    cut_plane *plane = NULL;
    int count = 0;
    /* counter-clockwise from above: normal +z on either side; "center" and "normal" must not be used */
    write_text("le_fort.mrk.json",
               "{\"markups\":[{\"type\":\"Plane\",\"coordinateSystem\":\"RAS\",\"center\":[9,9,9],\"normal\":"
               "[1,0,0],"
               "\"controlPoints\":[{\"label\":\"P-1\",\"position\":[1,2,3]},"
               "{\"label\":\"P-2\",\"position\":[11,2,3]},{\"label\":\"P-3\",\"position\":[1,12,3]}]}]}");
    assert_ok(planes_read("le_fort.mrk.json", &plane, &count, &e));
    assert_string_equal(plane->label, "le_fort");
    const double point[3] = {-1, -2, 3}, normal[3] = {0, 0, 1};
    for (int c = 0; c < 3; c++) {
        assert_near(plane->point[c], point[c], 0);
        assert_near(plane->normal[c], normal[c], 0);
    }
    free(plane);
}

/* RAS: baseToNode B = rotation about x by 90 deg then origin o; objectToBase shifts by s along the base's
 * axes and turns about y by t. Normal = B col(t), point = B s + o; here by hand. In the LPS file rows 0 and 1
 * are negated. */
static void matrices_of_an_lps_file_are_read_by_rows(void **state)
{
    (void)state;
    err e = {0};
    cut_plane *plane = NULL;
    int count = 0;
    /* B: x -> x, y -> z, z -> -y; o = (10, 20, 30). Object: z axis = (0.6, 0, 0.8), s = (1, 2, 3). */
    const char *lps =
        "{\"markups\":[{\"type\":\"Plane\",\"coordinateSystem\":\"LPS\",\"planeType\":\"%s\","
        "\"controlPoints\":[{\"label\":\"P-1\",\"position\":[-10,-20,30],\"positionStatus\":\"defined\"}%s],"
        "\"objectToBase\":[-0.8,-0,-0.6,-1, -0,-1,-0,-2, -0.6,0,0.8,3, 0,0,0,1],"
        "\"baseToNode\":[-1,-0,-0,-10, -0,-0,1,-20, 0,1,0,30, 0,0,0,1]}]}";
    /* RAS: normal = 0.6 x - 0.8 y, point = (11, 20 - 3, 30 + 2) */
    const double normal[3] = {-0.6, 0.8, 0}, point[3] = {-11, -17, 32};
    const char *type[2] = {"PointNormal", "3Points"};
    const char *more[2] = {
        "", ",{\"label\":\"P-2\",\"position\":[-15,-20,30]},{\"label\":\"P-3\",\"position\":[-10,-20,37]}"};
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof text, lps, type[i], more[i]);
        write_text("matrix.mrk.json", text);
        assert_ok(planes_read("matrix.mrk.json", &plane, &count, &e));
        for (int c = 0; c < 3; c++) {
            assert_near(plane->point[c], point[c], 1e-12);
            assert_near(plane->normal[c], normal[c], 1e-12);
        }
        free(plane);
    }
}

static void wrong_planes_are_refused_with_file_and_line(void **state)
{
    (void)state;
    static const struct {
        const char *path, *text, *says;
    } bad[] = {
        {"line.mrk.json",
         "{\"markups\":[{\"type\":\"Plane\",\n\"controlPoints\":[{\"position\":[0,0,0]},{\"position\":[1,1,1]"
         "},"
         "{\"position\":[2,2,2]}]}]}",
         "line.mrk.json:2: "},
        {"two.mrk.json", "{\"markups\":[{\"type\":\"Plane\",\n\"controlPoints\":[{\"position\":[0,0,0]}]}]}",
         "two.mrk.json:2: "},
        {"fit.mrk.json", "{\"markups\":[{\"type\":\"Plane\",\n\"planeType\":\"PlaneFit\",\"controlPoints\":[]}]}",
         "fit.mrk.json:2: "},
        {"matrix.mrk.json", "{\"markups\":[{\"type\":\"Plane\",\n\"objectToBase\":[1,2],\"controlPoints\":[]}]}",
         "matrix.mrk.json:2: "},
        {"points.mrk.json", "{\"markups\":[\n{\"type\":\"Fiducial\",\"controlPoints\":[]}]}", "points.mrk.json:2: "},
        {"plane.txt", "x", "plane.txt: unknown kind"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        cut_plane *plane = NULL;
        int count;
        write_text(bad[i].path, bad[i].text);
        bool read = planes_read(bad[i].path, &plane, &count, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].path, read, e.text);
        assert_null(plane);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_come_back_where_they_were),
        cmocka_unit_test(a_three_point_plane_means_the_same_in_ras_and_lps),
        cmocka_unit_test(matrices_of_an_lps_file_are_read_by_rows),
        cmocka_unit_test(wrong_planes_are_refused_with_file_and_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
