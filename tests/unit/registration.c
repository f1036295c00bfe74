/* Elastic bodies drawn onto surfaces whose shape is known. */
#include "tests/check.h"
#include "geometry/lattice.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "sim/registration.h"
#include "tests/unit/sphere.h"
#include <string.h>

typedef struct ball {
    surface moving;
    tetmesh body;
    embedding carried;
} ball;

static void make_ball(ball *b)
{
    err e = {0};
    b->moving = sphere((double[]){0, 0, 0}, 40, 20);
    const surface *list[] = {&b->moving};
    assert_ok(lattice_cover(list, 1, 12, 0, &b->body, &e));
    b->carried = embed_points(&b->body, b->moving.xyz, b->moving.vertex_count, 1, NULL, NULL);
}

static void free_ball(ball *b)
{
    surface_free(&b->moving);
    tetmesh_free(&b->body);
    embedding_free(&b->carried);
}

static registration draw_as(const ball *b, const surface *onto, const uint8_t *mute,
                            const registration_anchors *anchors, const registration_params *params)
{
    err e = {0};
    registration r;
    target_surface *target = target_surface_make(onto);
    registration_part part = {&b->moving, &b->carried, target, mute, 1};
    registration_problem problem = {.body = &b->body, .part_count = 1, .part = &part, .anchors = anchors};
    assert_ok(registration_run(&problem, params, &r, &e));
    target_surface_free(&target);
    print_message(
        "%d rounds, %d factorisations, %.2f s; %d of %d vertices %.3f mm (95 %% %.3f, most %.3f), min J %.2f\n",
        r.rounds, r.factorisations, r.total_s, r.gaps->with_target, r.gaps->vertices, r.gaps->mean_mm, r.gaps->p95_mm,
        r.gaps->max_mm, r.min_j);
    return r;
}

static registration draw(const ball *b, const surface *onto, const uint8_t *mute, const registration_anchors *anchors)
{
    registration_params params = registration_params_default();
    return draw_as(b, onto, mute, anchors, &params);
}

static surface carried_surface(const ball *b, const registration *r)
{
    surface out = surface_copy(&b->moving);
    double *u = NEW_ARRAY(double, 3 * (size_t)b->body.vertex_count);
    for (size_t i = 0; i < 3 * (size_t)b->body.vertex_count; i++) u[i] = r->xyz[i] - b->body.xyz[i];
    embedding_apply(&b->carried, &b->body, u, b->moving.xyz, out.xyz);
    free(u);
    return out;
}

static void a_body_that_fits_stays(void **state)
{
    (void)state;
    ball b;
    make_ball(&b);
    registration r = draw(&b, &b.moving, NULL, NULL);
    for (size_t i = 0; i < 3 * (size_t)b.body.vertex_count; i++) assert_near(r.xyz[i], b.body.xyz[i], 1e-9);
    assert_int_equal(r.gaps->with_target, b.moving.vertex_count);
    registration_free(&r);
    free_ball(&b);
}

/* 15 mm longer one way and 12 mm shorter another, shifted and with a bump. */
static void a_ball_is_drawn_onto_an_egg(void **state)
{
    (void)state;
    ball b;
    make_ball(&b);
    surface egg = sphere((double[]){0, 0, 0}, 40, 40);
    for (size_t v = 0; v < (size_t)egg.vertex_count; v++) {
        double *x = egg.xyz + 3 * v, bump = 6 * exp(-((x[0] - 30) * (x[0] - 30) + (x[1] - 20) * (x[1] - 20)) / 300);
        x[2] *= 1.375;
        x[1] *= 0.7;
        x[0] += 5 + (x[0] > 0 ? bump : 0);
    }
    registration r = draw(&b, &egg, NULL, NULL);
    assert_true(r.gaps->with_target > 0.99 * r.gaps->vertices);
    assert_true(r.gaps->mean_mm < 0.1 && r.gaps->p95_mm < 0.3);
    assert_true(r.min_j > 0.1 && r.inverted_tets == 0);
    registration_free(&r);
    surface_free(&egg);
    free_ball(&b);
}

static void what_the_target_lacks_is_not_drawn_and_follows(void **state)
{
    (void)state;
    ball b;
    make_ball(&b);
    surface large = sphere((double[]){5, -4, -6}, 40, 30);
    uint8_t *keep = NEW_ARRAY(uint8_t, large.triangle_count);
    for (size_t t = 0; t < (size_t)large.triangle_count; t++) {
        double top = -HUGE_VAL;
        for (int k = 0; k < 3; k++) top = fmax(top, large.xyz[3 * large.tri[3 * t + k] + 2]);
        keep[t] = top < 9;
    }
    surface open = surface_select(&large, keep);
    registration r = draw(&b, &open, NULL, NULL);
    surface got = carried_surface(&b, &r);
    assert_true(r.gaps->with_target < 0.75 * r.gaps->vertices && r.gaps->with_target > 0.5 * r.gaps->vertices);
    double low = 0, high = 0; /* worst where the target is, and above it */
    for (size_t v = 0; v < (size_t)got.vertex_count; v++) {
        double *most = b.moving.xyz[3 * v + 2] < 0 ? &low : &high;
        *most = fmax(*most, fabs(vec_distance(got.xyz + 3 * v, (double[]){5, -4, -6}) - 40));
    }
    print_message("off by %.2f mm, and %.2f mm where there is none\n", low, high);
    assert_true(low < 0.2 && high < 0.5);
    surface_free(&got);
    surface_free(&open);
    surface_free(&large);
    free(keep);
    registration_free(&r);
    free_ball(&b);
}

static void anchors_bring_points_to_their_places(void **state)
{
    (void)state;
    ball b;
    make_ball(&b);
    rigid turn = rigid_rotation((double[]){0, 0, 0}, (double[]){0, 0, 1}, 0.4);
    int32_t count = b.moving.vertex_count;
    double *place = NEW_ARRAY(double, 3 * (size_t)count);
    for (size_t v = 0; v < (size_t)count; v++) rigid_apply(&turn, b.moving.xyz + 3 * v, place + 3 * v);
    registration_anchors anchors = {&b.carried, place, 20};
    uint8_t *mute = NEW_ARRAY(uint8_t, count);
    memset(mute, 1, (size_t)count);
    registration r = draw(&b, &b.moving, mute, &anchors);
    surface got = carried_surface(&b, &r);
    for (size_t v = 0; v < (size_t)count; v++) assert_true(vec_distance(got.xyz + 3 * v, place + 3 * v) < 1e-4);
    surface_free(&got);
    free(place);
    free(mute);
    registration_free(&r);
    free_ball(&b);
}

static void springs_give_way_where_tets_get_too_small(void **state)
{
    (void)state;
    ball b;
    make_ball(&b);
    surface small = sphere((double[]){0, 0, 0}, 35, 20);
    registration_params params = registration_params_default();
    params.min_j = 0;
    registration plain = draw_as(&b, &small, NULL, NULL, &params);
    assert_true(plain.min_j < 0.72 && plain.given_way == 0);
    params.min_j = 0.75;
    registration r = draw_as(&b, &small, NULL, NULL, &params);
    print_message("%d springs gave way\n", r.given_way);
    assert_true(r.given_way > 0 && r.min_j > 0.74);
    assert_true(r.gaps->mean_mm > plain.gaps->mean_mm + 0.1);
    registration_free(&plain);
    registration_free(&r);
    surface_free(&small);
    free_ball(&b);
}

static double asked(const target_surface *t, double x, double y, double z)
{
    static const target_rules near = {5, 0.3};
    double p[3] = {x, y, z}, n[3] = {x, y, z};
    target_point hit;
    vec_normalize(n);
    return target_surface_ask(t, p, n, &near, &hit);
}

/* Most of the cut is as rough as a scan's. */
static void where_a_scan_was_cut_it_might_go_on(void **state)
{
    (void)state;
    surface whole = sphere((double[]){0, 0, 0}, 40, 96), cut = surface_copy(&whole);
    for (size_t v = 0; v < (size_t)cut.vertex_count; v++) {
        double *x = cut.xyz + 3 * v;
        if (x[2] > 30) x[2] = 30 + (x[0] > -17 ? 0.04 * (double)(v % 2) : 0);
    }
    target_surface *of_whole = target_surface_make(&whole), *of_cut = target_surface_make(&cut);
    assert_near(asked(of_whole, 0, 0, 42), 2, 0.1);
    assert_near(asked(of_cut, 42, 0, 0), 2, 0.1);
    assert_near(asked(of_cut, 40 * 0.8, 0, 40 * 0.65), 1.23, 0.1); /* not far from the edge */
    assert_true(asked(of_cut, -10, 0, 33) == HUGE_VAL);
    assert_true(asked(of_cut, 10, 0, 33) == HUGE_VAL);
    assert_true(asked(of_cut, 28.2, 0, 31.1) == HUGE_VAL); /* above the edge */
    target_surface_free(&of_whole);
    target_surface_free(&of_cut);
    surface_free(&whole);
    surface_free(&cut);
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    const int threads[] = {1, 2, 3, 8};
    registration first = {0};
    ball b;
    make_ball(&b);
    surface large = sphere((double[]){2, 1, 0}, 45, 16);
    for (int k = 0; k < 4; k++) {
        parallel_set_threads(threads[k]);
        registration r = draw(&b, &large, NULL, NULL);
        if (k > 0) assert_memory_equal(r.xyz, first.xyz, 3 * (size_t)b.body.vertex_count * sizeof *r.xyz);
        if (k == 0)
            first = r;
        else
            registration_free(&r);
    }
    parallel_set_threads(0);
    registration_free(&first);
    surface_free(&large);
    free_ball(&b);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    err e = {0};
    registration r;
    ball b;
    make_ball(&b);
    registration_part part = {&b.moving, &b.carried, NULL, NULL, 1};
    registration_problem problem = {.body = &b.body, .part_count = 1, .part = &part};
    registration_params params = registration_params_default();
    assert_refused(registration_run(&problem, &params, &r, &e), ERR_GEOMETRY);
    params.stages = 0;
    assert_refused(registration_run(&problem, &params, &r, &e), ERR_INPUT);
    params = registration_params_default();
    params.across = 0;
    assert_refused(registration_run(&problem, &params, &r, &e), ERR_INPUT);
    free_ball(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(where_a_scan_was_cut_it_might_go_on),
        cmocka_unit_test(a_body_that_fits_stays),
        cmocka_unit_test(a_ball_is_drawn_onto_an_egg),
        cmocka_unit_test(what_the_target_lacks_is_not_drawn_and_follows),
        cmocka_unit_test(anchors_bring_points_to_their_places),
        cmocka_unit_test(springs_give_way_where_tets_get_too_small),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
