/* Label maps: NRRD in two frames and gzip, segment keys and layers, NIfTI, refusals. The files are made here
 * byte by byte, so that they test the reader and not a writer with the same mistake. */
#include "tests/check.h"
#include "geometry/mem.h"
#include "geometry/volume_file.h"
#include "geometry/write_whole.h"
#include <string.h>

static void write_bytes(const char *path, const char *head, const void *data, size_t size)
{
    err e = {0};
    size_t n = strlen(head);
    char *all = NEW_ARRAY(char, n + size);
    memcpy(all, head, n);
    memcpy(all + n, data, size);
    assert_ok(write_whole(path, all, n + size, &e));
    free(all);
}

#define NRRD_HEAD "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: raw\n"

static int16_t count_up[24];

/* Place of voxel (i,j,k). */
static void place(const volume *v, int i, int j, int k, double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = v->origin[c] + i * v->step[0][c] + j * v->step[1][c] + k * v->step[2][c];
}

static void check_places(const volume *v)
{
    double p[3];
    assert_int_equal(v->size[0], 2);
    assert_int_equal(v->size[1], 3);
    assert_int_equal(v->size[2], 4);
    place(v, 0, 0, 0, p);
    const double want[3] = {-10, -20, 30};
    for (int c = 0; c < 3; c++) assert_near(p[c], want[c], 1e-6);
    place(v, 1, 2, 3, p);
    const double last[3] = {-10 + 0.5, -20 + 2 * 0.75, 30 + 3 * 2};
    for (int c = 0; c < 3; c++) assert_near(p[c], last[c], 1e-6);
    for (int i = 0; i < 24; i++) assert_int_equal(v->value[i], i - 5);
}

static void nrrd_means_the_same_in_all_three_frames(void **state)
{
    (void)state;
    static const char *const frame[3] = {"space: left-posterior-superior\nspace directions: (0.5,0,0) "
                                         "(0,0.75,0) (0,0,2)\nspace origin: (-10,-20,30)\n\n",
                                         ("space: right-anterior-superior\nspace directions: (-0.5,0,0) "
                                          "(0,-0.75,0) (0,0,2)\nspace origin: (10,20,30)\n"
                                          "space units: \"mm\" \"mm\" \"mm\"\n\n"),
                                         "space: left-anterior-superior\nspace directions: (0.5,0,0) "
                                         "(0,-0.75,0) (0,0,2)\nspace origin: (-10,20,30)\n\n"};
    for (int i = 0; i < 3; i++) {
        err e = {0};
        char head[512];
        volume v;
        snprintf(head, sizeof head, "%s%s", NRRD_HEAD, frame[i]);
        write_bytes("frame.nrrd", head, count_up, sizeof count_up);
        assert_ok(volume_read("frame.nrrd", &v, &e));
        assert_int_equal(v.layers, 1);
        assert_int_equal(v.segment_count, 0);
        check_places(&v);
        volume_free(&v);
    }
}

static void gzip_nrrd_is_read(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    write_bytes("body.raw", "", count_up, sizeof count_up);
    write_bytes("zip.nrrd",
                "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: gzip\nspace: "
                "left-posterior-superior\nspace directions: (0.5,0,0) (0,0.75,0) (0,0,2)\nspace origin: "
                "(-10,-20,30)\n\n",
                "", 0);
    if (system("gzip -c body.raw >> zip.nrrd")) {
        print_message("no gzip program here: skipped\n");
        skip();
    }
    assert_ok(volume_read("zip.nrrd", &v, &e));
    check_places(&v);
    volume_free(&v);
}

static void overlapping_segments_become_layers(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    uint8_t data[2 * 2 * 1 * 1] = {1, 7, 3, 0}; /* voxel 0: 1 and 7, voxel 1: 3 and 0 */
    write_bytes("a.seg.nrrd",
                "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 1 1\nkinds: list domain domain "
                "domain\nencoding: raw\n"
                "space: left-posterior-superior\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nspace "
                "origin: (0,0,0)\n"
                "Segment0_ID:=s0\nSegment0_Name:=Upper Skull\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
                "Segment1_ID:=s1\nSegment1_Name:=Mandible\nSegment1_LabelValue:=7\nSegment1_Layer:=1\n\n",
                data, sizeof data);
    assert_ok(volume_read("a.seg.nrrd", &v, &e));
    assert_int_equal(v.layers, 2);
    const int16_t want[4] = {1, 3, 7, 0};
    assert_memory_equal(v.value, want, sizeof want);
    assert_int_equal(v.segment_count, 2);
    assert_string_equal(v.segment[0].name, "Upper Skull");
    assert_string_equal(v.segment[1].name, "Mandible");
    assert_int_equal(v.segment[1].label, 7);
    assert_int_equal(v.segment[1].layer, 1);
    volume_free(&v);
}

/* A NIfTI-1 header of 2 x 3 x 4 voxels with the fields the reader uses. */
static void make_nifti(char head[352], int16_t sform, int16_t qform, float slope, char units)
{
    memset(head, 0, 352);
    memcpy(head, &(int32_t){348}, 4);
    const int16_t dim[8] = {3, 2, 3, 4, 1, 1, 1, 1};
    const float pixdim[8] = {1, 0.5F, 0.75F, 2, 0, 0, 0, 0};
    /* RAS: +i goes to patient left, so x decreases; y decreases */
    const float srow[12] = {-0.5F, 0, 0, 10, 0, -0.75F, 0, 20, 0, 0, 2, 30};
    memcpy(head + 40, dim, sizeof dim);
    memcpy(head + 70, &(int16_t){4}, 2);  /* signed short */
    memcpy(head + 72, &(int16_t){16}, 2); /* bits */
    memcpy(head + 76, pixdim, sizeof pixdim);
    memcpy(head + 108, &(float){352}, 4);
    memcpy(head + 112, &slope, 4);
    head[123] = units;
    memcpy(head + 252, &qform, 2);
    memcpy(head + 254, &sform, 2);
    /* quaternion of a half turn about z: b = c = 0, d = 1 */
    memcpy(head + 264, &(float){1}, 4);
    memcpy(head + 268, &(float){10}, 4);
    memcpy(head + 272, &(float){20}, 4);
    memcpy(head + 276, &(float){30}, 4);
    memcpy(head + 280, srow, sizeof srow);
    memcpy(head + 344, "n+1", 4);
}

static void write_nifti(const char *path, const char head[352], size_t bytes)
{
    err e = {0};
    char all[400];
    memcpy(all, head, 352);
    memcpy(all + 352, count_up, sizeof count_up);
    assert_ok(write_whole(path, all, bytes, &e));
}

static void nifti_is_turned_from_ras_by_sform_or_qform(void **state)
{
    (void)state;
    char head[352];
    for (int i = 0; i < 3; i++) {
        err e = {0};
        volume v;
        make_nifti(head, i == 0 ? 1 : 0, i == 0 ? 0 : 1, i == 2 ? 1.0F : 0.0F, 2);
        write_nifti("a.nii", head, 400);
        assert_ok(volume_read("a.nii", &v, &e));
        check_places(&v);
        volume_free(&v);
    }
}

static void nifti_with_two_forms_that_disagree_is_refused(void **state)
{
    (void)state;
    char head[352];
    static const struct {
        int at; /* byte of the header */
        float value;
    } wrong[] = {{268, 10.5F}, /* qform shifted */
                 {264, -1},    /* no change: the same half turn */
                 {80, 0.6F},   /* voxels of another size */
                 {280, 0.5F},  /* sform a mirror image */
                 {276, 30.02F}};
    for (int i = 0; i < 5; i++) {
        err e = {0};
        volume v;
        make_nifti(head, 1, 2, 0, 2);
        memcpy(head + wrong[i].at, &wrong[i].value, 4);
        write_nifti("two.nii", head, 400);
        bool good = volume_read("two.nii", &v, &e);
        assert_int_equal(good, i == 1);
        if (good) {
            check_places(&v);
            volume_free(&v);
            continue;
        }
        assert_int_equal(e.code, ERR_INPUT);
        assert_non_null(strstr(e.text, "sform (code 1)"));
        assert_non_null(strstr(e.text, "qform (code 2)"));
        assert_int_equal(strstr(e.text, "mirror") != NULL, i == 3);
        bool sform_is_right = i != 3;
        assert_ok(volume_read_by("two.nii", sform_is_right ? VOLUME_FORM_SFORM : VOLUME_FORM_QFORM, &v, &e));
        check_places(&v);
        volume_free(&v);
        assert_ok(volume_read_by("two.nii", sform_is_right ? VOLUME_FORM_QFORM : VOLUME_FORM_SFORM, &v, &e));
        volume_free(&v);
    }
}

static void nifti_slope_and_units_are_honoured(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    char head[352];
    make_nifti(head, 1, 0, 3, 3); /* micrometres */
    memcpy(head + 116, &(float){-7}, 4);
    write_nifti("scaled.nii", head, 400);
    assert_refused(volume_read("scaled.nii", &v, &e), ERR_INPUT); /* voxels of half a micrometre */
    make_nifti(head, 1, 0, 3, 2);
    memcpy(head + 116, &(float){-7}, 4);
    write_nifti("scaled.nii", head, 400);
    assert_ok(volume_read("scaled.nii", &v, &e));
    for (int i = 0; i < 24; i++) assert_int_equal(v.value[i], 3 * (i - 5) - 7);
    volume_free(&v);
}

static void wrong_volumes_are_refused_by_name(void **state)
{
    (void)state;
    char head[352];
    make_nifti(head, 0, 0, 0, 2);
    write_nifti("nowhere.nii", head, 400);
    make_nifti(head, 1, 0, 0, 2);
    write_nifti("cut.nii", head, 390);
    write_nifti("header.nii", head, 352);
    make_nifti(head, 1, 0, 2000, 2);
    write_nifti("large.nii", head, 400);
#define GRID "space directions: (0.5,0,0) (0,0.75,0) (0,0,2)\nspace origin: (-10,-20,30)\n\n"
    write_bytes("nospace.nrrd", NRRD_HEAD "\n", count_up, sizeof count_up);
    write_bytes("cut.nrrd", NRRD_HEAD "space: left-posterior-superior\n" GRID, count_up, 40);
    write_bytes("scanner.nrrd", NRRD_HEAD "space: scanner-xyz\n" GRID, count_up, sizeof count_up);
    write_bytes("units.nrrd", NRRD_HEAD "space: left-posterior-superior\nspace units: \"m\" \"m\" \"m\"\n" GRID,
                count_up, sizeof count_up);
    write_bytes("sheared.nrrd",
                NRRD_HEAD "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.75,0) (0,0.2,2)\n"
                          "space origin: (-10,-20,30)\n\n",
                count_up, sizeof count_up);
    write_bytes("flat.nrrd",
                NRRD_HEAD "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.75,0) (0,0,0)\n"
                          "space origin: (-10,-20,30)\n\n",
                count_up, sizeof count_up);
    write_bytes("rgb.nrrd",
                "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain "
                "domain\nencoding: "
                "raw\nspace: left-posterior-superior\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: "
                "(0,0,0)\n\n",
                count_up, 24);
    write_bytes("label.seg.nrrd",
                NRRD_HEAD "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.75,0) "
                          "(0,0,2)\nspace origin: (0,0,0)\nSegment0_Name:=Skull\n\n",
                count_up, sizeof count_up);
    float big[24] = {40000};
    write_bytes("big.nrrd",
                "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: raw\nspace: "
                "left-posterior-superior\n" GRID,
                big, sizeof big);
    write_bytes("hello.nrrd", "hello\n", "", 0);
    write_bytes("hello.nii", "hello\n", "", 0);
    write_bytes("hello.nii.gz", "hello\n", "", 0);
    write_bytes("empty.nrrd", "", "", 0);
    write_bytes("scan.dcm", "hello\n", "", 0);
    static const struct {
        const char *path, *says;
    } bad[] = {{"nowhere.nii", "nowhere.nii: has neither sform nor qform"},
               {"cut.nii", "cut.nii: is not a complete NIfTI"},
               {"header.nii", "header.nii: is not a complete NIfTI"},
               {"large.nii", "large.nii: voxel 22 holds 34000"},
               {"nospace.nrrd", "nospace.nrrd: space: missing"},
               {"cut.nrrd", "cut.nrrd: cannot be read as NRRD"},
               {"scanner.nrrd", "scanner.nrrd: space: "},
               {"units.nrrd", "units.nrrd: space units: "},
               {"sheared.nrrd", "sheared.nrrd: axes 1 and 2 are not at right angles"},
               {"flat.nrrd", "flat.nrrd: "},
               {"rgb.nrrd", "rgb.nrrd: dimension: "},
               {"label.seg.nrrd", "label.seg.nrrd: Segment0_Name: has no label value"},
               {"big.nrrd", "big.nrrd: voxel 0 holds 40000"},
               {"hello.nrrd", "hello.nrrd: cannot be read as NRRD"},
               {"hello.nii", "hello.nii: is not a complete NIfTI"},
               {"hello.nii.gz", "hello.nii.gz: is not a complete NIfTI"},
               {"empty.nrrd", "empty.nrrd: the file is empty"},
               {"scan.dcm", "scan.dcm: unknown kind of volume file"},
               {"absent.nrrd", "absent.nrrd: cannot be read: "}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        volume v = {0};
        bool read = volume_read(bad[i].path, &v, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].path, read, e.text);
        assert_null(v.value);
    }
}

int main(void)
{
    for (int i = 0; i < 24; i++) count_up[i] = (int16_t)(i - 5);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nrrd_means_the_same_in_all_three_frames),
        cmocka_unit_test(gzip_nrrd_is_read),
        cmocka_unit_test(overlapping_segments_become_layers),
        cmocka_unit_test(nifti_is_turned_from_ras_by_sform_or_qform),
        cmocka_unit_test(nifti_with_two_forms_that_disagree_is_refused),
        cmocka_unit_test(nifti_slope_and_units_are_honoured),
        cmocka_unit_test(wrong_volumes_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
