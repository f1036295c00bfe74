/* gnathos study --ratios: every standard move as predict solves it, and on other meshes, beside published
 * windows. */
#include "app/study/measures.h"
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

static json_t *as_json(const answer *a)
{
    char name[96];
    study_measure_name(a->m, name, sizeof name);
    json_t *o = json_pack("{ss ss}", "move", study_moves[a->m->move].name, "measure", name);
    const json_column numbers[] = {{"value", a->value[PREDICTED]},
                                   {"value_without_contact", a->value[SAME_MESH]},
                                   {"value_edges_x1.5", a->value[COARSER]},
                                   {"value_edges_x2_halved", a->value[FINER]},
                                   {"bar", a->bar},
                                   {"low", a->m->low},
                                   {"high", a->m->high}};
    json_columns(o, numbers, sizeof numbers / sizeof *numbers);
    json_object_set_new(o, "published", json_string(a->m->published));
    json_object_set_new(o, "verdict", json_string(verdict_text[a->verdict]));
    json_object_set_new(o, "why", json_string(a->why));
    return o;
}

static json_t *table_json(const answer *a, const char *name)
{
    json_t *rows = json_array();
    for (int i = 0; i < STUDY_MEASURES; i++) json_array_append_new(rows, as_json(&a[i]));
    return json_pack("{ss so}", "case", name, "measures", rows);
}

static bool write(const answer *a, const study_task *t, err *e)
{
    for (int csv = 0; csv < 2; csv++) {
        char path[FIELD_PATH_SIZE + 32];
        whole_file f;
        snprintf(path, sizeof path, "%s/ratios.%s", t->folder, csv ? "csv" : "md");
        if (!whole_file_open(path, &f, e)) return false;
        if (csv) {
            json_t *all = table_json(a, t->patient->name);
            json_table_csv(json_object_get(all, "measures"), f.stream);
            json_decref(all);
        } else {
            print(a, t->patient->name, f.stream);
        }
        if (!whole_file_close(&f, e)) return false;
    }
    return true;
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
    if (!write(a, t, e)) return false;
    if (record)
        *record = table_json(a, t->patient->name);
    else
        print(a, t->patient->name, out);
    return true;
}
