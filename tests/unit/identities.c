/* What programs read of a model of identities, a head in it and a head made of it: on a template of ellipsoids. */
#include "app/identities/identities.h"
#include "tests/check.h"
#include "tests/small_head.h"

enum { HEADS = 6 };

static head_template t;
static head_model m;
static double *phi[HEADS];
static const char *const name[HEADS] = {"a", "b", "c", "d", "e", "f"};

static int setup(void **unused)
{
    (void)unused;
    err e = {0};
    t = small_head();
    for (int s = 0; s < HEADS; s++) {
        double bend[SMALL_BENDS];
        for (int k = 0; k < SMALL_BENDS; k++) bend[k] = 6 * sin(1 + 2.3 * s + 1.7 * k * k + s * k);
        head_shape h = small_shape(&t, bend);
        phi[s] = NEW_ARRAY(double, head_layout_of(&t).start[HEAD_BLOCK_COUNT]);
        if (!head_shape_to_frankfort(&t, &h, NULL, &e)) return -1;
        head_vector_of(&t, &h, phi[s]);
        head_shape_free(&h);
    }
    return head_model_learn(&t, (const double *const *)phi, name, HEADS, NULL, &m, &e) ? 0 : -1;
}

static int teardown(void **unused)
{
    (void)unused;
    for (int s = 0; s < HEADS; s++) free(phi[s]);
    head_model_free(&m);
    head_template_free(&t);
    return 0;
}

static double number_at(const json_t *o, const char *a, const char *b, const char *c)
{
    for (const char *const path[] = {a, b, c}, *const *k = path; k < path + 3 && *k; k++) o = json_object_get(o, *k);
    assert_true(json_is_number(o));
    return json_number_value(o);
}

static void the_record_of_a_model_has_every_mode_and_every_head(void **unused)
{
    (void)unused;
    const identities_learnt l = {.model = m, .bytes = 1000, .fresh = HEADS, .fit_s = 2};
    json_t *o = identities_json(&l), *modes = json_object_get(o, "modes"), *first = json_array_get(modes, 0),
           *last = json_array_get(modes, (size_t)m.modes.mode_count - 1);
    assert_string_equal(record_kind_of(o), "identities");
    assert_int_equal(json_array_size(modes), m.modes.mode_count);
    assert_int_equal(json_array_size(json_object_get(o, "names")), HEADS);
    assert_near(number_at(first, "share", NULL, NULL), principal_share(&m.modes, 0), 1e-15);
    assert_near(number_at(first, "left_out_rms_mm", NULL, NULL), m.left_out_rms_mm[1], 1e-15);
    assert_true(json_is_null(json_object_get(last, "left_out_rms_mm"))); /* one head fewer, one mode fewer */
    assert_near(number_at(o, "left_out", "face", "max_mm"), m.left_out[HEAD_FACE].max_mm, 1e-15);
    assert_near(number_at(o, "seconds", "fit", NULL), 2, 0);
    json_decref(o);
    const identities_learnt shown = {.model = m};
    o = identities_json(&shown);
    assert_null(json_object_get(o, "bytes")); /* what learning took is not known later */
    json_decref(o);
}

static void the_record_of_a_projection_has_its_coefficients_and_errors(void **unused)
{
    (void)unused;
    identities_projection p = {.name = "head", .model = &m, .gap = {[HEAD_SKULL] = {1, 2, 3}}};
    for (int k = 0; k < m.modes.mode_count; k++) p.p[k] = k - 1.5;
    json_t *o = identity_json(&p), *numbers = json_object_get(o, "p");
    assert_int_equal(json_array_size(numbers), m.modes.mode_count);
    assert_near(json_number_value(json_array_get(numbers, 1)), -0.5, 0);
    assert_near(number_at(o, "error", "skull", "p95_mm"), 2, 0);
    json_decref(o);
}

static void the_record_of_a_made_head_tells_draws_of_random_ones_only(void **unused)
{
    (void)unused;
    identities_made made = {.model = &m, .folder = "new", .p_count = 2, .p = {1, -1}, .tries = 1};
    json_t *o = identity_made_json(&made);
    assert_null(json_object_get(o, "draws"));
    assert_int_equal(json_array_size(json_object_get(o, "p")), 2);
    json_decref(o);
    made.random = true;
    made.seed = 9;
    o = identity_made_json(&made);
    assert_near(number_at(o, "seed", NULL, NULL), 9, 0);
    json_decref(o);
}

static void coefficients_that_no_head_has_are_refused_before_anything_is_made(void **unused)
{
    (void)unused;
    err e = {0};
    issue_list warnings = {0};
    identities_made made = {.folder = "identities_new", .p_count = 1, .p = {3.5}};
    assert_refused(identities_make(&t, &m, &made, NULL, &warnings, &e), ERR_USAGE);
    made.p_count = HEAD_MODES_MOST;
    made.p[0] = 0;
    assert_refused(identities_make(&t, &m, &made, NULL, &warnings, &e), ERR_USAGE);
    made.p_count = 1; /* ellipsoids are a sound shape, and no head to check */
    assert_false(identities_make(&t, &m, &made, NULL, &warnings, &e));
    assert_int_equal(e.code, ERR_INPUT);
    assert_non_null(strstr(e.text, "identities_new"));
    issue_list_free(&warnings);
}

/* Modes 0 and 1 of these two go together: a drawn head is near one of them. */
static void a_drawn_head_has_what_goes_together_and_is_nobodys(void **unused)
{
    (void)unused;
    enum { DRAWS = 4000 };
    double score[] = {1, 1, -1, -1}, p[2], q[2], sum = 0, square[2] = {0};
    const head_model two = {.score = score, .modes = {.sample_count = 2, .mode_count = 2}};
    uint64_t state = 7, again = 7;
    for (int i = 0; i < DRAWS; i++) {
        head_model_draw(&two, &state, p);
        if (i == 0) head_model_draw(&two, &again, q);
        if (i == 0) assert_memory_equal(p, q, sizeof p);
        for (int k = 0; k < 2; k++) {
            assert_true(fabs(p[k]) <= 2 / hypot(1, 0.5) && fabs(p[k]) != 1);
            square[k] += p[k] * p[k] / DRAWS;
        }
        sum += p[0] * p[1] / DRAWS;
    }
    for (int k = 0; k < 2; k++) assert_near(square[k], 1, 0.08); /* the kernel's tails are cut */
    assert_near(sum, 0.8, 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_record_of_a_model_has_every_mode_and_every_head),
        cmocka_unit_test(the_record_of_a_projection_has_its_coefficients_and_errors),
        cmocka_unit_test(the_record_of_a_made_head_tells_draws_of_random_ones_only),
        cmocka_unit_test(a_drawn_head_has_what_goes_together_and_is_nobodys),
        cmocka_unit_test(coefficients_that_no_head_has_are_refused_before_anything_is_made),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
