#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "geometry/mesh_file.h"
#include "geometry/repair.h"
#include "geometry/vec.h"

/* Repairs and frees s; checks what every result promises. */
static surface repaired(surface s, repair_report *r)
{
    err e = {0};
    surface out;
    repair_params p = repair_params_default();
    int32_t open, crowded, crossings;
    assert_ok(repair_solid(&s, &p, &out, r, &e));
    surface_edge_census(&out, &open, &crowded);
    assert_int_equal(open, 0);
    assert_int_equal(crowded, 0);
    assert_ok(repair_count_self_intersections(&out, 10, &crossings, &e));
    assert_int_equal(crossings, 0);
    assert_true(surface_volume(&out) > 0);
    surface_free(&s);
    return out;
}

static void a_sound_body_is_not_touched(void **state)
{
    (void)state;
    repair_report r;
    surface ball = body_ball(1, 2, 3, 20, 30), copy = surface_copy(&ball), out = repaired(ball, &r);
    assert_int_equal(out.vertex_count, copy.vertex_count);
    assert_memory_equal(out.xyz, copy.xyz, 3 * (size_t)out.vertex_count * sizeof *out.xyz);
    assert_true(r.max_deviation_mm < 1e-12);
    assert_false(r.wrapped || r.flipped);
    surface_free(&copy);
    surface_free(&out);
}

static void a_soup_is_welded_and_turned_outward(void **state)
{
    (void)state;
    surface box = body_box(0, 0, 0, 3, 4, 5), soup = surface_new(36, 12);
    for (int i = 0; i < 36; i++) {
        memcpy(soup.xyz + 3 * i, box.xyz + 3 * box.tri[i], 3 * sizeof(double));
        soup.tri[i] = i;
    }
    surface_flip(&soup);
    repair_report r;
    surface out = repaired(soup, &r);
    assert_int_equal(out.vertex_count, 8);
    assert_int_equal(r.welded_vertices, 28);
    assert_true(r.flipped);
    assert_near(surface_volume(&out), 60, 1e-12);
    surface_free(&box);
    surface_free(&out);
}

static void a_missing_face_is_filled(void **state)
{
    (void)state;
    surface box = body_box(0, 0, 0, 30, 40, 50);
    box.triangle_count -= 2;
    repair_report r;
    surface out = repaired(box, &r);
    assert_int_equal(r.boundary_loops, 1);
    assert_int_equal(r.holes_filled, 1);
    assert_near(r.widest_hole_mm, hypot(40, 50), 1e-9);
    assert_near(surface_volume(&out), 60000, 1e-6);
    surface_free(&out);
}

static void a_cavity_is_turned_inward(void **state)
{
    (void)state;
    repair_report r;
    surface out = repaired(body_with(body_box(0, 0, 0, 10, 10, 10), body_box(2, 2, 2, 5, 5, 5)), &r);
    assert_near(surface_volume(&out), 1000 - 27, 1e-9);
    surface_free(&out);
}

static void crumbs_are_dropped_and_counted(void **state)
{
    (void)state;
    repair_report r;
    surface out = repaired(body_with(body_box(0, 0, 0, 10, 10, 10), body_box(20, 0, 0, 20.1, 0.1, 0.1)), &r);
    assert_int_equal(r.components_found, 2);
    assert_int_equal(r.components_dropped, 1);
    assert_near(r.dropped_area_mm2, 0.06, 1e-12);
    assert_near(surface_volume(&out), 1000, 1e-9);
    surface_free(&out);
}

static void bodies_that_touch_in_a_point_or_an_edge_are_parted(void **state)
{
    (void)state;
    repair_report r;
    surface out = repaired(body_with(body_box(0, 0, 0, 10, 10, 10), body_box(10, 10, 10, 20, 20, 20)), &r);
    assert_near(surface_volume(&out), 2000, 2000 * 0.01);
    assert_true(r.max_deviation_mm <= 0.051);
    surface_free(&out);
    out = repaired(body_with(body_box(0, 0, 0, 10, 10, 10), body_box(10, 10, 0, 20, 20, 10)), &r);
    assert_near(surface_volume(&out), 2000, 2000 * 0.02);
    assert_true(r.max_deviation_mm <= 0.051);
    surface_free(&out);
}

static void a_fold_is_mended_where_it_is(void **state)
{
    (void)state;
    surface ball = body_ball(0, 0, 0, 20, 40), whole = surface_copy(&ball);
    const int32_t v = 2 + 19 * 80 + 7; /* on the equator: pulled out through the other side */
    for (int c = 0; c < 3; c++) ball.xyz[3 * v + c] *= -1.02;
    repair_report r;
    surface out = repaired(ball, &r);
    assert_true(r.self_intersections_found > 0);
    assert_int_equal(r.self_intersections_left, 0);
    assert_false(r.wrapped);
    assert_near(surface_volume(&out), surface_volume(&whole), 0.002 * surface_volume(&whole));
    surface_free(&whole);
    surface_free(&out);
}

static void refuses_empty_and_broken_surfaces(void **state)
{
    (void)state;
    err e = {0};
    repair_params p = repair_params_default();
    surface none = {0}, box = body_box(0, 0, 0, 1, 1, 1), out;
    assert_refused(repair_solid(&none, &p, &out, NULL, &e), ERR_GEOMETRY);
    box.xyz[4] = (double)NAN;
    assert_refused(repair_solid(&box, &p, &out, NULL, &e), ERR_GEOMETRY);
    box.xyz[4] = 0;
    p.wrap_alpha_mm = 0;
    assert_refused(repair_solid(&box, &p, &out, NULL, &e), ERR_INPUT);
    assert_refused(repair_wrap(&box, 1, 0, &out, &e), ERR_INPUT);
    surface_free(&box);
}

static void refuses_what_leaves_nothing(void **state)
{
    (void)state;
    err e = {0};
    repair_params p = repair_params_default();
    surface ball = body_ball(0, 0, 0, 40, 12), loose = surface_new(3 * ball.triangle_count, ball.triangle_count), out;
    uint32_t dice = 1;
    for (int32_t i = 0; i < 3 * ball.triangle_count; i++) {
        for (int c = 0; c < 3; c++) {
            dice = dice * 1664525 + 1013904223;
            loose.xyz[3 * i + c] = ball.xyz[3 * ball.tri[i] + c] + 0.0002 * (dice >> 8) / 16777216.0;
        }
        loose.tri[i] = i;
    }
    assert_refused(repair_solid(&loose, &p, &out, NULL, &e), ERR_GEOMETRY);
    for (int32_t i = 0; i < 3 * ball.triangle_count; i++) vec_copy(ball.xyz, ball.xyz + 3 * (i % ball.vertex_count));
    assert_refused(repair_solid(&ball, &p, &out, NULL, &e), ERR_GEOMETRY); /* all in one place */
    surface_free(&ball);
    surface_free(&loose);
}

static void a_wrap_encloses_its_input(void **state)
{
    (void)state;
    err e = {0};
    surface box = body_box(0, 0, 0, 20, 20, 20), out;
    box.triangle_count -= 1; /* open */
    assert_ok(repair_wrap(&box, 30, 0.5, &out, &e));
    double low[3], high[3];
    surface_bounds(&out, low, high);
    for (int c = 0; c < 3; c++) {
        assert_true(low[c] <= 0 && low[c] > -1);
        assert_true(high[c] >= 20 && high[c] < 21);
    }
    assert_true(surface_volume(&out) >= 8000);
    surface_free(&box);
    surface_free(&out);
}

static void scanned_bones_come_out_solid(void **state)
{
    (void)state;
    static const char *const files[] = {"phantom_head_ct/mandible.ply", "vtk_fullhead_ct/mandible.ply",
                                        "vtk_fullhead_ct/teeth_upper.ply",
                                        "bodyparts3d_skull/bone/right_temporal_bone.ply"};
    for (int i = 0; i < 4; i++) {
        char path[512];
        err e = {0};
        surface s;
        repair_report r;
        snprintf(path, sizeof path, "%s/%s", getenv("GNATHOS_DATA") ? getenv("GNATHOS_DATA") : "../shared/data",
                 files[i]);
        FILE *there = fopen(path, "rb");
        if (!there) {
            print_message("skipped: %s is not there\n", path);
            skip();
        }
        fclose(there);
        assert_ok(mesh_read_surface(path, MESH_SPACE_FROM_FILE, &s, NULL, &e));
        double before = surface_volume(&s);
        surface out = repaired(s, &r);
        assert_false(r.wrapped);
        assert_true(r.max_deviation_mm < 0.1);
        assert_near(surface_volume(&out), before, 1e-4 * before);
        surface_free(&out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_body_is_not_touched),
        cmocka_unit_test(a_soup_is_welded_and_turned_outward),
        cmocka_unit_test(a_missing_face_is_filled),
        cmocka_unit_test(a_cavity_is_turned_inward),
        cmocka_unit_test(crumbs_are_dropped_and_counted),
        cmocka_unit_test(bodies_that_touch_in_a_point_or_an_edge_are_parted),
        cmocka_unit_test(a_fold_is_mended_where_it_is),
        cmocka_unit_test(refuses_empty_and_broken_surfaces),
        cmocka_unit_test(refuses_what_leaves_nothing),
        cmocka_unit_test(a_wrap_encloses_its_input),
        cmocka_unit_test(scanned_bones_come_out_solid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
