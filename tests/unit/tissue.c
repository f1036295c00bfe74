/* The tissue stage on a toy head: skin and bone are two spheres, with landmarks where a face would have them. */
#include "tests/check.h"
#include "tests/unit/sphere.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/tissue.h"
#include <string.h>

static const double origin[3] = {0, 0, 0};
enum { SKIN_MM = 70, BONE_MM = 55 };

typedef struct toy {
    surface skin, bones;
    segments parts;
    landmarks points;
    head_frame frame;
    tissue_params params;
} toy;

/* A point of the sphere of this radius, `up` and `left` mm off its foremost point. */
static void front(landmarks *l, const char *label, double radius, double left, double up)
{
    double p[3] = {left, -sqrt(radius * radius - left * left - up * up), up};
    landmarks_set(l, label, p);
}

static toy make_toy(void)
{
    toy t = {
        .skin = sphere(origin, SKIN_MM, 60), .bones = sphere(origin, BONE_MM, 60), .params = tissue_params_default()};
    t.parts.part[SEGMENT_CRANIUM] = surface_copy(&t.bones);
    const double po_l[3] = {BONE_MM, 0, 0}, po_r[3] = {-BONE_MM, 0, 0};
    landmarks_set(&t.points, "Po_L", po_l);
    landmarks_set(&t.points, "Po_R", po_r);
    front(&t.points, "Or_L", BONE_MM, 20, 0);
    front(&t.points, "N", BONE_MM, 0, 15);
    front(&t.points, "Me", BONE_MM, 0, -45);
    front(&t.points, "U1", BONE_MM, 0, -19);
    front(&t.points, "L1", BONE_MM, 0, -21);
    front(&t.points, "Pn", SKIN_MM, 0, 5);
    front(&t.points, "Ls", SKIN_MM, 0, -14);
    front(&t.points, "Stm", SKIN_MM, 0, -20);
    front(&t.points, "Ch_L", SKIN_MM, 22, -20);
    front(&t.points, "Ch_R", SKIN_MM, -22, -20);
    err e = {0};
    assert_ok(head_frame_from_landmarks(&t.points, &t.frame, &e));
    t.params.element_mm = 5;
    t.params.coarse_mm = 12;
    t.params.neck_mm = 5;
    t.params.brow_mm = 25;
    return t;
}

static void free_toy(toy *t)
{
    surface_free(&t->skin);
    surface_free(&t->bones);
    segments_free(&t->parts);
    landmarks_free(&t->points);
}

static tissue make(const toy *t, tissue_report *r)
{
    err e = {0};
    tissue out;
    tissue_input in = {&t->skin, &t->bones, &t->parts, &t->points, &t->frame};
    assert_ok(tissue_make(&in, &t->params, &out, r, &e));
    return out;
}

/* Made once for all tests, on one thread. */
static toy t;
static tissue m;
static tissue_report r;

static int make_once(void **state)
{
    (void)state;
    t = make_toy();
    parallel_set_threads(1);
    m = make(&t, &r);
    parallel_set_threads(0);
    return 0;
}

static int free_once(void **state)
{
    (void)state;
    tissue_free(&m);
    free_toy(&t);
    return 0;
}

/* Volume between the spheres in front of the coronal plane y < c and between the planes zl < z < zh. */
static double shell_volume(double c, double zl, double zh)
{
    double sum = 0, h = 0.05;
    for (double z = zl + h / 2; z < zh; z += h) {
        double area = 0;
        const double radius[2] = {SKIN_MM, BONE_MM}, sign[2] = {1, -1};
        for (int i = 0; i < 2; i++) {
            double r2 = radius[i] * radius[i] - z * z;
            if (r2 <= 0) continue;
            double disc = sqrt(r2), k = fmax(-1, fmin(1, -c / disc)); /* part of the disc with y < c */
            area += sign[i] * r2 * (acos(k) - k * sqrt(1 - k * k));
        }
        sum += area * h;
    }
    return sum;
}

static void the_mesh_fills_the_space_between_skin_and_bone(void **state)
{
    (void)state;
    err e = {0};
    assert_ok(tetmesh_check(&m.mesh, &e));
    double want = shell_volume(t.params.coronal_mm, -45 - 5, 15 + 25);
    assert_near(r.quality.volume_mm3 / want, 1, 0.03);
    assert_true(r.quality.min_dihedral_deg > 3 && r.quality.min_radius_ratio > 0.02);
}

static void tied_nodes_lie_on_the_bone_and_sliding_ones_know_its_normal(void **state)
{
    (void)state;
    err e = {0};
    nearest *bone = NULL;
    assert_ok(nearest_create(&t.bones, &bone, &e));
    int tied = 0, sliding = 0;
    for (int32_t v = 0; v < m.mesh.vertex_count; v++) {
        const double *p = m.mesh.xyz + 3 * (size_t)v, *n = m.attach.normal + 3 * (size_t)v;
        if (m.side[v] != SIDE_BONE) continue;
        assert_near(nearest_point(bone, p, NULL, NULL), 0, 0.051);
        tied += m.attach.kind[v] == NODE_TIED;
        if (m.attach.kind[v] != NODE_SLIDING) continue;
        sliding++;
        assert_near(vec_norm(n), 1, 1e-12);
        assert_true(vec_dot(n, p) / vec_norm(p) > 0.95); /* out of the bone */
    }
    assert_true(tied > 50);
    assert_int_equal(sliding, 0); /* no molars: no known vestibule, so everything is tied */
    assert_int_equal(tied + r.fixed_nodes, r.tied_nodes);
    nearest_destroy(&bone);
}

static void the_lips_are_separate_between_the_mouth_corners(void **state)
{
    (void)state;
    assert_true(r.lip_pairs > 10);
    for (int32_t i = 0; i < m.attach.pair_count; i++) {
        const double *up = m.mesh.xyz + 3 * (size_t)m.attach.pair[2 * i],
                     *low = m.mesh.xyz + 3 * (size_t)m.attach.pair[2 * i + 1],
                     *n = m.attach.pair_normal + 3 * (size_t)i;
        assert_memory_equal(up, low, 3 * sizeof *up);
        assert_true(fabs(up[0]) < 22);
        assert_near(up[2], -20, 2.0); /* a facet of the sheet may lean by a good part of an element, 5 mm */
        assert_near(n[2], 1, 0.02);
    }
    /* no tet holds nodes of both lips of a pair */
    uint8_t *lip = NEW_ARRAY(uint8_t, m.mesh.vertex_count);
    for (int32_t i = 0; i < m.attach.pair_count; i++) {
        lip[m.attach.pair[2 * i]] = 1;
        lip[m.attach.pair[2 * i + 1]] = 2;
    }
    for (int32_t k = 0; k < m.mesh.tet_count; k++) {
        int seen = 0;
        for (int a = 0; a < 4; a++) seen |= lip[m.mesh.tet[4 * k + a]];
        assert_int_not_equal(seen, 3);
    }
    free(lip);
}

static void the_same_input_gives_the_same_bits(void **state)
{
    (void)state;
    tissue_report again;
    parallel_set_threads(3);
    tissue b = make(&t, &again);
    parallel_set_threads(0);
    assert_int_equal(m.mesh.vertex_count, b.mesh.vertex_count);
    assert_int_equal(m.mesh.tet_count, b.mesh.tet_count);
    assert_memory_equal(m.mesh.xyz, b.mesh.xyz, 3 * (size_t)m.mesh.vertex_count * sizeof(double));
    assert_memory_equal(m.mesh.tet, b.mesh.tet, 4 * (size_t)m.mesh.tet_count * sizeof(int32_t));
    assert_memory_equal(m.attach.kind, b.attach.kind, (size_t)m.mesh.vertex_count);
    tissue_free(&b);
}

static void skin_is_carried_exactly_by_an_affine_motion_and_by_its_own_lip(void **state)
{
    (void)state;
    embedding em = tissue_carry(&m, t.skin.xyz, t.skin.vertex_count, 2);
    double *u = NEW_ARRAY(double, 3 * (size_t)m.mesh.vertex_count),
           *out = NEW_ARRAY(double, 3 * (size_t)t.skin.vertex_count);
    for (int32_t v = 0; v < m.mesh.vertex_count; v++) {
        const double *x = m.mesh.xyz + 3 * (size_t)v;
        u[3 * v] = 0.1 * x[1] - 0.3 * x[2] + 1;
        u[3 * v + 1] = 0.2 * x[0];
        u[3 * v + 2] = -0.4 * x[2] + 0.05 * x[0] - 2;
    }
    embedding_apply(&em, &m.mesh, u, t.skin.xyz, out);
    int carried = 0;
    for (int32_t v = 0; v < t.skin.vertex_count; v++) {
        const double *x = t.skin.xyz + 3 * (size_t)v;
        if (em.tet[v] < 0) continue;
        carried++;
        assert_near(out[3 * v] - x[0], 0.1 * x[1] - 0.3 * x[2] + 1, 1e-9);
        assert_near(out[3 * v + 1] - x[1], 0.2 * x[0], 1e-9);
        assert_near(out[3 * v + 2] - x[2], -0.4 * x[2] + 0.05 * x[0] - 2, 1e-9);
        if (fabs(x[0]) < 20) assert_int_equal(m.mesh.region[em.tet[v]], x[2] > -20 ? REGION_UPPER : REGION_LOWER);
    }
    assert_true(carried > 500);
    free(u);
    free(out);
    embedding_free(&em);
}

static void missing_landmarks_and_bad_sizes_are_named(void **state)
{
    (void)state;
    toy bad = make_toy();
    err e = {0};
    tissue out;
    tissue_input in = {&bad.skin, &bad.bones, &bad.parts, &bad.points, &bad.frame};
    bad.params.coarse_mm = 1;
    assert_false(tissue_make(&in, &bad.params, &out, NULL, &e));
    assert_non_null(strstr(e.text, "tissue.coarse_mm"));
    e = (err){0};
    bad.params.coarse_mm = 12;
    snprintf(bad.points.point[11].label, LANDMARK_LABEL_SIZE, "other"); /* was Ch_R */
    assert_false(tissue_make(&in, &bad.params, &out, NULL, &e));
    assert_int_equal(e.code, ERR_INPUT);
    assert_non_null(strstr(e.text, "Ch_R"));
    free_toy(&bad);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mesh_fills_the_space_between_skin_and_bone),
        cmocka_unit_test(tied_nodes_lie_on_the_bone_and_sliding_ones_know_its_normal),
        cmocka_unit_test(the_lips_are_separate_between_the_mouth_corners),
        cmocka_unit_test(the_same_input_gives_the_same_bits),
        cmocka_unit_test(skin_is_carried_exactly_by_an_affine_motion_and_by_its_own_lip),
        cmocka_unit_test(missing_landmarks_and_bad_sizes_are_named),
    };
    return cmocka_run_group_tests(tests, make_once, free_once);
}
