/* A fit written and read again: the template's own shape, moved. Needs the template of heads. */
#include "tests/check.h"
#include "tests/planner/with_template.h"
#include "app/planner/identity/fit_file.h"
#include "app/planner/identity/fit_record.h"
#include "app/planner/store/pack_file.h"
#include "geometry/mem.h"
#include <string.h>
#include <unistd.h>

static head_fit f;

static int open_it(void **state)
{
    err e = {0};
    if (open_template(state)) return -1;
    f = (head_fit){.shape = head_shape_of(&t), .min_j = 0.5, .iterations = 7, .factorisations = 3, .total_s = 12.5};
    f.place = (head_place){.motion = rigid_translation((double[]){1, 2, 3}), .scale = 1.02, .by_landmarks = true};
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        int32_t n = t.part[p].vertex_count;
        f.gap_mm[p] = NEW_ARRAY(double, n);
        f.guessed[p] = NEW_ARRAY(uint8_t, n);
        for (int32_t v = 0; v < n; v++) {
            f.guessed[p][v] = v % 4 == 0;
            f.gap_mm[p][v] = v % 4 ? 0.001 * v : (double)NAN;
        }
        f.back_missed[p] = 0.125;
        f.back[p] = (registration_gaps){.vertices = 7, .with_target = 5, .max_mm = 9};
        f.gaps[p] = (registration_gaps){
            .vertices = n, .with_target = n - (n + 3) / 4, .mean_mm = 0.25, .p95_mm = 1, .max_mm = 3};
    }
    return !head_fit_write(&t, &f, "fit.pack", &e);
}

static int close_it(void **state)
{
    head_fit_free(&f);
    close_template(state);
    return unlink("fit.pack");
}

static void comes_back_as_it_was(void **state)
{
    (void)state;
    err e = {0};
    head_fit g = {0};
    assert_ok(head_fit_read(&t, "fit.pack", &g, &e));
    assert_memory_equal(g.place.motion.t, f.place.motion.t, sizeof f.place.motion.t);
    assert_true(g.place.scale == f.place.scale && g.place.by_landmarks && g.min_j == f.min_j);
    assert_true(g.iterations == 7 && g.factorisations == 3 && g.total_s == f.total_s && g.inverted_tets == 0);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        size_t n = (size_t)t.part[p].vertex_count;
        assert_memory_equal(g.shape.part[p], f.shape.part[p], 3 * n * sizeof(double));
        assert_memory_equal(g.gap_mm[p], f.gap_mm[p], n * sizeof(double));
        assert_memory_equal(g.guessed[p], f.guessed[p], n);
        assert_int_equal(g.gaps[p].with_target, f.gaps[p].with_target);
        assert_true(g.gaps[p].p95_mm == 1 && g.gaps[p].max_mm == 3);
        assert_true(g.back[p].with_target == 5 && g.back[p].max_mm == 9 && g.back_missed[p] == 0.125);
    }
    assert_memory_equal(g.shape.rest, f.shape.rest, 3 * (size_t)t.tissue.mesh.vertex_count * sizeof(double));
    assert_memory_equal(g.shape.neutral, f.shape.neutral, 3 * (size_t)t.tissue.mesh.vertex_count * sizeof(double));
    head_fit_free(&g);
}

static void refuse_changed(const char *entry, size_t at, const void *bytes, size_t size)
{
    err e = {0};
    pack_file p = {0};
    head_fit none = {0};
    assert_ok(pack_read("fit.pack", &p, &e));
    for (int i = 0; i < p.count; i++)
        if (!strcmp(p.entry[i].name, entry)) memcpy((char *)p.entry[i].bytes + at, bytes, size);
    assert_ok(pack_write(&p, "changed.pack", &e));
    assert_refused(head_fit_read(&t, "changed.pack", &none, &e), ERR_INPUT);
    pack_free(&p);
    unlink("changed.pack");
}

static void other_and_damaged_fits_are_refused(void **state)
{
    (void)state;
    double nan = (double)NAN, huge = 1e300;
    refuse_changed("numbering", 3, "x", 1);
    refuse_changed("skin.xyz", 24, &nan, sizeof nan);
    refuse_changed("node.neutral", 8, &nan, sizeof nan);
    refuse_changed("node.rest", 8, &nan, sizeof nan);
    refuse_changed("numbers", 8 * 17, &huge, sizeof huge); /* vertices of the skin */
    err e = {0};
    head_fit none = {0};
    assert_refused(head_fit_read(&t, getenv("GNATHOS_TEMPLATE"), &none, &e), ERR_INPUT);
    assert_refused(head_fit_read(&t, "absent.pack", &none, &e), ERR_INPUT);
}

static void landmarks_over_nothing_are_guessed(void **state)
{
    (void)state;
    const fit_record r = {.head = &t, .fit = &f};
    int guessed = 0;
    for (int32_t i = 0; i < t.point_count; i++) {
        const head_point *p = &t.point[i];
        bool expected = false;
        for (int k = 0; k < 3 && p->triangle >= 0; k++)
            expected = expected || t.part[p->part].tri[3 * p->triangle + k] % 4 == 0;
        assert_int_equal(fit_point_is_guessed(&r, p), expected);
        guessed += expected;
    }
    assert_in_range(guessed, 1, t.point_count - 1);
    assert_near(fit_guessed_share(&f, CASE_SKIN), 0.25, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back_as_it_was),
        cmocka_unit_test(other_and_damaged_fits_are_refused),
        cmocka_unit_test(landmarks_over_nothing_are_guessed),
    };
    return cmocka_run_group_tests(tests, open_it, close_it);
}
