/* Gaps between tissue and bone at rest, against those that are asked one by one. */
#include "geometry/nearest.h"
#include "geometry/rest_gap.h"
#include "tests/check.h"
#include "tests/physics/block.h"
#include "tests/unit/bodies.h"

/* A block of tissue 60 x 8 x 6 mm, all of its surface asked but the face x = 0, over a bone that one end of it is in.
 */
static void set_up(tissue *t, segments *bones)
{
    block b = {30, 4, 3, {60, 8, 6}, 6, 0};
    *t = (tissue){.mesh = block_mesh(&b)};
    t->side = NEW_ARRAY(uint8_t, t->mesh.vertex_count);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        const double *x = t->mesh.xyz + 3 * (size_t)v;
        bool inner = x[0] > 0 && x[0] < 60 && x[1] > 0 && x[1] < 8 && x[2] > 0 && x[2] < 6;
        t->side[v] = inner ? SIDE_INSIDE : x[0] > 0 ? x[2] > 0 ? SIDE_SKIN : SIDE_BONE : SIDE_CUT;
    }
    *bones = (segments){0};
    bones->part[SEGMENT_DISTAL] = body_box(-3, -3, -3, 7, 11, 9);
    bones->part[SEGMENT_CHIN] = body_box(21, 1, 2, 22, 7, 4); /* between nodes: edges pass it */
    bones->kerf = body_box(12, -1, -9, 12.5, 9, -1);
}

static void check_against(const tissue *t, const nearest *to, const double *gap)
{
    int32_t inside = 0, far = 0;
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        if (!rest_gap_asks(t, v)) {
            assert_true(isnan(gap[v]));
            continue;
        }
        double exact = nearest_point(to, t->mesh.xyz + 3 * (size_t)v, NULL, NULL);
        bool in = nearest_inside(to, t->mesh.xyz + 3 * (size_t)v);
        assert_int_equal(gap[v] < 0, in);
        assert_true(fabs(gap[v]) <= exact + 1e-12);
        if (exact <= rest_gap_exact_mm) assert_near(fabs(gap[v]), exact, 1e-12);
        assert_true(exact <= rest_gap_exact_mm || fabs(gap[v]) > rest_gap_exact_mm);
        inside += in;
        far += exact > rest_gap_exact_mm + 4;
    }
    printf("%d nodes inside, %d far off\n", inside, far);
}

static void gaps_are_those_of_single_questions(void **state)
{
    (void)state;
    tissue t;
    segments bones;
    segment_trees trees;
    rest_gap g;
    err e = {0};
    set_up(&t, &bones);
    assert_ok(segment_trees_make(&bones, NULL, &trees, &e));
    rest_gap_make(&t, &trees, &g);
    check_against(&t, trees.part[SEGMENT_DISTAL], g.part[SEGMENT_DISTAL]);
    check_against(&t, trees.part[SEGMENT_CHIN], g.part[SEGMENT_CHIN]);
    check_against(&t, trees.kerf, g.kerf);
    assert_null(g.part[SEGMENT_MAXILLA]);
    assert_true(g.part[SEGMENT_DISTAL][t.mesh.vertex_count - 1] > rest_gap_exact_mm);
    rest_gap_free(&g);
    segment_trees_free(&trees);
    segments_free(&bones);
    tissue_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gaps_are_those_of_single_questions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
