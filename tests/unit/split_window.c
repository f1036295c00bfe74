/* A cut that comes out of the bone in the middle of a plate: counted by handles, laid anew, or named with its place. */
#include "geometry/boolean.h"
#include "geometry/handles.h"
#include "geometry/osteotomy.h"
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "tests/unit/box_mandible.h"
#include <string.h>

static surface without(const surface *bone, surface tool)
{
    err e = {0};
    surface out;
    bool ok = boolean_apply(bone, &tool, BOOLEAN_DIFFERENCE, &out, NULL, &e);
    assert_true(ok);
    surface_free(&tool);
    return out;
}

static void handles_are_counted_over_all_pieces(void **state)
{
    (void)state;
    surface box = body_box(0, 0, 0, 30, 30, 10), ring = without(&box, body_box(10, 10, -1, 20, 20, 11)),
            pit = without(&box, body_box(10, 10, 3, 20, 20, 11)), far = body_box(50, 0, 0, 60, 10, 10),
            pair = surface_joined(&ring, &ring), three = surface_joined(&pair, &far);
    assert_int_equal(surface_handles(&box), 0);
    assert_int_equal(surface_handles(&pit), 0);
    assert_int_equal(surface_handles(&ring), 1);
    assert_int_equal(surface_handles(&three), 2);
    surface all[] = {box, ring, pit, far, pair, three};
    for (int i = 0; i < 6; i++) surface_free(&all[i]);
}

/* The box mandible with a recess in the outer face of the left ramus, to x. */
static segments split(double x, cut_report *r)
{
    err e = {0};
    model m = box_mandible();
    surface bone = without(&m.mandible, body_box(x, -20.3, -3.1, 40, -11.2, 8.3));
    osteotomy_input in = {.mandible = &bone, .points = &m.points, .kinds = OSTEOTOMY_BSSO};
    osteotomy_params p = osteotomy_params_default();
    segments s;
    assert_ok(osteotomy_cut(&in, &p, &s, r, &e));
    surface_free(&bone);
    model_free(&m);
    return s;
}

static const char *warning_of(const cut_report *r, const char *words)
{
    for (int i = 0; i < r->warning_count; i++)
        if (strstr(r->warning[i], words)) return r->warning[i];
    return NULL;
}

static void a_split_that_comes_out_of_the_plate_is_laid_further_inside(void **state)
{
    (void)state;
    cut_report r;
    segments s = split(29.5, &r);
    double wide, moved;
    const char *told = warning_of(&r, "proximal_left: as first laid");
    assert_non_null(told);
    assert_int_equal(sscanf(strstr(told, "window of"), "window of %lf", &wide), 1);
    assert_true(wide > 9 && wide < 16); /* the recess is 9.1 by 11.4 mm */
    assert_int_equal(sscanf(strstr(told, "by up to"), "by up to %lf", &moved), 1);
    assert_true(moved > 1 && moved <= 4.05); /* not more than the plate is deep */
    assert_null(warning_of(&r, "proximal_right"));
    assert_null(warning_of(&r, "meets no bone"));
    for (int i = SEGMENT_DISTAL; i <= SEGMENT_PROXIMAL_RIGHT; i++) assert_int_equal(r.handles[i], 0);
    segments_free(&s);
    cut_report_free(&r);
}

static void a_window_that_stays_is_named_with_its_place(void **state)
{
    (void)state;
    cut_report r;
    segments s = split(20, &r); /* through and through: no plate can be left */
    double wide, p[3];
    const char *told = warning_of(&r, "proximal_left: the cut meets no bone"), *at = told ? strchr(told, '(') : NULL;
    assert_non_null(at);
    assert_null(warning_of(&r, "as first laid"));
    assert_int_equal(sscanf(strstr(told, "window of"), "window of %lf", &wide), 1);
    assert_near(wide, 14.6, 1.5);
    assert_int_equal(sscanf(at, "(%lf, %lf, %lf)", p, p + 1, p + 2), 3);
    assert_near(p[1], -15.75, 1);
    assert_near(p[2], 2.6, 1);
    assert_non_null(strstr(told, "handles of the bone 1, of its pieces 2"));
    assert_int_equal(r.handles[SEGMENT_PROXIMAL_LEFT], 1);
    assert_int_equal(r.handles[SEGMENT_PROXIMAL_RIGHT], 0);
    segments_free(&s);
    cut_report_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(handles_are_counted_over_all_pieces),
        cmocka_unit_test(a_split_that_comes_out_of_the_plate_is_laid_further_inside),
        cmocka_unit_test(a_window_that_stays_is_named_with_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
