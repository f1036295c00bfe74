#include "app/planner/patient/case_warnings.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const record_row warning_row[] = {
    {RECORD_AT(case_warning, part), .name = "part",
     .words = "skin|skull|mandible|upper_teeth|lower_teeth|landmarks|planes|case|cuts", .help = "what it is about"},
    ROW_OPTIONAL(case_warning, field, "field", NULL, "the landmark or field it is about"),
    ROW(case_warning, text, "text", NULL, "what is doubtful"),
};
const record_table case_warning_table = {.title = "Something doubtful about a case", RECORD_ROWS(warning_row)};

/* The name of a part, and its path: case_surface first, then these. */
enum { PART_LANDMARKS = CASE_SURFACE_COUNT, PART_PLANES, PART_CASE, PART_CUTS, PART_COUNT };

static const char *part_name(int part)
{
    static const char *const others[] = {"landmarks", "planes", "case", "cuts"};
    return part < CASE_SURFACE_COUNT ? case_surface_name((case_surface)part) : others[part - CASE_SURFACE_COUNT];
}

static const char *part_path(const case_file *c, int part)
{
    switch (part) {
    case PART_LANDMARKS: return c->landmarks;
    case PART_PLANES: return c->planes;
    case PART_CASE: return c->path;
    case PART_CUTS: return NULL;
    default: return c->surface[part];
    }
}

/* Whether an issue shows the path. */
static bool shows(const char *shown, const char *path)
{
    char text[4 * FIELD_PATH_SIZE];
    if (!path || !*path) return false;
    snprintf(text, sizeof text, "%s", path);
    err_printable(text, sizeof text);
    return !strcmp(shown, text);
}

static int part_of(const case_file *c, const issue *one)
{
    if (!one->file) return PART_CUTS;
    for (int part = 0; part < PART_CASE; part++)
        if (shows(one->file, part_path(c, part))) return part;
    return PART_CASE;
}

static void add(case_warnings *w, const char *part, const char *of, const char *text)
{
    w->item = GROW_ARRAY(case_warning, w->item, w->count + 1);
    w->item[w->count++] = (case_warning){.part = part, .field = of, .text = text};
}

void case_warnings_make(const case_file *c, const issue_list *from, case_warnings *out)
{
    *out = (case_warnings){0};
    for (int i = 0; i < from->count; i++) {
        const issue *one = &from->item[i];
        if (one->level == ISSUE_WARNING) add(out, part_name(part_of(c, one)), one->field, one->text);
    }
    if (!from->left_out[ISSUE_WARNING]) return;
    snprintf(out->more, sizeof out->more, "and %d more warnings, which gnathos check counts too",
             from->left_out[ISSUE_WARNING]);
    add(out, part_name(PART_CASE), NULL, out->more);
}

void case_warnings_free(case_warnings *w)
{
    free(w->item);
    *w = (case_warnings){0};
}

void case_warnings_read(const json_t *list, case_warnings *out)
{
    size_t i;
    json_t *item;
    *out = (case_warnings){0};
    json_array_foreach((json_t *)list, i, item)
    {
        const char *part = json_string_value(json_object_get(item, "part")),
                   *text = json_string_value(json_object_get(item, "text"));
        if (part && text) add(out, part, json_string_value(json_object_get(item, "field")), text);
    }
}

void case_warnings_issues(const case_warnings *w, const case_file *c, issue_list *out)
{
    for (int i = 0; i < w->count; i++) {
        const case_warning *one = &w->item[i];
        int part = 0;
        while (part < PART_CUTS && strcmp(part_name(part), one->part)) part++;
        issue_add(out, ISSUE_WARNING, ERR_NONE, part_path(c, part), 0, part == PART_CUTS ? one->part : one->field, "%s",
                  one->text);
    }
}
