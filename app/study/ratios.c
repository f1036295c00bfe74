/* The moves that the literature reports, and how far soft tissue follows each. Windows: Gupta and Schendel
 * 2022 (Peterson's Principles of Oral and Maxillofacial Surgery, tables 67.1 to 67.10, some thirty primary
 * papers), widened to the spread of the papers and rounded. */
#include "app/study/study.h"
#include "geometry/mem.h"
#include "geometry/rig.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct standard_move {
    const char *name, *file;                       /* file: no spaces */
    double maxilla_mm[2], mandible_mm, chin_mm[2]; /* forward and up */
    double close_deg;                              /* the jaw turns shut about the condyles: autorotation */
} standard_move;

enum {
    LF_ADVANCE,
    LF_IMPACT,
    LF_SETBACK,
    MAND_ADVANCE,
    MAND_SETBACK,
    AUTOROTATION,
    CHIN_ADVANCE,
    CHIN_SETBACK,
    CHIN_LONGER,
    CHIN_SHORTER,
    MMA,
    MOVE_COUNT
};
static const standard_move moves[MOVE_COUNT] = {
    [LF_ADVANCE] = {"Le Fort I advance 5 mm", "lf_advance", .maxilla_mm = {5, 0}},
    [LF_IMPACT] = {"Le Fort I impaction 4 mm", "lf_impact", .maxilla_mm = {0, 4}},
    [LF_SETBACK] = {"Le Fort I setback 3 mm", "lf_setback", .maxilla_mm = {-3, 0}},
    [MAND_ADVANCE] = {"mandibular advance 6 mm", "mand_advance", .mandible_mm = 6},
    [MAND_SETBACK] = {"mandibular setback 5 mm", "mand_setback", .mandible_mm = -5},
    [AUTOROTATION] = {"autorotation 2 degrees", "autorotation", .close_deg = 2},
    [CHIN_ADVANCE] = {"genioplasty advance 6 mm", "chin_advance", .chin_mm = {6, 0}},
    [CHIN_SETBACK] = {"genioplasty setback 4 mm", "chin_setback", .chin_mm = {-4, 0}},
    [CHIN_LONGER] = {"genioplasty lengthening 4 mm", "chin_longer", .chin_mm = {0, -4}},
    [CHIN_SHORTER] = {"genioplasty shortening 4 mm", "chin_shorter", .chin_mm = {0, 4}},
    [MMA] = {"both jaws advance 10 mm", "mma", .maxilla_mm = {10, 0}, .mandible_mm = 10},
};

enum { FORWARD, UP };
/* Of genioplasties the chin moves as a whole and Pog may lie above its cut: Me stands for the bone. */
static const struct window {
    int move;
    const char *soft, *hard;
    int axis;
    double low, high;
    const char *published; /* range of the papers */
} windows[] = {
    {LF_ADVANCE, "Ls", "U1", FORWARD, 0.4, 0.9, "0.33-0.90"},
    {LF_ADVANCE, "A'", "A", FORWARD, 0.35, 0.9, "0.38-0.91"},
    {LF_ADVANCE, "Sn", "A", FORWARD, 0.25, 0.65, "0.24-0.60"},
    {LF_ADVANCE, "Pn", "U1", FORWARD, 0.1, 0.4, "0.17-0.36"},
    {LF_IMPACT, "Ls", "U1", UP, 0.1, 0.5, "0.30-0.51"},
    {LF_IMPACT, "Stms", "U1", UP, 0.2, 0.5, "0.40-0.41"},
    {LF_IMPACT, "Sn", "U1", UP, 0.15, 0.35, "0.20-0.29"},
    {LF_IMPACT, "Pn", "U1", UP, 0.1, 0.25, "0.15-0.16"},
    {LF_SETBACK, "Ls", "U1", FORWARD, 0.5, 0.8, "0.66-0.76"},
    {LF_SETBACK, "Sn", "U1", FORWARD, 0.2, 0.5, "0.33"},
    {LF_SETBACK, "A'", "U1", FORWARD, 0.2, 0.5, "0.33"},
    {MAND_ADVANCE, "Li_soft", "L1", FORWARD, 0.4, 0.8, "0.26-0.85"},
    {MAND_ADVANCE, "B'", "B", FORWARD, 0.85, 1.15, "0.86-1.19"},
    {MAND_ADVANCE, "Pg'", "Pog", FORWARD, 0.9, 1.1, "0.94-1.10"},
    {MAND_ADVANCE, "Me'", "Me", FORWARD, 0.85, 1.1, "0.87-1.04"},
    {MAND_ADVANCE, "Ls", "L1", FORWARD, -0.1, 0.1, "-0.02"},
    {MAND_SETBACK, "Li_soft", "L1", FORWARD, 0.6, 1.0, "0.75-1.02"},
    {MAND_SETBACK, "B'", "B", FORWARD, 0.85, 1.1, "0.93-1.09"},
    {MAND_SETBACK, "Pg'", "Pog", FORWARD, 0.8, 1.05, "0.83-1.04"},
    {MAND_SETBACK, "Ls", "L1", FORWARD, 0, 0.35, "0.20-0.32"},
    {AUTOROTATION, "Pg'", "Pog", FORWARD, 0.75, 1.1, "0.79-1.0"},
    {AUTOROTATION, "Pg'", "Pog", UP, 0.75, 1.2, "0.8-1.2"},
    {AUTOROTATION, "Li_soft", "L1", FORWARD, 0.75, 1.1, "0.75"},
    {AUTOROTATION, "B'", "B", FORWARD, 0.75, 1.1, "0.9-1.0"},
    {CHIN_ADVANCE, "Pg'", "Me", FORWARD, 0.6, 1.0, "0.57-1.0"},
    {CHIN_ADVANCE, "Li_soft", "Me", FORWARD, 0, 0.5, "0.44"},
    {CHIN_SETBACK, "Pg'", "Me", FORWARD, 0.3, 0.75, "0.33-0.75"},
    {CHIN_LONGER, "Me'", "Me", UP, 0.8, 1.05, "1.0"},
    {CHIN_SHORTER, "Me'", "Me", UP, 0.2, 0.45, "0.25-0.40"},
    {MMA, "Ls", "U1", FORWARD, 0.8, 1.0, "about 0.90"},
    {MMA, "Li_soft", "L1", FORWARD, 0.8, 1.0, "about 0.90"},
    {MMA, "Pg'", "Pog", FORWARD, 0.8, 1.0, "about 0.90"},
};
enum { WINDOWS = sizeof windows / sizeof *windows, MESHES = 3 };
/* The case's own mesh first; the spread over the three is the error bar. */
static const study_rung meshes[MESHES] = {{.name = "the case's own", .coarsening = 1},
                                          {.name = "edges x 1.5", .coarsening = 1.5},
                                          {.name = "edges x 2, halved", .coarsening = 2, .refined = 1}};

static bool motion_of(const standard_move *m, const prepared *p, rigid motion[SEGMENT_COUNT], err *e)
{
    rig_controls c = rig_controls_default();
    const landmark *left = landmarks_find(&p->points, "Co_L"), *right = landmarks_find(&p->points, "Co_R");
    double condyle[2][3] = {{0}};
    c.maxilla_advance_mm = m->maxilla_mm[FORWARD];
    c.maxilla_impaction_mm = m->maxilla_mm[UP];
    c.mandible_advance_mm = m->mandible_mm;
    if (m->chin_mm[FORWARD] != 0 || m->chin_mm[UP] != 0) {
        c.move[SEGMENT_CHIN].kind = MOVE_ANGLES;
        vec_scale(p->frame.posterior, -m->chin_mm[FORWARD], c.move[SEGMENT_CHIN].translate_mm);
        vec_axpy(c.move[SEGMENT_CHIN].translate_mm, m->chin_mm[UP], p->frame.up,
                 c.move[SEGMENT_CHIN].translate_mm);
    }
    c.jaw.open_deg = -m->close_deg;
    if (left && right) {
        vec_copy(left->xyz, condyle[0]);
        vec_copy(right->xyz, condyle[1]);
    }
    return rig_motion(&c, &p->frame, left && right ? (const double(*)[3])condyle : NULL, motion, e);
}

static bool component(const prepared *p, const study_run *r, const char *label, int axis, double *mm)
{
    const landmark *l = landmarks_find(&p->points, label);
    if (!l || !r->point_mm) return false;
    const double *d = r->point_mm + 3 * (l - p->points.point);
    *mm = axis == FORWARD ? -vec_dot(d, p->frame.posterior) : vec_dot(d, p->frame.up);
    return true;
}

static double ratio_of(const prepared *p, const study_run *r, const struct window *w)
{
    double soft, hard;
    if (!component(p, r, w->soft, w->axis, &soft) || !component(p, r, w->hard, w->axis, &hard) ||
        fabs(hard) < 0.5)
        return (double)NAN;
    return soft / hard;
}

static const char *verdict(const struct window *w, double ratio, double bar)
{
    if (isnan(ratio)) return "not known";
    if (ratio >= w->low && ratio <= w->high)
        return ratio - bar >= w->low && ratio + bar <= w->high ? "inside" : "inside, at the edge";
    double out = ratio < w->low ? w->low - ratio : ratio - w->high;
    return out <= bar ? "OUTSIDE, within the bar" : "OUTSIDE";
}

typedef struct ratio_table {
    double ratio[WINDOWS][MESHES];
    bool solved[MOVE_COUNT][MESHES];
} ratio_table;

static void print(const ratio_table *t, const char *name, bool csv, FILE *out)
{
    int outside = 0, known = 0;
    if (csv)
        fprintf(out, "move,soft,hard,direction,ratio,bar,low,high,published,verdict\n");
    else
        fprintf(
            out,
            "# Soft : hard ratios of %s\n\nThe bar is the largest difference to the ratio on two other "
            "meshes, \"%s\" and \"%s\": "
            "surface, attachment and tets anew. Windows: published ranges of patients, rounded outwards.\n\n"
            "| move | soft : hard | | ratio | bar | window | published | "
            "|\n|---|---|---|---|---|---|---|---|\n",
            name, meshes[1].name, meshes[2].name);
    for (int i = 0; i < WINDOWS; i++) {
        const struct window *w = &windows[i];
        double bar = 0;
        for (int k = 1; k < MESHES; k++)
            if (!isnan(t->ratio[i][k])) bar = fmax(bar, fabs(t->ratio[i][k] - t->ratio[i][0]));
        const char *says = t->solved[w->move][0] ? verdict(w, t->ratio[i][0], bar) : "not solved";
        known += !isnan(t->ratio[i][0]);
        outside += !strncmp(says, "OUTSIDE", 7);
        const char *direction = w->axis == FORWARD ? "forward" : "up";
        if (csv)
            fprintf(out, "%s,%s,%s,%s,%.4f,%.4f,%g,%g,%s,\"%s\"\n", moves[w->move].name, w->soft, w->hard,
                    direction, t->ratio[i][0], bar, w->low, w->high, w->published, says);
        else if (isnan(t->ratio[i][0]))
            fprintf(out, "| %s | %s : %s | %s | | | %g to %g | %s | %s |\n", moves[w->move].name, w->soft,
                    w->hard, direction, w->low, w->high, w->published, says);
        else
            fprintf(out, "| %s | %s : %s | %s | %.2f | %.2f | %g to %g | %s | %s |\n", moves[w->move].name,
                    w->soft, w->hard, direction, t->ratio[i][0], bar, w->low, w->high, w->published, says);
    }
    if (!csv) fprintf(out, "\n%d ratios known, %d outside their window.\n", known, outside);
}

bool study_ratios(study_task *t, const prepared *p, command_options *common, err *e)
{
    ratio_table table = {0};
    for (int m = 0; m < MOVE_COUNT; m++) {
        bool possible = motion_of(&moves[m], p, t->motion, e);
        if (!possible) { /* a case without condyles */
            command_note(common, "%s: left out: %s", moves[m].name, e->text);
            *e = (err){0};
        }
        t->name = moves[m].file;
        if (possible && !study_task_key(t, e)) return false;
        for (int k = 0; k < MESHES; k++) {
            study_run run = {0};
            bool fresh;
            char stage[160];
            snprintf(stage, sizeof stage, "%s, %s", moves[m].name, meshes[k].name);
            command_progress_at(common, stage, (double)(MESHES * m + k) / (MESHES * MOVE_COUNT));
            if (possible && !study_get(t, &meshes[k], &run, &fresh, e)) return false;
            table.solved[m][k] = run.result.solved;
            if (possible && !run.result.solved) command_note(common, "%s: %s", stage, run.result.text);
            for (int i = 0; i < WINDOWS; i++)
                if (windows[i].move == m) table.ratio[i][k] = ratio_of(p, &run, &windows[i]);
            study_run_free(&run);
        }
    }
    for (int csv = 0; csv < 2; csv++) {
        char path[FIELD_PATH_SIZE + 32];
        whole_file f;
        snprintf(path, sizeof path, "%s/ratios.%s", t->folder, csv ? "csv" : "md");
        if (!whole_file_open(path, &f, e)) return false;
        print(&table, t->patient->name, csv, f.stream);
        if (!whole_file_close(&f, e)) return false;
    }
    print(&table, t->patient->name, false, stdout);
    return true;
}
