/* Heads of several seeds, from one coarse mean head: their bite, and what the split makes of their mandibles. */
#include "geometry/osteotomy.h"
#include "geometry/repair.h"
#include "tests/check.h"
#include "tests/norm_bite.h"
#include <string.h>

static norm_mean *mean;

static int build(void **state)
{
    (void)state;
    err e = {0};
    return norm_mean_build(3, true, &mean, &e) ? 0 : -1;
}

static int clean(void **state)
{
    (void)state;
    norm_mean_free(mean);
    return 0;
}

static norm_head_params drawn(norm_sex sex, int skeletal_class, uint64_t seed)
{
    norm_head_params p = norm_head_params_default();
    p.sex = sex;
    p.skeletal_class = skeletal_class;
    p.seed = seed;
    return p;
}

static norm_head shaped(const norm_head_params *p)
{
    err e = {0};
    norm_head h;
    assert_ok(norm_head_shape(mean, p, &h, &e));
    return h;
}

static void the_bite_of_every_class_is_its_own_level_and_in_contact(void **state)
{
    (void)state;
    norm_head_params p[] = {drawn(NORM_FEMALE, 1, 9), drawn(NORM_MALE, 2, 10), drawn(NORM_MALE, 3, 11)};
    p[1].asymmetry_mm = 4; /* of the chin: the teeth stay level */
    for (int i = 0; i < 3; i++) {
        err e = {0};
        norm_bite b;
        norm_head h = shaped(&p[i]);
        assert_ok(norm_bite_measure(&h, &p[i], &b, &e));
        assert_true(b.in_range);
        assert_near(h.obtained[OVERJET_MM], h.asked[OVERJET_MM], 0.1);
        assert_near(h.obtained[OVERBITE_MM], h.asked[OVERBITE_MM], 0.1);
        for (int side = 0; side < 2; side++) assert_true(b.touching[side] >= 1);
        assert_true(b.overlap_mm < 0.1);
        assert_near(b.cant_deg, 0, 0.5);
        norm_head_free(&h);
    }
}

/* Split through the lateral plate on both sides as the sagittal cut is first laid. */
static void a_flaring_ramus_is_split_without_a_window(void **state)
{
    (void)state;
    err e = {0};
    norm_head_params p = drawn(NORM_MALE, 2, 4);
    norm_head h = shaped(&p);
    osteotomy_params op = osteotomy_params_default();
    osteotomy_input in = {.mandible = &h.mandible, .points = &h.points, .kinds = OSTEOTOMY_BSSO};
    segments s;
    cut_report r;
    assert_ok(osteotomy_cut(&in, &op, &s, &r, &e));
    int anew = 0;
    for (int k = 0; k < r.warning_count; k++) anew += strstr(r.warning[k], "as first laid") != NULL;
    assert_int_equal(anew, 2);
    for (int k = SEGMENT_DISTAL; k <= SEGMENT_PROXIMAL_RIGHT; k++) assert_int_equal(r.handles[k], 0);
    segments_free(&s);
    cut_report_free(&r);
    norm_head_free(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bite_of_every_class_is_its_own_level_and_in_contact),
        cmocka_unit_test(a_flaring_ramus_is_split_without_a_window),
    };
    return cmocka_run_group_tests(tests, build, clean);
}
