/* Derivatives of distances and of the energy of contact, by differences. */
#include "tests/check.h"
#include "sim/src/contact/contact_state.h"
#include "tests/physics/touching.h"

/* Which tests and the stress suite lean on. */
static void derivatives_of_known_shapes_are_exact(void **state)
{
    (void)state;
    static const known_bone bones[6] = {{KNOWN_PLANE, {1, 2, 0.3}, 0, 0},   {KNOWN_PLATE, {0, 0, 0}, 0.3, 0.5},
                                        {KNOWN_BALL, {0, 1, -3}, 4, 0},     {KNOWN_EDGE, {0, 0, 0}, 0, 0.7},
                                        {KNOWN_CUSPS, {0.5, 0.2, 1}, 2, 0}, {KNOWN_TEETH, {-0.3, 1, 1}, 8, 0.25}};
    double h = 1e-5;
    uint64_t seed = 9;
    for (int k = 0; k < 6; k++) {
        bone_shape shape = known_shape(&bones[k]);
        double worst = 0, sharpest = 0, off = 0;
        for (int n = 0; n < 400; n++) {
            double x[3] = {4 * block_random(&seed), 4 * block_random(&seed), 2 * block_random(&seed)}, grad[3], hess[9];
            shape.distance(shape.context, x, grad, hess);
            for (int c = 0; c < 3; c++) {
                double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]}, g[2][3];
                up[c] += h;
                down[c] -= h;
                double slope =
                    shape.distance(shape.context, up, g[0], NULL) - shape.distance(shape.context, down, g[1], NULL);
                assert_near(slope / (2 * h), grad[c], 1e-7);
                for (int r = 0; r < 3; r++) {
                    worst = fmax(worst, fabs((g[0][r] - g[1][r]) / (2 * h) - hess[3 * r + c]));
                    sharpest = fmax(sharpest, fabs(hess[3 * r + c]));
                }
            }
            double hit[3], normal[3];
            if (!shape.leave(shape.context, x, (double[]){0.36, 0.48, 0.8}, 6, hit, normal)) continue;
            off = fmax(off, fabs(shape.distance(shape.context, hit, grad, NULL)));
        }
        printf("kind %d: Hessian off by %.1e, largest %.3g; ways out end %.1e mm off the surface\n", bones[k].kind,
               worst, sharpest, off);
        assert_true(worst <= 1e-3 * sharpest && off < 1e-9); /* the third derivative jumps where rounding ends */
    }
}

/* Energy, force and stiffness of contacts alone, at a random shape in deep contact. */
static void check_derivatives(touching *t, double lift_mm)
{
    err e = {0};
    const setting *s = &t->body;
    contact *c = NULL;
    assert_ok(contact_make(&s->mesh, &s->attach, &t->setup, 15, &c, &e));
    rigid guide = rigid_identity();
    contact_move(c, s->problem.motion, &guide, s->mesh.xyz);
    size_t n = 3 * (size_t)s->mesh.vertex_count;
    double *x = COPY_ARRAY(double, s->mesh.xyz, n), *w = NEW_ARRAY(double, n), *f = NEW_ARRAY(double, n);
    double *at = NEW_ARRAY(double, n), *up = NEW_ARRAY(double, n), *down = NEW_ARRAY(double, n), h = 1e-6;
    uint64_t seed = 12;
    for (size_t i = 0; i < n; i++) {
        x[i] += 0.15 * block_random(&seed);
        w[i] = block_random(&seed);
    }
    for (int32_t i = 0; i < s->attach.pair_count; i++) x[3 * (size_t)s->attach.pair[2 * i] + 2] += lift_mm;
    contact_refresh(c, x);
    for (size_t i = 0; i < n; i++) x[i] += 0.02 * block_random(&seed); /* not where it was refreshed */
    double energy = contact_energy(c, x, f), slope = 0, side[2];
    assert_true(energy > 0);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < n; i++) at[i] = x[i] + (k ? -h : h) * w[i];
        side[k] = contact_energy(c, at, k ? down : up);
    }
    double scale = 0, worst = 0, sum[3] = {0};
    for (size_t i = 0; i < n; i++) {
        slope += f[i] * w[i];
        sum[i % 3] += f[i];
    }
    assert_near((side[0] - side[1]) / (2 * h), slope, 1e-6 * fabs(slope));
    elements el;
    boundary b;
    assembly a;
    attach_map loose = contact_loosened(&s->attach, &t->setup);
    assert_ok(elements_make(&s->mesh, &s->table, 1, &el, &e));
    assert_ok(boundary_make(&s->mesh, &loose, &b, &e));
    assert_ok(assembly_make(&s->mesh, &el, &b, c->coupling, c->coupling_count, &a, &e));
    contact_stiffness(c, x, NULL, true, &a);
    assembly_multiply(&a, w, at);
    for (size_t i = 0; i < n; i++) scale = fmax(scale, fabs(at[i]));
    for (size_t i = 0; i < n; i++) worst = fmax(worst, fabs((up[i] - down[i]) / (2 * h) - at[i]));
    printf("stiffness off by %.1e of its largest\n", worst / scale);
    assert_true(worst < 1e-6 * scale);
    if (t->setup.upper_count) /* lip on lip: equal and opposite */
        for (int k = 0; k < 3; k++) assert_near(sum[k], 0, 1e-9 * scale);
    memset(a.edge_block, 0, 9 * (size_t)a.edge_count * sizeof *a.edge_block);
    contact_stiffness(c, x, NULL, false, &a);
    double quadratic = 0;
    assembly_multiply(&a, w, at);
    for (size_t i = 0; i < n; i++) quadratic += w[i] * at[i];
    assert_true(quadratic > 0);
    assembly_free(&a);
    boundary_free(&b);
    attach_map_free(&loose);
    contact_destroy(&c);
    elements_free(&el);
    free(x);
    free(w);
    free(f);
    free(at);
    free(up);
    free(down);
}

static void forces_and_stiffness_are_derivatives_of_the_energy(void **state)
{
    (void)state;
    touching s;
    two_lips(&s);
    check_derivatives(&s, -0.3);
    touching_free(&s);
    static const known_bone bones[2] = {{KNOWN_BALL, {10, 8, -30}, 30, 0}, {KNOWN_TEETH, {9.4, 8.3, 0}, 2, 0.25}};
    for (int k = 0; k < 2; k++) {
        block_on_plane(&s, 0.45);
        s.bone = bones[k];
        rigid *motion = &s.body.problem.motion[SEGMENT_DISTAL];
        *motion = rigid_rotation(bones[k].at, (double[]){0.8, 0, 0.6}, 0.4);
        motion->t[2] += 0.8;
        check_derivatives(&s, 0);
        touching_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_of_known_shapes_are_exact),
        cmocka_unit_test(forces_and_stiffness_are_derivatives_of_the_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
