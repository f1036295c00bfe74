#include "app/planner/patient/check_record.h"
#include <math.h>

static double exit_status(const void *of)
{
    const issue *i = of;
    return i->level == ISSUE_ERROR ? (double)i->code : (double)NAN;
}

static bool has_line(const void *of) { return ((const issue *)of)->line > 0; }

static const record_row issue_row[] = {
    ROW_WORD(issue, level, "level", "error|warning|info", "how bad it is"),
    {.kind = RECORD_COUNT,
     .number = exit_status,
     .name = "exit_status",
     .optional = true,
     .help = "of an error, which gnathos would leave with"},
    ROW_OPTIONAL(issue, file, "file", NULL, "the file it is in"),
    ROW_WHEN(has_line, issue, line, "line", NULL, "its line there"),
    ROW_OPTIONAL(issue, field, "field", NULL, "the field it is about"),
    ROW(issue, text, "text", NULL, "what is wrong"),
};
const record_table issue_table = {.title = "Something to tell of an input", RECORD_ROWS(issue_row)};

typedef struct checked_surface {
    const char *file;
    int32_t vertices, triangles, open_edges, crowded_edges;
    double diagonal_mm;
} checked_surface;

static const record_row surface_row[] = {
    ROW(checked_surface, file, "file", NULL, "the file it was read from"),
    ROW(checked_surface, vertices, "vertices", NULL, "its vertices"),
    ROW(checked_surface, triangles, "triangles", NULL, "its triangles"),
    ROW(checked_surface, open_edges, "open_edges", NULL, "edges with one triangle"),
    ROW(checked_surface, crowded_edges, "crowded_edges", NULL, "edges with more than two triangles"),
    ROW(checked_surface, diagonal_mm, "diagonal_mm", "mm", "of its box, corner to corner"),
};
static const record_table surface_table = {.title = "A surface of a case", RECORD_ROWS(surface_row)};

typedef struct check_record {
    const char *path, *name, *plan;
    const case_file *patient;
    const check_found *found;
    bool ok;
    int32_t landmarks, automatic;
    double residual_mm;
    int issues;
    const issue *issue;
} check_record;

static const void *next_surface(const void *of, int *i, const char **key, void *space)
{
    const check_record *r = of;
    const check_found *f = r->found;
    while (*i < CASE_SURFACE_COUNT && !f->mesh[*i].vertex_count) ++*i;
    if (*i == CASE_SURFACE_COUNT) return NULL;
    checked_surface *s = space;
    *s = (checked_surface){.file = r->patient->surface[*i],
                           .vertices = f->mesh[*i].vertex_count,
                           .triangles = f->mesh[*i].triangle_count,
                           .open_edges = f->open_edges[*i],
                           .crowded_edges = f->crowded_edges[*i],
                           .diagonal_mm = f->diagonal_mm[*i]};
    *key = case_surface_name((case_surface)*i);
    return s;
}

static const record_row check_row[] = {
    ROW(check_record, path, "case", NULL, "path of the case"),
    ROW(check_record, name, "name", NULL, "its name"),
    ROW(check_record, ok, "ok", NULL, "there is no error"),
    ROW_MAP(next_surface, "surface", OBJECT, &surface_table, "surfaces", NULL, "what was read"),
    ROW(check_record, landmarks, "landmarks", NULL, "how many landmarks were read"),
    ROW(check_record, automatic, "landmarks_automatic", NULL, "how many of them gnathos placed"),
    ROW_OPTIONAL(check_record, residual_mm, "frankfort_residual_mm", "mm",
                 "distance of porions and orbitales from their common plane"),
    ROW_OPTIONAL(check_record, plan, "plan", NULL, "path of the plan that was checked too"),
    ROW_ARRAY(check_record, issue, issues, &issue_table, "issues", "everything that is wrong or worth a word"),
};
const record_table check_record_table = {.kind = "check", .title = "Record of gnathos check", RECORD_ROWS(check_row)};

json_t *check_record_json(const case_file *c, const check_found *found, const char *plan, const issue_list *issues)
{
    const check_record r = {.path = c->path,
                            .name = c->name,
                            .plan = plan,
                            .patient = c,
                            .found = found,
                            .ok = issue_count(issues, ISSUE_ERROR) == 0,
                            .landmarks = found->points.count,
                            .automatic = landmarks_automatic(&found->points, NULL, 0),
                            .residual_mm = found->has_frame ? found->frame_residual_mm : (double)NAN,
                            .issues = issues->count,
                            .issue = issues->item};
    return record_json(&check_record_table, &r);
}
