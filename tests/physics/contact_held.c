/* Tissue that keeps in touch with bones of known shape: it slides along their surface and enters none. */
#include "tests/check.h"
#include "app/stress/shapes.h"
#include "geometry/parallel.h"
#include "sim/src/contact/contact_state.h"
#include "tests/physics/setting.h"
#include <string.h>

/* The same level, but a gradient whose length grows with the distance. */
static double ball_squared(const void *context, const double x[3], double grad[3], double *hess)
{
    const known_bone *b = context;
    double r[3];
    vec_sub(x, b->at, r);
    vec_scale(r, 1 / b->size, grad);
    for (int i = 0; hess && i < 9; i++) hess[i] = (i % 4 == 0) / b->size;
    return (vec_dot(r, r) - b->size * b->size) / (2 * b->size);
}

/* A shell of tissue 6 mm thick on a ball of the cranium, its outside tied to the maxilla. */
static void shell_on_ball(setting *s, const known_bone *b)
{
    block cells = {5, 5, 3, {20, 20, 6}, 5, 0};
    *s = (setting){.mesh = block_mesh(&cells), .table = tissue_material(MATERIAL_SNH_LOG, 15, 0.45)};
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        double *x = s->mesh.xyz + 3 * (size_t)v, n[3] = {x[0] - 10, x[1] - 10, b->size}, height = x[2];
        vec_normalize(n);
        vec_axpy(b->at, b->size + height, n, x);
        if (height == 6) tie(&s->attach, v, SEGMENT_MAXILLA);
        if (height != 0) continue;
        s->attach.kind[v] = NODE_SLIDING;
        s->attach.segment[v] = SEGMENT_CRANIUM;
        vec_copy(n, s->attach.normal + 3 * (size_t)v);
    }
    wire(s);
}

static contact_setup held_by(const bone_shape *cranium, const bone_shape *maxilla)
{
    contact_setup c = {.params = contact_params_default(), .held = true};
    c.shape[SEGMENT_CRANIUM] = cranium;
    c.shape[SEGMENT_MAXILLA] = maxilla;
    return c;
}

static void a_shell_turns_on_a_ball_as_one_piece(void **state)
{
    (void)state;
    known_bone b = {KNOWN_BALL, {5, -3, 2}, 30, 0};
    bone_shape shape = known_shape(&b);
    contact_setup touch = held_by(&shape, NULL);
    setting s;
    shell_on_ball(&s, &b);
    rigid turn = rigid_rotation(b.at, (double[]){1 / sqrt(5), 2 / sqrt(5), 0}, 0.3);
    s.problem.motion[SEGMENT_MAXILLA] = turn;
    solve_params params = solve_params_default();
    for (int with = 0; with < 2; with++) {
        s.problem.contact = with ? &touch : NULL;
        equilibrium q = solve(&s, &params);
        double worst = 0;
        assert_int_equal(q.outcome, SOLVED);
        for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
            double want[3];
            rigid_apply(&turn, s.mesh.xyz + 3 * (size_t)v, want);
            worst = fmax(worst, vec_distance(want, q.xyz + 3 * (size_t)v));
        }
        printf("%s: off by %.1e mm, %.3g uJ, %d iterations\n", with ? "on the ball" : "on tangent planes", worst,
               q.energy_uj, q.iterations);
        if (with) { /* a move of 9 mm on the ball: nothing is strained */
            assert_near(worst, 0, 1e-4);
            assert_near(q.energy_uj, 0, 1e-6);
            assert_true(q.contact.held && q.contact.slide_off_mm < 1e-4 && q.iterations < 20);
        } else
            assert_true(worst > 0.5);
        equilibrium_free(&q);
    }
    tear_down(&s);
}

/* Of a linear energy F.x along the surface: all its second derivative is the surface's bend. */
static void the_bend_of_a_level_is_in_the_stiffness(void **state)
{
    (void)state;
    err e = {0};
    known_bone b = {KNOWN_BALL, {5, -3, 2}, 30, 0};
    bone_shape shape = {.context = &b, .distance = ball_squared};
    contact_setup touch = held_by(&shape, NULL);
    setting s;
    contact *c = NULL;
    elements el;
    boundary bound;
    assembly a;
    shell_on_ball(&s, &b);
    size_t n = 3 * (size_t)s.mesh.vertex_count;
    double *force = NEW_ARRAY(double, n), *w = NEW_ARRAY(double, n), *at = NEW_ARRAY(double, n), side[3], h = 1e-3,
           want = 0;
    assert_ok(contact_make(&s.mesh, &s.attach, &touch, 15, &c, &e));
    assert_ok(elements_make(&s.mesh, &s.table, 1, &el, &e));
    assert_ok(boundary_make(&s.mesh, &s.attach, &bound, &e));
    assert_ok(assembly_make(&s.mesh, &el, &bound, NULL, 0, &a, &e));
    rigid guide = rigid_identity();
    contact_move(c, s.problem.motion, &guide, s.mesh.xyz);
    contact_refresh(c, s.mesh.xyz);
    contact_energy(c, s.mesh.xyz, NULL);
    uint64_t seed = 4;
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
        double *d = w + 3 * (size_t)v, *normal = s.attach.normal + 3 * (size_t)v;
        if (s.attach.kind[v] != NODE_SLIDING) continue;
        for (int k = 0; k < 3; k++) d[k] = block_random(&seed), force[3 * v + k] = block_random(&seed);
        vec_axpy(d, -vec_dot(d, normal), normal, d);
    }
    for (int k = -1; k <= 1; k++) {
        for (size_t i = 0; i < n; i++) at[i] = s.mesh.xyz[i] + k * h * w[i];
        for (int again = 0; again < 4; again++) contact_retract(c, &s.attach, at);
        side[k + 1] = 0;
        for (size_t i = 0; i < n; i++) side[k + 1] += force[i] * (at[i] - s.mesh.xyz[i]);
    }
    contact_stiffness(c, s.mesh.xyz, force, true, &a);
    assembly_multiply(&a, w, at);
    for (size_t i = 0; i < n; i++) want += w[i] * at[i];
    printf("second derivative along the ball %.8g, by differences %.8g\n", want,
           (side[0] - 2 * side[1] + side[2]) / (h * h));
    assert_near((side[0] - 2 * side[1] + side[2]) / (h * h), want, 1e-5 * fabs(want));
    assembly_free(&a);
    boundary_free(&bound);
    elements_free(&el);
    contact_destroy(&c);
    free(force);
    free(w);
    free(at);
    tear_down(&s);
}

/* A block that hangs from the cranium; its bottom is free. */
static void hanging_block(setting *s, int32_t **bottom, int32_t *count)
{
    block cells = {6, 6, 4, {18, 18, 12}, 6, 0.1};
    *s = (setting){.mesh = block_mesh(&cells), .table = tissue_material(MATERIAL_SNH_LOG, 15, 0.45)};
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    *bottom = NEW_ARRAY(int32_t, s->mesh.vertex_count);
    *count = 0;
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        if (s->mesh.xyz[3 * (size_t)v + 2] == 12) tie(&s->attach, v, SEGMENT_CRANIUM);
        if (s->mesh.xyz[3 * (size_t)v + 2] == 0) (*bottom)[(*count)++] = v;
    }
    wire(s);
}

typedef struct ball_below {
    bone_shape shape;
    contact_setup touch;
    int32_t *bottom;
} ball_below;

/* The block over a ball of the maxilla; *out is not to be moved, and its bottom is the caller's to free. */
static void hang_over_ball(setting *s, const known_bone *b, ball_below *out)
{
    out->shape = known_shape(b);
    out->touch = held_by(NULL, &out->shape);
    hanging_block(s, &out->bottom, &out->touch.extra_count);
    out->touch.extra = out->bottom;
}

static void a_ball_pressed_into_tissue_stays_out_of_it_and_its_work_is_the_energy(void **state)
{
    (void)state;
    known_bone b = {KNOWN_BALL, {9, 8, -11}, 10, 0};
    setting s;
    ball_below under;
    hang_over_ball(&s, &b, &under);
    s.problem.contact = &under.touch;
    solve_params params = solve_params_default();
    double energy[3], force = 0, h = 0.02;
    for (int k = -1; k <= 1; k++) {
        s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, 4 + k * h});
        equilibrium q = solve(&s, &params);
        assert_int_equal(q.outcome, SOLVED);
        energy[k + 1] = q.energy_uj;
        if (k) {
            equilibrium_free(&q);
            continue;
        }
        force = q.segment_force_mn[SEGMENT_MAXILLA][2]; /* of the bone on the tissue */
        assert_true(q.imbalance < 1e-6 && q.contact.active_nodes > 3 && q.contact.depth_mm < 0.1);
        for (int32_t i = 0; i < under.touch.extra_count; i++) {
            double x[3], grad[3];
            vec_sub(q.xyz + 3 * (size_t)under.bottom[i], (double[]){0, 0, 4}, x);
            assert_true(under.shape.distance(&b, x, grad, NULL) > -0.1);
        }
        printf("%d nodes touch, %.3f mm deep, %d iterations\n", q.contact.active_nodes, q.contact.depth_mm,
               q.iterations);
        equilibrium_free(&q);
    }
    printf("force %.6g mN, by energy %.6g\n", force, (energy[2] - energy[0]) / (2 * h));
    assert_near(force, (energy[2] - energy[0]) / (2 * h), 2e-3 * fabs(force));
    free(under.bottom);
    tear_down(&s);
}

/* A plate 1 mm thick comes up from 0.2 mm below the tissue: where that does not feel it, the tissue lies beyond the
 * plate's middle, from where the nearest way out leads below. */
static void tissue_comes_back_to_its_own_side_of_a_thin_bone(void **state)
{
    (void)state;
    known_bone plate = {KNOWN_PLATE, {0, 0, 0}, 0.5, 0.02};
    bone_shape shape = known_shape(&plate);
    contact_setup touch = held_by(NULL, &shape);
    setting s;
    int32_t *bottom;
    hanging_block(&s, &bottom, &touch.extra_count);
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) s.mesh.xyz[3 * (size_t)v + 2] += 0.7;
    touch.extra = bottom;
    s.problem.contact = &touch;
    solve_params params = solve_params_default();
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, 1});
    equilibrium q = solve(&s, &params);
    assert_int_equal(q.outcome, SOLVED);
    for (int32_t i = 0; i < touch.extra_count; i++) assert_true(q.xyz[3 * (size_t)bottom[i] + 2] > 1 + 0.5 - 0.1);
    assert_int_equal(q.contact.lost, 0);
    equilibrium_free(&q);
    free(bottom);
    tear_down(&s);
}

static void what_nothing_comes_near_costs_nothing_and_changes_nothing(void **state)
{
    (void)state;
    known_bone b = {KNOWN_BALL, {9, 8, -40}, 10, 0};
    setting s;
    ball_below under;
    hang_over_ball(&s, &b, &under);
    s.problem.motion[SEGMENT_CRANIUM] = rigid_rotation((double[]){0, 0, 0}, (double[]){0, 1, 0}, 0.1);
    solve_params params = solve_params_default();
    equilibrium without = solve(&s, &params);
    s.problem.contact = &under.touch;
    equilibrium with = solve(&s, &params);
    assert_int_equal(with.contact.active_nodes, 0);
    assert_int_equal(with.iterations, without.iterations);
    for (size_t i = 0; i < 3 * (size_t)s.mesh.vertex_count; i++) assert_near(with.xyz[i], without.xyz[i], 1e-9);
    equilibrium_free(&with);
    equilibrium_free(&without);
    free(under.bottom);
    tear_down(&s);
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    known_bone b = {KNOWN_BALL, {9, 8, -11}, 10, 0};
    setting s;
    ball_below under;
    hang_over_ball(&s, &b, &under);
    s.problem.contact = &under.touch;
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, 3});
    solve_params params = solve_params_default();
    equilibrium first = {0};
    static const int counts[4] = {1, 2, 3, 8};
    for (int k = 0; k < 4; k++) {
        parallel_set_threads(counts[k]);
        equilibrium q = solve(&s, &params);
        if (k) assert_memory_equal(q.xyz, first.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
        if (k)
            equilibrium_free(&q);
        else
            first = q;
    }
    parallel_set_threads(0);
    equilibrium_free(&first);
    free(under.bottom);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shell_turns_on_a_ball_as_one_piece),
        cmocka_unit_test(the_bend_of_a_level_is_in_the_stiffness),
        cmocka_unit_test(a_ball_pressed_into_tissue_stays_out_of_it_and_its_work_is_the_energy),
        cmocka_unit_test(tissue_comes_back_to_its_own_side_of_a_thin_bone),
        cmocka_unit_test(what_nothing_comes_near_costs_nothing_and_changes_nothing),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
