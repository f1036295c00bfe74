/* The study as a table: Markdown, CSV, JSON. */
#include "app/study/study.h"
#include "app/planner/store/json_table.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const char *study_group_name(int group)
{
    static const char *const text[GROUP_COUNT] = {"mesh", "element", "tolerance", "material", "threads", "scene"};
    return text[group];
}

static void print_soonest(const study_table *t, double most_mm, bool p95, FILE *out)
{
    int i = study_soonest(t, most_mm, p95, t->reference_error_mm), near = study_soonest(t, most_mm, p95, 0);
    fprintf(out, "* %.2f mm for %s: ", most_mm, p95 ? "95 % of the moved skin" : "the mean of the moved skin");
    if (i >= 0)
        fprintf(out, "**%s**, %.2f s", t->run[i].rung->name, t->run[i].result.wall_s);
    else
        fprintf(out, "no setting is shown to reach it");
    if (near >= 0 && near != i)
        fprintf(out, "%s **%s**, %.2f s, comes so near the reference, whatever that is off itself",
                i >= 0 ? ";" : ", but", t->run[near].rung->name, t->run[near].result.wall_s);
    fprintf(out, ".\n");
}

static void print_nearest(const study_table *t, FILE *out)
{
    int best = -1;
    for (int i = 0; i < t->count; i++)
        if (t->best[i] && (best < 0 || t->error[i].mean_mm < t->error[best].mean_mm)) best = i;
    if (best >= 0)
        fprintf(out, "\nNearest to the reference in the mean: **%s**, %.3f mm off it, %.2f s.\n",
                t->run[best].rung->name, t->error[best].mean_mm, t->run[best].result.wall_s);
}

static void print_orders(const study_table *t, FILE *out)
{
    const study_error *own = &t->error[study_default];
    const char *reference = study_rungs[study_reference].name, *coarsest = study_rungs[study_family[0]].name;
    fprintf(out,
            "One prediction, computed in %d ways and compared with the finest of them, the reference \"%s\": "
            "the case's "
            "own mesh with every edge halved, eight times the tets. An error is the distance between the two "
            "skins at "
            "the same vertex, over the %d vertices that move by more than 0.1 mm. \"edges x 2\" is a mesh "
            "made anew with "
            "edges twice as long as the case's: surface and attachments change with it. \"halved\" splits "
            "each tet in "
            "eight and keeps them: what it changes is the discretisation alone. Contact with bone, which "
            "predict counts in, is left out but in two rows."
            "\n\n",
            t->count, reference, own->vertices);
    fprintf(out, "The case's own mesh is %.3f mm off in the mean, %.3f mm at 95 %%, %.2f mm at most. ", own->mean_mm,
            own->p95_mm, own->max_mm);
    study_error anew = study_compare(&t->run[study_default + 1], &t->run[study_default]);
    fprintf(out,
            "Meshed anew with \"%s\", the skin differs from that of the case's own mesh by %.3f mm in the "
            "mean and "
            "%.3f mm at 95 %%, which no halving shows.\n\n",
            study_rungs[study_default + 1].name, anew.mean_mm, anew.p95_mm);
    if (isnan(t->order))
        fprintf(out,
                "How good is the reference? \"%s\", halved and halved twice give no order of convergence, so "
                "it is only "
                "known to be off by about its distance to the mesh that was halved, %.3f mm in the mean. ",
                coarsest, t->reference_error_mm);
    else
        fprintf(out,
                "How good is the reference? \"%s\", halved and halved twice converge with order %.2f (in the "
                "mean); if "
                "the case's own mesh and its half do so too, the reference is itself off by %.3f mm in the mean "
                "(Richardson's extrapolation%s). ",
                coarsest, t->order, t->reference_error_mm,
                t->order < 0.8 ? "; an order so far below 1 makes this a cautious bound" : "");
    fprintf(out,
            "Over meshes made anew the mean error falls with size to the power %.2f, with averaged volumes "
            "%.2f.\n\n",
            t->plain_slope, t->average_slope);
    fprintf(out, "Which setting reaches an error soonest, the reference's own counted in:\n\n");
}

static void print_tubes(const study_table *t, FILE *out)
{
    fprintf(out, "\n## Against an exact answer\n\nA thick tube in plane strain, inner wall turned by 26 degrees (4.5 "
                 "mm), against its "
                 "radial equations: root mean square error of the nodes, mm; between meshes the observed order.\n\n"
                 "| Poisson | tets | 4 cells | | 8 cells | | 16 cells | unknowns, s of the last |\n"
                 "|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < STUDY_TUBES; i += 3) {
        const study_tube *row = t->tube + i;
        fprintf(out, "| %.2f | %s ", row->poisson, row->average ? "averaged" : "plain");
        for (int k = 0; k < 3; k++) {
            if (k) fprintf(out, "| %.2f ", log2(row[k - 1].error_mm / row[k].error_mm));
            fprintf(out, "| %.4f ", row[k].error_mm);
        }
        fprintf(out, "| %lld, %.2f |\n", (long long)row[2].unknowns, row[2].wall_s);
    }
}

static bool is_other_question(int i) { return study_rungs[i].group == GROUP_MATERIAL || study_rungs[i].contact; }

void study_print(const study_table *t, FILE *out)
{
    fprintf(out, "# Error against run time: %s, %s\n\n", t->task->patient->name, t->plan_name);
    print_orders(t, out);
    for (int k = 0; k < 4; k++) print_soonest(t, k % 2 ? 0.02 : 0.1, k >= 2, out);
    print_nearest(t, out);
    fprintf(out,
            "\nTimes are of the solve alone, on %d cores; a mesh is made once per case. \"changes\" is the "
            "distance to "
            "the skin of the case's own settings, for runs on the same mesh: what a tolerance, a thread, a load "
            "step or tissue left out does to the answer. Rows of other materials, of another Poisson ratio and "
            "of "
            "contact answer another question: only that column says something of them. \"front\" marks what "
            "nothing "
            "beats in both time and mean error. \"averaged\" is the element with averaged volumes, which locks "
            "less.\n\n",
            t->cores);
    fprintf(out, "| | setting | outcome | nodes | unknowns | iterations (of them with contact) | factors | "
                 "wall s | CPU s "
                 "| order/assemble/factor/solve s "
                 "| peak MB | mean error mm | 95 %% mm | max mm | changes by mm, mean (max) | front |\n");
    fprintf(out, "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < t->count; i++) {
        const study_result *r = &t->run[i].result;
        fprintf(out, "| %s | %s | %s | ", study_group_name(study_rungs[i].group), study_rungs[i].name, r->text);
        if (!r->solved) {
            fprintf(out, "| | | | | | | %.0f | | | | | |\n", r->peak_mb);
            continue;
        }
        fprintf(out, "%d | %lld | %d (%d) | %d | %.2f | %.2f | %.2f/%.2f/%.2f/%.2f | %.0f | ", r->nodes,
                (long long)r->unknowns, r->iterations, r->contact_iterations, r->factorisations, r->wall_s, r->cpu_s,
                r->prepare_s, r->assemble_s, r->factor_s, r->solve_s, r->peak_mb);
        const study_error *error = &t->error[i], *change = &t->change[i];
        if (i == study_reference)
            fprintf(out, "reference | | | ");
        else if (is_other_question(i))
            fprintf(out, "| | | ");
        else
            fprintf(out, "%.3f | %.3f | %.2f | ", error->mean_mm, error->p95_mm, error->max_mm);
        if (isnan(change->mean_mm) || i == study_default)
            fprintf(out, "| ");
        else
            fprintf(out, "%.2g (%.2g) | ", change->mean_mm, change->max_mm);
        fprintf(out, "%s |\n", t->best[i] ? "yes" : "");
    }
    print_tubes(t, out);
}

bool study_write(const study_table *t, const json_t *record, const char *folder, err *e)
{
    static const char *const names[2] = {"study.md", "study.csv"};
    char path[FIELD_PATH_SIZE + 32];
    for (int k = 0; k < 2; k++) {
        whole_file f;
        snprintf(path, sizeof path, "%s/%s", folder, names[k]);
        if (!whole_file_open(path, &f, e)) return false;
        if (k)
            json_table_csv(json_object_get(record, "runs"), f.stream);
        else
            study_print(t, f.stream);
        if (!whole_file_close(&f, e)) return false;
    }
    snprintf(path, sizeof path, "%s/study.json", folder);
    return json_file_write(record, path, e) && study_plot(t, folder, e);
}
