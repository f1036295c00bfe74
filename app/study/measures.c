/* The moves that the literature reports, and how soft tissue answers each. Windows: Gupta and Schendel 2022
 * (Peterson's Principles of Oral and Maxillofacial Surgery, tables 67.1 to 67.10, some thirty primary
 * papers), widened to the spread of the papers and rounded; alar width: 3-D scans of 32 patients after 3
 * months (PMC6173856); thickness: Veltkamp and others 2002 (AJODO), mean and deviation of 62 patients. An
 * open window asks for the sign alone. */
#include "app/study/measures.h"
#include "app/planner/plan/plan_moves.h"
#include "geometry/cephalometry.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <string.h>

enum {
    LF_ADVANCE,
    LF_IMPACT,
    LF_SETBACK,
    LF_DOWN,
    MAND_ADVANCE,
    MAND_SETBACK,
    AUTOROTATION,
    CHIN_ADVANCE,
    CHIN_SETBACK,
    CHIN_LONGER,
    CHIN_SHORTER,
    MAND_AND_CHIN,
    MMA,
    MOVES
};
const standard_move study_moves[] = {
    [LF_ADVANCE] = {"Le Fort I advance 5 mm", "lf_advance", {{"maxilla_advance_mm", 5}}},
    [LF_IMPACT] = {"Le Fort I impaction 4 mm", "lf_impact", {{"maxilla_impaction_mm", 4}}},
    [LF_SETBACK] = {"Le Fort I setback 3 mm", "lf_setback", {{"maxilla_advance_mm", -3}}},
    [LF_DOWN] = {"Le Fort I down-graft 3 mm", "lf_down", {{"maxilla_impaction_mm", -3}}},
    [MAND_ADVANCE] = {"mandibular advance 6 mm", "mand_advance", {{"mandible_advance_mm", 6}}},
    [MAND_SETBACK] = {"mandibular setback 5 mm", "mand_setback", {{"mandible_advance_mm", -5}}},
    [AUTOROTATION] = {"autorotation 2 degrees", "autorotation", {{"jaw.pitch_deg", -2}}},
    [CHIN_ADVANCE] = {"genioplasty advance 6 mm", "chin_advance", {{"chin_advance_mm", 6}}},
    [CHIN_SETBACK] = {"genioplasty setback 4 mm", "chin_setback", {{"chin_advance_mm", -4}}},
    [CHIN_LONGER] = {"genioplasty lengthening 4 mm", "chin_longer", {{"chin_lift_mm", -4}}},
    [CHIN_SHORTER] = {"genioplasty shortening 4 mm", "chin_shorter", {{"chin_lift_mm", 4}}},
    [MAND_AND_CHIN] = {"mandible 6 mm, chin 5 mm more",
                       "mand_and_chin",
                       {{"mandible_advance_mm", 6}, {"chin_advance_mm", 5}}},
    [MMA] = {"both jaws advance 10 mm", "mma", {{"maxilla_advance_mm", 10}, {"mandible_advance_mm", 10}}},
};
const int study_move_count = MOVES;

#define MORE ((double)INFINITY)
#define FORWARD STUDY_FORWARD
#define UP STUDY_UP
#define FOLLOWS(move, soft, hard, axis, low, high, published)                                                          \
    {                                                                                                                  \
        move, MEASURE_FOLLOWS, soft, hard, axis, axis, low, high, published                                            \
    }
#define CROSSES(move, soft, hard, low, high, published)                                                                \
    {                                                                                                                  \
        move, MEASURE_FOLLOWS, soft, hard, UP, FORWARD, low, high, published                                           \
    }
#define TURNS(move, hard, axis, low, high, published)                                                                  \
    {                                                                                                                  \
        move, MEASURE_TURNS, "nasolabial angle", hard, axis, axis, low, high, published                                \
    }
#define WIDENS(move, low, high, published)                                                                             \
    {                                                                                                                  \
        move, MEASURE_WIDENS, "Al_L", "Al_R", 0, 0, low, high, published                                               \
    }
#define THICKENS(move, soft, hard, low, high, published)                                                               \
    {                                                                                                                  \
        move, MEASURE_THICKENS, soft, hard, FORWARD, FORWARD, low, high, published                                     \
    }

/* Of genioplasties the chin moves as a whole and Pog may lie above its cut: Me stands for the bone. */
const study_measure study_measures[] = {
    FOLLOWS(LF_ADVANCE, "Ls", "U1", FORWARD, 0.4, 0.9, "0.33-0.90"),
    FOLLOWS(LF_ADVANCE, "A'", "A", FORWARD, 0.35, 0.9, "0.38-0.91"),
    FOLLOWS(LF_ADVANCE, "Sn", "A", FORWARD, 0.25, 0.65, "0.24-0.60"),
    FOLLOWS(LF_ADVANCE, "Pn", "U1", FORWARD, 0.1, 0.4, "0.17-0.36"),
    CROSSES(LF_ADVANCE, "Ls", "U1", 0, MORE, "0.3"),
    CROSSES(LF_ADVANCE, "Stms", "U1", 0, MORE, "0.3"),
    TURNS(LF_ADVANCE, "U1", FORWARD, -3, -0.5, "-1.2"),
    WIDENS(LF_ADVANCE, 0, MORE, "+4 mm, move not told"),
    FOLLOWS(LF_IMPACT, "Ls", "U1", UP, 0.1, 0.5, "0.30-0.51"),
    FOLLOWS(LF_IMPACT, "Stms", "U1", UP, 0.2, 0.5, "0.40-0.41"),
    FOLLOWS(LF_IMPACT, "Sn", "U1", UP, 0.15, 0.35, "0.20-0.29"),
    FOLLOWS(LF_IMPACT, "Pn", "U1", UP, 0.1, 0.25, "0.15-0.16"),
    FOLLOWS(LF_SETBACK, "Ls", "U1", FORWARD, 0.5, 0.8, "0.66-0.76"),
    FOLLOWS(LF_SETBACK, "Sn", "U1", FORWARD, 0.2, 0.5, "0.33"),
    FOLLOWS(LF_SETBACK, "A'", "U1", FORWARD, 0.2, 0.5, "0.33"),
    WIDENS(LF_SETBACK, -MORE, 0, "-4.7 mm, move not told"),
    FOLLOWS(LF_DOWN, "Pn", "U1", UP, 0, MORE, "tip goes down"),
    TURNS(LF_DOWN, "U1", UP, -MORE, 0, "opens"),
    FOLLOWS(MAND_ADVANCE, "Li_soft", "L1", FORWARD, 0.4, 0.8, "0.26-0.85"),
    FOLLOWS(MAND_ADVANCE, "B'", "B", FORWARD, 0.85, 1.15, "0.86-1.19"),
    FOLLOWS(MAND_ADVANCE, "Pg'", "Pog", FORWARD, 0.9, 1.1, "0.94-1.10"),
    FOLLOWS(MAND_ADVANCE, "Me'", "Me", FORWARD, 0.85, 1.1, "0.87-1.04"),
    FOLLOWS(MAND_ADVANCE, "Ls", "L1", FORWARD, -0.1, 0.1, "-0.02"),
    FOLLOWS(MAND_SETBACK, "Li_soft", "L1", FORWARD, 0.6, 1.0, "0.75-1.02"),
    FOLLOWS(MAND_SETBACK, "B'", "B", FORWARD, 0.85, 1.1, "0.93-1.09"),
    FOLLOWS(MAND_SETBACK, "Pg'", "Pog", FORWARD, 0.8, 1.05, "0.83-1.04"),
    FOLLOWS(MAND_SETBACK, "Ls", "L1", FORWARD, 0, 0.35, "0.20-0.32"),
    FOLLOWS(AUTOROTATION, "Pg'", "Pog", FORWARD, 0.75, 1.1, "0.79-1.0"),
    FOLLOWS(AUTOROTATION, "Pg'", "Pog", UP, 0.75, 1.2, "0.8-1.2"),
    FOLLOWS(AUTOROTATION, "Li_soft", "L1", FORWARD, 0.75, 1.1, "0.75"),
    FOLLOWS(AUTOROTATION, "B'", "B", FORWARD, 0.75, 1.1, "0.9-1.0"),
    FOLLOWS(CHIN_ADVANCE, "Pg'", "Me", FORWARD, 0.6, 1.0, "0.57-1.0"),
    FOLLOWS(CHIN_ADVANCE, "Li_soft", "Me", FORWARD, 0, 0.5, "0.44"),
    FOLLOWS(CHIN_SETBACK, "Pg'", "Me", FORWARD, 0.3, 0.75, "0.33-0.75"),
    FOLLOWS(CHIN_LONGER, "Me'", "Me", UP, 0.8, 1.05, "1.0"),
    FOLLOWS(CHIN_SHORTER, "Me'", "Me", UP, 0.2, 0.45, "0.25-0.40"),
    THICKENS(MAND_AND_CHIN, "Li_soft", "L1", -4.8, -0.8, "-2.8 +- 2.0"),
    THICKENS(MAND_AND_CHIN, "B'", "B", -1.3, 3.3, "1.0 +- 2.3"),
    THICKENS(MAND_AND_CHIN, "Pg'", "Me", -3.0, 1.4, "-0.8 +- 2.2"),
    FOLLOWS(MMA, "Ls", "U1", FORWARD, 0.8, 1.0, "about 0.90"),
    FOLLOWS(MMA, "Li_soft", "L1", FORWARD, 0.8, 1.0, "about 0.90"),
    FOLLOWS(MMA, "Pg'", "Pog", FORWARD, 0.8, 1.0, "about 0.90"),
};
_Static_assert(sizeof study_measures / sizeof *study_measures == STUDY_MEASURES, "count in measures.h");

bool study_move_motion(const standard_move *m, const prepared *p, rigid motion[SEGMENT_COUNT], err *e)
{
    rig_controls c = rig_controls_default();
    double condyle[2][3];
    bool hinged = plan_moves_condyles(&p->points, condyle);
    for (size_t i = 0; i < sizeof m->control / sizeof *m->control && m->control[i].name; i++) {
        control x;
        bool known = control_named(m->control[i].name, &x);
        assert(known);
        control_apply(&x, m->control[i].value, &p->frame, &c);
    }
    return rig_motion(&c, &p->frame, hinged ? (const double(*)[3])condyle : NULL, motion, e);
}

void study_add_lips(prepared *p)
{
    static const char *const label[2] = {"Stms", "Stmi"};
    const double off_mm[2] = {0.05, -0.05};
    const landmark *seam = landmarks_find(&p->points, "Stm");
    const lip_sheet *sheet = &p->tissue.lips;
    double local[3], at[3], normal[3];
    if (!seam) return;
    head_frame_to_local(&sheet->frame, seam->xyz, local);
    local[2] = lip_sheet_height(sheet, local[0]);
    head_frame_to_world(&sheet->frame, local, at);
    lip_sheet_normal(sheet, local[0], normal);
    for (int k = 0; k < 2; k++) {
        double lip[3];
        vec_axpy(at, off_mm[k], normal, lip);
        if (!landmarks_find(&p->points, label[k])) landmarks_set(&p->points, label[k], lip);
    }
}

static bool component(const prepared *p, const study_run *r, const char *label, int axis, double *mm)
{
    const landmark *l = landmarks_find(&p->points, label);
    if (!l || !r->point_mm) return false;
    const double *d = r->point_mm + 3 * (l - p->points.point);
    *mm = axis == FORWARD ? -vec_dot(d, p->frame.posterior) : vec_dot(d, p->frame.up);
    return true;
}

/* Change of a cephalometric measure; NaN where a landmark is missing. */
static double turn(const prepared *p, const study_run *r, const char *name)
{
    ceph_value before[CEPH_MEASURES_MAX], after[CEPH_MEASURES_MAX];
    landmarks moved = landmarks_copy(&p->points);
    double change = (double)NAN;
    for (int32_t i = 0; i < moved.count; i++)
        vec_add(moved.point[i].xyz, r->point_mm + 3 * (size_t)i, moved.point[i].xyz);
    ceph_evaluate(&p->points, &p->frame, before);
    ceph_evaluate(&moved, &p->frame, after);
    for (int i = 0; i < ceph_measure_count; i++)
        if (!strcmp(ceph_measures[i].name, name)) change = after[i].value - before[i].value;
    landmarks_free(&moved);
    return change;
}

static double widening(const prepared *p, const study_run *r, const char *a, const char *b)
{
    const landmark *l = landmarks_find(&p->points, a), *m = landmarks_find(&p->points, b);
    double before, at[3], to[3];
    if (!l || !m) return (double)NAN;
    before = vec_distance(l->xyz, m->xyz);
    vec_add(l->xyz, r->point_mm + 3 * (l - p->points.point), at);
    vec_add(m->xyz, r->point_mm + 3 * (m - p->points.point), to);
    return vec_distance(at, to) - before;
}

double study_measure_value(const study_measure *m, const prepared *p, const study_run *r)
{
    const double least_mm = 0.5; /* a bone that moves less says nothing */
    double soft, hard, unknown = (double)NAN;
    if (!r->point_mm) return unknown;
    assert(r->point_count == p->points.count);
    switch ((study_measure_kind)m->kind) {
    case MEASURE_WIDENS: return widening(p, r, m->soft, m->hard);
    case MEASURE_TURNS:
        return component(p, r, m->hard, m->hard_axis, &hard) && fabs(hard) >= least_mm ? turn(p, r, m->soft) / hard
                                                                                       : unknown;
    case MEASURE_FOLLOWS:
    case MEASURE_THICKENS:
        if (!component(p, r, m->soft, m->soft_axis, &soft) || !component(p, r, m->hard, m->hard_axis, &hard))
            return unknown;
        if (m->kind == MEASURE_THICKENS) return soft - hard;
        return fabs(hard) >= least_mm ? soft / hard : unknown;
    }
    return unknown;
}

void study_measure_name(const study_measure *m, char *out, size_t size)
{
    static const char *const axis[2] = {"forward", "up"};
    switch ((study_measure_kind)m->kind) {
    case MEASURE_FOLLOWS:
        if (m->soft_axis == m->hard_axis)
            snprintf(out, size, "%s : %s, %s", m->soft, m->hard, axis[m->hard_axis]);
        else
            snprintf(out, size, "%s %s : %s %s", m->soft, axis[m->soft_axis], m->hard, axis[m->hard_axis]);
        return;
    case MEASURE_TURNS:
        snprintf(out, size, "%s, degrees per mm of %s %s", m->soft, m->hard, axis[m->hard_axis]);
        return;
    case MEASURE_WIDENS: snprintf(out, size, "%s to %s, wider by mm", m->soft, m->hard); return;
    case MEASURE_THICKENS: snprintf(out, size, "%s before %s, thicker by mm", m->soft, m->hard); return;
    }
}

const char *study_measure_lacks(const study_measure *m, const prepared *p)
{
    if (!landmarks_find(&p->points, m->hard)) return m->hard;
    if (m->kind != MEASURE_TURNS) return landmarks_find(&p->points, m->soft) ? NULL : m->soft;
    static const char *const angle[2] = {"Sn", "Ls"}; /* and Pn where Cm is missing: every head has one */
    for (int k = 0; k < 2; k++)
        if (!landmarks_find(&p->points, angle[k])) return angle[k];
    return NULL;
}
