/* What a plan changes in the attachments: cuts that open, cuts that do not, and the septum of the nose. */
#include "tests/check.h"
#include "tests/physics/block.h"
#include "tests/unit/bodies.h"
#include "geometry/nose.h"
#include "geometry/plan_attach.h"

/* A plate of tissue on two bones: distal for x < 20, chin for x > 20.5, the saw between them. */
typedef struct setting {
    tissue t;
    segments bones;
    rigid motion[SEGMENT_COUNT];
} setting;

static void set_up(setting *s)
{
    block b = {20, 4, 3, {40, 8, 6}, 6, 0};
    *s = (setting){.t.mesh = block_mesh(&b)};
    s->bones.part[SEGMENT_DISTAL] = body_box(-1, -1, -5, 20, 9, 0);
    s->bones.part[SEGMENT_CHIN] = body_box(20.5, -1, -5, 41, 9, 0);
    s->bones.kerf = body_box(20, -1, -5, 20.5, 9, 0);
    s->t.attach = attach_map_new(s->t.mesh.vertex_count, 0);
    s->t.side = NEW_ARRAY(uint8_t, s->t.mesh.vertex_count);
    for (int32_t v = 0; v < s->t.mesh.vertex_count; v++) {
        const double *x = s->t.mesh.xyz + 3 * (size_t)v;
        if (x[2] > 0) continue;
        s->t.side[v] = SIDE_BONE;
        if (fabs(x[0] - 20.25) >= 4.25) tie(&s->t.attach, v, x[0] < 20 ? SEGMENT_DISTAL : SEGMENT_CHIN);
    }
    rest_motions(s->motion);
}

static void tear_down(setting *s)
{
    tissue_free(&s->t);
    segments_free(&s->bones);
}

static attach_map attach(const setting *s)
{
    plan_attach_params p = plan_attach_params_default(4);
    plan_attach_report r;
    attach_map a;
    segment_trees trees;
    rest_gap gap;
    err e = {0};
    assert_ok(segment_trees_make(&s->bones, NULL, &trees, &e));
    rest_gap_make(&s->t, &trees, &gap);
    plan_attach(&s->t, &gap, s->motion, &p, &a, &r);
    rest_gap_free(&gap);
    segment_trees_free(&trees);
    return a;
}

static void a_cut_that_stays_shut_was_not_made(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    s.motion[SEGMENT_DISTAL] = s.motion[SEGMENT_CHIN] = rigid_translation((double[]){0, -6, 0});
    attach_map a = attach(&s);
    for (int32_t v = 0; v < a.node_count; v++) {
        if (s.t.side[v] != SIDE_BONE) continue;
        assert_int_equal(a.kind[v], NODE_TIED);
        assert_int_equal(a.segment[v], s.t.mesh.xyz[3 * (size_t)v] < 20.2 ? SEGMENT_DISTAL : SEGMENT_CHIN);
    }
    attach_map_free(&a);
    tear_down(&s);
}

static void along_a_cut_that_opens_the_moved_piece_keeps_its_tissue(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    s.motion[SEGMENT_CHIN] = rigid_translation((double[]){0, -6, 0});
    attach_map a = attach(&s);
    for (int32_t v = 0; v < a.node_count; v++) {
        double x = s.t.mesh.xyz[3 * (size_t)v];
        if (s.t.side[v] != SIDE_BONE) continue;
        if (x > 21.5) assert_int_equal(a.segment[v], SEGMENT_CHIN);
        if (x < 21 && x > 13) assert_int_equal(a.kind[v], NODE_FREE);
        if (x < 12) assert_int_equal(a.segment[v], SEGMENT_DISTAL);
    }
    /* no tet hangs on both */
    for (int32_t t = 0; t < s.t.mesh.tet_count; t++) {
        bool on[SEGMENT_COUNT] = {0};
        for (int k = 0; k < 4; k++) {
            int32_t v = s.t.mesh.tet[4 * (size_t)t + (size_t)k];
            if (a.kind[v] == NODE_TIED) on[a.segment[v]] = true;
        }
        assert_false(on[SEGMENT_DISTAL] && on[SEGMENT_CHIN]);
    }
    attach_map_free(&a);
    tear_down(&s);
}

static void lips_beside_a_cut_stay_lips(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    int32_t pair[2] = {-1, -1};
    for (int32_t v = 0; v < s.t.mesh.vertex_count; v++)
        if (s.t.side[v] == SIDE_BONE && s.t.attach.kind[v] == NODE_FREE) pair[pair[0] >= 0] = v;
    attach_map_free(&s.t.attach);
    s.t.attach = attach_map_new(s.t.mesh.vertex_count, 1);
    memcpy(s.t.attach.pair, pair, sizeof pair);
    attach_map a = attach(&s);
    assert_int_equal(a.pair_count, 1);
    assert_int_equal(a.kind[pair[0]], NODE_FREE);
    assert_int_equal(a.kind[pair[1]], NODE_FREE);
    attach_map_free(&a);
    tear_down(&s);
}

static void without_a_saw_nothing_changes(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    surface_free(&s.bones.kerf);
    s.motion[SEGMENT_CHIN] = rigid_translation((double[]){0, -6, 0});
    attach_map a = attach(&s);
    assert_memory_equal(a.kind, s.t.attach.kind, (size_t)a.node_count);
    attach_map_free(&a);
    tear_down(&s);
}

/* A block as nose: x left, -y forward, z up; behind y = 20 the nasal cavity, the maxilla below.
 */
static void the_septum_lies_in_the_midplane_clear_of_skin_and_maxilla(void **state)
{
    (void)state;
    block b = {10, 20, 15, {20, 40, 30}, 6, 0};
    tissue t = {.mesh = block_mesh(&b)};
    t.side = NEW_ARRAY(uint8_t, t.mesh.vertex_count);
    t.attach = attach_map_new(t.mesh.vertex_count, 0);
    for (int32_t v = 0; v < t.mesh.vertex_count; v++)
        if (t.mesh.xyz[3 * (size_t)v + 1] > 19.9) t.side[v] = SIDE_HOLE; /* all of the cavity */
    surface skin = body_box(-5, 0, -10, 25, 60, 35);
    segments bones = {.part[SEGMENT_MAXILLA] = body_box(-5, 15, -10, 25, 60, 0)};
    landmarks l = {0};
    nose_params p = nose_params_default();
    rigid up = rigid_translation((double[]){0, 0, 5}), still = rigid_identity();
    nose n = {0}, trimmed = {0};
    segment_trees trees;
    err e = {0};
    assert_ok(segment_trees_make(&bones, &skin, &trees, &e));
    landmarks_set(&l, "N", (double[]){10, 15, 30});
    landmarks_set(&l, "ANS", (double[]){10, 15, 0});
    assert_false(nose_make(&t, &trees, &still, &l, &p, &n)); /* no tip */
    landmarks_set(&l, "Pn", (double[]){10, 0, 12});
    assert_true(nose_make(&t, &trees, &still, &l, &p, &n));
    int32_t count = 0;
    for (int32_t i = 0; i < t.mesh.tet_count; i++) {
        if (n.region[i] != REGION_SEPTUM) continue;
        double centre[3] = {0};
        count++;
        for (int k = 0; k < 4; k++)
            vec_axpy(centre, 0.25, t.mesh.xyz + 3 * (size_t)t.mesh.tet[4 * (size_t)i + (size_t)k], centre);
        assert_true(fabs(centre[0] - 10) < 2 && centre[1] > p.dorsum_mm && centre[2] > 0);
        assert_true(centre[1] < 15 + 12); /* not in the cavity */
        assert_true(centre[1] < 15 - p.foot_mm || centre[2] > p.foot_mm);
    }
    assert_int_equal(count, n.septum_tets);
    assert_true(n.anchors > 0);
    for (int32_t i = 0; i < n.anchors; i++) assert_true(t.mesh.xyz[3 * (size_t)n.anchor[i] + 2] > 2 * p.foot_mm);
    assert_true(nose_make(&t, &trees, &up, &l, &p, &trimmed));
    assert_true(trimmed.septum_tets < n.septum_tets); /* an impacted maxilla takes its foot */
    nose_free(&n);
    nose_free(&trimmed);
    segment_trees_free(&trees);
    landmarks_free(&l);
    segments_free(&bones);
    surface_free(&skin);
    tissue_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cut_that_stays_shut_was_not_made),
        cmocka_unit_test(along_a_cut_that_opens_the_moved_piece_keeps_its_tissue),
        cmocka_unit_test(lips_beside_a_cut_stay_lips),
        cmocka_unit_test(without_a_saw_nothing_changes),
        cmocka_unit_test(the_septum_lies_in_the_midplane_clear_of_skin_and_maxilla),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
