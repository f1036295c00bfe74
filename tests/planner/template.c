/* The template that fixture "template" made (GNATHOS_TEMPLATE). */
#include "tests/check.h"
#include "app/planner/identity/lip_overlap.h"
#include "app/planner/identity/template_get.h"
#include "app/planner/store/pack_file.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <string.h>
#include <unistd.h>

static head_template t;

static int open_it(void **state)
{
    (void)state;
    err e = {0};
    template_source s;
    if (!head_template_get(NULL, &t, &s, &e)) {
        print_error("%s\n", e.text);
        return -1;
    }
    return s.made || s.place != TEMPLATE_NAMED;
}

static int close_it(void **state)
{
    (void)state;
    head_template_free(&t);
    return 0;
}

/* Turned, grown by a tenth and sheared: what an affine map does to every vertex it does to every landmark. */
static void map(const double p[3], double out[3])
{
    static const double a[9] = {0.88, -0.66, 0.1, 0.66, 0.88, 0, 0, 0.05, 1.1};
    for (int i = 0; i < 3; i++) out[i] = a[3 * i] * p[0] + a[3 * i + 1] * p[1] + a[3 * i + 2] * p[2] + 10 * i;
}

static void landmarks_move_with_their_parts(void **state)
{
    (void)state;
    head_shape s = head_shape_of(&t);
    landmarks before = head_points(&t, &s);
    assert_int_equal(before.count, t.point_count);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        for (int32_t v = 0; v < t.part[p].vertex_count; v++)
            map(t.part[p].xyz + 3 * (size_t)v, s.part[p] + 3 * (size_t)v);
    landmarks after = head_points(&t, &s);
    int inside = 0;
    for (int32_t i = 0; i < before.count; i++) {
        double there[3], from_case = vec_distance(before.point[i].xyz, t.point[i].at);
        inside += t.point[i].triangle < 0;
        assert_near(from_case, 0, t.point[i].triangle < 0 ? 1e-9 : 0.3);
        map(before.point[i].xyz, there);
        assert_near(vec_distance(there, after.point[i].xyz), 0, 1e-9);
    }
    assert_in_range(inside, 1, 8);
    landmarks_free(&before);
    landmarks_free(&after);
    head_shape_free(&s);
}

static void lies_in_its_own_frame(void **state)
{
    (void)state;
    head_shape s = head_shape_of(&t);
    landmarks l = head_points(&t, &s);
    head_frame f;
    err e = {0};
    assert_ok(head_frame_from_landmarks(&l, &f, &e));
    for (int c = 0; c < 3; c++) assert_near(f.origin[c], 0, 0.05);
    assert_near(f.up[2], 1, 1e-6);
    assert_near(f.left[0], 1, 1e-6);
    landmarks_free(&l);
    head_shape_free(&s);
}

static void lips_overlap_at_rest_and_all_else_stays(void **state)
{
    (void)state;
    const attach_map *a = &t.tissue.attach;
    const double *neutral = t.tissue.mesh.xyz;
    double deepest = 0;
    for (int32_t i = 0; i < a->pair_count; i++) {
        size_t up = 3 * (size_t)a->pair[2 * i], low = 3 * (size_t)a->pair[2 * i + 1];
        double apart[3];
        assert_near(vec_distance(neutral + up, neutral + low), 0, 1e-12);
        vec_sub(t.rest + up, t.rest + low, apart);
        double depth = -vec_dot(apart, a->pair_normal + 3 * (size_t)i);
        assert_true(depth >= -1e-9 && depth <= lip_overlap_mm + 1e-9);
        deepest = fmax(deepest, depth);
    }
    assert_true(deepest > 0.95 * lip_overlap_mm);
    head_shape own = head_shape_of(&t);
    landmarks l = head_points(&t, &own);
    const double *lip = landmarks_find(&l, "Stm")->xyz;
    for (int32_t v = 0; v < a->node_count; v++) {
        const double *x = neutral + 3 * (size_t)v;
        double moved = vec_distance(x, t.rest + 3 * (size_t)v);
        if (a->kind[v] == NODE_TIED) assert_near(moved, 0, 1e-12);
        if (vec_distance(x, lip) > 60) assert_near(moved, 0, 0.1 * lip_overlap_mm);
    }
    landmarks_free(&l);
    head_shape_free(&own);
    err e = {0};
    tetmesh rest = t.tissue.mesh;
    rest.xyz = t.rest;
    assert_ok(tetmesh_check(&rest, &e));
}

static void every_tooth_has_its_number(void **state)
{
    (void)state;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        assert_int_equal(t.tooth[p] != NULL, p >= CASE_UPPER_TEETH);
        if (!t.tooth[p]) continue;
        int size[14] = {0};
        for (int32_t v = 0; v < t.part[p].vertex_count; v++) {
            assert_in_range(t.tooth[p][v], 0, 13);
            size[t.tooth[p][v]]++;
        }
        for (int i = 0; i < 14; i++) assert_true(size[i] > 100);
    }
}

static void face_hangs_in_the_tissue(void **state)
{
    (void)state;
    int32_t off = 0, face = 0;
    for (int32_t v = 0; v < t.part[CASE_SKIN].vertex_count; v++) {
        const double *x = t.part[CASE_SKIN].xyz + 3 * (size_t)v;
        if (x[1] > -40 || x[2] > 20 || x[2] < -90) continue;
        face++;
        off += t.skin_on_tissue.tet[v] < 0;
    }
    assert_true(face > 2000 && off * 50 < face);
}

/* A file that was edited, with a right checksum. */
static void refuse_edited(const char *entry, size_t at, int32_t value)
{
    err e = {0};
    pack_file f = {0};
    head_template edited = {0};
    assert_ok(pack_read(getenv("GNATHOS_TEMPLATE"), &f, &e));
    for (int i = 0; i < f.count; i++)
        if (!strcmp(f.entry[i].name, entry)) memcpy((char *)f.entry[i].bytes + at, &value, sizeof value);
    assert_ok(pack_write(&f, "edited.pack", &e));
    assert_refused(head_template_read("edited.pack", &edited, &e), ERR_INPUT);
    pack_free(&f);
    unlink("edited.pack");
}

static void edited_files_are_refused(void **state)
{
    (void)state;
    refuse_edited("version", 0, HEAD_TEMPLATE_VERSION + 1);
    refuse_edited("skin.tri", 12, 1 << 28);
    refuse_edited("mandible.tri", 0, -1);
    refuse_edited("tet.node", 0, 1 << 28);
    refuse_edited("skin.tet", 4, 1 << 28);
    refuse_edited("pair.node", 0, 1 << 28);
    refuse_edited("upper_teeth.tooth", 0, 1 << 28);
    refuse_edited("upper_teeth.tooth", 0, 3); /* in range, but not the numbering of the version */
    refuse_edited("points", LANDMARK_LABEL_SIZE, CASE_SURFACE_COUNT);
    refuse_edited("points", LANDMARK_LABEL_SIZE + 4, 1 << 28);
    refuse_edited("node.rest", 4, 0x7ff80000); /* not a number */
}

static void torn_file_is_refused(void **state)
{
    (void)state;
    err e = {0};
    head_template none = {0};
    FILE *from = fopen(getenv("GNATHOS_TEMPLATE"), "rb"), *to = fopen("torn.pack", "wb");
    assert_true(from && to);
    char half[4096];
    for (int i = 0; i < 100; i++) fwrite(half, 1, fread(half, 1, sizeof half, from), to);
    fclose(from);
    fclose(to);
    assert_refused(head_template_read("torn.pack", &none, &e), ERR_INPUT);
    unlink("torn.pack");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(landmarks_move_with_their_parts),
        cmocka_unit_test(lies_in_its_own_frame),
        cmocka_unit_test(lips_overlap_at_rest_and_all_else_stays),
        cmocka_unit_test(every_tooth_has_its_number),
        cmocka_unit_test(face_hangs_in_the_tissue),
        cmocka_unit_test(edited_files_are_refused),
        cmocka_unit_test(torn_file_is_refused),
    };
    return cmocka_run_group_tests(tests, open_it, close_it);
}
