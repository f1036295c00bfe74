/* seeds FIRST LAST FILE [COARSENESS]: synthetic heads of the seeds FIRST to LAST: teeth and mandible as `gnathos new`
 * makes them and the mandible cut as `gnathos cut` does. Classes and sexes take turns. Adds one line per seed to FILE
 * and leaves out seeds that are there already. */
#include "cases/norm_head/norm_head.h"
#include "geometry/boolean.h"
#include "geometry/handles.h"
#include "geometry/osteotomy.h"
#include "geometry/repair.h"
#include "tests/norm_bite.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char *const header = "seed,class,sex,proximal_left,proximal_right,distal_made,laid_anew,overjet_mm,"
                                  "overbite_mm,bite_in_range,touching_left,touching_right,overlap_mm,cant_deg,seconds,"
                                  "fault\n";

typedef struct row {
    int seed, skeletal_class, genus[2], made, anew;
    norm_sex sex;
    norm_bite bite;
    double overjet_mm, overbite_mm;
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
        if (norm_bite_measure(&h, &p, &r->bite, &e) && !cut(&h, r, &e)) r->genus[0] = r->genus[1] = -1;
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
            r->bite.in_range, r->bite.touching[0], r->bite.touching[1], r->bite.overlap_mm, r->bite.cant_deg, seconds,
            r->fault);
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
