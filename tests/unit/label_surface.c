/* From label maps to surfaces: masks by hand counts, surfaces by the volume of a ball. */
#include "tests/check.h"
#include "geometry/label_surface.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <string.h>

static mask box_mask(int n)
{
    const int32_t size[3] = {n, n, n};
    return mask_new(size);
}

static uint8_t *at(mask *m, int i, int j, int k) { return m->on + ((int64_t)k * m->size[1] + j) * m->size[0] + i; }

static void fill(mask *m, const int low[3], const int high[3], uint8_t value)
{
    for (int k = low[2]; k <= high[2]; k++)
        for (int j = low[1]; j <= high[1]; j++)
            for (int i = low[0]; i <= high[0]; i++) *at(m, i, j, k) = value;
}

static void islands_cavities_and_contacts_are_counted(void **state)
{
    (void)state;
    mask m = box_mask(12);
    fill(&m, (const int[3]){1, 1, 1}, (const int[3]){5, 5, 5}, 1);
    *at(&m, 3, 3, 3) = 0; /* a cavity */
    *at(&m, 6, 6, 6) = 1; /* touches at a corner: the same component of 26 neighbours, another of 6 */
    fill(&m, (const int[3]){9, 9, 9}, (const int[3]){10, 9, 9}, 1);
    int64_t dropped;
    assert_int_equal(mask_drop_islands(&m, 3, &dropped), 1);
    assert_int_equal(dropped, 2);
    assert_int_equal(mask_count(&m), 125);
    assert_int_equal(mask_keep_largest(&m), 1);
    assert_int_equal(mask_count(&m), 124);
    assert_int_equal(mask_fill_cavities(&m), 1);
    assert_int_equal(mask_count(&m), 125);
    mask other = box_mask(12);
    fill(&other, (const int[3]){6, 0, 0}, (const int[3]){7, 3, 11}, 1);
    assert_int_equal(mask_contacts(&m, &other), 15);
    int32_t low[3], high[3];
    assert_true(mask_bounds(&other, low, high));
    assert_int_equal(low[0], 6);
    assert_int_equal(high[2], 11);
    mask_free(&m);
    mask_free(&other);
}

static void sealing_closes_narrow_openings_only(void **state)
{
    (void)state;
    volume grid = {.step = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int wide = 0; wide < 2; wide++) {
        mask m = box_mask(40);
        fill(&m, (const int[3]){5, 5, 0}, (const int[3]){34, 34, 39}, 1);
        fill(&m, (const int[3]){12, 12, 10}, (const int[3]){28, 28, 30}, 0); /* a chamber */
        int half = wide ? 5 : 1;                                             /* a nostril of 11 or 3 mm */
        fill(&m, (const int[3]){20 - half, 5, 20 - half}, (const int[3]){20 + half, 11, 20 + half}, 0);
        mask_seal(&m, &grid, 3);
        assert_int_equal(*at(&m, 20, 20, 20), !wide);
        assert_int_equal(*at(&m, 20, 8, 20), !wide);
        assert_int_equal(*at(&m, 2, 20, 20), 0);
        /* a tube to the upper face is sealed too: the head goes on there */
        assert_int_equal(*at(&m, 5, 5, 39), 1);
        mask_free(&m);
    }
}

/* A ball of radius 20 mm, cut in two halves (labels 1 and 2), in a turned grid of 0.9 x 1.1 x 2 mm voxels. */
static volume ball_volume(void)
{
    const double c = cos(0.4), s = sin(0.4);
    volume v = {.size = {64, 56, 32}, .layers = 1};
    const double step[3][3] = {{0.9 * c, 0.9 * s, 0}, {-1.1 * s, 1.1 * c, 0}, {0, 0, 2}};
    memcpy(v.step, step, sizeof step);
    for (int a = 0; a < 3; a++) vec_axpy(v.origin, -v.size[a] / 2.0, step[a], v.origin);
    v.value = NEW_ARRAY(int16_t, 64 * 56 * 32);
    for (int k = 0; k < v.size[2]; k++)
        for (int j = 0; j < v.size[1]; j++)
            for (int i = 0; i < v.size[0]; i++) {
                double p[3];
                vec_copy(v.origin, p);
                vec_axpy(p, i, v.step[0], p);
                vec_axpy(p, j, v.step[1], p);
                vec_axpy(p, k, v.step[2], p);
                if (vec_norm(p) < 20) v.value[(k * v.size[1] + j) * v.size[0] + i] = p[0] < 0.3 ? 1 : 2;
            }
    return v;
}

static void a_ball_comes_out_closed_round_and_of_its_volume(void **state)
{
    (void)state;
    err e = {0};
    const double pi = 3.14159265358979;
    volume v = ball_volume();
    mask ball = mask_new(v.size);
    mask_add_label(&ball, &v, 1, 0);
    mask_add_label(&ball, &v, 2, 0);
    label_surface_params p = label_surface_params_default();
    label_fields *f = label_fields_create(&v, &ball, 1, p.sigma_voxels);
    surface s, again;
    int32_t open, crowded;
    assert_ok(label_surface_make(f, 0, &p, &s, NULL, &e));
    assert_ok(surface_check(&s, &e));
    surface_edge_census(&s, &open, &crowded);
    assert_int_equal(open, 0);
    assert_int_equal(crowded, 0);
    assert_near(surface_volume(&s), 4 * pi / 3 * 8000, 0.02 * 4 * pi / 3 * 8000);
    for (int32_t i = 0; i < s.vertex_count; i++) assert_near(vec_norm(s.xyz + 3 * i), 20, 1);
    assert_ok(label_surface_make(f, 0, &p, &again, NULL, &e));
    assert_int_equal(again.vertex_count, s.vertex_count);
    assert_memory_equal(again.xyz, s.xyz, 3 * (size_t)s.vertex_count * sizeof *s.xyz);
    print_message("ball: %d triangles, volume %.0f of %.0f mm^3\n", s.triangle_count, surface_volume(&s),
                  4 * pi / 3 * 8000);
    surface_free(&s);
    surface_free(&again);
    label_fields_destroy(&f);
    mask_free(&ball);
    volume_free(&v);
}

static void two_touching_parts_share_the_space_without_overlap(void **state)
{
    (void)state;
    volume v = ball_volume();
    mask half[3] = {mask_new(v.size), mask_new(v.size), mask_new(v.size)};
    mask_add_label(&half[0], &v, 1, 0);
    mask_add_label(&half[1], &v, 2, 0);
    label_fields *f = label_fields_create(&v, half, 3, 0.7);
    assert_int_equal(label_fields_at(f, (const double[3]){-8, 1, 2}), 0);
    assert_int_equal(label_fields_at(f, (const double[3]){8, 1, 2}), 1);
    assert_int_equal(label_fields_at(f, (const double[3]){30, 1, 2}), -1);
    assert_int_equal(label_fields_at(f, (const double[3]){1e9, 1, 2}), -1);
    int changes = 0, before = 0;
    for (double x = -19; x < 19; x += 0.05) {
        int now = label_fields_at(f, (const double[3]){x, 3, 1});
        assert_in_range(now, 0, 1); /* no gap between them */
        changes += now != before;
        before = now;
    }
    assert_int_equal(changes, 1);
    err e = {0};
    surface s;
    label_surface_params p = label_surface_params_default();
    assert_refused(label_surface_make(f, 2, &p, &s, NULL, &e), ERR_GEOMETRY);
    label_fields_destroy(&f);
    for (int i = 0; i < 3; i++) mask_free(&half[i]);
    volume_free(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(islands_cavities_and_contacts_are_counted),
        cmocka_unit_test(sealing_closes_narrow_openings_only),
        cmocka_unit_test(a_ball_comes_out_closed_round_and_of_its_volume),
        cmocka_unit_test(two_touching_parts_share_the_space_without_overlap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
