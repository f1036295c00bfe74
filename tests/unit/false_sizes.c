/* Headers that promise more than the file holds are refused before room is made for it. */
#include "geometry/mesh_file.h"
#include "geometry/volume_file.h"
#include "tests/check.h"
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
}

static void refused_mesh(const char *path, const char *says)
{
    surface s;
    err e = {0};
    assert_false(mesh_read_surface(path, MESH_SPACE_FROM_FILE, &s, NULL, &e));
    assert_int_equal(e.code, ERR_INPUT);
    if (!strstr(e.text, says)) fail_msg("%s", e.text);
}

#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void what_a_ply_promises_is_held_against_it(void **state)
{
    (void)state;
    static const struct {
        const char *header, *says;
    } tries[] = {
        {"property float x\nelement vertex 3\n" FACE, "a.ply:3: is not a complete PLY file: no element before"},
        {"element vertex 99999999999\n" XYZ FACE, "99999999999 items of \"vertex\" do not fit"},
        {"element vertex -3\n" XYZ FACE, "a.ply:3: is not a complete PLY file: no number of the element \"vertex\""},
        {"element vertex 3\nproperty real x\n" FACE, "a.ply:4: is not a complete PLY file: unknown type \"real\""},
        {"element vertex 3\nproperty float X\nproperty float Y\nproperty float Z\n" FACE, "x, y or z is missing"},
        {"element vertex 3\nproperty list uchar float x\n" FACE, "x, y or z is missing"},
        {"element vertex 3\n" XYZ "property float x\n" FACE,
         "a.ply:7: is not a complete PLY file: there twice is \"x\""},
        {"element vertex 3\n" XYZ "element vertex 4\n" XYZ FACE, "there twice is \"vertex\""},
        {"element vertex 3\n" XYZ "element face 1\nproperty list float int vertex_indices\nend_header\n",
         "a list cannot be counted by \"float\""},
        {"element vertex 3\n" XYZ "element face 999999999999\nproperty list uchar int vertex_indices\nend_header\n",
         "items of \"face\" do not fit"},
        {"element vertex 0\n" XYZ "element filler 999999999999\nelement face 0\nproperty list uchar int vertex_index\n"
         "end_header\n",
         "holds no triangles"},
        {"element vertex 3\n" XYZ "element face 1\nproperty list uint int vertex_indices\nend_header\n",
         "face 0 of 1 is missing"},
        {"element vertex 3\n" XYZ, "missing is \"end_header\""},
    };
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++)
        for (int binary = 0; binary < 2; binary++) {
            char text[1024];
            bool ends = strstr(tries[i].header, "end_header") != NULL;
            int n = snprintf(text, sizeof text, "ply\nformat %s 1.0\n%s%s", binary ? "binary_little_endian" : "ascii",
                             tries[i].header,
                             !ends    ? ""
                             : binary ? "123456789012345678901234567890123456\377\377\377\377"
                                      : "0 0 0\n1 0 0\n0 1 0\n3000000000 0 1 2\n");
            write_file("a.ply", text, (size_t)n);
            refused_mesh("a.ply", tries[i].says);
        }
}

static void counts_of_stl_and_glb_are_held_against_the_file(void **state)
{
    (void)state;
    unsigned char stl[84 + 100] = "binary";
    memset(stl + 80, 0xFF, 4);
    write_file("count.stl", stl, sizeof stl);
    refused_mesh("count.stl", "count.stl: ");
    static const struct {
        const char *buffer, *view, *accessor, *says;
    } tries[] = {
        {"36", "36", "\"count\":4000000000", "accessor 0 promises more"},
        {"36", "4000000000", "\"count\":3", "bufferView 0 promises more"},
        {"4000000000", "36", "\"count\":3", "buffer 0 promises more"},
        {"36", "36", "\"byteOffset\":12,\"count\":3", "accessor 0 promises more"},
        {"36", "36", "\"byteOffset\":-12,\"count\":3", "accessor 0 promises more"},
        {"36", "36", "\"count\":-3", "accessor 0 promises more"},
    };
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char text[2048];
        int n = snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
            "\"componentType\":5126,\"type\":\"VEC3\",%s}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%s}],"
            "\"buffers\":[{\"byteLength\":%s,\"uri\":\"data:application/octet-stream;base64,"
            "AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MTD6amZk+\"}]}",
            tries[i].accessor, tries[i].view, tries[i].buffer);
        write_file("a.gltf", text, (size_t)n);
        refused_mesh("a.gltf", tries[i].says);
    }
}

static void refused_volume(const char *path, const char *says)
{
    volume v;
    err e = {0};
    assert_false(volume_read(path, &v, &e));
    assert_int_equal(e.code, ERR_INPUT);
    if (!strstr(e.text, says)) fail_msg("%s", e.text);
}

static void volumes_that_the_file_cannot_hold_are_refused(void **state)
{
    (void)state;
    static const char *const encodings[] = {"raw", "gzip", "ascii", "hex"};
    for (int i = 0; i < 4; i++) {
        char text[1024];
        int n = snprintf(text, sizeof text,
                         "NRRD0004\ntype: short\ndimension: 3\nsizes: 60000 60000 60000\nendian: little\nencoding: %s\n"
                         "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                         "space origin: (0,0,0)\n\n0123456789",
                         encodings[i]);
        write_file("a.nrrd", text, (size_t)n);
        refused_volume("a.nrrd", "is not complete: its header promises");
    }
    static const char beside[] = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nspace: "
                                 "left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: "
                                 "(0,0,0)\ndata file: /dev/zero\n";
    write_file("a.nrrd", beside, sizeof beside - 1);
    refused_volume("a.nrrd", "data file: its voxels lie in another file");
    unsigned char nifti[352 + 8] = {0};
    const int16_t dim[8] = {3, 30000, 30000, 30000, 1, 1, 1, 1}, type = 4, bits = 16, code = 1;
    const float offset = 352;
    const int32_t head = 348;
    memcpy(nifti, &head, 4);
    memcpy(nifti + 40, dim, sizeof dim);
    memcpy(nifti + 70, &type, 2);
    memcpy(nifti + 72, &bits, 2);
    memcpy(nifti + 108, &offset, 4);
    memcpy(nifti + 254, &code, 2);
    memcpy(nifti + 344, "n+1", 4);
    write_file("a.nii", nifti, sizeof nifti);
    refused_volume("a.nii", "is not complete: its header promises 54000000000000 bytes");
}

static void all_of_that_took_little_memory(void **state)
{
    (void)state;
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    assert_true(used.ru_maxrss < 300 * 1024); /* kB */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_ply_promises_is_held_against_it),
                                       cmocka_unit_test(counts_of_stl_and_glb_are_held_against_the_file),
                                       cmocka_unit_test(volumes_that_the_file_cannot_hold_are_refused),
                                       cmocka_unit_test(all_of_that_took_little_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
