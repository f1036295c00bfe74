#include "app/planner/judge/judge.h"
#include "app/planner/judge/parts.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include "geometry/vec.h"
#include <stdlib.h>

/* The bone that each landmark lies on, or is nearest to. */
static void find_carriers(judge *j)
{
    const landmarks *l = &j->prepared->points;
    j->carrier = NEW_ARRAY(int, l->count);
    for (int32_t i = 0; i < l->count; i++) {
        double least = HUGE_VAL;
        for (int s = 0; s < SEGMENT_COUNT; s++) {
            double d = j->body[s] ? distance_tree_between(clash_body_tree(j->body[s]), l->point[i].xyz, 0, least, NULL)
                                  : HUGE_VAL;
            if (d >= least) continue;
            least = d;
            j->carrier[i] = s;
        }
    }
}

/* In occlusion the cusps of the first molars overlap by 1 to 2 mm. */
static void find_bite(judge *j)
{
    const double apart_mm = 3;
    const landmarks *l = &j->prepared->points;
    const landmark *front[2] = {landmarks_find(l, "U1"), landmarks_find(l, "L1")};
    double sum = 0, d[3];
    int count = 0;
    for (int side = 1; side >= -1; side -= 2) {
        molar upper, lower;
        if (!molar_find(l, true, side, &upper) || !molar_find(l, false, side, &lower)) continue;
        if (upper.on_crest || lower.on_crest) continue; /* no tooth there that could meet another */
        vec_sub(upper.xyz, lower.xyz, d);
        sum += vec_dot(d, j->prepared->frame.up);
        count++;
    }
    if (!count && front[0] && front[1]) { /* incisors only where no molars are */
        vec_sub(front[0]->xyz, front[1]->xyz, d);
        sum = vec_dot(d, j->prepared->frame.up);
        count = 1;
    }
    j->jaws_apart = count && sum / count > apart_mm;
}

/* Where any bone may come to that a plan moves: the skull elsewhere is left out. */
static void find_reach(const prepared *p, double box[6])
{
    const double reach_mm = 25;
    for (int c = 0; c < 3; c++) {
        box[c] = HUGE_VAL;
        box[3 + c] = -HUGE_VAL;
    }
    for (int s = SEGMENT_MAXILLA; s < SEGMENT_COUNT; s++) {
        double low[3], high[3];
        if (!p->segments.part[s].triangle_count) continue;
        surface_bounds(&p->segments.part[s], low, high);
        for (int c = 0; c < 3; c++) {
            box[c] = fmin(box[c], low[c] - reach_mm);
            box[3 + c] = fmax(box[3 + c], high[c] + reach_mm);
        }
    }
}

static bool make_bodies(judge *j, err *e)
{
    double box[6];
    find_reach(j->prepared, box);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        const surface *part = &j->prepared->segments.part[s];
        clash_params p = clash_params_default();
        if (s == SEGMENT_CRANIUM) p.box = box;
        uint8_t *kind = NULL;
        if (!part->triangle_count) continue;
        if (s == SEGMENT_CRANIUM || s == SEGMENT_DISTAL) p.cell_mm = 0; /* never the smaller one of a cut */
        if (s == SEGMENT_MAXILLA || s == SEGMENT_DISTAL) kind = judge_crowns(j->prepared, (segment_id)s, &j->no_crowns);
        bool ok = clash_body_make(part, kind, &p, &j->body[s], e);
        free(kind);
        if (!ok) return err_prefix(e, "the %s segment", segment_name((segment_id)s));
    }
    return true;
}

bool judge_create(const case_file *c, const prepared *p, judge **out, err *e)
{
    judge *j = NEW_ARRAY(judge, 1);
    j->patient = c;
    j->prepared = p;
    find_bite(j);
    if (!make_bodies(j, e)) {
        judge_free(&j);
        return false;
    }
    judge_bones_make(j);
    find_carriers(j);
    judge_nerve_make(j);
    judge_teeth_make(j);
    *out = j;
    return true;
}

void judge_free(judge **j)
{
    if (!*j) return;
    judge_bones_free(*j);
    for (int s = 0; s < SEGMENT_COUNT; s++) clash_body_free(&(*j)->body[s]);
    free((*j)->carrier);
    free((*j)->bite);
    free(*j);
    *j = NULL;
}

void judge_plan(const judge *j, const plan_moves *m, judgement *out)
{
    out->count = 0;
    out->worst = LIMIT_NOT_JUDGED;
    out->reason = -1;
    judge_moves(j, m, out);
    judge_bones(j, m, out);
    judge_nerve(j, m, out);
    judge_teeth(j, m, out);
    judge_bite(j, m, out);
    judge_cuts(j, out);
    judge_warnings(j, out);
}
