/* The results for people and for programs. */
#include "app/stress/stress.h"
#include "app/planner/store/json_table.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const kind_text[] = {"solved", "refused", "gave up", "CRASHED", "TIMED OUT"};
static const char *const want_text[] = {"solved", "refused", "solved or gives up", "gives up"};

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
                want_text[c[i]->want],
                one->kind == STRESS_SOLVED || one->kind == STRESS_GAVE_UP ? one->text : kind_text[one->kind],
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

static json_t *as_json(const stress_case *c, const stress_result *r)
{
    json_t *o = json_pack("{ss ss ss ss ss ss}", "case", c->name, "what", c->what, "expected", want_text[c->want],
                          "outcome", kind_text[r->kind], "text", r->text, "wrong", r->wrong);
    json_object_set_new(o, "known_limit", json_string(c->known ? c->known : ""));
    const json_column numbers[] = {{"nodes", r->nodes},
                                   {"tets", r->tets},
                                   {"unknowns", (double)r->unknowns},
                                   {"iterations", r->iterations},
                                   {"factorisations", r->factorisations},
                                   {"loads", r->loads},
                                   {"residual_mN", r->residual_mn},
                                   {"tolerance_mN", r->tolerance_mn},
                                   {"checked_residual_mN", r->checked_mn},
                                   {"newton_step_mm", r->correction_mm},
                                   {"energy_uJ", r->energy_uj},
                                   {"min_J", r->min_j},
                                   {"max_stretch", r->max_stretch},
                                   {"inverted_tets", r->inverted},
                                   {"moved_mm", r->moved_mm},
                                   {"contact_depth_mm", r->depth_mm},
                                   {"seconds", r->seconds},
                                   {"cpu_seconds", r->cpu_s},
                                   {"memory_MB", r->memory_mb}};
    json_columns(o, numbers, sizeof numbers / sizeof *numbers);
    return o;
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

json_t *stress_json(const stress_case *const *c, const stress_result *r, int count)
{
    json_t *list = json_array();
    int wrong = 0, known = 0;
    for (int i = 0; i < count; i++) {
        json_array_append_new(list, as_json(c[i], &r[i]));
        wrong += r[i].wrong[0] && !c[i]->known;
        known += r[i].wrong[0] && c[i]->known;
    }
    return json_pack("{si si si so}", "count", count, "wrong", wrong, "known_limits", known, "cases", list);
}

bool stress_write(const stress_case *const *c, const stress_result *r, int count, const char *folder, err *e)
{
    whole_file f;
    if (!open_in(folder, "stress.md", &f, e)) return false;
    stress_print(c, r, count, f.stream);
    if (!whole_file_close(&f, e) || !open_in(folder, "stress.csv", &f, e)) return false;
    json_t *all = stress_json(c, r, count);
    json_table_csv(json_object_get(all, "cases"), f.stream);
    if (!whole_file_close(&f, e) || !open_in(folder, "manifest.json", &f, e)) {
        json_decref(all);
        return false;
    }
    json_object_set_new(all, "schema", json_string("gnathos.stress.1"));
    json_dumpf(all, f.stream, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
    fputc('\n', f.stream);
    json_decref(all);
    return whole_file_close(&f, e);
}
