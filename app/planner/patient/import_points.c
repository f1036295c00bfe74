#include "app/planner/patient/import.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/frame.h"
#include <stdio.h>

static void note_landmarks(const import_result *r, issue_list *notes)
{
    head_frame frame;
    err why = {0};
    char missing[512] = "";
    size_t n = 0;
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark_row *row = &landmark_rows[i];
        if (row->need != NEED_ALWAYS || row->instead || landmarks_find(&r->points, row->label)) continue;
        n += (size_t)snprintf(missing + n, n < sizeof missing ? sizeof missing - n : 0, " %s", row->label);
    }
    if (!r->has_points)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL,
                  "no landmarks: place at least%s in 3D Slicer and save them as landmarks.mrk.json in the case, or let "
                  "`gnathos landmarks` (or --landmarks auto) place them",
                  missing);
    else if (*missing)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL, "landmarks still missing:%s", missing);
    else if (!head_frame_from_landmarks(&r->points, &frame, &why))
        issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL, "%s", why.text);
    if (r->points_skipped)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL,
                  "%d landmarks without a defined position were left out", r->points_skipped);
}

/* By p->place; names those that are too doubtful to be written as placed. */
static bool place_landmarks(const import_params *p, const task *watch, import_result *r, issue_list *notes, err *e)
{
    surface part[CASE_SURFACE_COUNT];
    char names[600] = "";
    size_t n = 0;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) part[i] = r->part[i].mesh;
    if (!p->place(part, watch, &r->points, e)) return false;
    for (int32_t i = 0; i < r->points.count; i++)
        if (r->points.point[i].doubt_mm > LANDMARK_DOUBT_MOST_MM && n < sizeof names)
            n += (size_t)snprintf(names + n, sizeof names - n, " %s", r->points.point[i].label);
    issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL,
              "the landmarks were placed by gnathos: look at them in 3D Slicer before they are used");
    if (n)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, NULL, 0, NULL,
                  "these may be more than %g mm off and are written as not placed:%s", LANDMARK_DOUBT_MOST_MM, names);
    return true;
}

bool import_points(const import_params *p, const task *watch, import_result *r, issue_list *notes, err *e)
{
    bool good = true;
    if (p->landmarks) {
        good = landmarks_read(p->landmarks, &r->points, &r->points_skipped, e);
        r->has_points = good;
    } else if (p->place) {
        good = r->has_points = place_landmarks(p, watch, r, notes, e);
    }
    if (good) note_landmarks(r, notes);
    return good;
}
