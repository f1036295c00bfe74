/* gnathos import from its command line to the files of the case. */
#include "tests/check.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <string.h>
#include <unistd.h>

static int run(const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "%s import -q %s >import.out 2>import.err", GNATHOS_BINARY, arguments);
    int status = system(command);
    return status < 0 ? -1 : status >> 8;
}

static void box(surface *s, const double low[3], const double high[3], bool open_below)
{
    static const int32_t tri[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    *s = surface_new(8, open_below ? 10 : 12);
    for (int v = 0; v < 8; v++)
        for (int c = 0; c < 3; c++) s->xyz[3 * v + c] = v >> c & 1 ? high[c] : low[c];
    memcpy(s->tri, tri + (open_below ? 2 : 0), 3 * (size_t)s->triangle_count * sizeof *s->tri);
}

static double number(const json_t *root, const char *surface_name, const char *key)
{
    const json_t *part = json_object_get(json_object_get(root, "surfaces"), surface_name);
    assert_non_null(json_object_get(part, key));
    return json_number_value(json_object_get(part, key));
}

static void write_box(const char *path, const double low[3], const double high[3], bool open_below)
{
    err e = {0};
    surface s;
    box(&s, low, high, open_below);
    assert_ok(mesh_write_surface(&s, path, &e));
    surface_free(&s);
}

static const double skin_low[3] = {-80, -100, -120}, skin_high[3] = {80, 100, 120};
static const double bone_low[3] = {-50, -60, 0}, bone_high[3] = {50, 60, 90};
static const double jaw_low[3] = {-40, -70, -60}, jaw_high[3] = {40, 0, -10};

static void an_open_skin_and_two_bones_become_a_case(void **state)
{
    (void)state;
    err e = {0};
    write_box("skin.stl", skin_low, skin_high, true);
    write_box("skull.obj", bone_low, bone_high, false);
    write_box("jaw.ply", jaw_low, jaw_high, false);
    assert_int_equal(system("rm -rf made"), 0);
    assert_int_equal(run("--skin skin.stl --skull skull.obj --mandible jaw.ply --name box --json -o made/"), 0);
    json_file out;
    assert_ok(json_file_read("import.out", &out, &e));
    assert_near(number(out.root, "skin", "holes"), 1, 0);
    assert_near(number(out.root, "skin", "open_edges"), 4, 0);
    assert_near(number(out.root, "skin", "welded_vertices"), 22, 0);
    assert_near(number(out.root, "skull", "open_edges"), 0, 0);
    assert_near(number(out.root, "mandible", "self_intersections"), 0, 0);
    json_file_free(&out);
    surface jaw;
    assert_ok(mesh_read_surface("made/mandible.ply", MESH_SPACE_FROM_FILE, &jaw, NULL, &e));
    assert_near(surface_volume(&jaw), 80 * 70 * 50, 1e-6);
    surface_free(&jaw);
    json_file made;
    assert_ok(json_file_read("made/case.json", &made, &e));
    assert_string_equal(json_string_value(json_object_get(made.root, "name")), "box");
    assert_string_equal(json_string_value(json_object_get(made.root, "frame")), "LPS");
    json_file_free(&made);
    /* a second time: refused, and the first stays */
    assert_int_equal(run("--skin skin.stl --skull skull.obj --mandible jaw.ply -o made"), ERR_INPUT);
    assert_int_equal(access("made/case.json", F_OK), 0);
}

static void units_and_axes_are_changed_only_when_told(void **state)
{
    (void)state;
    err e = {0};
    /* the same box in RAS metres, without a tag */
    FILE *f = fopen("metres.off", "wb");
    fputs("OFF\n4 4 0\n-0.08 -0.1 -0.12\n0.08 -0.1 -0.12\n0 0.1 -0.12\n0 0 0.12\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
          f);
    fclose(f);
    assert_int_equal(system("rm -rf made"), 0);
    const char *rest = "--skull metres.off --mandible metres.off --frame ras -o made";
    char line[256];
    snprintf(line, sizeof line, "--skin metres.off %s", rest);
    assert_int_equal(run(line), ERR_INPUT);
    assert_int_not_equal(access("made", F_OK), 0);
    snprintf(line, sizeof line, "--skin metres.off --unit m %s", rest);
    assert_int_equal(run(line), 0);
    surface s;
    assert_ok(mesh_read_surface("made/skin.ply", MESH_SPACE_RAS, &s, NULL, &e)); /* tagged LPS: not turned again */
    const double want[3] = {80, 100, -120};
    for (int c = 0; c < 3; c++) assert_near(s.xyz[c], want[c], 1e-12);
    surface_free(&s);
}

/* A head of 200 mm around a skull and a jaw that are balls, with a tooth in each; label numbers of DentalSegmentator.
 */
static void write_head(const char *path, bool named)
{
    enum { N = 70 };
    err e = {0};
    const double voxel = 3,
                 at[5][4] = {{0, 0, 0, 95}, {0, 0, 30, 40}, {0, -10, -45, 25}, {0, -45, 8, 6}, {0, -45, -35, 6}};
    const int label[5] = {0, 1, 2, 3, 4}; /* ball 0 is soft tissue: label 9 */
    uint8_t *value = NEW_ARRAY(uint8_t, N * N * N);
    for (int i = 0; i < N * N * N; i++) {
        double p[3] = {voxel * (i % N - (N - 1) / 2.0), voxel * (i / N % N - (N - 1) / 2.0),
                       voxel * (i / (N * N) - (N - 1) / 2.0)};
        for (int b = 0; b < 5; b++)
            if (vec_distance(p, at[b]) < at[b][3]) value[i] = (uint8_t)(b ? label[b] : 9);
    }
    whole_file w;
    assert_ok(whole_file_open(path, &w, &e));
    fprintf(w.stream,
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 70 70 70\nencoding: raw\nspace: left-posterior-superior\n"
            "space directions: (3,0,0) (0,3,0) (0,0,3)\nspace origin: (-103.5,-103.5,-103.5)\n");
    if (named)
        fputs("Segment0_Name:=Mandible\nSegment0_LabelValue:=2\nSegment1_Name:=upper skull\nSegment1_LabelValue:=1\n"
              "Segment2_Name:=Soft\nSegment2_LabelValue:=9\n",
              w.stream);
    fputc('\n', w.stream);
    (void)!fwrite(value, 1, N * N * N, w.stream);
    assert_ok(whole_file_close(&w, &e));
    free(value);
}

static void a_label_map_becomes_closed_surfaces(void **state)
{
    (void)state;
    err e = {0};
    const double pi = 3.14159265358979;
    write_head("head.nrrd", false);
    assert_int_equal(system("rm -rf made"), 0);
    assert_int_equal(run("--labels head.nrrd --preset dental-segmentator --skin 9 --edge 5 --json -o made"), 0);
    static const struct {
        const char *name;
        double radius;
    } ball[] = {{"skin", 95}, {"mandible", 25}, {"skull", 40}, {"upper_teeth", 6}, {"lower_teeth", 6}};
    json_file out;
    assert_ok(json_file_read("import.out", &out, &e));
    for (int i = 0; i < 5; i++) {
        double volume = 4 * pi / 3 * pow(ball[i].radius, 3);
        assert_near(number(out.root, ball[i].name, "open_edges"), 0, 0);
        assert_near(number(out.root, ball[i].name, "crowded_edges"), 0, 0);
        assert_near(number(out.root, ball[i].name, "self_intersections"), 0, 0);
        /* teeth of two voxels' radius lose a third to smoothing and to triangles; bones lose what a tooth takes */
        assert_near(number(out.root, ball[i].name, "volume_mm3"), volume, (ball[i].radius < 10 ? 0.4 : 0.04) * volume);
    }
    json_file_free(&out);
    write_head("head.seg.nrrd", true);
    assert_int_equal(system("rm -rf made"), 0);
    assert_int_equal(run("--labels head.seg.nrrd --preset dental-segmentator --skin soft --edge 5 -o made"), 0);
    assert_int_equal(access("made/skull.ply", F_OK), 0);
    assert_int_not_equal(access("made/upper_teeth.ply", F_OK), 0); /* the file names none */
}

static void real_heads_are_accepted(void **state)
{
    (void)state;
    const char *data = getenv("GNATHOS_DATA");
    static const char *const head[] = {"phantom_head_ct", "vtk_fullhead_ct"};
    char line[2048];
    snprintf(line, sizeof line, "%s/%s/skin.ply", data ? data : "", head[0]);
    if (!data || access(line, R_OK)) {
        print_message("no real heads in GNATHOS_DATA: skipped\n");
        skip();
    }
    for (int i = 0; i < 2; i++) {
        assert_int_equal(system("rm -rf real"), 0);
        snprintf(line, sizeof line,
                 "--skin %s/%s/skin.ply --skull %s/%s/skull.ply --mandible %s/%s/mandible.ply --landmarks "
                 "%s/%s/landmarks.mrk.json -o real",
                 data, head[i], data, head[i], data, head[i], data, head[i]);
        assert_int_equal(run(line), 0);
    }
    assert_int_equal(system("rm -rf real"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_open_skin_and_two_bones_become_a_case),
        cmocka_unit_test(units_and_axes_are_changed_only_when_told),
        cmocka_unit_test(a_label_map_becomes_closed_surfaces),
        cmocka_unit_test(real_heads_are_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
