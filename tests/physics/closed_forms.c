/* Every material against stresses written down a second time, from the principal stretches; a pulled bar; and
 * a thick sphere whose inner wall is pushed outwards, against the radial equation. */
#include "tests/check.h"
#include "sim/equilibrium.h"
#include "sim/src/solve/descent.h"
#include "tests/physics/block.h"
#include "tests/physics/evidence.h"
#include <string.h>

static const double young = 15, nu = 0.4;

static double poisson_of(material_model model) { return model == MATERIAL_ARAP ? 0 : nu; }

/* First Piola-Kirchhoff stress along principal stretch 0 of s[3], kPa. */
static double principal_stress(material_model model, double s0, double s1, double s2)
{
    double p = poisson_of(model), m = young / (2 * (1 + p)), l = young * p / ((1 + p) * (1 - 2 * p));
    double I = s0 * s0 + s1 * s1 + s2 * s2, J = s0 * s1 * s2, c = s1 * s2;
    switch (model) {
    case MATERIAL_SNH_LOG: {
        double mu = 4 * m / 3, la = l + 5 * m / 6, rest = 1 + 3 * mu / (4 * la);
        return mu * (1 - 1 / (I + 1)) * s0 + la * (J - rest) * c;
    }
    case MATERIAL_SNH: return m * s0 + (l + m) * (J - 1 - m / (l + m)) * c;
    case MATERIAL_NH_LN: return m * (s0 - 1 / s0) + l * log(J) / s0;
    case MATERIAL_NH_ISO: return m * pow(J, -2.0 / 3) * (s0 - I / (3 * s0)) + (l + 2 * m / 3) * (J - 1) * c;
    case MATERIAL_FIXED_COROTATED: return 2 * m * (s0 - 1) + l * (J - 1) * c;
    case MATERIAL_ARAP: return 2 * m * (s0 - 1);
    default: fail(); return 0;
    }
}

static material make(material_model model)
{
    err e = {0};
    material m = {0};
    assert_ok(material_make(model, young, poisson_of(model), &m, &e));
    return m;
}

/* Where the stress across a free side vanishes: `sides` of the other two stretches are that free one. */
static double free_stretch(material_model model, double pulled, int sides)
{
    double low = 0.05, high = 3;
    for (int k = 0; k < 100; k++) {
        double t = (low + high) / 2;
        double stress = sides == 2 ? principal_stress(model, t, t, pulled) : principal_stress(model, t, pulled, pulled);
        if (stress > 0)
            high = t;
        else
            low = t;
    }
    return (low + high) / 2;
}

static void uniaxial_and_biaxial_stresses_are_the_closed_forms(void **state)
{
    (void)state;
    double worst = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        material m = make((material_model)model);
        for (double s = 0.5; s < 2.6; s += 0.25)
            for (int sides = 1; sides <= 2; sides++) {
                double t = free_stretch((material_model)model, s, sides), P[9];
                double F[9] = {s, 0, 0, 0, sides == 2 ? t : s, 0, 0, 0, t};
                material_stress(&m, F, P);
                double want = principal_stress((material_model)model, s, F[4], t);
                assert_near(keep_worst(&worst, (P[0] - want) / young), 0, 1e-10);
                assert_near(P[8], 0, 1e-9 * young);
                for (int i = 0; i < 9; i++)
                    if (i % 4) assert_near(P[i], 0, 1e-10 * young);
            }
    }
    evidence("uniaxial and biaxial stress to stretch 2.5, every material, relative to Young's modulus", worst, "-");
}

/* Simple shear g: stretches a, 1, 1/a with a - 1/a = g, turned by tan(theta) = g/2. */
static void simple_shear_is_the_closed_form(void **state)
{
    (void)state;
    double worst = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        material m = make((material_model)model);
        for (double g = -2; g < 2.1; g += 0.5) {
            double a = g / 2 + sqrt(1 + g * g / 4), F[9] = {1, g, 0, 0, 1, 0, 0, 0, 1}, P[9], P1, P2, P3;
            P1 = principal_stress((material_model)model, a, 1, 1 / a);
            P2 = principal_stress((material_model)model, 1 / a, a, 1);
            P3 = principal_stress((material_model)model, 1, a, 1 / a);
            /* F = sum a_i u_i v_i^T: v along (1, a) for a and (-a, 1) for 1/a; u = F v / a_i; P = sum P_i u_i
             * v_i^T */
            double n = sqrt(1 + a * a), v1[2] = {1 / n, a / n}, v2[2] = {-a / n, 1 / n};
            double u1[2] = {(v1[0] + g * v1[1]) / a, v1[1] / a}, u2[2] = {(v2[0] + g * v2[1]) * a, v2[1] * a};
            material_stress(&m, F, P);
            for (int i = 0; i < 2; i++)
                for (int j = 0; j < 2; j++) {
                    double want = P1 * u1[i] * v1[j] + P2 * u2[i] * v2[j];
                    assert_near(keep_worst(&worst, (P[3 * i + j] - want) / young), 0, 1e-10);
                }
            assert_near(P[8], P3, 1e-10 * young);
        }
    }
    evidence("simple shear to 2, every material, relative to Young's modulus", worst, "-");
}

/* A bar between two plates on which it slides; one node is held so that it does not drift, another so that it
 * does not turn; neither carries anything. */
static void a_pulled_bar_thins_and_resists_as_the_closed_form_says(void **state)
{
    (void)state;
    double worst = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        err e = {0};
        block b = {4, 4, 4, {12, 12, 20}, 6, 0.2};
        tetmesh m = block_mesh(&b);
        attach_map a = attach_map_new(m.vertex_count, 0);
        for (int32_t v = 0; v < m.vertex_count; v++) {
            double z = m.xyz[3 * (size_t)v + 2];
            if (z != 0 && z != 20) continue;
            a.kind[v] = NODE_SLIDING;
            a.segment[v] = z == 0 ? SEGMENT_DISTAL : SEGMENT_MAXILLA;
            a.normal[3 * (size_t)v + 2] = 1;
        }
        tie(&a, block_node(&b, 2, 2, 0), SEGMENT_DISTAL);
        int32_t side = block_node(&b, 4, 2, 2);
        a.kind[side] = NODE_SLIDING;
        a.segment[side] = SEGMENT_CRANIUM;
        a.normal[3 * (size_t)side + 1] = 1;
        region_material table = {REGION_ANY, make((material_model)model)};
        equilibrium_problem problem = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
        rest_motions(problem.motion);
        double s = 1.5, t = free_stretch((material_model)model, s, 2);
        problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, 20 * (s - 1)});
        solve_params params = solve_params_default();
        params.rel_tol = 1e-12;
        equilibrium q;
        assert_ok(equilibrium_solve(&problem, &params, &q, &e));
        assert_int_equal(q.outcome, SOLVED);
        for (int32_t v = 0; v < m.vertex_count; v++) {
            const double *X = m.xyz + 3 * (size_t)v, *x = q.xyz + 3 * (size_t)v;
            double want[3] = {6 + t * (X[0] - 6), 6 + t * (X[1] - 6), s * X[2]};
            assert_near(keep_worst(&worst, vec_distance(x, want)), 0, 1e-7);
        }
        double pull = principal_stress((material_model)model, s, t, t) * 12 * 12;
        assert_near(q.segment_force_mn[SEGMENT_MAXILLA][2] / pull, 1, 1e-7);
        assert_near(q.segment_force_mn[SEGMENT_CRANIUM][1] / pull, 0, 1e-7);
        print_message("%s pulled by half: thins to %.6f, resists with %.3f mN\n",
                      material_model_name((material_model)model), t, pull);
        equilibrium_free(&q);
        tetmesh_free(&m);
        attach_map_free(&a);
    }
    evidence("a bar pulled by half, every material: worst node", worst, "mm");
}

/* ---- the thick sphere ---- */

static const double inner = 10, outer = 20, push = 2;

/* r'' of the radial equation  P0' + 2 (P0 - P1) / R = 0,  P0 = P0(r', r/R, r/R). */
static double bend(material_model model, double R, double r, double slope)
{
    const double h = 1e-5;
    double t = r / R, p0 = principal_stress(model, slope, t, t), p1 = principal_stress(model, t, t, slope);
    double by_slope = (principal_stress(model, slope + h, t, t) - principal_stress(model, slope - h, t, t)) / (2 * h);
    double by_t =
        (principal_stress(model, slope, t + h, t + h) - principal_stress(model, slope, t - h, t - h)) / (2 * h);
    return (-2 * (p0 - p1) / R - by_t * (slope - t) / R) / by_slope;
}

/* Runge-Kutta from the inner wall to R; returns r. */
static double shoot(material_model model, double slope, double to)
{
    enum { STEPS = 400 };
    double h = (to - inner) / STEPS, r = inner + push;
    for (int k = 0; k < STEPS; k++) {
        double R = inner + k * h;
        double a1 = slope, b1 = bend(model, R, r, slope);
        double a2 = slope + h / 2 * b1, b2 = bend(model, R + h / 2, r + h / 2 * a1, a2);
        double a3 = slope + h / 2 * b2, b3 = bend(model, R + h / 2, r + h / 2 * a2, a3);
        double a4 = slope + h * b3, b4 = bend(model, R + h, r + h * a3, a4);
        r += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        slope += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
    return r;
}

static double first_slope(material_model model)
{
    double low = 0.3, high = 1.2; /* the outer wall is reached too early, too late */
    for (int k = 0; k < 60; k++) {
        double slope = (low + high) / 2;
        if (shoot(model, slope, outer) > outer)
            high = slope;
        else
            low = slope;
    }
    return (low + high) / 2;
}

/* A cube of 4n cells a side without its inner 2n, pushed out to a ball: |X| by the largest coordinate. */
static tetmesh sphere_mesh(int n)
{
    block b = {4 * n, 4 * n, 4 * n, {4, 4, 4}, 5, 0};
    tetmesh whole = block_mesh(&b);
    int32_t *number = NEW_ARRAY(int32_t, whole.vertex_count), nodes = 0, tets = 0;
    memset(number, 0xff, (size_t)whole.vertex_count * sizeof *number);
    for (int pass = 0; pass < 2; pass++) {
        tets = 0;
        for (int32_t t = 0; t < whole.tet_count; t++) {
            double c[3] = {-2, -2, -2}, far = 0;
            int32_t *v = whole.tet + 4 * (size_t)t;
            for (int a = 0; a < 4; a++) vec_axpy(c, 0.25, whole.xyz + 3 * (size_t)v[a], c);
            for (int k = 0; k < 3; k++) far = fmax(far, fabs(c[k]));
            if (far < 1) continue;
            for (int a = 0; pass && a < 4; a++) {
                if (number[v[a]] < 0) number[v[a]] = nodes++;
                whole.tet[4 * (size_t)tets + a] = v[a];
            }
            tets++;
        }
    }
    tetmesh m = tetmesh_new(nodes, tets);
    for (int32_t i = 0; i < 4 * tets; i++) m.tet[i] = number[whole.tet[i]];
    for (int32_t v = 0; v < whole.vertex_count; v++) {
        double c[3], far = 0;
        if (number[v] < 0) continue;
        for (int k = 0; k < 3; k++) {
            c[k] = whole.xyz[3 * (size_t)v + k] - 2;
            far = fmax(far, fabs(c[k]));
        }
        vec_scale(c, (inner + (outer - inner) * (far - 1)) / vec_norm(c), m.xyz + 3 * (size_t)number[v]);
    }
    free(number);
    tetmesh_free(&whole);
    return m;
}

/* Root mean square error over the nodes, mm. */
static double sphere_error(material_model model, int n, double slope)
{
    err e = {0};
    tetmesh m = sphere_mesh(n);
    attach_map a = attach_map_new(m.vertex_count, 0);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double R = vec_norm(m.xyz + 3 * (size_t)v);
        if (R < inner + 1e-9 || R > outer - 1e-9) tie(&a, v, SEGMENT_CRANIUM);
    }
    region_material table = {REGION_ANY, make(model)};
    equilibrium_problem problem = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    rest_motions(problem.motion);
    solver *t = NULL;
    assert_ok(solver_create(&problem, 1, &t, &e));
    for (int32_t v = 0; v < m.vertex_count; v++) {
        const double *X = m.xyz + 3 * (size_t)v;
        if (vec_norm(X) < inner + 1e-9) vec_scale(X, 1 + push / inner, t->b.origin + 3 * (size_t)v);
    }
    solve_params params = solve_params_default();
    equilibrium q = {0};
    descent d;
    solve_outcome outcome;
    descent_make(&d, t, &params, &q);
    assert_ok(load_run(&d, &(load_task){.load = 1, .rel_tol = 1e-10}, m.xyz, &outcome, &e));
    assert_int_equal(outcome, SOLVED);
    double sum = 0;
    int32_t free_nodes = 0;
    for (int32_t v = 0; v < m.vertex_count; v++) {
        if (a.kind[v] == NODE_TIED) continue;
        const double *X = m.xyz + 3 * (size_t)v;
        double want[3], R = vec_norm(X);
        vec_scale(X, shoot(model, slope, R) / R, want);
        sum += pow(vec_distance(want, d.here.x + 3 * (size_t)v), 2);
        free_nodes++;
    }
    descent_free(&d);
    equilibrium_free(&q);
    solver_destroy(&t);
    tetmesh_free(&m);
    attach_map_free(&a);
    return sqrt(sum / free_nodes);
}

static void a_thick_sphere_meets_the_radial_equation(void **state)
{
    (void)state;
    double worst = 0, order = HUGE_VAL;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        double slope = first_slope((material_model)model);
        assert_near(shoot((material_model)model, slope, outer), outer, 1e-9);
        double coarse = sphere_error((material_model)model, 2, slope),
               fine = sphere_error((material_model)model, 4, slope);
        print_message("%s: off the radial equation by %.4f and, halved, %.4f mm of %.0f mm pushed: order %.2f\n",
                      material_model_name((material_model)model), coarse, fine, push, log2(coarse / fine));
        assert_true(fine < 0.05 * push);
        assert_true(log2(coarse / fine) > 1.5);
        keep_worst(&worst, fine);
        order = fmin(order, log2(coarse / fine));
    }
    evidence("thick sphere, inner wall pushed out 2 mm, 4 cells: root mean square error against the radial equation",
             worst, "mm");
    evidence("the same: least order of convergence of a material", order, "-");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniaxial_and_biaxial_stresses_are_the_closed_forms),
        cmocka_unit_test(simple_shear_is_the_closed_form),
        cmocka_unit_test(a_pulled_bar_thins_and_resists_as_the_closed_form_says),
        cmocka_unit_test(a_thick_sphere_meets_the_radial_equation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
