/* Distances between a scan and the template that lies on it but for one cheek, and what of it is guessed and missed. */
#include "tests/check.h"
#include "tests/planner/with_template.h"
#include "app/planner/identity/fit_record.h"
#include "app/planner/identity/fit_state.h"
#include "geometry/mem.h"
#include "geometry/vec.h"

static const double swollen_mm = 8;

static bool is_cheek(const double x[3]) { return x[0] > 30 && x[1] < -20 && x[2] < -5 && x[2] > -70; }

/* The template's skin, open at the neck, its left cheek swollen. */
static surface scanned(void)
{
    surface s = surface_copy(&t.part[CASE_SKIN]), open;
    double *normal = surface_vertex_normals(&s);
    uint8_t *keep = NEW_ARRAY(uint8_t, s.triangle_count);
    for (int32_t i = 0; i < s.triangle_count; i++) keep[i] = s.xyz[3 * (size_t)s.tri[3 * (size_t)i] + 2] > -100;
    for (size_t v = 0; v < (size_t)s.vertex_count; v++)
        if (is_cheek(s.xyz + 3 * v)) vec_axpy(s.xyz + 3 * v, swollen_mm, normal + 3 * v, s.xyz + 3 * v);
    open = surface_select(&s, keep);
    surface_free(&s);
    free(normal);
    free(keep);
    return open;
}

static void a_swollen_cheek_is_missed_and_a_neck_is_guessed(void **state)
{
    (void)state;
    head_scan s = {.part = {[CASE_SKIN] = scanned()}};
    fit_state f = {.t = &t, .target = {[CASE_SKIN] = target_surface_make(&s.part[CASE_SKIN])}};
    head_fit out = {0};
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) f.at[p] = t.part[p]; /* borrowed */
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) fit_measure_part(&f, &s, (case_surface)p, &out);
    int cheek = 0, missed = 0, near = 0;
    for (size_t v = 0; v < (size_t)t.part[CASE_SKIN].vertex_count; v++) {
        const double *x = t.part[CASE_SKIN].xyz + 3 * v;
        if (x[2] < -115) assert_int_equal(out.guessed[CASE_SKIN][v], GUESS_ABSENT);
        if (x[2] > -90 && x[0] < 0) assert_int_equal(out.guessed[CASE_SKIN][v], GUESS_NONE);
        if (x[0] < 40 || x[1] > -35 || !is_cheek(x)) continue; /* off the rim of the swelling */
        cheek++;
        missed += out.guessed[CASE_SKIN][v] == GUESS_MISSED;
        if (out.guessed[CASE_SKIN][v] != GUESS_MISSED) continue;
        near += fabs(out.gap_mm[CASE_SKIN][v] - swollen_mm) < 1.5;
        assert_near(fit_shown_mm(&out, CASE_SKIN, v), out.gap_mm[CASE_SKIN][v], 0);
    }
    const registration_gaps *there = &out.gaps[CASE_SKIN], *back = &out.back[CASE_SKIN];
    print_message(
        "%d of %d of the cheek missed; to the scan %.2f mean, %.2f most; back %.2f mean, %.2f most, %d of %d\n", missed,
        cheek, there->mean_mm, there->max_mm, back->mean_mm, back->max_mm, back->with_target, back->vertices);
    assert_true(cheek > 20 && missed > 0.7 * cheek && near > 0.8 * missed);
    assert_true(there->max_mm <= fit_found_mm && there->mean_mm < 0.2); /* what is missed does not count there */
    assert_true(back->max_mm > 0.9 * swollen_mm && back->max_mm < 1.1 * swollen_mm); /* but here */
    assert_true(back->with_target > 0.8 * back->vertices && out.back_missed[CASE_SKIN] > 0.005);
    assert_near(fit_share(&out, CASE_SKIN, GUESS_NONE) + fit_share(&out, CASE_SKIN, GUESS_MISSED) +
                    fit_guessed_share(&out, CASE_SKIN),
                1, 1e-12);
    for (int p = CASE_SKULL; p < CASE_SURFACE_COUNT; p++) { /* not scanned */
        assert_near(fit_guessed_share(&out, (case_surface)p), 1, 0);
        assert_int_equal(out.back[p].vertices, 0);
    }
    target_surface_free(&f.target[CASE_SKIN]);
    head_scan_free(&s);
    head_fit_free(&out);
}

/* A bag in the head, as a sinus is: its far wall looks as the skin before it does, but stands behind a wall. */
static void a_cavity_of_the_scan_is_not_what_the_template_stands_for(void **state)
{
    (void)state;
    surface skin = surface_copy(&t.part[CASE_SKIN]), bag = surface_copy(&t.part[CASE_SKIN]);
    double *normal = surface_vertex_normals(&skin);
    for (size_t v = 0; v < (size_t)skin.vertex_count; v++)
        vec_axpy(bag.xyz + 3 * v, -9, normal + 3 * v, bag.xyz + 3 * v);
    head_scan s = {.part = {[CASE_SKIN] = surface_joined(&skin, &bag)}};
    fit_state f = {.t = &t, .target = {[CASE_SKIN] = target_surface_make(&s.part[CASE_SKIN])}};
    head_fit out = {0};
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) f.at[p] = t.part[p];
    fit_measure_part(&f, &s, CASE_SKIN, &out);
    print_message("%d of %d covered, %.2f mm in the mean\n", out.back[CASE_SKIN].with_target,
                  out.back[CASE_SKIN].vertices, out.back[CASE_SKIN].mean_mm);
    assert_true(out.back[CASE_SKIN].mean_mm < 0.3 && out.back_missed[CASE_SKIN] < 0.05);
    target_surface_free(&f.target[CASE_SKIN]);
    head_scan_free(&s);
    surface_free(&skin);
    surface_free(&bag);
    free(normal);
    head_fit_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_swollen_cheek_is_missed_and_a_neck_is_guessed),
        cmocka_unit_test(a_cavity_of_the_scan_is_not_what_the_template_stands_for),
    };
    return cmocka_run_group_tests(tests, open_template, close_template);
}
