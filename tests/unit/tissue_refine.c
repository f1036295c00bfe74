/* The same tissue in tets of half the size: nothing but the size may change. */
#include "tests/check.h"
#include "geometry/tissue_refine.h"
#include "tests/physics/lips.h"

static tissue lips_tissue(void)
{
    block b = {4, 3, 4, {20, 12, 16}, 5, 0.2};
    tissue t = {0};
    t.mesh = lips_mesh(&b, 2, true, &t.attach);
    t.side = NEW_ARRAY(uint8_t, t.mesh.vertex_count);
    for (int32_t i = 0; i < t.mesh.tet_count; i++) t.mesh.region[i] = i % 3;
    return t;
}

static void each_tet_becomes_eight_of_its_volume(void **state)
{
    (void)state;
    err e = {0};
    tissue t = lips_tissue(), fine;
    tissue_refine(&t, &fine);
    assert_int_equal(fine.mesh.tet_count, 8 * t.mesh.tet_count);
    assert_ok(tetmesh_check(&fine.mesh, &e));
    assert_near(tetmesh_measure(&fine.mesh).volume_mm3, tetmesh_measure(&t.mesh).volume_mm3, 1e-9);
    for (int32_t i = 0; i < fine.mesh.tet_count; i++) assert_int_equal(fine.mesh.region[i], t.mesh.region[i / 8]);
    int32_t *face, *fine_face, faces = tetmesh_boundary(&t.mesh, &face, NULL);
    assert_int_equal(tetmesh_boundary(&fine.mesh, &fine_face, NULL),
                     4 * faces); /* conforming inside, lips still apart */
    free(face);
    free(fine_face);
    tissue_free(&t);
    tissue_free(&fine);
}

static void attachment_and_lips_go_on_between_the_old_nodes(void **state)
{
    (void)state;
    tissue t = lips_tissue(), fine;
    tissue_refine(&t, &fine);
    int32_t paired = 0;
    for (int32_t v = 0; v < fine.mesh.vertex_count; v++) {
        const double *x = fine.mesh.xyz + 3 * (size_t)v;
        bool bottom = x[2] == 0, top = x[2] == 16;
        assert_int_equal(fine.attach.kind[v] == NODE_TIED, bottom || top);
        if (bottom || top) assert_int_equal(fine.attach.segment[v], bottom ? SEGMENT_DISTAL : SEGMENT_MAXILLA);
        if (fine.attach.kind[v] == NODE_SLIDING) {
            assert_near(x[0], 0, 1e-12);
            assert_near(fine.attach.normal[3 * (size_t)v], 1, 1e-12);
        }
    }
    for (int32_t i = 0; i < fine.attach.pair_count; i++) {
        const double *u = fine.mesh.xyz + 3 * (size_t)fine.attach.pair[2 * i],
                     *w = fine.mesh.xyz + 3 * (size_t)fine.attach.pair[2 * i + 1];
        assert_near(vec_distance(u, w), 0, 1e-12);
        assert_near(u[2], 8, 1e-12);
        assert_near(fine.attach.pair_normal[3 * (size_t)i + 2], 1, 1e-12);
        assert_int_equal(fine.attach.kind[fine.attach.pair[2 * i]], NODE_FREE);
        paired++;
    }
    assert_int_equal(paired, (2 * 4 + 1) * (2 * 3 + 1)); /* every node of the finer contact */
    tissue_free(&t);
    tissue_free(&fine);
}

static void points_are_carried_as_before(void **state)
{
    (void)state;
    tissue t = lips_tissue(), fine;
    tissue_refine(&t, &fine);
    double point[3 * 50], u[4096 * 3], before[3 * 50], after[3 * 50];
    uint64_t seed = 7;
    for (int i = 0; i < 50; i++) {
        point[3 * i] = 10 + 10.5 * block_random(&seed);
        point[3 * i + 1] = 6 + 6.3 * block_random(&seed);
        point[3 * i + 2] = 8 + 8.4 * block_random(&seed);
    }
    embedding coarse = embed_points(&t.mesh, point, 50, 2, NULL, NULL), refined;
    embedding_refine(&coarse, &t.mesh, &fine.mesh, &refined);
    assert_true(fine.mesh.vertex_count < 4096);
    for (int32_t v = 0; v < 3 * fine.mesh.vertex_count; v++) u[v] = 0;
    for (int32_t v = 0; v < 3 * t.mesh.vertex_count; v++)
        u[v] = block_random(&seed); /* piecewise linear on the old tets */
    for (int32_t i = 0; i < t.mesh.tet_count; i++)
        for (int k = 0; k < 32; k++) { /* a new node lies midway between two old ones of the parent */
            int32_t v = fine.mesh.tet[32 * (size_t)i + k];
            for (int a = 0; a < 4 && v >= t.mesh.vertex_count; a++)
                for (int b = a + 1; b < 4; b++) {
                    const int32_t *p = t.mesh.tet + 4 * (size_t)i;
                    double middle[3];
                    vec_add(t.mesh.xyz + 3 * (size_t)p[a], t.mesh.xyz + 3 * (size_t)p[b], middle);
                    vec_scale(middle, 0.5, middle);
                    if (vec_distance(middle, fine.mesh.xyz + 3 * (size_t)v) > 1e-12) continue;
                    for (int c = 0; c < 3; c++) u[3 * v + c] = (u[3 * p[a] + c] + u[3 * p[b] + c]) / 2;
                }
        }
    embedding_apply(&coarse, &t.mesh, u, point, before);
    embedding_apply(&refined, &fine.mesh, u, point, after);
    int inside = 0;
    for (int i = 0; i < 50; i++) {
        const double *w = coarse.weight + 4 * i;
        if (coarse.tet[i] < 0 || fmin(fmin(w[0], w[1]), fmin(w[2], w[3])) < 0)
            continue; /* outside, slopes may differ */
        assert_near(vec_distance(before + 3 * i, after + 3 * i), 0, 1e-12);
        inside++;
    }
    assert_true(inside > 20);
    embedding_free(&coarse);
    embedding_free(&refined);
    tissue_free(&t);
    tissue_free(&fine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_tet_becomes_eight_of_its_volume),
        cmocka_unit_test(attachment_and_lips_go_on_between_the_old_nodes),
        cmocka_unit_test(points_are_carried_as_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
