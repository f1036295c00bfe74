/* Reading and writing surfaces and tetrahedra: bits, tags, welding, refusals. */
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/write_whole.h"
#include <string.h>
#include <unistd.h>

static void write_text(const char *path, const char *text)
{
    err e = {0};
    assert_ok(write_whole(path, text, strlen(text), &e));
}

/* A cube with corners whose doubles do not fit into floats. */
static surface cube(void)
{
    static const int32_t tri[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    surface s = surface_new(8, 12);
    for (int v = 0; v < 8; v++)
        for (int c = 0; c < 3; c++) s.xyz[3 * v + c] = (v >> c & 1 ? 10.1 : -20.3) + c / 7.0;
    memcpy(s.tri, tri, sizeof tri);
    return s;
}

static void ply_round_trip_keeps_every_bit(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    s.xyz[0] = -0.0;
    s.xyz[5] = 4.9406564584124654e-324;
    mesh_file_report r;
    for (int colours = 0; colours < 2; colours++) {
        if (colours) s.rgb = NEW_ARRAY(uint8_t, 24);
        for (int i = 0; colours && i < 24; i++) s.rgb[i] = (uint8_t)(10 * i);
        assert_ok(mesh_write_surface(&s, "bits.ply", &e));
        assert_ok(mesh_read_surface("bits.ply", MESH_SPACE_FROM_FILE, &back, &r, &e));
        assert_int_equal(back.vertex_count, 8);
        assert_int_equal(back.triangle_count, 12);
        assert_memory_equal(back.xyz, s.xyz, 24 * sizeof *s.xyz);
        assert_memory_equal(back.tri, s.tri, 36 * sizeof *s.tri);
        assert_int_equal(!back.rgb, !colours);
        if (colours) assert_memory_equal(back.rgb, s.rgb, 24);
        assert_true(r.tagged && !r.ras && !r.welded_vertices && !r.dropped_triangles && !r.split_polygons);
        surface_free(&back);
    }
    surface_free(&s);
}

static void a_ply_for_viewers_holds_floats(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    assert_ok(mesh_write_surface_float(&s, "floats.ply", &e));
    assert_ok(mesh_read_surface("floats.ply", MESH_SPACE_FROM_FILE, &back, NULL, &e));
    for (int i = 0; i < 24; i++) assert_near(back.xyz[i], (double)(float)s.xyz[i], 0);
    assert_memory_equal(back.tri, s.tri, 36 * sizeof *s.tri);
    surface_free(&back);
    surface_free(&s);
}

static void ply_whose_data_start_with_a_newline_byte_is_read_right(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    unsigned char first[8] = {0x0A, 0x0D, 0x0A, 0, 0, 0, 0x59, 0x40}; /* little-endian double near 100 */
    memcpy(s.xyz, first, 8);
    assert_ok(mesh_write_surface(&s, "newline.ply", &e));
    assert_ok(mesh_read_surface("newline.ply", MESH_SPACE_FROM_FILE, &back, NULL, &e));
    assert_memory_equal(back.xyz, s.xyz, 24 * sizeof *s.xyz);
    surface_free(&back);
    surface_free(&s);
}

static void stl_cube_welds_to_eight_vertices(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    mesh_file_report r;
    assert_ok(mesh_write_surface(&s, "cube.STL", &e));
    assert_ok(mesh_read_surface("cube.STL", MESH_SPACE_FROM_FILE, &back, &r, &e));
    assert_int_equal(back.vertex_count, 8);
    assert_int_equal(back.triangle_count, 12);
    assert_int_equal(r.welded_vertices, 28);
    assert_true(r.tagged);
    int32_t boundary, nonmanifold;
    surface_edge_census(&back, &boundary, &nonmanifold);
    assert_int_equal(boundary, 0);
    assert_int_equal(nonmanifold, 0);
    assert_near(surface_volume(&back), surface_volume(&s), 1e-5 * surface_volume(&s));
    surface_free(&back);
    surface_free(&s);
}

static void text_stl_is_read_with_its_tag(void **state)
{
    (void)state;
    err e = {0};
    surface back = {0};
    mesh_file_report r;
    write_text("text.stl", "solid made by hand SPACE=RAS\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 2 3\n"
                           "vertex 1 5 3\nendloop\nendfacet\nendsolid\n");
    assert_ok(mesh_read_surface("text.stl", MESH_SPACE_FROM_FILE, &back, &r, &e));
    assert_true(r.tagged && r.ras);
    assert_int_equal(back.vertex_count, 3);
    assert_near(back.xyz[0], -1, 0);
    assert_near(back.xyz[1], -2, 0);
    assert_near(back.xyz[2], 3, 0);
    surface_free(&back);
}

static void obj_round_trip_is_good_to_float(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    mesh_file_report r;
    assert_ok(mesh_write_surface(&s, "cube.obj", &e));
    assert_ok(mesh_read_surface("cube.obj", MESH_SPACE_RAS, &back, &r, &e));
    assert_true(r.tagged && !r.ras); /* the tag wins over the caller */
    assert_int_equal(back.vertex_count, 8);
    assert_near(surface_volume(&back), surface_volume(&s), 1e-5 * surface_volume(&s));
    surface_free(&back);
    surface_free(&s);
}

static void obj_groups_become_one_welded_surface_and_polygons_are_split(void **state)
{
    (void)state;
    err e = {0};
    surface back = {0};
    mesh_file_report r;
    write_text("groups.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\ng floor\nf 1 4 3 2\ng side\nf 1 2 5\n");
    assert_ok(mesh_read_surface("groups.obj", MESH_SPACE_FROM_FILE, &back, &r, &e));
    assert_int_equal(back.vertex_count, 5);
    assert_int_equal(back.triangle_count, 3);
    assert_int_equal(r.split_polygons, 1);
    assert_false(r.tagged);
    surface_free(&back);
}

static void a_file_in_ras_reads_as_the_same_surface_in_lps(void **state)
{
    (void)state;
    err e = {0};
    surface ras = {0}, told = {0}, off = {0};
    mesh_file_report r;
    const char *body = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                       "property list uchar int vertex_indices\nend_header\n1 2 3\n4 5 6\n7 8 10\n3 0 1 2\n3 1 1 2\n";
    char text[400];
    snprintf(text, sizeof text, "ply\nformat ascii 1.0\ncomment 3D Slicer. SPACE=RAS\n%s", body);
    write_text("ras.ply", text);
    assert_ok(mesh_read_surface("ras.ply", MESH_SPACE_LPS, &ras, &r, &e));
    assert_true(r.tagged && r.ras);
    assert_int_equal(r.dropped_triangles, 1);
    assert_int_equal(ras.triangle_count, 1);
    snprintf(text, sizeof text, "ply\nformat ascii 1.0\n%s", body);
    write_text("told.ply", text);
    assert_ok(mesh_read_surface("told.ply", MESH_SPACE_RAS, &told, &r, &e));
    assert_true(!r.tagged && r.ras);
    write_text("lps.off", "OFF\n3 1 0\n-1 -2 3\n-4 -5 6\n-7 -8 10\n3 0 1 2\n");
    assert_ok(mesh_read_surface("lps.off", MESH_SPACE_FROM_FILE, &off, &r, &e));
    assert_false(r.ras);
    assert_memory_equal(ras.xyz, off.xyz, 9 * sizeof(double));
    assert_memory_equal(told.xyz, off.xyz, 9 * sizeof(double));
    assert_memory_equal(ras.tri, off.tri, 3 * sizeof(int32_t));
    surface_free(&ras);
    surface_free(&told);
    surface_free(&off);
}

static void gltf_is_turned_from_metres_with_y_up(void **state)
{
    (void)state;
    err e = {0};
    surface back = {0};
    /* one triangle (0,0,0) (0.1,0,0) (0,0.2,0.3) m, under a node moved by 1 m up (+y) */
    write_text("triangle.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                                "\"nodes\":[{\"mesh\":0,\"translation\":[0,1,0]}],"
                                "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":4}]}],"
                                "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
                                "\"min\":[0,0,0],\"max\":[0.1,0.2,0.3]}],"
                                "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                                "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
                                "AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MTD6amZk+\"}]}");
    assert_ok(mesh_read_surface("triangle.gltf", MESH_SPACE_FROM_FILE, &back, NULL, &e));
    const double want[9] = {0, 0, 1000, 100, 0, 1000, 0, -300, 1200};
    for (int i = 0; i < 9; i++) assert_near(back.xyz[i], want[i], 1e-4);
    surface_free(&back);
}

static void broken_files_are_refused_by_name(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    static const struct {
        const char *path, *text, *says;
    } bad[] = {
        {"mesh.xyz", "x", "mesh.xyz: unknown kind of mesh file"},
        {"noextension", "x", "noextension: unknown kind"},
        {"empty.ply", "", "empty.ply: the file is empty"},
        {"text.ply", "hello\n", "text.ply:1: is not a complete PLY"},
        {"none.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
         "none.ply: holds no triangles"},
        {"range.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 1 2\n",
         "range.ply: face 0 names vertex 1, but there are 1"},
        {"minus.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 -1 0\n",
         "minus.ply: face 0 names vertex -1"},
        {"huge.ply",
         "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
         "huge.ply: is not a complete PLY"},
        {"huge.off", "OFF\n99999999999999 1 0\n0 0 0\n", "huge.off:4: is not a complete OFF"},
        {"corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900000000000 0 1 2\n",
         "corners.off:7: is not a complete OFF file: face 0 of 1 is missing"},
        {"list.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n4000000000 0 0 0\n",
         "list.ply:12: is not a complete PLY file: face 0 of 1 is missing"},
        {"list_of_floats.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n1 0\n",
         "list_of_floats.ply:4: is not a complete PLY file: a list cannot be counted by \"float\""},
        {"no_z.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
         "no_z.ply:7: is not a complete PLY file: x, y or z is missing in \"vertex\""},
        {"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n0\n",
         "type.ply:4: is not a complete PLY file: unknown type \"half\""},
        {"before.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
         "before.ply:3: is not a complete PLY file: no element before the property \"float\""},
        {"tag.ply", "ply\nformat ascii 1.0\ncomment SPACE=LAS\nelement vertex 3\nend_header\n",
         "tag.ply:3: unknown tag SPACE=LAS"},
        {"empty.stl", "", "empty.stl: the file is empty"},
        {"nonsense.stl", "nonsense", "nonsense.stl: cannot be read as a mesh"},
        {"nonsense.glb", "nonsense", "nonsense.glb: cannot be read as a mesh"},
        {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj: "},
        {"infinite.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "infinite.obj: "},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        FILE *f = fopen(bad[i].path, "wb");
        fputs(bad[i].text, f);
        fclose(f);
        bool read = mesh_read_surface(bad[i].path, MESH_SPACE_FROM_FILE, &back, NULL, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].path, read, e.text);
        assert_null(back.xyz);
        e = (err){0};
    }
    assert_refused(mesh_read_surface("absent.ply", MESH_SPACE_FROM_FILE, &back, NULL, &e), ERR_INPUT);
    assert_refused(mesh_read_surface("/tmp", MESH_SPACE_FROM_FILE, &back, NULL, &e), ERR_INPUT);
    assert_refused(mesh_write_surface(&s, "cube.vtk", &e), ERR_USAGE);
    assert_refused(mesh_write_surface(&s, "no/such/folder/cube.ply", &e), ERR_RESOURCE);
    surface_free(&s);
}

/* Every proper beginning of a file must be refused, not read as a smaller mesh. */
static void truncated_files_are_refused(void **state)
{
    (void)state;
    err e = {0};
    surface s = cube(), back = {0};
    static const char *const name[] = {"cut.ply", "cut.stl"};
    for (int i = 0; i < 2; i++) {
        char bytes[4096];
        assert_ok(mesh_write_surface(&s, name[i], &e));
        FILE *f = fopen(name[i], "rb");
        size_t size = fread(bytes, 1, sizeof bytes, f);
        fclose(f);
        for (size_t n = 0; n < size; n += 7) {
            f = fopen(name[i], "wb");
            fwrite(bytes, 1, n, f);
            fclose(f);
            if (mesh_read_surface(name[i], MESH_SPACE_FROM_FILE, &back, NULL, &e))
                fail_msg("%s was read with %zu of %zu bytes", name[i], n, size);
            assert_int_equal(e.code, ERR_INPUT);
            e = (err){0};
        }
    }
    surface_free(&s);
}

static void welding_keeps_the_first_vertex_and_the_order(void **state)
{
    (void)state;
    surface s = surface_new(6, 2);
    const double xyz[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, -0.0, 0, 0, 1, 1, 0};
    const int32_t tri[6] = {0, 1, 2, 3, 5, 4}, want[6] = {0, 1, 2, 1, 3, 0};
    memcpy(s.xyz, xyz, sizeof xyz);
    memcpy(s.tri, tri, sizeof tri);
    mesh_file_report r = {0};
    mesh_weld(&s, &r);
    assert_int_equal(s.vertex_count, 4);
    assert_int_equal(r.welded_vertices, 2);
    assert_int_equal(r.dropped_triangles, 0);
    assert_memory_equal(s.tri, want, sizeof want);
    assert_near(s.xyz[9], 1, 0);
    assert_near(s.xyz[10], 1, 0);
    surface_free(&s);
}

static void an_output_appears_whole_or_not_at_all(void **state)
{
    (void)state;
    err e = {0};
    whole_file w;
    assert_ok(write_whole("whole.txt", "old", 3, &e));
    assert_ok(whole_file_open("whole.txt", &w, &e));
    fputs("half", w.stream);
    char text[8] = "";
    FILE *f = fopen("whole.txt", "rb");
    assert_int_equal(fread(text, 1, 8, f), 3);
    fclose(f);
    assert_int_equal(access(w.temporary, F_OK), 0);
    char temporary[256];
    snprintf(temporary, sizeof temporary, "%s", w.temporary);
    whole_file_abandon(&w);
    assert_int_not_equal(access(temporary, F_OK), 0);
    assert_int_equal(access("whole.txt", F_OK), 0);
    /* a full disk is found, and the old file stays */
    if (!access("/dev/full", W_OK)) {
        assert_ok(whole_file_open("whole.txt", &w, &e));
        assert_non_null(freopen("/dev/full", "wb", w.stream));
        fputs("half", w.stream);
        assert_refused(whole_file_close(&w, &e), ERR_RESOURCE);
        f = fopen("whole.txt", "rb");
        assert_int_equal(fread(text, 1, 8, f), 3);
        fclose(f);
    }
    whole_folder folder;
    assert_int_equal(system("rm -rf made"), 0);
    assert_ok(whole_folder_open("made/", &folder, &e));
    char inside[300];
    snprintf(inside, sizeof inside, "%s/a.txt", folder.temporary);
    assert_ok(write_whole(inside, "a", 1, &e));
    assert_int_not_equal(access("made", F_OK), 0);
    assert_ok(whole_folder_close(&folder, &e));
    assert_int_equal(access("made/a.txt", F_OK), 0);
    assert_refused(whole_folder_open("made", &folder, &e), ERR_INPUT);
    assert_refused(whole_folder_open("whole.txt", &folder, &e), ERR_INPUT);
}

static void vtu_blocks_lie_where_the_header_says(void **state)
{
    (void)state;
    err e = {0};
    tetmesh m = tetmesh_new(5, 2);
    const double xyz[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const int32_t tet[8] = {0, 1, 2, 3, 1, 2, 3, 4};
    memcpy(m.xyz, xyz, sizeof xyz);
    memcpy(m.tet, tet, sizeof tet);
    m.region[1] = 7;
    double u[15], p[5] = {1, 2, 3, 4, 5};
    for (int i = 0; i < 15; i++) u[i] = i / 3.0;
    point_array arrays[2] = {{"displacement", 3, u}, {"pressure_kpa", 1, p}};
    assert_ok(mesh_write_tets(&m, arrays, 2, "two.vtu", &e));
    char bytes[8192];
    FILE *f = fopen("two.vtu", "rb");
    size_t size = fread(bytes, 1, sizeof bytes - 1, f);
    fclose(f);
    bytes[size] = 0;
    char *data = strstr(bytes, "encoding=\"raw\">\n_");
    assert_non_null(data);
    data += strlen("encoding=\"raw\">\n_");
    static const struct {
        const char *name;
        uint64_t size;
    } block[] = {{"displacement", 120}, {"pressure_kpa", 40}, {"region", 8}, {"Points", 120},
                 {"connectivity", 64},  {"offsets", 16},      {"types", 2}};
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) {
        char key[64];
        snprintf(key, sizeof key, "Name=\"%s\"", block[i].name);
        char *at = strstr(bytes, key);
        assert_non_null(at);
        at = strstr(at, "offset=\"");
        assert_non_null(at);
        uint64_t length;
        memcpy(&length, data + strtoull(at + 8, NULL, 10), 8);
        assert_int_equal(length, block[i].size);
        const char *start = data + strtoull(at + 8, NULL, 10) + 8;
        if (i == 0) assert_memory_equal(start, u, 120);
        if (i == 3) assert_memory_equal(start, xyz, 120);
        if (i == 4) assert_int_equal(start[32 + 24], 4);
    }
    assert_refused(mesh_write_tets(&m, arrays, 2, "two.vtk", &e), ERR_USAGE);
    tetmesh_free(&m);
}

/* Each triangle with corners of its own, rounded apart by up to `apart` each way. */
static surface loose_ball(double apart)
{
    surface ball = body_ball(10, -20, 30, 40, 12), loose = surface_new(3 * ball.triangle_count, ball.triangle_count);
    uint32_t dice = 1;
    for (int32_t i = 0; i < loose.vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            dice = dice * 1664525 + 1013904223;
            loose.xyz[3 * i + c] = ball.xyz[3 * ball.tri[i] + c] + apart * ((dice >> 8) / 8388608.0 - 1);
        }
        loose.tri[i] = i;
    }
    surface_free(&ball);
    return loose;
}

static void loose_triangles_are_joined_near_by_or_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double apart, joined; /* joined < 0: refused */
    } tries[] = {{"loose.stl", 0.0002, 0.001}, {"loose.ply", 0.0002, 0.001}, {"loose.obj", 0.0002, 0.001},
                 {"loose.ply", 0.002, 0.01},   {"loose.ply", 0, 0},          {"loose.ply", 0.1, -1},
                 {"loose.stl", 0.1, -1}};
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        err e = {0};
        mesh_file_report r;
        int32_t open, crowded;
        surface s = loose_ball(tries[i].apart), back = {0};
        assert_ok(mesh_write_surface(&s, tries[i].name, &e));
        surface_free(&s);
        if (tries[i].joined < 0) {
            assert_refused(mesh_read_surface(tries[i].name, MESH_SPACE_FROM_FILE, &back, &r, &e), ERR_GEOMETRY);
            continue;
        }
        assert_ok(mesh_read_surface(tries[i].name, MESH_SPACE_FROM_FILE, &back, &r, &e));
        surface_edge_census(&back, &open, &crowded);
        assert_int_equal(open + crowded, 0);
        assert_int_equal(back.vertex_count, 2 + 11 * 24);
        assert_near(r.joined_mm, tries[i].joined, 0);
        assert_int_equal(!r.joined_vertices, !(tries[i].joined > 0));
        surface_free(&back);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ply_round_trip_keeps_every_bit),
        cmocka_unit_test(a_ply_for_viewers_holds_floats),
        cmocka_unit_test(ply_whose_data_start_with_a_newline_byte_is_read_right),
        cmocka_unit_test(stl_cube_welds_to_eight_vertices),
        cmocka_unit_test(text_stl_is_read_with_its_tag),
        cmocka_unit_test(obj_round_trip_is_good_to_float),
        cmocka_unit_test(obj_groups_become_one_welded_surface_and_polygons_are_split),
        cmocka_unit_test(a_file_in_ras_reads_as_the_same_surface_in_lps),
        cmocka_unit_test(gltf_is_turned_from_metres_with_y_up),
        cmocka_unit_test(broken_files_are_refused_by_name),
        cmocka_unit_test(truncated_files_are_refused),
        cmocka_unit_test(loose_triangles_are_joined_near_by_or_refused),
        cmocka_unit_test(welding_keeps_the_first_vertex_and_the_order),
        cmocka_unit_test(an_output_appears_whole_or_not_at_all),
        cmocka_unit_test(vtu_blocks_lie_where_the_header_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
