/* Heads of which only a part is known, made whole by a model of bent templates. */
#include "tests/check.h"
#include "tests/planner/with_template.h"
#include "app/planner/identity/head_likeliest.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <string.h>

enum { HEADS = 7, WAYS = 4 };
static head_model model;

/* Wider, longer, a deeper jaw, a fuller face: smooth and small enough that every head is one. */
static void bend(const double how[WAYS], double *xyz, int32_t count)
{
    for (size_t v = 0; v < (size_t)count; v++) {
        double *x = xyz + 3 * v, low = 1 / (1 + exp((x[2] + 30) / 30)), front = 1 / (1 + exp((x[1] + 20) / 40));
        x[0] *= 1 + 0.05 * how[0];
        x[1] *= 1 + 0.05 * how[1] * front;
        x[2] -= 4 * how[2] * low;
        x[1] -= 4 * how[3] * low * front;
    }
}

static head_shape bent(const double how[WAYS])
{
    head_shape s = head_shape_of(&t);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) bend(how, s.part[p], t.part[p].vertex_count);
    bend(how, s.neutral, t.tissue.mesh.vertex_count);
    bend(how, s.rest, t.tissue.mesh.vertex_count);
    return s;
}

static int open_it(void **state)
{
    static const double how[HEADS][WAYS] = {{1, 0, 0, 0},  {-1, 1, 0, 0}, {0, -1, 1, 0},    {0, 0, -1, 1},
                                            {1, 0, 0, -1}, {0, 1, 1, 0},  {-1, -1, -1, 0.5}};
    err e = {0};
    if (open_template(state)) return -1;
    head_layout l = head_layout_of(&t);
    double *phi[HEADS];
    const char *name[HEADS];
    for (int i = 0; i < HEADS; i++) {
        head_shape s = bent(how[i]);
        phi[i] = NEW_ARRAY(double, l.start[HEAD_BLOCK_COUNT]);
        head_vector_of(&t, &s, phi[i]);
        name[i] = "bent";
        head_shape_free(&s);
    }
    bool ok = head_model_learn(&t, (const double *const *)phi, name, HEADS, NULL, &model, &e);
    for (int i = 0; i < HEADS; i++) free(phi[i]);
    return ok ? 0 : -1;
}

static int close_it(void **state)
{
    head_model_free(&model);
    return close_template(state);
}

static const double truth[WAYS] = {0.6, -0.5, 0.8, -0.4};
static const rigid motion = {.r = {0.96, -0.28, 0, 0.28, 0.96, 0, 0, 0, 1}, .t = {30, -200, 350}};

static void move(double *xyz, int32_t count)
{
    for (size_t v = 0; v < (size_t)count; v++) rigid_apply(&motion, xyz + 3 * v, xyz + 3 * v);
}

/* That head somewhere else, its crown, mandible and teeth guessed: the template's, some 10 mm off. */
static head_fit partly_known(head_shape *whole)
{
    static const double mean[WAYS] = {-1, 1, -1, 1};
    *whole = bent(truth);
    head_fit f = {.shape = bent(mean)};
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        int32_t n = t.part[p].vertex_count;
        f.guessed[p] = NEW_ARRAY(uint8_t, n);
        for (size_t v = 0; v < (size_t)n; v++) {
            bool lost = p >= CASE_MANDIBLE || t.part[p].xyz[3 * v + 2] > 40;
            f.guessed[p][v] = lost ? GUESS_ABSENT : GUESS_NONE;
            if (!lost) vec_copy(whole->part[p] + 3 * v, f.shape.part[p] + 3 * v);
        }
        move(f.shape.part[p], n);
        move(whole->part[p], n);
    }
    return f;
}

static double off_mm(const head_shape *a, const head_shape *b, case_surface p)
{
    double sum = 0;
    for (size_t v = 0; v < (size_t)t.part[p].vertex_count; v++)
        sum += vec_distance(a->part[p] + 3 * v, b->part[p] + 3 * v);
    return sum / t.part[p].vertex_count;
}

static void what_is_missing_comes_from_what_is_there(void **state)
{
    (void)state;
    err e = {0};
    head_shape whole, made;
    head_likeliest how;
    head_fit f = partly_known(&whole);
    assert_ok(head_likeliest_make(&t, &model, &f, &how, &made, &e));
    print_message("%d modes, noise %.1f mm\n", how.mode_count, how.noise_mm);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        double guessed = off_mm(&f.shape, &whole, (case_surface)p), likeliest = off_mm(&made, &whole, (case_surface)p);
        print_message("%-12s %.2f mm off, %.2f as the likeliest head\n", case_surface_name((case_surface)p), guessed,
                      likeliest);
        assert_true(likeliest < 1);
        if (p >= CASE_MANDIBLE) assert_true(guessed > 4);
    }
    for (int32_t k = 0; k < how.mode_count; k++) assert_true(fabs(how.p[k]) < 3);
    head_shape_free(&whole);
    head_shape_free(&made);
    head_fit_free(&f);
}

static void a_fit_that_has_nothing_of_the_scan_is_refused(void **state)
{
    (void)state;
    err e = {0};
    head_shape whole, made;
    head_likeliest how;
    head_fit f = partly_known(&whole);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) memset(f.guessed[p], GUESS_ABSENT, (size_t)t.part[p].vertex_count);
    assert_refused(head_likeliest_make(&t, &model, &f, &how, &made, &e), ERR_GEOMETRY);
    head_shape_free(&whole);
    head_fit_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_missing_comes_from_what_is_there),
        cmocka_unit_test(a_fit_that_has_nothing_of_the_scan_is_refused),
    };
    return cmocka_run_group_tests(tests, open_it, close_it);
}
