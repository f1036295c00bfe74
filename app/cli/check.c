/* gnathos check CASE [--plan P]: everything wrong at once. */
#include "app/cli/verb.h"
#include "app/planner/patient/check_record.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static const struct argp_option options[] = {{"plan", 'p', "PLAN", 0, "Check this plan against the case too", 0}, {0}};

static void print_plain(const case_file *c, const check_found *found, const plan_file *plan, const issue_list *issues)
{
    printf("case %s (%s)\n", c->name, command_shown(c->path));
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (found->mesh[i].vertex_count)
            printf("  %-12s %8d vertices %8d triangles %6d open edges %7.1f mm\n", case_surface_name((case_surface)i),
                   found->mesh[i].vertex_count, found->mesh[i].triangle_count, found->open_edges[i],
                   found->diagonal_mm[i]);
    printf("  landmarks    %8d points, Frankfort plane within %.2f mm\n", found->points.count,
           found->frame_residual_mm);
    if (plan) printf("plan %s (%s)\n", plan->name, command_shown(plan->path));
    printf("no errors, %d warnings\n", issue_count(issues, ISSUE_WARNING));
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
    check_case(c, &r->watch, &found, &issues);
    bool planned = plan && plan_file_read(r->plan_path, c, &r->plan, &issues);
    if (planned && readable && found.has_frame)
        planned = plan_moves_make(&r->plan, c, &found.points, &r->moves, &issues);
    bool ok = issue_none_is_error(&issues, &first);
    command_print_issues(&r->common, &issues);
    if (r->common.json)
        command_print_record(check_record_json(c, &found, plan ? plan->path : NULL, &issues));
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
