#include "app/planner/patient/anatomy.h"
#include "app/planner/patient/check.h"
#include "geometry/boolean.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/plane_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool stopped(const task *watch, err *e)
{
    return task_interrupted(watch) && !err_set(e, ERR_INTERRUPTED, "interrupted");
}

static bool read_solid(const case_file *c, case_surface which, const task *watch, surface *raw, surface *solid,
                       repair_report *report, err *e)
{
    if (stopped(watch, e)) return false;
    repair_params p = repair_params_default();
    surface in = {0};
    if (!mesh_read_surface(c->surface[which], case_file_space(c), &in, NULL, e)) return false;
    if (!repair_solid(&in, &p, solid, report, e)) {
        surface_free(&in);
        return err_prefix(e, "%s", c->surface[which]);
    }
    if (raw)
        *raw = in;
    else
        surface_free(&in);
    return true;
}

/* A bone, united with its teeth where the case has them apart. */
static bool read_bone(const case_file *c, case_surface bone, case_surface teeth, const task *watch, surface *out,
                      repair_report *report, err *e)
{
    surface part[2] = {{0}};
    if (!read_solid(c, bone, watch, NULL, &part[0], report, e)) return false;
    if (!c->surface[teeth][0]) {
        *out = part[0];
        return true;
    }
    bool ok =
        read_solid(c, teeth, watch, NULL, &part[1], NULL, e) && !stopped(watch, e) && boolean_unite(part, 2, out, e);
    surface_free(&part[0]);
    surface_free(&part[1]);
    return ok;
}

/* The user's planes, each labelled with the segment it cuts off. */
static bool user_planes(const case_file *c, cut_plane **out, int *count, err *e)
{
    cut_plane *all = NULL;
    int found = 0;
    *out = NULL;
    *count = 0;
    for (int i = 0; i < c->osteotomy_count; i++) {
        const case_osteotomy *o = &c->osteotomy[i];
        if (o->cut != CUT_USER) continue;
        if (!all && !planes_read(c->planes, &all, &found, e)) return false;
        int at = 0;
        while (at < found && strcmp(all[at].label, o->plane)) at++;
        if (at == found) {
            free(all);
            free(*out);
            *out = NULL;
            return err_at(e, ERR_INPUT, c->planes, 0, NULL, "has no plane \"%s\", which an osteotomy of the case needs",
                          o->plane);
        }
        *out = GROW_ARRAY(cut_plane, *out, *count + 1);
        cut_plane *p = &(*out)[(*count)++];
        *p = all[at];
        snprintf(p->label, sizeof p->label, "%s", segment_name(o->segment));
    }
    free(all);
    return true;
}

static bool cut(const case_file *c, anatomy *a, err *e)
{
    osteotomy_input in = {.skull = &a->skull, .mandible = &a->mandible, .points = &a->points};
    if (case_file_cuts(c, CUT_LE_FORT_1)) in.kinds |= OSTEOTOMY_LE_FORT_1;
    if (case_file_cuts(c, CUT_BSSO)) in.kinds |= OSTEOTOMY_BSSO;
    if (case_file_cuts(c, CUT_GENIOPLASTY)) in.kinds |= OSTEOTOMY_GENIOPLASTY;
    cut_plane *planes;
    if (!user_planes(c, &planes, &in.plane_count, e)) return false;
    in.plane = planes;
    bool ok = osteotomy_params_check(&c->cuts, e) && osteotomy_cut(&in, &c->cuts, &a->segments, &a->cuts, e);
    free(planes);
    for (int i = 0; ok && i < a->cuts.warning_count; i++)
        issue_add(&a->warnings, ISSUE_WARNING, ERR_NONE, NULL, 0, "cuts", "%s", a->cuts.warning[i]);
    for (int i = 0; ok && i < a->cuts.note_count; i++)
        issue_add(&a->warnings, ISSUE_INFO, ERR_NONE, NULL, 0, "cuts", "%s", a->cuts.note[i]);
    return ok;
}

bool anatomy_make(const case_file *c, bool skin, const task *watch, anatomy *out, err *e)
{
    anatomy a = {0};
    clock_span begin = clock_now();
    bool ok = check_case_passes(c, watch, &a.warnings, e);
    a.check_span = clock_lap(&begin);
    task_progress(watch, "reading and repairing the surfaces", 0.1);
    ok = ok && landmarks_read(c->landmarks, &a.points, NULL, e) && head_frame_from_landmarks(&a.points, &a.frame, e) &&
         read_bone(c, CASE_SKULL, CASE_UPPER_TEETH, watch, &a.skull, &a.skull_repair, e) &&
         read_bone(c, CASE_MANDIBLE, CASE_LOWER_TEETH, watch, &a.mandible, &a.mandible_repair, e) &&
         (!skin || read_solid(c, CASE_SKIN, watch, &a.skin, &a.closed_skin, &a.skin_repair, e));
    a.repair_span = clock_lap(&begin);
    if (ok) {
        task_progress(watch, "cutting the bones", 0.2);
        ok = !stopped(watch, e) && cut(c, &a, e) && !stopped(watch, e);
        a.cut_span = clock_lap(&begin);
    }
    if (!ok) {
        anatomy_free(&a);
        return false;
    }
    *out = a;
    return true;
}

void anatomy_free(anatomy *a)
{
    landmarks_free(&a->points);
    surface_free(&a->skin);
    surface_free(&a->closed_skin);
    surface_free(&a->skull);
    surface_free(&a->mandible);
    segments_free(&a->segments);
    cut_report_free(&a->cuts);
    issue_list_free(&a->warnings);
}
