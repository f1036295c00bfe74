/* What the moves alone decide: envelopes, the condyles' seat, the room for the airway. */
#include "app/planner/judge/parts.h"
#include "geometry/incisor.h"
#include "geometry/vec.h"

/* How far the bite goes back: the lower incisors, less what the upper ones go forwards. The airway's front wall hangs
 * on both jaws (soft palate and tongue). */
static void judge_airway(const judge *j, const plan_moves *m, judgement *out)
{
    static const char *const note = "from the moves: the scan's airway itself is not measured";
    double to[3], back[2] = {0};
    for (int k = 0; k < 2; k++) {
        const landmarks *l = &j->prepared->points;
        incisor front;
        double d[3];
        if (!incisor_find(l, !k, &front) || !judge_landmark(j, m, front.by, to)) continue; /* required landmarks */
        vec_sub(to, landmarks_find(l, front.by)->xyz, d);
        back[k] = vec_dot(d, j->prepared->frame.posterior);
    }
    double worse = fmax(back[1] + fmin(back[0], 0), back[0]);
    judgement_add(out, j->patient, LIMIT_AIRWAY_SETBACK, "", fmax(worse, 0), false, note);
}

void judge_moves(const judge *j, const plan_moves *m, judgement *out)
{
    static const segment_id moved[] = {SEGMENT_MAXILLA, SEGMENT_DISTAL, SEGMENT_CHIN, SEGMENT_PROXIMAL_LEFT};
    for (int l = 0; l < LIMIT_MOVE_COUNT; l++) {
        int group = l / 4; /* four measures each; the condyles' two come last */
        const char *where = "";
        if (!j->prepared->segments.part[moved[group]].triangle_count) {
            judgement_add(out, j->patient, (limit_id)l, where, (double)NAN, false, "the case does not cut this bone");
            continue;
        }
        bool registered = l == LIMIT_CONDYLE_TURN && m->measure[l] > m->commanded_turn_deg &&
                          limit_judge(&j->patient->limits[l], m->commanded_turn_deg) != LIMIT_STOP;
        finding *f = judgement_add(out, j->patient, (limit_id)l, where, m->measure[l], registered,
                                   registered ? "from a matrix, taken for a registration's: cautions at most" : NULL);
        f->estimated = false;
        f->segment_a = moved[group];
        const landmark *at = plan_moves_reference(&j->prepared->points, moved[group]);
        f->has_place = at && judge_landmark(j, m, at->label, f->place);
    }
    judge_airway(j, m, out);
}
