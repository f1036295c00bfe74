/* Readers take regular files only, of text with or without a byte order mark, and quote names without control bytes. */
#include "geometry/input_file.h"
#include "geometry/json_file.h"
#include "geometry/landmarks.h"
#include "geometry/mesh_file.h"
#include "geometry/transform_file.h"
#include "geometry/volume_file.h"
#include "tests/check.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void put(const char *path, const char *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
}

/* Every kind of reader, by the ending. */
static bool read_any(const char *path, err *e)
{
    const char *dot = strrchr(path, '.');
    landmarks points = {0};
    rigid motion;
    surface s = {0};
    volume v = {0};
    json_file f = {0};
    if (!strcmp(dot, ".fcsv")) return landmarks_read(path, &points, NULL, e);
    if (!strcmp(dot, ".tfm")) return transform_read(path, &motion, e);
    if (!strcmp(dot, ".nrrd") || !strcmp(dot, ".nii")) return volume_read(path, &v, e);
    if (!strcmp(dot, ".json")) return json_file_read(path, &f, e);
    return mesh_read_surface(path, MESH_SPACE_FROM_FILE, &s, NULL, e);
}

static const char *const endings[] = {"fcsv", "tfm", "nrrd", "nii", "json", "stl", "obj", "glb"};
enum { ENDINGS = sizeof endings / sizeof *endings };

static void pipes_devices_and_folders_are_refused_without_waiting(void **state)
{
    (void)state;
    for (int i = 0; i < ENDINGS; i++) {
        char pipe_name[32], device[32], folder[32];
        err e = {0};
        snprintf(pipe_name, sizeof pipe_name, "pipe.%s", endings[i]);
        snprintf(device, sizeof device, "device.%s", endings[i]);
        snprintf(folder, sizeof folder, "folder.%s", endings[i]);
        unlink(pipe_name);
        unlink(device);
        assert_int_equal(mkfifo(pipe_name, 0600), 0);
        assert_int_equal(symlink("/dev/zero", device), 0);
        mkdir(folder, 0700);
        assert_false(read_any(pipe_name, &e));
        assert_non_null(strstr(e.text, "is not a regular file"));
        e = (err){0};
        assert_false(read_any(device, &e));
        assert_non_null(strstr(e.text, "is not a regular file"));
        e = (err){0};
        assert_false(read_any(folder, &e));
        assert_non_null(strstr(e.text, "is a folder"));
    }
}

static const char fcsv[] = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
                           "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                           "1,1,2,3,0,0,0,1,1,1,0,N,,\n";
static const char tfm[] = "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n"
                          "Parameters: 1 0 0 0 1 0 0 0 1 -1 -2 -3\nFixedParameters: 0 0 0\n";

static void put_marked(const char *path, const char *text)
{
    char all[1024];
    int n = snprintf(all, sizeof all, "\xEF\xBB\xBF%s", text);
    put(path, all, (size_t)n);
}

static void a_byte_order_mark_is_no_part_of_the_text(void **state)
{
    (void)state;
    err e = {0};
    landmarks points;
    rigid motion;
    put_marked("mark.fcsv", fcsv);
    put_marked("mark.tfm", tfm);
    assert_ok(landmarks_read("mark.fcsv", &points, NULL, &e));
    assert_int_equal(points.count, 1);
    assert_near(points.point[0].xyz[2], 3, 0);
    landmarks_free(&points);
    assert_ok(transform_read("mark.tfm", &motion, &e));
    assert_near(motion.t[1], 2, 0);
}

static void utf16_is_told_by_name(void **state)
{
    (void)state;
    static const char wide[] = "\xFF\xFE#\0 \0M\0";
    static const char *const names[] = {"wide.fcsv", "wide.tfm"};
    for (int i = 0; i < 2; i++) {
        err e = {0};
        put(names[i], wide, sizeof wide - 1);
        assert_false(read_any(names[i], &e));
        assert_non_null(strstr(e.text, "UTF-16"));
    }
}

static void sizes_are_held_against_what_is_read(void **state)
{
    (void)state;
    err e = {0};
    int64_t size = 0;
    put("five.bin", "12345", 5);
    assert_null(input_file_open("five.bin", 4, &size, &e));
    assert_non_null(strstr(e.text, "has 5 bytes; at most 4 are read"));
    e = (err){0};
    FILE *f = input_file_open("five.bin", 5, &size, &e);
    assert_non_null(f);
    assert_int_equal(size, 5);
    fclose(f);
    put("none.tfm", "", 0);
    assert_false(read_any("none.tfm", &e));
    assert_non_null(strstr(e.text, "the file is empty"));
}

static void control_bytes_are_quoted(void **state)
{
    (void)state;
    err e = {0};
    err_set(&e, ERR_INPUT, "%s",
            "a\nb\x1b[2Jc\xC2\x9B"
            "d\xC3\xA4\x7F");
    assert_string_equal(e.text, "a\\x0ab\\x1b[2Jc\\xc2\\x9bd\xC3\xA4\\x7f");
    char full[16] = "0123456789ab\n\n";
    err_printable(full, sizeof full);
    assert_string_equal(full, "0123456789ab");
    char tail[16] = "0123\n56789abcde";
    err_printable(tail, sizeof tail);
    assert_string_equal(tail, "0123\\x0a56789ab");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pipes_devices_and_folders_are_refused_without_waiting),
        cmocka_unit_test(a_byte_order_mark_is_no_part_of_the_text),
        cmocka_unit_test(utf16_is_told_by_name),
        cmocka_unit_test(sizes_are_held_against_what_is_read),
        cmocka_unit_test(control_bytes_are_quoted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
