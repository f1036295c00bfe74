/* The results for people and for programs. */
#include "app/stress/stress.h"
#include "app/planner/store/json_table.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *stress_kind_name(int kind)
{
    static const char *const text[] = {"solved", "refused", "gave up", "CRASHED", "TIMED OUT"};
    return text[kind];
}

const char *stress_want_name(int want)
{
    static const char *const text[] = {"solved", "refused", "solved or gives up", "gives up"};
    return text[want];
}

static const char *verdict(const stress_case *c, const stress_result *r)
{
    return !r->wrong[0] ? "as expected" : c->known ? "known limit" : "WRONG";
}

/* A number for a cell: "" where it is not known. */
static const char *cell(char *out, size_t size, const char *format, double x)
{
    if (isnan(x)) return "";
    snprintf(out, size, format, x);
    return out;
}

void stress_print(const stress_case *const *c, const stress_result *r, int count, FILE *out)
{
    enum { WIDE = 32 };
    fprintf(out, "| case | expected | outcome | iterations | residual mN | Newton step mm | energy uJ | min "
                 "J | inverted | moved mm | CPU s | |\n");
    fprintf(out, "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < count; i++) {
        char a[WIDE], b[WIDE], d[WIDE], e[WIDE], f[WIDE], g[WIDE];
        const stress_result *one = &r[i];
        fprintf(out, "| %s | %s | %s | %d | %s | %s | %s | %s | %d | %s | %s | %s |\n", c[i]->name,
                stress_want_name(c[i]->want),
                one->kind == STRESS_SOLVED || one->kind == STRESS_GAVE_UP ? one->text : stress_kind_name(one->kind),
                one->iterations, cell(a, WIDE, "%.2e", one->checked_mn >= 0 ? one->checked_mn : one->residual_mn),
                cell(b, WIDE, "%.1e", one->correction_mm), cell(d, WIDE, "%.6g", one->energy_uj),
                cell(e, WIDE, "%.4g", one->min_j), one->inverted, cell(f, WIDE, "%.4g", one->moved_mm),
                cell(g, WIDE, "%.2f", one->cpu_s), verdict(c[i], one));
    }
    int wrong = 0, known = 0;
    fputc('\n', out);
    for (int i = 0; i < count; i++) {
        if (!r[i].wrong[0]) continue;
        wrong += !c[i]->known;
        known += c[i]->known != NULL;
        fprintf(out, "* %s: %s (%s)%s%s\n", c[i]->name, r[i].wrong, r[i].text, c[i]->known ? "; known: " : "",
                c[i]->known ? c[i]->known : "");
    }
    fprintf(out, "%s%d cases, %d not as expected, %d known limit%s\n", wrong + known ? "\n" : "", count, wrong, known,
            known == 1 ? "" : "s");
}

static bool open_in(const char *folder, const char *name, whole_file *out, err *e)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s/%s", folder, name);
    bool ok = whole_file_open(path, out, e);
    free(path);
    return ok;
}

bool stress_write(const stress_case *const *c, const stress_result *r, int count, const json_t *record,
                  const char *folder, err *e)
{
    whole_file f;
    if (!open_in(folder, "stress.md", &f, e)) return false;
    stress_print(c, r, count, f.stream);
    if (!whole_file_close(&f, e) || !open_in(folder, "stress.csv", &f, e)) return false;
    json_table_csv(json_object_get(record, "cases"), f.stream);
    if (!whole_file_close(&f, e)) return false;
    size_t size = strlen(folder) + 16;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s/stress.json", folder);
    bool ok = json_file_write(record, path, e);
    free(path);
    return ok;
}
