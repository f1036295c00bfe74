/* gnathos study --ratios: every standard move as predict solves it, and on other meshes, beside published
 * windows. */
#include "app/study/measures.h"
#include "app/study/record.h"
#include "app/planner/store/json_table.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <string.h>

/* As predict solves it; and without contact, which takes a tenth of the time: on the same mesh, and on others
 * whose distance to it is the error bar. */
enum { PREDICTED, SAME_MESH, COARSER, FINER, RUNS };
static const study_rung runs[RUNS] = {[PREDICTED] = {.name = "predicted", .coarsening = 1, .contact = CONTACT_BONES},
                                      [SAME_MESH] = {.name = "without contact", .coarsening = 1},
                                      [COARSER] = {.name = "edges x 1.5", .coarsening = 1.5},
                                      [FINER] = {.name = "edges x 2, halved", .coarsening = 2, .refined = 1}};

typedef enum verdict { INSIDE, AT_EDGE, WITHIN_BAR, OUTSIDE, NOT_KNOWN, NO_BAR } verdict;
static const char *const verdict_text[] = {"inside",  "inside, at the edge", "OUTSIDE, within the bar",
                                           "OUTSIDE", "not known",           "inside, no bar"};

typedef struct answer {
    const study_measure *m;
    double value[RUNS], bar; /* NaN: not known */
    int verdict;
    char why[96]; /* of NOT_KNOWN; else what the reader should know, or "" */
} answer;

static void judge(answer *a)
{
    const study_measure *m = a->m;
    double x = a->value[PREDICTED], out = fmax(m->low - x, x - m->high);
    a->bar = (double)NAN;
    for (int k = COARSER; k < RUNS; k++) /* fmax passes NaN over */
        a->bar = fmax(a->bar, fabs(a->value[k] - a->value[SAME_MESH]));
    if (isnan(x))
        a->verdict = NOT_KNOWN;
    else if (out > 0)
        a->verdict = out <= a->bar ? WITHIN_BAR : OUTSIDE;
    else
        a->verdict = isnan(a->bar) ? NO_BAR : -out < a->bar ? AT_EDGE : INSIDE;
}

static void print_window(const study_measure *m, FILE *out)
{
    if (isinf(m->high))
        fprintf(out, "above %g", m->low);
    else if (isinf(m->low))
        fprintf(out, "below %g", m->high);
    else
        fprintf(out, "%g to %g", m->low, m->high);
}

static void print_row(const answer *a, FILE *out)
{
    char name[96];
    study_measure_name(a->m, name, sizeof name);
    fprintf(out, "| %s | %s | ", study_moves[a->m->move].name, name);
    if (a->verdict == NOT_KNOWN)
        fprintf(out, "| | ");
    else if (isnan(a->bar))
        fprintf(out, "%.2f | | ", a->value[PREDICTED]);
    else
        fprintf(out, "%.2f | %.2f | ", a->value[PREDICTED], a->bar);
    print_window(a->m, out);
    fprintf(out, " | %s | %s%s%s |\n", a->m->published, verdict_text[a->verdict], a->why[0] ? ": " : "", a->why);
}

static void print(const answer *a, const char *name, FILE *out)
{
    int outside = 0, known = 0;
    fprintf(out, "# Prediction beside published moves: %s\n\n", name);
    fprintf(out,
            "Each standard move is solved as gnathos predict does; its value stands beside the range that "
            "papers report. "
            "The bar is the largest difference that another mesh makes, \"%s\" or \"%s\": surface, "
            "attachment and tets anew, "
            "all without contact with bone. \"A : B, forward\" is how far skin point A goes for each mm of "
            "bone or tooth "
            "point B; forward is along Frankfort, up across it. Windows are the published ranges of "
            "patients, rounded "
            "outwards; an open one asks for the sign alone. The nasolabial angle is taken at Sn between Ls "
            "and Cm, or Pn "
            "where a head has no Cm; Stms is the upper lip's edge at Stm where both lips share a point.\n\n",
            runs[COARSER].name, runs[FINER].name);
    fprintf(out, "| move | measure | value | bar | window | published | |\n|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < STUDY_MEASURES; i++) {
        known += a[i].verdict != NOT_KNOWN;
        outside += a[i].verdict == OUTSIDE || a[i].verdict == WITHIN_BAR;
        print_row(&a[i], out);
    }
    fprintf(out, "\n%d measures known, %d outside their window.\n", known, outside);
}

typedef struct answer_view {
    const char *move, *published, *verdict;
    char measure[96], why[96];
    double value[RUNS], bar, low, high;
} answer_view;

#define VALUE(run, name_, help_)                                                                                       \
    {                                                                                                                  \
        .kind = RECORD_NUMBER, .offset = offsetof(answer_view, value) + (run) * sizeof(double), .name = name_,         \
        .help = help_                                                                                                  \
    }

static const record_row answer_row[] = {
    ROW(answer_view, move, "move", NULL, "the standard move"),
    ROW(answer_view, measure, "measure", NULL, "what is measured of it"),
    VALUE(PREDICTED, "value", "as gnathos predict solves it"),
    VALUE(SAME_MESH, "value_without_contact", "the same without contact"),
    VALUE(COARSER, "value_edges_x1_5", "without contact, on a mesh of edges 1.5 times as long"),
    VALUE(FINER, "value_edges_x2_halved", "without contact, edges twice as long and halved"),
    ROW(answer_view, bar, "bar", NULL, "the largest difference that another mesh makes"),
    ROW(answer_view, low, "low", NULL, "low end of the published window; null: open"),
    ROW(answer_view, high, "high", NULL, "high end of it; null: open"),
    ROW(answer_view, published, "published", NULL, "what papers report"),
    ROW(answer_view, verdict, "verdict", NULL, "how the value stands to the window"),
    ROW(answer_view, why, "why", NULL, "why it is not known, or what to know"),
};
static const record_table answer_table = {.title = "A measure of a standard move", RECORD_ROWS(answer_row)};

typedef struct ratios_view {
    const char *case_name;
    const answer *answer;
} ratios_view;

static const void *next_answer(const void *of, int *i, const char **key, void *space)
{
    (void)key;
    if (*i == STUDY_MEASURES) return NULL;
    const answer *a = &((const ratios_view *)of)->answer[*i];
    answer_view *v = space;
    *v = (answer_view){.move = study_moves[a->m->move].name,
                       .published = a->m->published,
                       .verdict = verdict_text[a->verdict],
                       .bar = a->bar,
                       .low = a->m->low,
                       .high = a->m->high};
    study_measure_name(a->m, v->measure, sizeof v->measure);
    memcpy(v->why, a->why, sizeof v->why);
    memcpy(v->value, a->value, sizeof v->value);
    return v;
}

static const record_row ratios_row[] = {
    ROW(ratios_view, case_name, "case", NULL, "name of the case"),
    ROW_LIST(next_answer, &answer_table, "measures", "every measure of every standard move"),
};
const record_table study_ratios_table = {
    .kind = "study_ratios", .title = "Record of gnathos study --ratios, ratios.json", RECORD_ROWS(ratios_row)};

static bool write(const answer *a, const json_t *record, const study_task *t, err *e)
{
    char path[FIELD_PATH_SIZE + 32];
    for (int csv = 0; csv < 2; csv++) {
        whole_file f;
        snprintf(path, sizeof path, "%s/ratios.%s", t->folder, csv ? "csv" : "md");
        if (!whole_file_open(path, &f, e)) return false;
        if (csv)
            json_table_csv(json_object_get(record, "measures"), f.stream);
        else
            print(a, t->patient->name, f.stream);
        if (!whole_file_close(&f, e)) return false;
    }
    snprintf(path, sizeof path, "%s/ratios.json", t->folder);
    return json_file_write(record, path, e);
}

/* The answers of one move; on each mesh from the journal, else solved now. */
static bool run_move(study_task *t, int move, const prepared *p, answer *a, err *e)
{
    const standard_move *m = &study_moves[move];
    char reason[96] = "";
    if (!study_move_motion(m, p, t->motion, e)) {
        snprintf(reason, sizeof reason, "%.90s", e->text);
        *e = (err){0};
    } else if (!study_task_key(t, e)) {
        return false;
    }
    t->name = m->file;
    for (int k = 0; k < RUNS; k++) {
        study_run run = {0};
        bool fresh;
        char stage[160];
        snprintf(stage, sizeof stage, "%s, %s", m->name, runs[k].name);
        task_progress(t->watch, stage, (double)(RUNS * move + k) / (RUNS * study_move_count));
        if (!reason[0] && !study_get(t, &runs[k], &run, &fresh, e)) return false;
        if (!reason[0] && !run.result.solved) task_note(t->watch, "%s: %s", stage, run.result.text);
        for (int i = 0; i < STUDY_MEASURES; i++) {
            if (a[i].m->move != move) continue;
            a[i].value[k] = study_measure_value(a[i].m, p, &run);
            const char *lacks = study_measure_lacks(a[i].m, p);
            if (k > 0) continue;
            if (reason[0] || !run.result.solved)
                snprintf(a[i].why, sizeof a[i].why, "%.90s", reason[0] ? reason : run.result.text);
            else if (lacks)
                snprintf(a[i].why, sizeof a[i].why, "the head has no landmark %s", lacks);
            else
                snprintf(a[i].why, sizeof a[i].why, "%s hardly moves", a[i].m->hard);
        }
        study_run_free(&run);
    }
    return true;
}

bool study_ratios(study_task *t, prepared *p, FILE *out, json_t **record, err *e)
{
    answer a[STUDY_MEASURES] = {0};
    for (int i = 0; i < STUDY_MEASURES; i++) a[i].m = &study_measures[i];
    study_add_lips(p);
    for (int move = 0; move < study_move_count; move++)
        if (!run_move(t, move, p, a, e)) return false;
    for (int i = 0; i < STUDY_MEASURES; i++) {
        judge(&a[i]);
        if (a[i].verdict == NOT_KNOWN) continue;
        bool stands_in = a[i].m->kind == MEASURE_TURNS && !landmarks_find(&p->points, "Cm");
        snprintf(a[i].why, sizeof a[i].why, "%s", stands_in ? "Pn stands for Cm" : "");
    }
    const ratios_view v = {t->patient->name, a};
    json_t *own = record_json(&study_ratios_table, &v);
    bool ok = write(a, own, t, e);
    if (ok && record)
        *record = json_incref(own);
    else if (ok)
        print(a, t->patient->name, out);
    json_decref(own);
    return ok;
}
