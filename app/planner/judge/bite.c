/* How the teeth and the midlines stand as planned, from landmarks alone. */
#include "app/planner/judge/parts.h"
#include "geometry/molar.h"
#include "geometry/vec.h"

enum { ACROSS, BACK, UP }; /* axes of the head frame */

static bool planned(const judge *j, const plan_moves *m, const char *label, double local[3])
{
    double p[3];
    if (!judge_landmark(j, m, label, p)) return false;
    head_frame_to_local(&j->prepared->frame, p, local);
    return true;
}

static finding *add(const judge *j, judgement *out, limit_id id, double value, const char *note)
{
    return judgement_add(out, j->patient, id, "", value, false, note);
}

/* An overjet that the patient came with is not the plan's doing: it cautions where the plan leaves or lessens it. */
static void judge_overjet(const judge *j, const plan_moves *m, double overjet, judgement *out)
{
    const double rounding_mm = 1e-6;
    plan_moves none = *m;
    double u1[3], l1[3];
    for (int s = 0; s < SEGMENT_COUNT; s++) none.move[s] = rigid_identity();
    double scan = planned(j, &none, "U1", u1) && planned(j, &none, "L1", l1) ? l1[BACK] - u1[BACK] : (double)NAN;
    bool scans_own = limit_judge(&j->patient->limits[LIMIT_OVERJET], overjet) == LIMIT_STOP && overjet * scan > 0 &&
                     fabs(overjet) <= fabs(scan) + rounding_mm;
    finding *f = judgement_add(out, j->patient, LIMIT_OVERJET, "", overjet, scans_own,
                               scans_own ? "the scan itself has it and the plan does not worsen it" : NULL);
    f->estimated = false;
    f->scan = scan;
}

static void judge_incisors(const judge *j, const plan_moves *m, judgement *out)
{
    static const char *const apart = "the scan shows the jaws apart, so that the plan's bite is not known",
                             *const missing = "needs U1 and L1: alveolar points tell no overjet, overbite or midline";
    double u1[3], l1[3];
    bool teeth = planned(j, m, "U1", u1) && planned(j, m, "L1", l1), there = teeth && !j->jaws_apart;
    const char *why = there ? NULL : teeth ? apart : missing;
    double overlap = there ? l1[UP] - u1[UP] : (double)NAN;
    if (there)
        judge_overjet(j, m, l1[BACK] - u1[BACK], out);
    else
        add(j, out, LIMIT_OVERJET, (double)NAN, why);
    add(j, out, LIMIT_OVERBITE, overlap, why);
    add(j, out, LIMIT_OPEN_BITE, there ? fmax(-overlap, 0) : overlap, why);
    add(j, out, LIMIT_DENTAL_MIDLINE, there ? l1[ACROSS] - u1[ACROSS] : (double)NAN, why);
}

/* The cant of the bite, by the same tooth of both sides: the first molars, the next that are there, or the canines. */
static void judge_cant(const judge *j, const plan_moves *m, judgement *out)
{
    static const struct {
        char tooth;
        const char *note;
    } notes[] = {{'7', "by the second molars: the case has not both first ones"},
                 {'5', "by the second premolars: the case has not both first molars"},
                 {'4', "by the first premolars: the case has not both first molars"},
                 {'3', "by the canines: the case has not both first molars"}};
    const landmarks *l = &j->prepared->points;
    const landmark *pair[2];
    const char *note = NULL;
    double left[3], right[3];
    if (!molar_pair(l, true, pair)) {
        pair[0] = landmarks_find(l, "U3_L");
        pair[1] = landmarks_find(l, "U3_R");
    }
    bool there = pair[0] && pair[1] && planned(j, m, pair[0]->label, left) && planned(j, m, pair[1]->label, right);
    for (int i = 0; there && i < 4; i++)
        if (pair[0]->label[1] == notes[i].tooth) note = notes[i].note;
    double cant = there ? atan2(right[UP] - left[UP], left[ACROSS] - right[ACROSS]) : (double)NAN;
    add(j, out, LIMIT_OCCLUSAL_CANT, cant * 180 / M_PI,
        there ? note : "needs the same tooth left and right: U6, U7, U5, U4 or U3");
}

/* Where a first molar, or what stands for it, is as planned. */
static bool planned_molar(const judge *j, const plan_moves *m, int side, double local[3], bool *stands_in)
{
    const landmarks *l = &j->prepared->points;
    molar at;
    double p[3];
    if (!molar_find(l, true, side, &at)) return false;
    rigid_apply(&m->move[j->carrier[landmarks_find(l, at.by) - l->point]], at.xyz, p);
    head_frame_to_local(&j->prepared->frame, p, local);
    *stands_in |= at.stands_in;
    return true;
}

static void judge_plane(const judge *j, const plan_moves *m, judgement *out)
{
    double a[3], b[3], c[3];
    bool stands_in = false, there = planned(j, m, "U1", a) && planned_molar(j, m, 1, b, &stands_in) &&
                                    planned_molar(j, m, -1, c, &stands_in);
    double drop = there ? (b[UP] + c[UP]) / 2 - a[UP] : (double)NAN,
           reach = there ? (b[BACK] + c[BACK]) / 2 - a[BACK] : 1;
    judgement_add(out, j->patient, LIMIT_OCCLUSAL_PLANE, "", atan2(drop, reach) * 180 / M_PI, stands_in,
                  !there      ? "needs U1 and, on both sides, U6 or the next tooth"
                  : stands_in ? "a first molar is missing: by the next tooth"
                              : NULL);
}

void judge_bite(const judge *j, const plan_moves *m, judgement *out)
{
    double a[3], b[3];
    judge_incisors(j, m, out);
    bool there = planned(j, m, "U1", a) && planned(j, m, "N", b); /* the face's midline runs through N */
    add(j, out, LIMIT_UPPER_MIDLINE, there ? a[ACROSS] - b[ACROSS] : (double)NAN, there ? NULL : "needs U1 and N");
    there = planned(j, m, "Me", a) && planned(j, m, "N", b);
    add(j, out, LIMIT_CHIN_DEVIATION, there ? a[ACROSS] - b[ACROSS] : (double)NAN, there ? NULL : "needs Me and N");
    there = planned(j, m, "U3_L", a) && planned(j, m, "U3_R", b);
    add(j, out, LIMIT_CANINE_YAW, there ? a[BACK] - b[BACK] : (double)NAN, there ? NULL : "needs U3_L and U3_R");
    judge_plane(j, m, out);
    judge_cant(j, m, out);
}
