/* seeds FIRST LAST FILE [COARSENESS]: synthetic heads of the seeds FIRST to LAST: teeth and mandible as `gnathos new`
 * makes them and the mandible cut as `gnathos cut` does. Classes and sexes take turns. Adds one line per seed to FILE
 * and leaves out seeds that are there already. */
#include "cases/norm_head/norm_head.h"
#include "geometry/boolean.h"
#include "geometry/handles.h"
#include "geometry/nearest.h"
#include "geometry/osteotomy.h"
#include "geometry/repair.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char *const header = "seed,class,sex,proximal_left,proximal_right,distal_made,laid_anew,overjet_mm,"
                                  "overbite_mm,bite_in_range,touching_left,touching_right,overlap_mm,cant_deg,seconds,"
                                  "fault\n";

typedef struct row {
    int seed, skeletal_class, genus[2], made, anew, touching[2];
    norm_sex sex;
    bool in_range;
    double overjet_mm, overbite_mm, overlap_mm, cant_deg;
    char fault[256];
} row;

static bool known(const char *path, int seed)
{
    char line[512];
    bool found = false;
    FILE *f = fopen(path, "r");
    while (f && !found && fgets(line, sizeof line, f)) found = strchr("0123456789", *line) && atoi(line) == seed;
    if (f) fclose(f);
    return found;
}

/* Within two standard deviations of the mean of the class, or what can be built of that. */
static bool in_range(measure_id id, const row *r, const norm_head *h)
{
    const measure *m = &measures[id];
    double mean = m->mean[r->sex] + (r->skeletal_class > 1 ? m->class_shift[r->skeletal_class - 2] : 0),
           low = fmax(mean - 2 * m->sd[r->sex], m->low), high = fmin(mean + 2 * m->sd[r->sex], m->high);
    return h->obtained[id] > low - 0.1 && h->obtained[id] < high + 0.1;
}

/* Lower teeth behind the canines within 0.1 mm of an upper tooth, and the deepest that any lies in one. */
static bool find_contacts(const norm_head *h, row *r, err *e)
{
    enum { BEHIND_CANINE = 3 };
    nearest *upper = NULL;
    int32_t *shell, shells = surface_components(&h->lower_teeth, &shell);
    if (!nearest_create(&h->upper_teeth, &upper, e)) return false;
    double *least = malloc((size_t)shells * sizeof *least);
    for (int32_t i = 0; i < shells; i++) least[i] = HUGE_VAL;
    for (int32_t i = 0; i < 3 * h->lower_teeth.triangle_count; i++) {
        const double *p = h->lower_teeth.xyz + 3 * (size_t)h->lower_teeth.tri[i];
        double d = nearest_point(upper, p, NULL, NULL);
        if (d < 1 && nearest_inside(upper, p)) d = -d;
        least[shell[i / 3]] = fmin(least[shell[i / 3]], d);
    }
    for (int32_t i = 0; i < shells; i++) {
        if (i % (shells / 2) < BEHIND_CANINE) continue;
        r->touching[i >= shells / 2] += least[i] < 0.1;
        r->overlap_mm = fmax(r->overlap_mm, -least[i]);
    }
    free(least);
    free(shell);
    nearest_destroy(&upper);
    return true;
}

/* Steeper of the two lines through the first molars, against the horizontal. */
static double cant_deg(const landmarks *l)
{
    static const char *const pair[2][2] = {{"U6_L", "U6_R"}, {"L6_L", "L6_R"}};
    double worst = 0;
    for (int k = 0; k < 2; k++) {
        const double *a = landmarks_find(l, pair[k][0])->xyz, *b = landmarks_find(l, pair[k][1])->xyz;
        double deg = atan2(a[2] - b[2], a[0] - b[0]) * 180 / acos(-1);
        if (fabs(deg) > fabs(worst)) worst = deg;
    }
    return worst;
}

static bool cut(const norm_head *h, row *r, err *e)
{
    repair_params rp = repair_params_default();
    osteotomy_params op = osteotomy_params_default();
    surface part[2] = {{0}}, jaw = {0};
    segments s = {0};
    cut_report report = {0};
    bool ok = repair_solid(&h->mandible, &rp, &part[0], NULL, e) &&
              repair_solid(&h->lower_teeth, &rp, &part[1], NULL, e) && boolean_unite(part, 2, &jaw, e);
    const osteotomy_input in = {.mandible = &jaw, .points = &h->points, .kinds = OSTEOTOMY_BSSO};
    ok = ok && osteotomy_cut(&in, &op, &s, &report, e);
    if (ok) {
        int32_t all = 0;
        for (int i = 0; i < SEGMENT_COUNT; i++) all += report.handles[i];
        for (int k = 0; k < 2; k++) r->genus[k] = report.handles[SEGMENT_PROXIMAL_LEFT + k];
        r->made = all - surface_handles(&jaw) - r->genus[0] - r->genus[1];
        for (int i = 0; i < report.warning_count; i++) r->anew += strstr(report.warning[i], "moved inwards") != NULL;
    }
    segments_free(&s);
    cut_report_free(&report);
    for (int k = 0; k < 2; k++) surface_free(&part[k]);
    surface_free(&jaw);
    return ok;
}

static void run(const norm_mean *mean, row *r)
{
    err e = {0};
    norm_head h = {0};
    norm_head_params p = norm_head_params_default();
    p.sex = r->sex;
    p.skeletal_class = r->skeletal_class;
    p.seed = (uint64_t)r->seed;
    if (norm_head_shape(mean, &p, &h, &e)) {
        r->overjet_mm = h.obtained[OVERJET_MM];
        r->overbite_mm = h.obtained[OVERBITE_MM];
        r->in_range = in_range(OVERJET_MM, r, &h) && in_range(OVERBITE_MM, r, &h);
        r->cant_deg = cant_deg(&h.points);
        if (find_contacts(&h, r, &e) && !cut(&h, r, &e)) r->genus[0] = r->genus[1] = -1;
    }
    snprintf(r->fault, sizeof r->fault, "%.255s", e.text);
    for (char *c = r->fault; *c; c++)
        if (*c == ',' || *c == '\n') *c = ';';
    norm_head_free(&h);
}

static void write_row(FILE *f, const row *r, double seconds)
{
    fprintf(f, "%d,%d,%c,%d,%d,%d,%d,%.2f,%.2f,%d,%d,%d,%.2f,%.3f,%.1f,%s\n", r->seed, r->skeletal_class,
            r->sex == NORM_MALE ? 'm' : 'f', r->genus[0], r->genus[1], r->made, r->anew, r->overjet_mm, r->overbite_mm,
            r->in_range, r->touching[0], r->touching[1], r->overlap_mm, r->cant_deg, seconds, r->fault);
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc > 5) return fprintf(stderr, "usage: %s FIRST LAST FILE [COARSENESS]\n", argv[0]), 2;
    err e = {0};
    norm_mean *mean = NULL;
    if (!norm_mean_build(argc > 4 ? atof(argv[4]) : 1, true, &mean, &e))
        return fprintf(stderr, "seeds: %s\n", e.text), 1;
    for (int seed = atoi(argv[1]); seed <= atoi(argv[2]); seed++) {
        if (known(argv[3], seed)) continue;
        clock_t start = clock();
        row r = {.seed = seed, .skeletal_class = seed % 3 + 1, .sex = seed % 2 ? NORM_FEMALE : NORM_MALE};
        run(mean, &r);
        FILE *f = fopen(argv[3], "a");
        if (!f) return perror(argv[3]), 1;
        if (!ftell(f)) fputs(header, f);
        write_row(f, &r, (double)(clock() - start) / CLOCKS_PER_SEC);
        fclose(f);
    }
    norm_mean_free(mean);
    return 0;
}
