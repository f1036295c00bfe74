/* Incisors that are missing, and jaws without teeth: alveolar points tell where edges and cusps would be. */
#include "tests/check.h"
#include "geometry/frame.h"
#include "geometry/incisor.h"
#include "geometry/molar.h"
#include "geometry/vec.h"

static landmarks jaws(bool with_frame)
{
    static const landmark all[] = {{"Pr", {0, -88, -41}, 0},          {"Id", {0, -87, -60}, 0},
                                   {"U6_crest_L", {26, -62, -38}, 0}, {"U6_crest_R", {-26, -62, -38}, 0},
                                   {"Po_L", {60, 0, 0}, 0},           {"Po_R", {-60, 0, 0}, 0},
                                   {"Or_L", {30, -81, 0}, 0}};
    landmarks l = {0};
    for (size_t i = 0; i < (with_frame ? sizeof all / sizeof *all : 4); i++)
        landmarks_set(&l, all[i].label, all[i].xyz);
    return l;
}

static void the_tooth_itself_tells_first(void **state)
{
    (void)state;
    landmarks l = jaws(true);
    incisor edge;
    landmarks_set(&l, "U1", (const double[3]){0, -92, -52});
    assert_true(incisor_find(&l, true, &edge) && !edge.stands_in);
    assert_string_equal(edge.by, "U1");
    assert_near(vec_distance(edge.xyz, (const double[3]){0, -92, -52}), 0, 0);
    landmarks_free(&l);
}

static void the_edge_stands_a_crown_off_the_crest(void **state)
{
    (void)state;
    landmarks l = jaws(true);
    incisor upper, lower;
    assert_true(incisor_find(&l, true, &upper) && upper.stands_in);
    assert_true(incisor_find(&l, false, &lower) && lower.stands_in);
    assert_string_equal(upper.by, "Pr");
    assert_string_equal(lower.by, "Id");
    assert_near(vec_distance(upper.xyz, (const double[3]){0, -88, -51.5}), 0, 1e-9); /* down: 10.5 mm */
    assert_near(vec_distance(lower.xyz, (const double[3]){0, -87, -51}), 0, 1e-9);   /* up: 9 mm */
    landmarks_free(&l);
    l = jaws(false); /* neither up nor down without a head frame */
    assert_false(incisor_find(&l, true, &upper));
    landmarks_free(&l);
}

static void without_molars_the_crest_tells_their_cusp(void **state)
{
    (void)state;
    landmarks l = jaws(true);
    molar m;
    const landmark *pair[2];
    assert_true(molar_find(&l, true, 1, &m) && m.stands_in && m.on_crest);
    assert_string_equal(m.by, "U6_crest_L");
    assert_near(vec_distance(m.xyz, (const double[3]){26, -62, -45.5}), 0, 1e-9);
    assert_false(molar_find(&l, false, 1, &m)); /* no point of the lower crest */
    assert_false(molar_pair(&l, true, pair));   /* no teeth to compare */
    landmarks_set(&l, "U5_L", (const double[3]){24, -68, -46});
    assert_true(molar_find(&l, true, 1, &m) && !m.on_crest); /* a tooth tells better */
    assert_string_equal(m.by, "U5_L");
    assert_true(m.xyz[1] > -65 && m.xyz[1] < -63); /* 6 mm behind, away from where the incisor would be */
    landmarks_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tooth_itself_tells_first),
        cmocka_unit_test(the_edge_stands_a_crown_off_the_crest),
        cmocka_unit_test(without_molars_the_crest_tells_their_cusp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
