/* The lower lip falls back onto the lower teeth by the way they come forward, and no farther than onto them.
 */
#include "tests/check.h"
#include "tests/physics/block.h"
#include "tests/unit/bodies.h"
#include "geometry/lip_rest.h"
#include "geometry/segment_trees.h"

/* A lip of 20 x 6 x 10 mm (x left, -y forward, z up) whose lining (y = 6) stands 4 mm in front of the lower
 * teeth. */
typedef struct setting {
    tissue t;
    segments bones;
    landmarks points;
    head_frame frame;
    rigid motion[SEGMENT_COUNT];
} setting;

static void set_up(setting *s)
{
    block b = {8, 3, 5, {20, 6, 10}, 6, 0};
    *s = (setting){.t.mesh = block_mesh(&b)};
    s->frame = (head_frame){.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};
    s->bones.part[SEGMENT_DISTAL] = body_box(-20, 10, -30, 40, 40, 12);
    s->bones.part[SEGMENT_MAXILLA] = body_box(-20, 5, 12.5, 40, 40, 40);
    landmarks_set(&s->points, "L1", (double[]){10, 10, 12});
    landmarks_set(&s->points, "L6_L", (double[]){30, 35, 12});
    landmarks_set(&s->points, "L6_R", (double[]){-10, 35, 12});
    s->t.attach = attach_map_new(s->t.mesh.vertex_count, 0);
    s->t.side = NEW_ARRAY(uint8_t, s->t.mesh.vertex_count);
    for (int32_t i = 0; i < s->t.mesh.tet_count; i++) s->t.mesh.region[i] = REGION_LOWER;
    for (int32_t v = 0; v < s->t.mesh.vertex_count; v++) {
        const double *x = s->t.mesh.xyz + 3 * (size_t)v;
        if (x[1] > 5.9) s->t.side[v] = SIDE_HOLE;
        if (x[2] < 0.1) tie(&s->t.attach, v, SEGMENT_DISTAL);
    }
    rest_motions(s->motion);
}

static void tear_down(setting *s)
{
    tissue_free(&s->t);
    segments_free(&s->bones);
    landmarks_free(&s->points);
}

static int32_t rest(setting *s)
{
    segment_trees trees;
    err e = {0};
    lip_rest_params p = lip_rest_params_default(15);
    assert_ok(segment_trees_make(&s->bones, NULL, &trees, &e));
    int32_t count = lip_rest(&s->t, trees.part[SEGMENT_DISTAL], s->motion, &s->points, &s->frame, &p, &s->t.attach);
    segment_trees_free(&trees);
    return count;
}

static void expect_shift(const setting *s, int32_t count, double shift_mm)
{
    int32_t found = 0;
    for (int32_t v = 0; v < s->t.mesh.vertex_count; v++) {
        const attach_map *a = &s->t.attach;
        bool lining = s->t.side[v] == SIDE_HOLE && a->kind[v] != NODE_TIED;
        assert_int_equal(lining, a->kind[v] == NODE_SLIDING);
        if (!lining) continue;
        found++;
        assert_int_equal(a->segment[v], SEGMENT_DISTAL);
        assert_near(a->shift_mm[v], shift_mm, 1e-9);
        assert_near(a->normal[3 * (size_t)v + 1], -1, 1e-9);
    }
    assert_true(found > 0);
    assert_int_equal(found, count);
}

static void it_follows_the_upper_teeth_until_it_meets_the_lower_ones(void **state)
{
    (void)state;
    for (int far = 0; far < 2; far++) {
        setting s;
        set_up(&s);
        s.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, far ? -6 : -3, 0});
        expect_shift(&s, rest(&s), far ? -4 : -3);
        tear_down(&s);
    }
}

static void both_jaws_together_leave_it_where_it_is(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    s.motion[SEGMENT_DISTAL] = s.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, -5, 0});
    assert_int_equal(rest(&s), 0);
    s.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 3, 0}); /* set back */
    assert_int_equal(rest(&s), 0);
    assert_null(s.t.attach.shift_mm);
    tear_down(&s);
}

static void the_other_lip_and_the_lip_line_are_left_alone(void **state)
{
    (void)state;
    setting s;
    set_up(&s);
    s.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, -3, 0});
    for (int32_t i = 0; i < s.t.mesh.tet_count; i++) s.t.mesh.region[i] = REGION_UPPER;
    assert_int_equal(rest(&s), 0);
    tear_down(&s);
    set_up(&s);
    s.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, -3, 0});
    landmarks_free(&s.points);
    assert_int_equal(rest(&s), 0); /* no teeth known */
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_follows_the_upper_teeth_until_it_meets_the_lower_ones),
        cmocka_unit_test(both_jaws_together_leave_it_where_it_is),
        cmocka_unit_test(the_other_lip_and_the_lip_line_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
