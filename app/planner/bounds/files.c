#include "app/planner/bounds/write.h"
#include "geometry/grid_file.h"
#include "geometry/mem.h"
#include <stdlib.h>
#include <string.h>

char *audit_map_name(const audit *a, int request, const char *ending)
{
    const audit_request *r = &a->settings.request[request];
    char name[256] = "map";
    for (int k = 0; k < r->axis_count; k++) {
        size_t n = strlen(name);
        snprintf(name + n, sizeof name - n, "_%s", a->settings.control[r->axis[k]].name);
    }
    size_t n = strlen(name);
    snprintf(name + n, sizeof name - n, "%s", ending);
    return mem_text(name);
}

const char *audit_level_name(int level)
{
    return level == VERDICT_STOP ? "stop" : level == VERDICT_CAUTION ? "caution" : "fine";
}

static void put_verdict(FILE *f, const verdict *v)
{
    fprintf(f, "%s,%s,%.17g", audit_level_name(v->level), limit_default[v->reason].name, v->value);
}

static bool write_samples(const audit *a, const output_dir *dir, err *e)
{
    char *path = output_dir_file(dir, "samples.csv");
    whole_file w;
    bool ok = whole_file_open(path, &w, e);
    free(path);
    if (!ok) return false;
    for (int k = 0; k < a->settings.control_count; k++) fprintf(w.stream, "%s,", a->settings.control[k].name);
    fprintf(w.stream, "level,limit,value\n");
    for (int64_t i = 0; i < a->points.count; i++) {
        const sample *s = &a->points.item[i];
        for (int k = 0; k < a->settings.control_count; k++) fprintf(w.stream, "%.10g,", audit_value(a, k, s->at[k]));
        put_verdict(w.stream, &s->v);
        fputc('\n', w.stream);
    }
    return whole_file_close(&w, e);
}

static bool write_map_csv(const audit *a, int request, const output_dir *dir, err *e)
{
    const feasible_map *m = &a->map[request];
    char *name = audit_map_name(a, request, ".csv"), *path = output_dir_file(dir, name);
    whole_file w;
    bool ok = whole_file_open(path, &w, e);
    free(path);
    free(name);
    if (!ok) return false;
    for (int k = 0; k < m->params.axis_count; k++)
        fprintf(w.stream, "%s,", a->settings.control[m->params.axis[k]].name);
    fprintf(w.stream, "level,limit,value,judged,behind\n");
    for (int64_t i = 0; i < m->node_count; i++) {
        int32_t at[SAMPLE_AXES_MAX];
        feasible_map_place(m, i, at);
        for (int k = 0; k < m->params.axis_count; k++)
            fprintf(w.stream, "%.10g,", audit_value(a, m->params.axis[k], at[m->params.axis[k]]));
        put_verdict(w.stream, &m->node[i]);
        fprintf(w.stream, ",%d,%d\n", m->judged[i], m->behind[i]);
    }
    return whole_file_close(&w, e);
}

static bool write_map_vti(const audit *a, int request, const output_dir *dir, err *e)
{
    const feasible_map *m = &a->map[request];
    enum { LEVEL, LIMIT, VALUE, JUDGED, BEHIND, ARRAYS };
    static const char *const names[ARRAYS] = {"level", "limit", "value", "judged", "behind"};
    double *data[ARRAYS], origin[3] = {0}, spacing[3] = {1, 1, 1};
    point_array arrays[ARRAYS];
    for (int i = 0; i < ARRAYS; i++) {
        data[i] = NEW_ARRAY(double, m->node_count);
        arrays[i] = (point_array){.name = names[i], .components = 1, .value = data[i]};
    }
    for (int64_t i = 0; i < m->node_count; i++) {
        data[LEVEL][i] = m->node[i].level;
        data[LIMIT][i] = m->node[i].reason;
        data[VALUE][i] = m->node[i].value;
        data[JUDGED][i] = m->judged[i];
        data[BEHIND][i] = m->behind[i];
    }
    for (int k = 0; k < m->params.axis_count; k++) {
        origin[k] = audit_value(a, m->params.axis[k], m->params.low[k]);
        spacing[k] = a->settings.spacing;
    }
    char *name = audit_map_name(a, request, ".vti"), *path = output_dir_file(dir, name);
    bool ok = grid_file_write(m->count, origin, spacing, arrays, ARRAYS, path, e);
    for (int i = 0; i < ARRAYS; i++) free(data[i]);
    free(path);
    free(name);
    return ok;
}

bool audit_write_files(const audit *a, const output_dir *dir, err *e)
{
    json_t *record = NULL;
    char *path = output_dir_file(dir, "audit.json");
    bool ok = audit_json(a, &record, e) && json_file_write(record, path, e) && write_samples(a, dir, e);
    json_decref(record);
    free(path);
    for (int i = 0; ok && i < a->settings.request_count; i++)
        if (a->map[i].node_count) ok = write_map_csv(a, i, dir, e) && write_map_vti(a, i, dir, e);
    return ok;
}
