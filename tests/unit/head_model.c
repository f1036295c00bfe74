/* Heads as vectors, models of them, and whether a made one is a head: on a template of ellipsoids. */
#include "app/planner/identity/head_gather.h"
#include "app/planner/identity/head_model.h"
#include "app/planner/identity/head_sound.h"
#include "geometry/parallel.h"
#include "tests/check.h"
#include "tests/small_head.h"
#include <unistd.h>

enum { HEADS = 8 };

static head_template t;
static double *phi[HEADS], bend[HEADS][SMALL_BENDS];
static const char *const name[HEADS] = {"a", "b", "c", "d", "e", "f", "g", "h"};

static double *vector_of(head_shape *s)
{
    err e = {0};
    double *x = NEW_ARRAY(double, head_layout_of(&t).start[HEAD_BLOCK_COUNT]);
    assert_ok(head_shape_to_frankfort(&t, s, NULL, &e));
    head_vector_of(&t, s, x);
    return x;
}

static int setup(void **unused)
{
    (void)unused;
    t = small_head();
    for (int s = 0; s < HEADS; s++) {
        for (int k = 0; k < SMALL_BENDS; k++) bend[s][k] = 8 * sin(1 + 2.3 * s + 1.7 * k * k + s * k) / (1 + k);
        head_shape h = small_shape(&t, bend[s]);
        phi[s] = vector_of(&h);
        head_shape_free(&h);
    }
    return 0;
}

static int teardown(void **unused)
{
    (void)unused;
    for (int s = 0; s < HEADS; s++) free(phi[s]);
    head_template_free(&t);
    return 0;
}

static head_model learnt(void)
{
    err e = {0};
    head_model m;
    assert_ok(head_model_learn(&t, (const double *const *)phi, name, HEADS, NULL, &m, &e));
    return m;
}

static double farthest(const double *a, const double *b)
{
    head_gap gap[HEAD_GAP_COUNT];
    double most = 0;
    head_vector_gaps(&t, a, b, NULL, gap);
    for (int k = 0; k < HEAD_GAP_COUNT; k++) most = fmax(most, gap[k].max_mm);
    return most;
}

static void a_shape_comes_back_from_its_vector(void **unused)
{
    (void)unused;
    head_shape s = head_vector_shape(&t, phi[3]);
    double *again = NEW_ARRAY(double, head_layout_of(&t).start[HEAD_BLOCK_COUNT]);
    head_vector_of(&t, &s, again);
    assert_near(farthest(again, phi[3]), 0, 0);
    landmarks l = head_points(&t, &s);
    for (int k = 0; k < 2; k++) assert_near(landmarks_find(&l, k ? "Po_L" : "Po_R")->xyz[2], 0, 1e-6);
    landmarks_free(&l);
    free(again);
    head_shape_free(&s);
}

static void where_a_head_lies_does_not_count_and_its_size_does(void **unused)
{
    (void)unused;
    head_shape s = small_shape(&t, bend[0]);
    rigid move = rigid_rotation((double[3]){10, 20, 30}, (double[3]){0.6, 0, 0.8}, 0.3);
    double *block[] = {s.part[0], s.part[1], s.part[2], s.part[3], s.part[4], s.rest, s.neutral};
    int nodes = t.tissue.mesh.vertex_count;
    for (int b = 0; b < 7; b++)
        for (int i = 0; i < (b < 5 ? t.part[b].vertex_count : nodes); i++)
            rigid_apply(&move, block[b] + 3 * i, block[b] + 3 * i);
    double *moved = vector_of(&s);
    assert_near(farthest(moved, phi[0]), 0, 1e-9);
    for (int b = 0; b < 7; b++)
        for (int i = 0; i < 3 * (b < 5 ? t.part[b].vertex_count : nodes); i++) block[b][i] *= 1.1;
    double *grown = vector_of(&s);
    assert_true(farthest(grown, phi[0]) > 8);
    free(moved);
    free(grown);
    head_shape_free(&s);
}

static void blocks_weigh_the_same(void **unused)
{
    (void)unused;
    head_layout l = head_layout_of(&t);
    double *w = head_vector_weights(&t);
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) {
        double sum = 0;
        for (int i = l.start[b]; i < l.start[b + 1]; i++) sum += w[i] / 3;
        assert_near(sum, b == HEAD_REST || b == HEAD_NEUTRAL ? 0.5 : 1, 1e-12);
    }
    free(w);
}

static void what_is_not_known_does_not_count(void **unused)
{
    (void)unused;
    head_layout l = head_layout_of(&t);
    double *known = NEW_ARRAY(double, l.start[HEAD_BLOCK_COUNT]);
    head_gap all[HEAD_GAP_COUNT], some[HEAD_GAP_COUNT];
    for (int i = l.start[HEAD_SKULL]; i < l.start[HEAD_MANDIBLE]; i++) known[i] = 1;
    head_vector_gaps(&t, phi[0], phi[1], NULL, all);
    head_vector_gaps(&t, phi[0], phi[1], known, some);
    assert_near(some[HEAD_SKULL].mean_mm, all[HEAD_SKULL].mean_mm, 0);
    assert_true(all[HEAD_FACE].mean_mm > 0 && isnan(some[HEAD_FACE].mean_mm) && isnan(some[HEAD_MANDIBLE].max_mm));
    free(known);
}

static void heads_of_few_bends_are_made_of_few_numbers(void **unused)
{
    (void)unused;
    head_model m = learnt();
    assert_true(m.modes.mode_count >= SMALL_BENDS && m.modes.mode_count < HEADS);
    double p[HEADS], *made = NEW_ARRAY(double, m.modes.length);
    for (int s = 0; s < HEADS; s++) {
        principal_project(&m.modes, phi[s], p);
        principal_make(&m.modes, p, m.modes.mode_count, made);
        assert_near(farthest(made, phi[s]), 0, 1e-6);
    }
    assert_true(m.left_out_rms_mm[0] > 1);
    assert_true(m.left_out_rms_mm[m.left_out_modes] < 0.1 * m.left_out_rms_mm[0]);
    assert_true(m.left_out[HEAD_FACE].max_mm >= m.left_out[HEAD_FACE].p95_mm);
    assert_true(m.left_out[HEAD_FACE].p95_mm >= m.left_out[HEAD_FACE].mean_mm);
    free(made);
    head_model_free(&m);
}

static void a_model_comes_back_from_its_file_bit_for_bit(void **unused)
{
    (void)unused;
    err e = {0};
    head_model m = learnt(), back;
    assert_ok(head_model_write(&m, "small.model", &e));
    assert_ok(head_model_read("small.model", &t, &back, &e));
    assert_int_equal(back.modes.mode_count, m.modes.mode_count);
    assert_int_equal(back.modes.sample_count, HEADS);
    assert_memory_equal(back.modes.mode, m.modes.mode,
                        sizeof(double) * (size_t)m.modes.length * (size_t)m.modes.mode_count);
    assert_memory_equal(back.modes.weight, m.modes.weight, sizeof(double) * (size_t)m.modes.length);
    assert_memory_equal(back.left_out, m.left_out, sizeof m.left_out);
    assert_memory_equal(back.score, m.score, sizeof(double) * (size_t)(HEADS * m.modes.mode_count));
    assert_string_equal(back.name[7], "h");
    head_model_free(&back);
    head_model_free(&m);
}

static void refuse_file(const char *path, const char *words)
{
    err e = {0};
    head_model m;
    assert_false(head_model_read(path, &t, &m, &e));
    assert_int_equal(e.code, ERR_INPUT);
    if (!strstr(e.text, words)) print_error("%s\n", e.text);
    assert_non_null(strstr(e.text, words));
}

static void a_model_of_another_template_or_not_whole_is_refused_by_name(void **unused)
{
    (void)unused;
    err e = {0};
    head_model m = learnt();
    assert_ok(head_model_write(&m, "other.model", &e));
    char own = t.numbering[0];
    t.numbering[0] = 'x';
    refuse_file("other.model",
                "other.model: was learnt on a template of another numbering (5ma11) than this program's (xma11)");
    t.numbering[0] = own;
    refuse_file("none.model", "none.model: cannot be read: No such file or directory");
    assert_int_equal(truncate("other.model", 4000), 0);
    refuse_file("other.model", "is not a whole model of identities");
    m.modes.length -= 3;
    assert_ok(head_model_write(&m, "other.model", &e));
    refuse_file("other.model", "other.model: weights: holds");
    m.modes.length += 3;
    m.modes.sd[1] = (double)NAN;
    assert_ok(head_model_write(&m, "other.model", &e));
    refuse_file("other.model", "other.model: sd: number 1 is not finite");
    head_model_free(&m);
    assert_refused(head_model_learn(&t, (const double *const *)phi, name, 2, NULL, &m, &e), ERR_GEOMETRY);
}

static void refuse_shape(const head_shape *s, const char *words)
{
    err e = {0};
    head_soundness f;
    assert_ok(head_soundness_of(&t, s, &f, &e));
    assert_false(head_sound(&f, 0, &e));
    assert_int_equal(e.code, ERR_GEOMETRY);
    if (!strstr(e.text, words)) print_error("%s\n", e.text);
    assert_non_null(strstr(e.text, words));
}

static void what_is_no_head_is_refused_with_the_reason(void **unused)
{
    (void)unused;
    err e = {0};
    head_soundness f;
    head_shape s = small_shape(&t, bend[1]);
    assert_ok(head_soundness_of(&t, &s, &f, &e));
    assert_ok(head_sound(&f, 0, &e));
    assert_true(f.min_j > 0.5 && f.min_j < 1 && f.teeth_overlap_mm <= 0 && f.bone_out_mm <= 0);
    double *node = s.rest + 3 * (t.tissue.mesh.vertex_count / 2), z = node[2];
    node[2] += 40;
    refuse_shape(&s, "tetrahedra of its tissue are inverted");
    node[2] = z;
    for (int i = 0; i < t.part[CASE_MANDIBLE].vertex_count; i++) s.part[CASE_MANDIBLE][3 * i + 1] -= 40;
    refuse_shape(&s, "its mandible lies ");
    for (int i = 0; i < t.part[CASE_MANDIBLE].vertex_count; i++) s.part[CASE_MANDIBLE][3 * i + 1] += 40;
    for (int i = 0; i < t.part[CASE_LOWER_TEETH].vertex_count; i++) s.part[CASE_LOWER_TEETH][3 * i + 2] += 4;
    refuse_shape(&s, "its upper and lower teeth lie ");
    head_shape_free(&s);
}

typedef struct source {
    int calls, refused; /* heads below this number are refused */
    err_code how;
} source;

static bool shape_of(void *context, int32_t i, head_shape *out, err *e)
{
    source *s = context;
    __atomic_add_fetch(&s->calls, 1, __ATOMIC_RELAXED);
    if (i < s->refused) return err_set(e, s->how, "has two noses");
    *out = small_shape(&t, bend[i % HEADS]);
    return true;
}

static void heads_are_gathered_once_and_in_order(void **unused)
{
    (void)unused;
    err e = {0};
    source of = {0};
    head_source from = {HEADS, name, shape_of, &of};
    for (int round = 0; round < 4; round++) {
        parallel_set_threads((const int[]){1, 2, 3, 8}[round]);
        head_set set;
        if (round < 2) unlink("gather.journal"); /* rounds 2 and 3 go on from where round 1 came to */
        assert_ok(head_gather(&t, &from, "key", "gather.journal", false, NULL, &set, &e));
        assert_int_equal(of.calls, round == 0 ? HEADS : 2 * HEADS);
        assert_int_equal(set.count, HEADS);
        assert_int_equal(set.fresh, round < 2 ? HEADS : 0);
        for (int s = 0; s < HEADS; s++) assert_near(farthest(set.phi[s], phi[s]), 0, 0);
        head_set_free(&set);
    }
    parallel_set_threads(0);
    head_set set;
    assert_refused(head_gather(&t, &from, "another", "gather.journal", false, NULL, &set, &e), ERR_INPUT);
    assert_ok(head_gather(&t, &from, "another", "gather.journal", true, NULL, &set, &e));
    head_set_free(&set);
}

static int notes;
static void count_note(const char *text, void *context)
{
    (void)context;
    if (strstr(text, "is left out: has two noses")) notes++;
}

static void a_head_that_cannot_be_had_is_left_out_and_told_and_two_of_ten_are_too_many(void **unused)
{
    (void)unused;
    err e = {0};
    task watch = {.note = count_note};
    static const char *const ten[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"};
    source of = {.refused = 1, .how = ERR_GEOMETRY};
    head_source from = {10, ten, shape_of, &of};
    head_set set;
    unlink("gather.journal");
    assert_ok(head_gather(&t, &from, "key", "gather.journal", false, &watch, &set, &e));
    assert_int_equal(set.count, 9);
    assert_int_equal(set.refused, 1);
    assert_int_equal(notes, 1);
    assert_string_equal(set.name[0], "2");
    head_set_free(&set);
    of.refused = 2;
    unlink("gather.journal");
    assert_refused(head_gather(&t, &from, "key", "gather.journal", false, &watch, &set, &e), ERR_GEOMETRY);
    of.how = ERR_RESOURCE; /* not that head's alone */
    unlink("gather.journal");
    assert_refused(head_gather(&t, &from, "key", "gather.journal", false, &watch, &set, &e), ERR_RESOURCE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_comes_back_from_its_vector),
        cmocka_unit_test(where_a_head_lies_does_not_count_and_its_size_does),
        cmocka_unit_test(blocks_weigh_the_same),
        cmocka_unit_test(what_is_not_known_does_not_count),
        cmocka_unit_test(heads_of_few_bends_are_made_of_few_numbers),
        cmocka_unit_test(a_model_comes_back_from_its_file_bit_for_bit),
        cmocka_unit_test(a_model_of_another_template_or_not_whole_is_refused_by_name),
        cmocka_unit_test(what_is_no_head_is_refused_with_the_reason),
        cmocka_unit_test(heads_are_gathered_once_and_in_order),
        cmocka_unit_test(a_head_that_cannot_be_had_is_left_out_and_told_and_two_of_ten_are_too_many),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
