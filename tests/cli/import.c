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
    /* tetrahedra in RAS metres, without a tag */
    static const struct {
        const char *path;
        double scale, up;
    } body[] = {{"metres.off", 1, 0}, {"bone.off", 0.3, 0.03}, {"jaw.off", 0.25, -0.05}};
    for (int i = 0; i < 3; i++) {
        double s = body[i].scale, z = body[i].up;
        FILE *f = fopen(body[i].path, "wb");
        fprintf(f, "OFF\n4 4 0\n%g %g %g\n%g %g %g\n0 %g %g\n0 0 %g\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n", -0.08 * s,
                -0.1 * s, z - 0.12 * s, 0.08 * s, -0.1 * s, z - 0.12 * s, 0.1 * s, z - 0.12 * s, z + 0.12 * s);
        fclose(f);
    }
    assert_int_equal(system("rm -rf made"), 0);
    const char *rest = "--skull bone.off --mandible jaw.off --frame ras -o made";
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

/* What import said, whole. */
static bool said(const char *words)
{
    char text[8192];
    FILE *f = fopen("import.err", "rb");
    assert_non_null(f);
    size_t n = fread(text, 1, sizeof text - 1, f);
    fclose(f);
    text[n] = 0;
    return strstr(text, words) != NULL;
}

/* A label map of 40^3 voxels of 5 mm: boxes {label, low[3], high[3]} in mm from the middle; header: more lines of it.
 */
static void write_boxes(const char *path, const double (*box_)[7], int count, const char *header)
{
    enum { N = 40 };
    err e = {0};
    uint8_t *value = NEW_ARRAY(uint8_t, N * N * N);
    for (int i = 0; i < N * N * N; i++) {
        const double p[3] = {5.0 * (i % N) - 97.5, 5.0 * (i / N % N) - 97.5, 5.0 * (i / (N * N)) - 97.5};
        for (int b = 0; b < count; b++) {
            bool in = true;
            for (int c = 0; c < 3; c++) in &= p[c] > box_[b][1 + c] && p[c] < box_[b][4 + c];
            if (in) value[i] = (uint8_t)box_[b][0];
        }
    }
    whole_file w;
    assert_ok(whole_file_open(path, &w, &e));
    fprintf(w.stream,
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 40 40 40\nencoding: raw\nspace: left-posterior-superior\n"
            "space directions: (5,0,0) (0,5,0) (0,0,5)\nspace origin: (-97.5,-97.5,-97.5)\n%s\n",
            header);
    (void)!fwrite(value, 1, N * N * N, w.stream);
    assert_ok(whole_file_close(&w, &e));
    free(value);
}

/* skull, mandible right and left, upper and lower teeth */
static const double head_boxes[5][7] = {{1, -50, -60, 10, 50, 60, 80},
                                        {2, -50, -60, -60, 0, 20, -20},
                                        {3, 0, -60, -60, 50, 20, -20},
                                        {4, -30, -75, 10, 30, -60, 25},
                                        {5, -30, -75, -30, 30, -60, -15}};

static int import_boxes(const char *labels)
{
    char line[512];
    write_box("skin.stl", skin_low, skin_high, true);
    assert_int_equal(system("rm -rf made"), 0);
    snprintf(line, sizeof line, "%s --skin skin.stl --edge 5 --json -o made", labels);
    return run(line);
}

static double made_mm3(const char *part)
{
    err e = {0};
    json_file out;
    assert_ok(json_file_read("import.out", &out, &e));
    double mm3 = number(out.root, part, "label_mm3");
    json_file_free(&out);
    return mm3;
}

static void all_segments_of_a_name_make_the_part(void **state)
{
    (void)state;
    const double half = 50 * 80 * 40;
    write_boxes("two.seg.nrrd", head_boxes, 3,
                "Segment0_Name:=Upper Skull\nSegment0_LabelValue:=1\nSegment1_Name:=Mandible\nSegment1_LabelValue:=2\n"
                "Segment2_Name:=mandible\nSegment2_LabelValue:=3\n");
    assert_int_equal(import_boxes("--labels two.seg.nrrd --preset dental-segmentator"), 0);
    assert_near(made_mm3("mandible"), 2 * half, 1);
    assert_int_equal(import_boxes("--labels two.seg.nrrd --skull \"upper skull\" --mandible Mandible"), 0);
    assert_near(made_mm3("mandible"), 2 * half, 1);
}

static void gaps_in_the_numbering_lose_no_segment(void **state)
{
    (void)state;
    write_boxes("gaps.seg.nrrd", head_boxes, 3,
                "Segment12_Name:=Mandible\nSegment12_LabelValue:=3\nSegment3_Name:=Upper Skull\n"
                "Segment3_LabelValue:=1\nSegment7_Name:=Mandible\nSegment7_LabelValue:=2\n");
    assert_int_equal(import_boxes("--labels gaps.seg.nrrd --preset dental-segmentator"), 0);
    assert_near(made_mm3("mandible"), 2 * 50 * 80 * 40, 1);
    write_boxes("nameless.seg.nrrd", head_boxes, 3,
                "Segment0_Name:=Upper Skull\nSegment0_LabelValue:=1\nSegment1_LabelValue:=2\n");
    assert_int_equal(import_boxes("--labels nameless.seg.nrrd --preset dental-segmentator"), ERR_INPUT);
}

static void a_label_makes_one_part_and_unused_ones_are_told(void **state)
{
    (void)state;
    write_boxes("head5.nrrd", head_boxes, 5, "");
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --mandible 2,3 --upper-teeth 4 --lower-teeth 4"),
                     ERR_USAGE);
    assert_true(said("the label \"4\" is named for the"));
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --mandible 1,2"), ERR_USAGE);
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --mandible 2,3,3 --upper-teeth 4"), 0);
    json_file out;
    err e = {0};
    assert_ok(json_file_read("import.out", &out, &e));
    const json_t *issues = json_object_get(out.root, "issues");
    bool told = false;
    for (size_t i = 0; i < json_array_size(issues); i++) {
        const char *text = json_string_value(json_object_get(json_array_get(issues, i), "text"));
        told |= strstr(text, "no part of the case: 5") != NULL;
    }
    assert_true(told);
    json_file_free(&out);
}

static void presets_are_held_against_the_shapes(void **state)
{
    (void)state;
    /* numbers of other tools: mandible 1, lower teeth 2, skull 3, upper teeth 7 */
    static const double other[4][7] = {{3, -50, -60, 10, 50, 60, 80},
                                       {1, -50, -60, -60, 50, 20, -20},
                                       {7, -30, -75, 10, 30, -60, 25},
                                       {2, -30, -75, -30, 30, -60, -15}};
    write_boxes("other.nrrd", other, 4, "");
    assert_int_equal(import_boxes("--labels other.nrrd --preset dental-segmentator"), ERR_GEOMETRY);
    assert_true(said("another tool's"));
    assert_int_equal(import_boxes("--labels other.nrrd --preset totalsegmentator-craniofacial"), 0);
    assert_near(made_mm3("skull"), 100 * 120 * 70, 1);
    static const double fairy[4][7] = {{2, -50, -60, 10, 50, 60, 80},
                                       {1, -50, -60, -60, 50, 20, -20},
                                       {11, -30, -75, 10, 30, -60, 25},
                                       {41, -30, -75, -30, 30, -60, -15}};
    write_boxes("fairy.nrrd", fairy, 4, "");
    assert_int_equal(import_boxes("--labels fairy.nrrd --preset dental-segmentator"), ERR_GEOMETRY);
    assert_int_equal(import_boxes("--labels fairy.nrrd --preset toothfairy"), 0);
    assert_int_equal(import_boxes("--labels fairy.nrrd --preset nnunet"), ERR_USAGE);
    /* teeth of the other arch */
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --mandible 2,3 --upper-teeth 5 --lower-teeth 4"),
                     ERR_GEOMETRY);
}

static void a_ct_that_is_not_in_hounsfield_units_is_no_skin(void **state)
{
    (void)state;
    static const double air_and_head[1][7] = {{200, -80, -80, -80, 80, 80, 80}};
    write_boxes("grey.nrrd", air_and_head, 1, "");
    write_boxes("head5.nrrd", head_boxes, 5, "");
    assert_int_equal(system("rm -rf made"), 0);
    const char *rest = "--labels head5.nrrd --skull 1 --mandible 2,3 --ct grey.nrrd --edge 5 -o made";
    assert_int_equal(run(rest), ERR_INPUT);
    assert_true(said("Hounsfield"));
    char line[256];
    snprintf(line, sizeof line, "--skin-hu 100 %s", rest);
    assert_int_equal(run(line), 0);
    assert_int_equal(system("rm -rf made"), 0);
    snprintf(line, sizeof line, "--skin-hu -500 %s", rest);
    assert_int_equal(run(line), ERR_INPUT);
}

static void bones_that_are_there_twice_are_refused(void **state)
{
    (void)state;
    err e = {0};
    surface skull, jaw, both;
    box(&skull, bone_low, bone_high, false);
    box(&jaw, jaw_low, jaw_high, false);
    both = surface_joined(&skull, &jaw);
    assert_ok(mesh_write_surface(&both, "both.ply", &e));
    assert_ok(mesh_write_surface(&jaw, "jaw.ply", &e));
    assert_ok(mesh_write_surface(&skull, "bone.ply", &e));
    write_box("skin.stl", skin_low, skin_high, true);
    assert_int_equal(system("rm -rf made"), 0);
    assert_int_equal(run("--skin skin.stl --skull both.ply --mandible jaw.ply -o made"), ERR_GEOMETRY);
    assert_true(said("holds the mandible too"));
    assert_int_equal(run("--skin skin.stl --skull bone.ply --mandible both.ply -o made"), ERR_GEOMETRY);
    assert_int_equal(run("--skin skin.stl --skull jaw.ply --mandible bone.ply -o made"), ERR_GEOMETRY);
    assert_true(said("above"));
    assert_int_equal(run("--skin skin.stl --skull bone.ply --mandible jaw.ply -o made"), 0);
    surface_free(&skull);
    surface_free(&jaw);
    surface_free(&both);
}

static void an_option_given_twice_means_both(void **state)
{
    (void)state;
    const double half_low[3] = {-50, -60, 0}, half_high[3] = {0, 60, 90}, rest_low[3] = {1, -60, 0};
    write_box("skin.stl", skin_low, skin_high, true);
    write_box("half.ply", half_low, half_high, false);
    write_box("rest.obj", rest_low, bone_high, false);
    write_box("jaw.ply", jaw_low, jaw_high, false);
    assert_int_equal(system("rm -rf made"), 0);
    const char *both = "--skin skin.stl --skull half.ply --skull rest.obj --mandible jaw.ply --json -o made";
    assert_int_equal(run(both), 0);
    json_file out;
    err e = {0};
    assert_ok(json_file_read("import.out", &out, &e));
    assert_near(number(out.root, "skull", "pieces"), 2, 0);
    assert_near(number(out.root, "skull", "volume_mm3"), (50 + 49) * 120 * 90, 1e-3);
    json_file_free(&out);
    assert_int_equal(system("rm -rf made"), 0);
    assert_int_equal(run("--skin skin.stl --skull half.ply --skull half.ply --mandible jaw.ply -o made"), ERR_USAGE);
    assert_true(said("named twice"));
    assert_int_equal(run("--skin skin.stl --skull half.ply --mandible jaw.ply --name a --name b -o made"), ERR_USAGE);
    assert_true(said("--name is given twice: a and b"));
    write_boxes("head5.nrrd", head_boxes, 5, "");
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --mandible 2 --mandible 3 --upper-teeth 4"), 0);
    assert_near(made_mm3("mandible"), 2 * 50 * 80 * 40, 1);
    assert_int_equal(import_boxes("--labels head5.nrrd --skull 1 --skull half.ply --mandible 2,3"), ERR_USAGE);
    assert_true(said("mesh files and labels"));
}

static void label_files_of_one_structure_each_are_one_segmentation(void **state)
{
    (void)state;
    static const double skull[1][7] = {{1, -50, -60, 10, 50, 60, 80}}, jaw[1][7] = {{1, -50, -60, -60, 50, 20, -20}},
                        teeth[1][7] = {{3, -30, -75, 10, 30, -60, 25}}, over[1][7] = {{1, -30, -75, 10, 30, -50, 25}};
    write_boxes("skull.nrrd", skull, 1, "");
    write_boxes("mandible.nrrd", jaw, 1, "");
    write_boxes("teeth_upper.nrrd", teeth, 1, "");
    write_boxes("teeth_lower.nrrd", teeth, 0, ""); /* nothing found */
    write_boxes("head5.nrrd", head_boxes, 5, "");
    const char *files =
        "--labels skull.nrrd --labels mandible.nrrd --labels teeth_upper.nrrd --labels teeth_lower.nrrd";
    char line[512];
    snprintf(line, sizeof line, "%s --preset totalsegmentator-craniofacial", files);
    assert_int_equal(import_boxes(line), 0);
    assert_near(made_mm3("skull"), 100 * 120 * 70, 1);
    assert_near(made_mm3("mandible"), 100 * 80 * 40, 1);
    assert_near(made_mm3("upper_teeth"), 60 * 15 * 15, 1);
    snprintf(line, sizeof line, "%s --skull skull,teeth_upper --mandible mandible", files);
    assert_int_equal(import_boxes(line), 0);
    assert_near(made_mm3("skull"), 100 * 120 * 70 + 60 * 15 * 15, 1);
    snprintf(line, sizeof line, "%s --skull skull --mandible jaw", files);
    assert_int_equal(import_boxes(line), ERR_INPUT);
    assert_true(said("skull.nrrd and 3 more: has no label \"jaw\"; choose by name: \"skull\", \"mandible\""));
    assert_int_equal(import_boxes("--labels skull.nrrd --labels head5.nrrd --skull skull --mandible head5"), ERR_INPUT);
    assert_true(said("several labels"));
    write_boxes("teeth_upper.nrrd", over, 1, ""); /* overlap: both whole */
    snprintf(line, sizeof line, "%s --skull skull --mandible mandible --upper-teeth teeth_upper", files);
    assert_int_equal(import_boxes(line), 0);
    assert_near(made_mm3("skull"), 100 * 120 * 70, 1);
    assert_near(made_mm3("upper_teeth"), 60 * 25 * 15, 1);
    assert_int_equal(system("sed 's/origin: (-97.5,/origin: (-97.4,/' mandible.nrrd >moved.nrrd"), 0);
    assert_int_equal(import_boxes("--labels skull.nrrd --labels moved.nrrd --skull skull --mandible moved"), ERR_INPUT);
    assert_true(said("0.1 mm from those of skull.nrrd"));
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
        cmocka_unit_test(all_segments_of_a_name_make_the_part),
        cmocka_unit_test(gaps_in_the_numbering_lose_no_segment),
        cmocka_unit_test(a_label_makes_one_part_and_unused_ones_are_told),
        cmocka_unit_test(presets_are_held_against_the_shapes),
        cmocka_unit_test(a_ct_that_is_not_in_hounsfield_units_is_no_skin),
        cmocka_unit_test(bones_that_are_there_twice_are_refused),
        cmocka_unit_test(an_option_given_twice_means_both),
        cmocka_unit_test(label_files_of_one_structure_each_are_one_segmentation),
        cmocka_unit_test(real_heads_are_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
