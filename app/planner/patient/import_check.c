#include "app/planner/patient/check.h"
#include "app/planner/patient/check_parts.h"
#include "app/planner/patient/import.h"
#include "geometry/frame.h"
#include <stdio.h>

/* What check will say of bones against skin and of landmarks, as advice: landmarks can be mended in the case. */
void import_note_as_case(const import_params *p, const import_result *r, issue_list *notes)
{
    case_file c = case_file_default();
    check_found f = {.points = r->points};
    const char *name[CASE_SURFACE_COUNT];
    head_frame frame;
    err e = {0};
    issue_list found = {0};
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        name[i] = r->part[i].source;
        snprintf(c.surface[i], sizeof c.surface[i], "%s", name[i]);
        f.mesh[i] = r->part[i].mesh;
        f.open_edges[i] = r->part[i].open_edges;
        f.crowded_edges[i] = r->part[i].crowded_edges;
    }
    snprintf(c.landmarks, sizeof c.landmarks, "%s", p->landmarks ? p->landmarks : "");
    f.has_frame = r->has_points && head_frame_from_landmarks(&r->points, &frame, &e);
    check_trees(f.mesh, name, f.tree, &found);
    check_bones_inside(&c, &f, &found);
    check_place(&c, &f, &found);
    check_order(&c, &f, &found);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) nearest_destroy(&f.tree[i]);
    for (int i = 0; i < found.count; i++)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, found.item[i].file, 0, found.item[i].field, "%s", found.item[i].text);
    issue_list_free(&found);
}
