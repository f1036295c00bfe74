/* gnathos check CASE [--plan P]: everything wrong at once. */
#include "app/cli/verb.h"
#include "app/planner/patient/check.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static const struct argp_option options[] = {{"plan", 'p', "PLAN", 0, "Check this plan against the case too", 0}, {0}};

static void print_plain(const case_file *c, const check_found *found, const plan_file *plan, const issue_list *issues)
{
    printf("case %s (%s)\n", c->name, c->path);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (found->mesh[i].vertex_count)
            printf("  %-12s %8d vertices %8d triangles %6d open edges %7.1f mm\n", case_surface_name((case_surface)i),
                   found->mesh[i].vertex_count, found->mesh[i].triangle_count, found->open_edges[i],
                   found->diagonal_mm[i]);
    printf("  landmarks    %8d points, Frankfort plane within %.2f mm\n", found->points.count,
           found->frame_residual_mm);
    if (plan) printf("plan %s (%s)\n", plan->name, plan->path);
    printf("no errors, %d warnings\n", issue_count(issues, ISSUE_WARNING));
}

static void set_text(json_t *o, const char *key, const char *text)
{
    if (text && *text) json_object_set_new(o, key, json_string(text));
}

static void print_json(const case_file *c, const check_found *found, const plan_file *plan, const issue_list *issues)
{
    json_t *list = json_array(), *surfaces = json_object();
    for (int i = 0; i < issues->count; i++) {
        const issue *one = &issues->item[i];
        json_t *o = json_pack("{s:s}", "level", issue_level_name(one->level));
        if (one->level == ISSUE_ERROR) json_object_set_new(o, "exit_status", json_integer(one->code));
        set_text(o, "file", one->file);
        if (one->line > 0) json_object_set_new(o, "line", json_integer(one->line));
        set_text(o, "field", one->field);
        set_text(o, "text", one->text);
        json_array_append_new(list, o);
    }
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (found->mesh[i].vertex_count)
            json_object_set_new(surfaces, case_surface_name((case_surface)i),
                                json_pack("{s:s, s:i, s:i, s:i, s:i, s:f}", "file", c->surface[i], "vertices",
                                          found->mesh[i].vertex_count, "triangles", found->mesh[i].triangle_count,
                                          "open_edges", found->open_edges[i], "crowded_edges", found->crowded_edges[i],
                                          "diagonal_mm", found->diagonal_mm[i]));
    json_t *result =
        json_pack("{s:s, s:s, s:b, s:o, s:i}", "case", c->path, "name", c->name, "ok",
                  issue_count(issues, ISSUE_ERROR) == 0, "surfaces", surfaces, "landmarks", found->points.count);
    if (found->has_frame) json_object_set_new(result, "frankfort_residual_mm", json_real(found->frame_residual_mm));
    if (plan) set_text(result, "plan", plan->path);
    json_object_set_new(result, "issues", list);
    command_print_json(result, "check");
}

static bool run(run_context *r, err *e)
{
    (void)e;
    case_file *c = &r->patient;
    const plan_file *plan = r->plan_path ? &r->plan : NULL;
    check_found found = {0};
    issue_list issues = {0};
    err first = {0};
    bool readable = case_file_read(r->argument[0], c, &issues);
    command_progress_at(&r->common, "surfaces", -1);
    check_surfaces(c, &found, &issues);
    check_bones_inside(c, &found, &issues);
    command_progress_at(&r->common, "landmarks", -1);
    check_landmarks(c, &found, &issues);
    check_planes(c, &issues);
    bool planned = plan && plan_file_read(r->plan_path, c, &r->plan, &issues);
    if (planned && readable && found.has_frame)
        planned = plan_moves_make(&r->plan, c, &found.points, &r->moves, &issues);
    bool ok = issue_none_is_error(&issues, &first);
    command_print_issues(&r->common, &issues);
    if (r->common.json)
        print_json(c, &found, plan, &issues);
    else if (ok && !r->common.quiet)
        print_plain(c, &found, plan, &issues);
    issue_list_free(&issues);
    check_found_free(&found);
    r->status = (int)first.code; /* all issues are told already */
    return true;
}

const verb verb_check = {.arguments = "CASE",
                         .about =
                             "Reads a case (a folder or its case.json) and, with --plan, a plan, and names everything "
                             "wrong in them: fields, files, units, meshes, landmarks, limits. Changes nothing. Errors "
                             "leave with the exit status of the first of them.",
                         .options = options,
                         .argument_count = 1,
                         .missing_argument = "name a case: a folder or its case.json",
                         .run = run};
