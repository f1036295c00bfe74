/* Files of other programs: what VTK 9.1 and ITK 5.2 wrote (tests/fuzz/corpus) is read as they mean it. */
#include "tests/check.h"
#include "geometry/landmarks.h"
#include "geometry/mesh_file.h"
#include "geometry/src/files/inflate.h"
#include "geometry/transform_file.h"
#include "geometry/vec.h"
#include "geometry/volume_file.h"
#include "geometry/write_whole.h"
#include <string.h>

static const char *corpus(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", FOREIGN_FILES, name);
    return path;
}

/* The tetrahedron (0,0,0) (10.1,0,0) (0,10.3,0) (0,0,10.7), in RAS or LPS. */
static void every_form_of_vtk_holds_the_same_tetrahedron(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool ras, tagged;
    } file[] = {{"vtp/ascii.vtp", true, true},
                {"vtp/binary.vtp", true, true},
                {"vtp/binary_zlib.vtp", true, true},
                {"vtp/appended.vtp", false, false},
                {"vtp/appended_zlib_base64.vtp", true, true},
                {"vtp/appended_zlib_raw_big.vtp", false, false},
                {"vtp/strips.vtp", false, false},
                {"vtk/ascii42.vtk", false, true},
                {"vtk/binary42.vtk", false, true},
                {"vtk/ascii51.vtk", false, true},
                {"vtk/binary51.vtk", false, true},
                {"vtk/strips.vtk", false, true}};
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        err e = {0};
        surface s;
        mesh_file_report r;
        int32_t open, crowded;
        assert_ok(mesh_read_surface(corpus(file[i].name), MESH_SPACE_FROM_FILE, &s, &r, &e));
        if (r.ras != file[i].ras || r.tagged != file[i].tagged) fail_msg("%s: tags", file[i].name);
        double side = r.ras ? -1 : 1;
        const double want[12] = {0, 0, 0, side * 10.1, 0, 0, 0, side * 10.3, 0, 0, 0, 10.7};
        assert_int_equal(s.vertex_count, 4);
        assert_int_equal(s.triangle_count, 4);
        for (int k = 0; k < 12; k++)
            if (s.xyz[k] != want[k]) fail_msg("%s: coordinate %d is %.17g", file[i].name, k, s.xyz[k]);
        surface_edge_census(&s, &open, &crowded);
        assert_int_equal(open + crowded, 0);
        bool turned = strstr(file[i].name, "strips") != NULL; /* made to face inwards */
        assert_near(surface_volume(&s), (turned ? -1 : 1) * 10.1 * 10.3 * 10.7 / 6, 1e-9);
        surface_free(&s);
    }
}

static void what_we_write_as_vtp_reads_back_bit_for_bit(void **state)
{
    (void)state;
    err e = {0};
    surface s, back;
    mesh_file_report r;
    assert_ok(mesh_read_surface(corpus("vtp/ascii.vtp"), MESH_SPACE_FROM_FILE, &s, NULL, &e));
    s.xyz[3] = 1.0 / 3;
    assert_ok(mesh_write_surface_arrays(&s, NULL, 0, "own.vtp", &e));
    assert_ok(mesh_read_surface("own.vtp", MESH_SPACE_RAS, &back, &r, &e));
    assert_true(r.tagged && !r.ras);
    assert_int_equal(back.vertex_count, s.vertex_count);
    assert_memory_equal(back.xyz, s.xyz, 12 * sizeof *s.xyz);
    assert_memory_equal(back.tri, s.tri, 12 * sizeof *s.tri);
    surface_free(&s);
    surface_free(&back);
}

/* ITK: voxel (3, 2, 5) lies at (-9.7, -17.9, 40) and holds 523. */
static void every_form_of_metaimage_holds_the_same_voxels(void **state)
{
    (void)state;
    static const char *const name[] = {"mha/short.mha", "mha/packed.mha", "mha/big_endian.mha"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        err e = {0};
        volume v;
        assert_ok(volume_read(corpus(name[i]), &v, &e));
        const double want[3] = {-9.7, -17.9, 40};
        for (int c = 0; c < 3; c++)
            assert_near(v.origin[c] + 3 * v.step[0][c] + 2 * v.step[1][c] + 5 * v.step[2][c], want[c], 1e-12);
        for (int k = 0; k < 120; k++) assert_int_equal(v.value[k], k % 4 + 10 * (k / 4 % 5) + 100 * (k / 20));
        volume_free(&v);
    }
}

static void a_metaimage_may_have_its_voxels_in_a_file_beside_it(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    static const char head[] =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nElementByteOrderMSB = False\nTransformMatrix = "
        "1 0 0 0 1 0 0 0 1\nOrigin = 1 2 3\nElementSpacing = 1 1 2\nDimSize = 2 1 2\nElementType = MET_UCHAR\n"
        "HeaderSize = %s\nElementDataFile = beside.raw\n";
    static const char *const skip[] = {"3", "-1"};
    assert_ok(write_whole("beside.raw", "abc\1\2\3\4", 7, &e));
    for (int i = 0; i < 2; i++) {
        char text[512];
        snprintf(text, sizeof text, head, skip[i]);
        assert_ok(write_whole("beside.mhd", text, strlen(text), &e));
        assert_ok(volume_read("beside.mhd", &v, &e));
        for (int k = 0; k < 4; k++) assert_int_equal(v.value[k], k + 1);
        assert_near(v.origin[1], 2, 0);
        volume_free(&v);
    }
}

static void every_file_of_a_transform_is_the_same_motion(void **state)
{
    (void)state;
    err e = {0};
    rigid want, got;
    static const char *const name[] = {"mat/euler.mat", "mat/affine.mat", "mat/versor.mat", "mat/big_endian.mat",
                                       "h5/affine.h5",  "h5/packed.h5",   "mat/float.mat"};
    assert_ok(transform_read(corpus("tfm/itk_euler.tfm"), &want, &e));
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        double rough = strstr(name[i], "float") ? 1e-5 : 1e-12;
        assert_ok(transform_read(corpus(name[i]), &got, &e));
        for (int k = 0; k < 9; k++) assert_near(got.r[k], want.r[k], rough);
        for (int k = 0; k < 3; k++) assert_near(got.t[k], want.t[k], 10 * rough);
    }
}

static void points_of_a_curve_are_points(void **state)
{
    (void)state;
    err e = {0};
    landmarks l;
    int32_t skipped;
    assert_ok(landmarks_read(corpus("markups/curve.mrk.json"), &l, &skipped, &e));
    assert_int_equal(l.count, 1);
    assert_int_equal(skipped, 1);
    assert_near(landmarks_find(&l, "N")->xyz[1], -90, 0);
    landmarks_free(&l);
}

static void what_is_not_whole_or_another_thing_is_refused_by_name(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *says;
    } bad[] = {
        {"grid.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n",
         "grid.vtk:4: DATASET: is UNSTRUCTURED_GRID"},
        {"points.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1000000000 double\n",
         "points.vtk: is not a complete VTK file of PolyData: a point is missing"},
        {"cell.vtk",
         "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\nPOLYGONS 1 4\n999999999 0\n",
         "cell.vtk:9: is not a complete VTK file of PolyData: a cell is missing"},
        {"tag.vtk", "# vtk DataFile Version 3.0\nSPACE=LAS\nASCII\n", "tag.vtk:2: unknown tag SPACE=LAS"},
        {"grid.vtp", "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">",
         "grid.vtp: is not a complete VTP file: it holds no PolyData"},
        {"lzma.vtp", "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" compressor=\"vtkLZMADataCompressor\">",
         "lzma.vtp: is not a complete VTP file: it is compressed by another program"},
        {"corner.vtp",
         "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><Piece><Points><DataArray type=\"Float32\" "
         "format=\"ascii\">0 0 0</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
         "format=\"ascii\">0 0 7</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
         "</Polys></Piece>",
         "corner.vtp: is not a complete VTP file: a cell names a point that is not there"},
        {"sides.mha",
         "ObjectType = Image\nNDims = 3\nDimSize = 1 1 1\nElementSpacing = 1 1 1\nOffset = 0 0 0\n"
         "ElementType = MET_UCHAR\nElementDataFile = LOCAL\nx",
         "sides.mha: TransformMatrix: missing: the sides of the head are unknown"},
        {"slices.mhd",
         "ObjectType = Image\nNDims = 3\nDimSize = 1 1 1\nElementSpacing = 1 1 1\nOffset = 0 0 0\nTransformMatrix = "
         "1 0 0 0 1 0 0 0 1\nElementType = MET_UCHAR\nElementDataFile = s%03d.raw\n",
         "slices.mhd: ElementDataFile: a file for each slice"},
        {"five.mat", "MATLAB 5.0 MAT-file, ...........", "five.mat: is a file of MATLAB 5"},
        {"torn.h5", "\211HDF\r\n\032\n", "torn.h5: is not an HDF5 file"},
        {"scan.mhb", "x",
         "scan.mhb: unknown kind of volume file; read are .nrrd .seg.nrrd .nii .nii.gz .mha .mhd (DICOM: convert with dcm2niix); did "
         "you mean .mha?"},
        {"mesh.slt", "x",
         "mesh.slt: unknown kind of mesh file; read are .ply .off .stl .obj .gltf .glb .vtk .vtp; did you mean .stl?"},
        {"move.tmf", "x",
         "move.tmf: unknown kind of transform file; read are .tfm .txt .h5 .hdf5 .mat; did you mean .tfm?"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        surface s;
        volume v;
        rigid m;
        const char *end = strrchr(bad[i].name, '.');
        assert_ok(write_whole(bad[i].name, bad[i].text, strlen(bad[i].text), &e));
        bool read = end[1] == 'v' || end[1] == 's' ? mesh_read_surface(bad[i].name, MESH_SPACE_FROM_FILE, &s, NULL, &e)
                    : end[1] == 'm' && end[2] == 'h' ? volume_read(bad[i].name, &v, &e)
                                                     : transform_read(bad[i].name, &m, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].name, read, e.text);
    }
    err e = {0};
    volume v;
    rigid m;
    surface s;
    assert_refused(volume_read(corpus("mha/false_length.mha"), &v, &e), ERR_INPUT);
    assert_refused(transform_read(corpus("h5/composite.h5"), &m, &e), ERR_INPUT);
    assert_refused(mesh_read_surface(corpus("vtp/many_blocks.vtp"), MESH_SPACE_FROM_FILE, &s, NULL, &e), ERR_INPUT);
    assert_refused(volume_read(corpus("nrrd/false_length.nrrd"), &v, &e), ERR_INPUT);
    assert_refused(volume_read(corpus("nifti/false_length.nii"), &v, &e), ERR_INPUT);
    assert_refused(mesh_read_surface(corpus("gltf/sparse.gltf"), MESH_SPACE_FROM_FILE, &s, NULL, &e), ERR_INPUT);
    assert_false(inflate_can_give(10, 20000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_of_vtk_holds_the_same_tetrahedron),
        cmocka_unit_test(what_we_write_as_vtp_reads_back_bit_for_bit),
        cmocka_unit_test(every_form_of_metaimage_holds_the_same_voxels),
        cmocka_unit_test(a_metaimage_may_have_its_voxels_in_a_file_beside_it),
        cmocka_unit_test(every_file_of_a_transform_is_the_same_motion),
        cmocka_unit_test(points_of_a_curve_are_points),
        cmocka_unit_test(what_is_not_whole_or_another_thing_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
