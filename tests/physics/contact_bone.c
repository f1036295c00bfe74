/* A body that lies on bone: pressed, dragged, lifted off, pushed through. */
#include "tests/check.h"
#include "sim/src/contact/contact_state.h"
#include "tests/physics/evidence.h"
#include "tests/physics/touching.h"

static void nothing_pushes_beyond_the_activation_distance(void **state)
{
    (void)state;
    touching s;
    err e = {0};
    contact *c = NULL;
    block_on_plane(&s, 0.45);
    s.bone.at[2] = -1; /* 1 mm away at rest */
    const tetmesh *m = &s.body.mesh;
    assert_ok(contact_make(m, &s.body.attach, &s.setup, 15, &c, &e));
    rigid guide = rigid_identity();
    for (int k = 0; k < 2; k++) {
        double rise = k ? 0.902 : 0.898; /* the activation distance is 0.1 mm */
        s.body.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, rise});
        contact_move(c, s.body.problem.motion, &guide, m->xyz);
        contact_refresh(c, m->xyz);
        double *force = NEW_ARRAY(double, 3 * (size_t)m->vertex_count);
        double energy = contact_energy(c, m->xyz, force);
        for (int32_t i = 0; !k && i < 3 * m->vertex_count; i++) assert_true(force[i] == 0);
        assert_true(k ? energy > 0 : energy == 0);
        free(force);
    }
    contact_destroy(&c);
    touching_free(&s);
}

static void a_pressed_block_carries_what_elasticity_says(void **state)
{
    (void)state;
    touching s;
    block_on_plane(&s, 0); /* no lateral strain: the stress is uniaxial and even */
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -0.6});
    equilibrium q = solve_touching(&s, "pressed");
    const double *f = q.segment_force_mn[SEGMENT_DISTAL];
    double depth = q.contact.depth_mm, stretch = (12 - 0.6 + depth) / 12;
    /* the same column alone: SNH with the logarithm at Poisson 0, force per area d psi / d stretch */
    double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, stretch}, P[9];
    material_stress(&s.body.table.material, F, P);
    assert_true(depth > 0 && depth < 0.1);
    assert_near(f[2], -P[8] * 20 * 16, 0.02 * fabs(f[2]));
    evidence("contact: a block pressed on a plane, force against the closed form, off by",
             fabs(f[2] / (-P[8] * 20 * 16) - 1), "-");
    assert_near(f[2] + q.segment_force_mn[SEGMENT_MAXILLA][2], 0, 1e-6 * f[2]);
    assert_near(q.contact.bone_area_mm2, 20 * 16, 1e-9);
    assert_near(q.contact.pressure_kpa, f[2] / (20 * 16), 0.02 * q.contact.pressure_kpa);
    assert_true(fabs(f[0]) < 1e-9 * f[2] && fabs(f[1]) < 1e-9 * f[2]); /* no friction */
    equilibrium_free(&q);
    touching_free(&s);
}

static void a_pressed_block_agrees_with_sliding_constraints(void **state)
{
    (void)state;
    touching s;
    block_on_plane(&s, 0.45);
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){5, 1, -2});
    equilibrium touch = solve_touching(&s, "pressed and pushed aside");
    s.body.problem.contact = NULL;
    solve_params params = solve_params_default();
    equilibrium slide = solve(&s.body, &params);
    assert_int_equal(slide.outcome, SOLVED);
    double worst = apart(&slide, &touch);
    assert_true(touch.contact.depth_mm < 0.1);
    assert_true(worst < 0.15);
    evidence("contact: a block pressed 2 mm and dragged, beside sliding constraints: worst node", worst, "mm");
    double a = touch.segment_force_mn[SEGMENT_DISTAL][2], b = slide.segment_force_mn[SEGMENT_DISTAL][2];
    assert_near(a, b, 0.06 * b);
    for (int k = 0; k < 2; k++) assert_true(fabs(touch.segment_force_mn[SEGMENT_DISTAL][k]) < 1e-6 * a);
    equilibrium_free(&touch);
    equilibrium_free(&slide);
    touching_free(&s);
}

static void a_block_slides_and_lifts_off_without_force(void **state)
{
    (void)state;
    for (int lift = 0; lift < 2; lift++) {
        touching s;
        block_on_plane(&s, 0.45);
        double t[3] = {4, -1, lift ? 3 : 0};
        s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation(t);
        equilibrium q = solve_touching(&s, lift ? "lifted off" : "slid");
        for (int32_t v = 0; v < q.node_count; v++)
            for (int c = 0; c < 3; c++) assert_near(q.xyz[3 * v + c], s.body.mesh.xyz[3 * v + c] + t[c], 1e-9);
        assert_int_equal(q.contact.active_nodes, 0);
        assert_true(q.contact.depth_mm < 1e-9);
        equilibrium_free(&q);
        touching_free(&s);
    }
}

/* The plate rises into the block; without contact that would stay where it is: beyond the plate's middle, or beyond the
 * plate, from where it must come back or be told of. */
static void tissue_that_starts_behind_a_thick_plate_ends_in_front(void **state)
{
    (void)state;
    static const double rise[2] = {4, 6};
    for (int k = 0; k < 2; k++) {
        touching s;
        block_on_plane(&s, 0.45);
        s.bone = (known_bone){KNOWN_PLATE, {0, 0, -2.5}, 2.5, 0.1};
        s.body.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, rise[k]});
        equilibrium q = solve_touching(&s, "thick plate");
        double lowest = HUGE_VAL;
        for (int32_t v = 0; v < q.node_count; v++)
            if (s.body.attach.kind[v] == NODE_SLIDING) lowest = fmin(lowest, q.xyz[3 * v + 2]);
        printf("lowest node %.3f mm over the plate, %d went through\n", lowest - rise[k], q.contact.passed);
        assert_true(lowest > rise[k] - 0.1 || (k && q.contact.passed == 30));
        assert_true(q.contact.depth_mm < 0.1);
        equilibrium_free(&q);
        touching_free(&s);
    }
}

static void contacts_too_deep_are_stiffened_or_not_accepted(void **state)
{
    (void)state;
    touching s;
    block_on_plane(&s, 0.45);
    s.setup.params.pressure_kpa = 0.5; /* far too soft a wall */
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -2});
    equilibrium q = solve_touching(&s, "soft wall");
    assert_true(q.contact.stiffenings > 0);
    assert_true(q.contact.depth_mm < 0.1);
    equilibrium_free(&q);
    s.setup.params.max_stiffenings = 0;
    solve_params params = solve_params_default();
    params.max_halvings = 0;
    q = solve(&s.body, &params);
    assert_int_equal(q.outcome, STOPPED_PENETRATION);
    assert_true(q.contact.depth_mm > 0.1);
    equilibrium_free(&q);
    touching_free(&s);
}

/* The bone is 0.3 mm higher than its smooth distance says. */
static const double higher_mm = 0.3;
static double exact_distance(const void *context, const double x[3])
{
    const known_bone *plane = context;
    return x[2] - plane->at[2] - higher_mm;
}

static void the_exact_distance_has_the_last_word(void **state)
{
    (void)state;
    for (int corrected = 0; corrected < 2; corrected++) {
        touching s;
        block_on_plane(&s, 0.45);
        s.bone.at[2] = -1; /* 1 mm away at rest, 0.7 as it is */
        s.shape.exact = exact_distance;
        if (!corrected) s.setup.params.max_corrections = 0;
        s.body.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, 2});
        equilibrium q = solve_touching(&s, corrected ? "corrected" : "by the smooth distance");
        double deepest = 0;
        for (int32_t v = 0; v < q.node_count; v++)
            if (s.body.mesh.xyz[3 * v + 2] == 0) deepest = fmax(deepest, 1 + higher_mm - q.xyz[3 * v + 2]);
        assert_true((deepest < s.setup.params.exact_limit_mm) == (corrected == 1));
        assert_int_equal(q.contact.corrections, corrected);
        equilibrium_free(&q);
        touching_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_pushes_beyond_the_activation_distance),
        cmocka_unit_test(the_exact_distance_has_the_last_word),
        cmocka_unit_test(a_pressed_block_carries_what_elasticity_says),
        cmocka_unit_test(a_pressed_block_agrees_with_sliding_constraints),
        cmocka_unit_test(a_block_slides_and_lifts_off_without_force),
        cmocka_unit_test(tissue_that_starts_behind_a_thick_plate_ends_in_front),
        cmocka_unit_test(contacts_too_deep_are_stiffened_or_not_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
