/* The template on heads whose shape is known: itself moved, bent, cut and roughened. */
#include "tests/check.h"
#include "tests/planner/with_template.h"
#include "app/planner/identity/head_fit.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/target_surface.h"
#include <string.h>

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1;
}

/* Bumps of 70 mm about a head, the largest shift of a vertex 20 mm. */
typedef struct bending {
    double centre[6][3], push[6][3], scale;
} bending;

static void push_of(const bending *b, const double p[3], double u[3])
{
    memset(u, 0, 3 * sizeof *u);
    for (int k = 0; k < 6; k++) {
        double d = vec_distance(p, b->centre[k]);
        vec_axpy(u, b->scale * exp(-d * d / (2 * 70.0 * 70.0)), b->push[k], u);
    }
}

static bending make_bending(uint64_t seed)
{
    bending b = {.scale = 1};
    double most = 0, u[3];
    for (int k = 0; k < 6; k++)
        for (int c = 0; c < 3; c++) {
            b.centre[k][c] = (c == 1 ? -20 : 0) + 80 * uniform(&seed);
            b.push[k][c] = uniform(&seed);
        }
    for (size_t v = 0; v < (size_t)t.part[CASE_SKIN].vertex_count; v++) {
        push_of(&b, t.part[CASE_SKIN].xyz + 3 * v, u);
        most = fmax(most, vec_norm(u));
    }
    b.scale = 20 / most;
    return b;
}

/* The template's parts and landmarks, bent (or not) and then moved. */
static head_scan scan_of(const bending *b, const rigid *motion, double scale)
{
    head_scan s = {0};
    head_shape shape = head_shape_of(&t);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        for (size_t v = 0; v < (size_t)t.part[p].vertex_count; v++) {
            double u[3] = {0}, *x = shape.part[p] + 3 * v;
            if (b) push_of(b, x, u);
            vec_add(x, u, x);
            vec_scale(x, scale, x);
            rigid_apply(motion, x, x);
        }
        s.part[p] = head_part(&t, &shape, (case_surface)p);
    }
    s.points = head_points(&t, &shape);
    head_shape_free(&shape);
    return s;
}

static head_fit fit(const head_scan *s)
{
    err e = {0};
    head_fit f;
    head_fit_params params = head_fit_params_default();
    assert_ok(head_fit_make(&t, s, &params, NULL, &f, &e));
    print_message("%.1f s, %d factorisations, min J %.2f\n", f.total_s, f.factorisations, f.min_j);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        print_message("%-12s %d of %d: mean %.3f, 95 %% %.3f, most %.3f mm\n", case_surface_name((case_surface)p),
                      f.gaps[p].with_target, f.gaps[p].vertices, f.gaps[p].mean_mm, f.gaps[p].p95_mm, f.gaps[p].max_mm);
    assert_int_equal(f.inverted_tets, 0);
    assert_true(f.min_j > 0);
    return f;
}

/* Mean distance of the vertices of a known part from the fitted one, or from their own fitted places. */
static double off_mm(const head_fit *f, const surface *known, case_surface p, bool own_places)
{
    surface got = head_part(&t, &f->shape, p);
    distance_tree *near = distance_tree_make(&got);
    double sum = 0;
    for (size_t v = 0; v < (size_t)known->vertex_count; v++)
        sum += own_places ? vec_distance(got.xyz + 3 * v, known->xyz + 3 * v)
                          : distance_tree_to(near, known->xyz + 3 * v, NULL);
    distance_tree_free(&near);
    surface_free(&got);
    return sum / known->vertex_count;
}

static void a_moved_and_scaled_template_is_recovered(void **state)
{
    (void)state;
    rigid motion = rigid_rotation((double[]){10, -30, 20}, (double[]){0.6, 0.48, 0.64}, 0.5);
    head_scan s = scan_of(NULL, &motion, 1.07);
    head_fit f = fit(&s);
    double worst = 0, x[3];
    assert_near(f.place.scale, 1.07, 1e-8);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        for (size_t v = 0; v < (size_t)t.part[p].vertex_count; v++)
            worst = fmax(worst, vec_distance(f.shape.part[p] + 3 * v, s.part[p].xyz + 3 * v));
    for (size_t v = 0; v < (size_t)t.tissue.mesh.vertex_count; v++)
        for (int k = 0; k < 2; k++) {
            vec_scale((k ? t.rest : t.tissue.mesh.xyz) + 3 * v, 1.07, x);
            rigid_apply(&motion, x, x);
            worst = fmax(worst, vec_distance((k ? f.shape.rest : f.shape.neutral) + 3 * v, x));
        }
    print_message("farthest %.2g mm\n", worst);
    assert_true(worst < 1e-6);
    head_fit_free(&f);
    head_scan_free(&s);
}

static void a_bent_head_is_recovered(void **state)
{
    (void)state;
    bending b = make_bending(3);
    rigid still = rigid_identity();
    head_scan s = scan_of(&b, &still, 1);
    head_fit f = fit(&s);
    for (int p = CASE_SKIN; p <= CASE_MANDIBLE; p++) {
        double surface_off = off_mm(&f, &s.part[p], (case_surface)p, false),
               own = off_mm(&f, &s.part[p], (case_surface)p, true);
        print_message("%-12s %.3f mm from the surface, %.3f mm from its own place\n",
                      case_surface_name((case_surface)p), surface_off, own);
        assert_true(surface_off < 0.3 && own < 4);
    }
    head_fit_free(&f);
    head_scan_free(&s);
}

/* Without neck and crown, the rest 0.5 mm rough. */
static void a_cut_and_noisy_scan_is_fitted_where_it_is(void **state)
{
    (void)state;
    bending b = make_bending(5);
    rigid still = rigid_identity();
    head_scan s = scan_of(&b, &still, 1), whole = scan_of(&b, &still, 1);
    uint64_t seed = 9;
    for (int p = CASE_SKIN; p <= CASE_MANDIBLE; p++) {
        uint8_t *keep = NEW_ARRAY(uint8_t, s.part[p].triangle_count);
        for (size_t k = 0; k < (size_t)s.part[p].triangle_count; k++) {
            double z = s.part[p].xyz[3 * (size_t)s.part[p].tri[3 * k] + 2];
            keep[k] = z < 60 && z > -110;
        }
        surface cut = surface_select(&s.part[p], keep);
        for (size_t v = 0; v < (size_t)cut.vertex_count; v++) {
            double n[3] = {uniform(&seed), uniform(&seed), uniform(&seed)};
            vec_axpy(cut.xyz + 3 * v, 0.5, n, cut.xyz + 3 * v);
        }
        surface_free(&s.part[p]);
        s.part[p] = cut;
        free(keep);
    }
    head_fit f = fit(&s);
    for (int p = CASE_SKIN; p <= CASE_MANDIBLE; p++) {
        surface got = head_part(&t, &f.shape, (case_surface)p);
        target_surface *known = target_surface_make(&whole.part[p]);
        target_rules any = {HUGE_VAL, -2};
        double sum = 0;
        int32_t count = 0, guessed_in = 0;
        for (size_t v = 0; v < (size_t)got.vertex_count; v++) {
            target_point hit;
            double z = whole.part[p].xyz[3 * v + 2];
            if (z > 55 || z < -105) continue;
            sum += target_surface_ask(known, got.xyz + 3 * v, NULL, &any, &hit);
            guessed_in += f.guessed[p][v] != GUESS_NONE;
            count++;
        }
        print_message("%-12s %.3f mm from the true surface where there is a scan, %d of %d guessed there\n",
                      case_surface_name((case_surface)p), sum / count, guessed_in, count);
        assert_true(sum / count < 0.6 && guessed_in < count / 10);
        for (size_t v = 0; v < (size_t)got.vertex_count; v++)
            if (whole.part[p].xyz[3 * v + 2] > 70) assert_int_equal(f.guessed[p][v], GUESS_ABSENT);
        target_surface_free(&known);
        surface_free(&got);
    }
    head_fit_free(&f);
    head_scan_free(&s);
    head_scan_free(&whole);
}

/* Every vertex of the scan is where it was, and the tissue, of which nothing was told, goes as it went. */
static void a_head_in_the_template_s_numbering_is_known(void **state)
{
    (void)state;
    err e = {0};
    bending b = make_bending(3);
    rigid motion = rigid_rotation((double[]){10, -30, 20}, (double[]){0.6, 0.48, 0.64}, 0.5);
    head_scan s = scan_of(&b, &motion, 1.03);
    head_fit f;
    assert_true(head_fit_is_numbered(&t, &s));
    assert_ok(head_fit_numbered(&t, &s, NULL, &f, &e));
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        assert_memory_equal(f.shape.part[p], s.part[p].xyz, 3 * (size_t)s.part[p].vertex_count * sizeof(double));
        for (int32_t v = 0; v < s.part[p].vertex_count; v++) assert_int_equal(f.guessed[p][v], GUESS_NONE);
    }
    double sum = 0, bent = 0, moved[3], u[3];
    int32_t nodes = t.tissue.mesh.vertex_count;
    for (size_t v = 0; v < (size_t)nodes; v++) {
        push_of(&b, t.tissue.mesh.xyz + 3 * v, u);
        vec_add(t.tissue.mesh.xyz + 3 * v, u, moved);
        vec_scale(moved, 1.03, moved);
        rigid_apply(&motion, moved, moved);
        sum += vec_distance(f.shape.neutral + 3 * v, moved);
        bent += vec_norm(u);
    }
    double off = 0;
    int32_t carried = 0;
    for (int32_t v = 0; v < t.skin_on_tissue.point_count; v++) {
        int32_t tet = t.skin_on_tissue.tet[v];
        double at[3] = {0};
        if (tet < 0) continue;
        for (int k = 0; k < 4; k++)
            vec_axpy(at, t.skin_on_tissue.weight[4 * v + k], f.shape.neutral + 3 * t.tissue.mesh.tet[4 * tet + k], at);
        off += vec_distance(at, s.part[CASE_SKIN].xyz + 3 * v);
        carried++;
    }
    print_message("tissue %.3f mm off in the mean where it was bent by %.1f, skin on it %.3f; min J %.2f, %.1f s\n",
                  sum / nodes, bent / nodes, off / carried, f.min_j, f.total_s);
    assert_true(bent / nodes > 5 && sum / nodes < 1.5 && off / carried < 0.2);
    assert_true(f.min_j > 0 && f.inverted_tets == 0);
    head_fit_free(&f);
    int32_t first = s.part[CASE_SKIN].tri[0];
    s.part[CASE_SKIN].tri[0] = s.part[CASE_SKIN].tri[1];
    s.part[CASE_SKIN].tri[1] = first;
    assert_false(head_fit_is_numbered(&t, &s));
    assert_refused(head_fit_numbered(&t, &s, NULL, &f, &e), ERR_INPUT);
    head_scan_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moved_and_scaled_template_is_recovered),
        cmocka_unit_test(a_bent_head_is_recovered),
        cmocka_unit_test(a_cut_and_noisy_scan_is_fitted_where_it_is),
        cmocka_unit_test(a_head_in_the_template_s_numbering_is_known),
    };
    return cmocka_run_group_tests(tests, open_template, close_template);
}
