#include "app/pictures/subject.h"
#include "geometry/mem.h"
#include "geometry/surface_stretch.h"
#if GNATHOS_WITH_CGAL
#include "geometry/surface_compare.h"
#endif
#include <stdlib.h>

static const double rim_reach_mm = 1.2; /* the saw is half a millimetre wide, its edges are divided into as much */

void pictures_subject_make(const pictures_input *in, pictures_subject *out)
{
    *out = (pictures_subject){.at_rest = in->at_rest};
    subject *s = &out->shown;
    *s = (subject){.case_name = in->case_name,
                   .plan_text = in->plan_text,
                   .case_hash = in->hash,
                   .skin_before = in->skin_before,
                   .skin_after = in->skin_after,
                   .parts = out->part,
                   .before = in->before,
                   .after = in->after,
                   .frame = *in->frame};
    for (int i = 0; i < SEGMENT_COUNT; i++) {
        if (!in->at_rest->part[i].triangle_count) continue;
        subject_part *p = &out->part[s->part_count++];
        *p = (subject_part){.bone = &in->at_rest->part[i],
                            .before = rigid_identity(),
                            .after = in->move[i],
                            .kind = MATERIAL_BONE,
                            .name = segment_title((segment_id)i)};
        segment_color((segment_id)i, p->rgb);
    }
}

void pictures_subject_free(pictures_subject *p)
{
    cut_rims_free(&p->rims);
    free(p->signed_mm);
    free(p->stretch_percent);
    *p = (pictures_subject){0};
}

static bool measure_signed(pictures_subject *p, err *e)
{
#if GNATHOS_WITH_CGAL
    const subject *s = &p->shown;
    double *mm = NEW_ARRAY(double, s->skin_after->vertex_count);
    if (!surface_signed_distance(s->skin_after, s->skin_before, mm, e)) {
        free(mm);
        return false;
    }
    /* measured from the predicted skin: turned round, outside of the old skin is positive */
    for (int32_t v = 0; v < s->skin_after->vertex_count; v++) mm[v] = -mm[v];
    p->shown.signed_mm = p->signed_mm = mm;
    return true;
#else
    (void)p;
    return err_set(e, ERR_USAGE, "no signed distance: this build has no closest points (GNATHOS_CGAL=OFF)");
#endif
}

static void find_rims(pictures_subject *p)
{
    p->rims = cut_rims_find(p->at_rest, rim_reach_mm);
    p->rims_known = true;
    for (int i = 0, part = 0; i < SEGMENT_COUNT; i++) {
        if (!p->at_rest->part[i].triangle_count) continue;
        p->part[part].rim = p->rims.piece[i];
        p->part[part++].rim_count = p->rims.count[i];
    }
}

bool pictures_subject_measure(pictures_subject *p, panel_show show, err *e)
{
    const subject *s = &p->shown;
    if (show == SHOW_BONES && !p->rims_known) find_rims(p);
    if (show == SHOW_SIGNED && s->skin_after && !p->signed_mm) return measure_signed(p, e);
    if (show == SHOW_STRETCH && s->skin_after && !p->stretch_percent) {
        p->stretch_percent = NEW_ARRAY(double, s->skin_after->vertex_count);
        surface_stretch(s->skin_before, s->skin_after, p->stretch_percent);
        p->shown.stretch_percent = p->stretch_percent;
    }
    return true;
}
