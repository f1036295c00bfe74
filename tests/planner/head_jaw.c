/* The mouth of the template opened and closed again. */
#include "tests/check.h"
#include "tests/planner/with_template.h"
#include "app/planner/identity/head_jaw.h"
#include "app/planner/identity/head_sound.h"
#include "geometry/mem.h"
#include "geometry/rig.h"
#include "geometry/vec.h"
#include <string.h>

static head_place as_it_is = {.scale = 1};

static int open_it(void **state)
{
    as_it_is.motion = rigid_identity();
    return open_template(state);
}

static const double *point(const char *label)
{
    for (int32_t i = 0; i < t.point_count; i++)
        if (!strcmp(t.point[i].label, label)) return t.point[i].at;
    fail_msg("the template has no %s", label);
    return NULL;
}

static rigid opening(double deg, double glide_mm)
{
    const head_frame f = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};
    const jaw_motion j = {.open_deg = deg, .protrude_mm = glide_mm};
    double condyle[2][3];
    vec_copy(point("Co_L"), condyle[0]);
    vec_copy(point("Co_R"), condyle[1]);
    return rig_jaw_motion(&j, &f, (const double(*)[3])condyle);
}

/* Mean and largest distance of vertices from where they were. */
static double apart(const double *a, const double *b, int32_t count, double *most)
{
    double sum = 0;
    *most = 0;
    for (size_t v = 0; v < (size_t)count; v++) {
        double d = vec_distance(a + 3 * v, b + 3 * v);
        *most = fmax(*most, d);
        sum += d / count;
    }
    return sum;
}

static void an_opened_mouth_is_closed_again(void **state)
{
    (void)state;
    err e = {0};
    head_shape closed = head_shape_of(&t), s = head_shape_of(&t);
    rigid down = opening(8, 0);
    head_closing c;
    double most, mean;
    assert_ok(head_jaw_turn(&t, &down, &s, &e));
    mean = apart(s.part[CASE_SKIN], closed.part[CASE_SKIN], t.part[CASE_SKIN].vertex_count, &most);
    print_message("opened: skin %.2f mm in the mean, %.2f at most\n", mean, most);
    assert_true(most > 8 && mean < 4);
    for (size_t v = 0; v < (size_t)t.part[CASE_SKIN].vertex_count; v++)
        if (closed.part[CASE_SKIN][3 * v + 2] > 60)
            assert_near(vec_distance(s.part[CASE_SKIN] + 3 * v, closed.part[CASE_SKIN] + 3 * v), 0, 0.3);
    assert_ok(head_jaw_close(&t, &as_it_is, NULL, &s, &c, &e));
    print_message("open %.2f mm, turned %.2f deg, left %.2f mm\n", c.open_mm, c.turn_deg, c.left_mm);
    assert_int_equal(c.stop, JAW_AT_BITE);
    assert_near(c.turn_deg, 8, 1e-6);
    assert_near(c.left_mm, 0, 1e-6);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        mean = apart(s.part[p], closed.part[p], t.part[p].vertex_count, &most);
        print_message("%-12s %.3f mm in the mean, %.3f at most\n", case_surface_name((case_surface)p), mean, most);
        assert_true(p == CASE_SKIN ? mean < 0.3 && most < 3 : most < 1e-6);
    }
    head_soundness f;
    assert_ok(head_soundness_of(&t, &s, &f, &e));
    assert_int_equal(f.inverted_tets, 0);
    head_shape_free(&closed);
    head_shape_free(&s);
}

/* Bones alone: the tissue is not asked where the mouth is not open. */
static void what_is_closed_stays_as_it_is(void **state)
{
    (void)state;
    err e = {0};
    head_closing c;
    char text[160];
    head_shape s = head_shape_of(&t);
    assert_ok(head_jaw_close(&t, &as_it_is, NULL, &s, &c, &e));
    assert_int_equal(c.stop, JAW_NOT_OPEN);
    assert_memory_equal(s.neutral, t.tissue.mesh.xyz, 3 * (size_t)t.tissue.mesh.vertex_count * sizeof(double));
    assert_string_equal(head_closing_text(&c, text, sizeof text), "the mouth is closed");
    head_shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_opened_mouth_is_closed_again),
        cmocka_unit_test(what_is_closed_stays_as_it_is),
    };
    return cmocka_run_group_tests(tests, open_it, close_template);
}
