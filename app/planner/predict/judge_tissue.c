#include "app/planner/predict/judge_tissue.h"
#include "geometry/vec.h"
#include <string.h>

static bool planned(const prepared *p, const carried_landmarks *c, const char *label, double local[3])
{
    const landmark *l = c ? landmarks_find(&c->after, label) : NULL;
    if (l) head_frame_to_local(&p->frame, l->xyz, local);
    return l != NULL;
}

static void judge_incisor_show(const case_file *c, const prepared *p, const carried_landmarks *points, judgement *io)
{
    double lip[3], edge[3];
    bool open = planned(p, points, "Stms", lip), there = open || planned(p, points, "Stm", lip);
    if (!points || !there || !planned(p, points, "U1", edge)) {
        judgement_add(io, c, LIMIT_INCISOR_SHOW, "", (double)NAN, false,
                      points ? "needs U1 and Stms or Stm" : "no face: the solve failed");
        return;
    }
    judgement_add(io, c, LIMIT_INCISOR_SHOW, "", lip[2] - edge[2], !open,
                  open ? "the lip as in the scan; men 2 to 4, women 3 to 6"
                       : "the scan's lips are closed: at rest the lip may stand higher");
}

static void put_tet(finding *f, const prepared *p, const equilibrium *q, int32_t tet)
{
    if (tet < 0) return;
    const int32_t *node = p->tissue.mesh.tet + 4 * (size_t)tet;
    f->has_place = true;
    for (int k = 0; k < 4; k++) vec_axpy(f->place, 0.25, q->xyz + 3 * (size_t)node[k], f->place);
}

/* Where a solve that failed is stuck. */
static void put_node(finding *f, const equilibrium *q, int32_t node)
{
    if (node < 0) return;
    f->has_place = true;
    vec_copy(q->xyz + 3 * (size_t)node, f->place);
}

static void judge_lower_face(const case_file *c, const prepared *p, const carried_landmarks *points, judgement *io)
{
    double brow[3], nose[3], chin[3];
    bool there = planned(p, points, "G'", brow) && planned(p, points, "Sn", nose) && planned(p, points, "Me'", chin);
    judgement_add(io, c, LIMIT_LOWER_FACE, "", there ? (nose[2] - chin[2]) / (brow[2] - chin[2]) : (double)NAN, false,
                  there    ? NULL
                  : points ? "needs G', Sn and Me'"
                           : "no face: the solve failed");
}

void judge_tissue(const case_file *c, const prepared *p, const equilibrium *q, const carried_landmarks *points,
                  judgement *io)
{
    bool known = q->outcome == SOLVED;
    const char *note = known ? NULL : "the solve failed";
    finding *f = judgement_add(io, c, LIMIT_SOLVED, "", known, false, solve_outcome_text(q->outcome));
    if (!known) put_node(f, q, q->stuck_node);
    f = judgement_add(io, c, LIMIT_SMALLEST_J, "", known ? q->extremes.min_j : (double)NAN, false, note);
    if (known) put_tet(f, p, q, q->extremes.min_j_tet);
    f = judgement_add(io, c, LIMIT_STRETCH, "", known ? q->extremes.max_stretch : (double)NAN, false, note);
    if (known) put_tet(f, p, q, q->extremes.max_stretch_tet);
    judge_incisor_show(c, p, points, io);
    judge_lower_face(c, p, points, io);
}
