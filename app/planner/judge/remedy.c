#include "app/planner/judge/remedy.h"
#include "app/planner/judge/parts.h"
#include "app/planner/plan/plan_vary.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

static const double fine_step = 0.05, first_step = 0.5, stride = 3, reach_mm = 4.5;

typedef struct change { /* along an axis of the head, there or back; a turn is only made less */
    segment_id segment;
    rig_axis axis;
    bool back;
} change;

/* The most that this change can be; 0: it cannot. */
static double most(const plan_file *p, change c)
{
    segment_move m = p->segment[c.segment].move;
    if (m.kind == MOVE_NONE) return 0;
    if (c.axis < RIG_PITCH) return reach_mm;
    return m.kind == MOVE_ANGLES ? fabs(*rig_angle(&m, c.axis)) : 0;
}

static void apply(plan_file *p, const head_frame *f, change c, double by)
{
    segment_move *m = &p->segment[c.segment].move;
    bool turn = c.axis >= RIG_PITCH, back = turn ? *rig_angle(m, c.axis) > 0 : c.back;
    rig_move(m, c.axis, back ? -by : by, f);
}

typedef void (*judge_part)(const judge *, const plan_moves *, judgement *);

/* All that a plan changes, from cheap to dear. */
static const judge_part parts[] = {judge_moves,    judge_bite,  judge_places, judge_nerve,
                                   judge_contacts, judge_pairs, judge_teeth,  judge_trims};
enum { PARTS = sizeof parts / sizeof *parts };

typedef struct trial {
    const judge *j;
    const case_file *c;
    const prepared *p;
    plan_file plan;
    const judgement *now;
    int which;
    judge_part first; /* the part that the finding is of */
} trial;

static const finding *counterpart(const judgement *now, const finding *f)
{
    const finding *was = now->finding;
    while (was->limit != f->limit || strcmp(was->where, f->where) != 0) was++;
    return was;
}

/* Nothing that this part judges is worse than now, and the finding, if it is one of them, is better by a level. */
static bool allows(const trial *t, judge_part part, const plan_moves *m)
{
    judgement then = {.reason = -1};
    part(t->j, m, &then);
    for (int i = 0; i < then.count; i++) {
        const finding *f = &then.finding[i], *was = counterpart(t->now, f);
        if (f->level > was->level) return false;
        if (was != &t->now->finding[t->which]) continue;
        if (f->level == was->level || f->level == LIMIT_NOT_JUDGED) return false;
    }
    return true;
}

/* Which part the finding comes from. */
static judge_part part_of(const judge *j, const plan_moves *m, const judgement *now, int which)
{
    for (int k = 0;; k++) {
        judgement some = {.reason = -1};
        assert(k < PARTS);
        parts[k](j, m, &some);
        for (int i = 0; i < some.count; i++)
            if (counterpart(now, &some.finding[i]) == &now->finding[which]) return parts[k];
    }
}

/* The limit is better by a level, and nothing is worse. Most changes fail at the limit itself, which is asked first. */
static bool helps(const trial *t, change c, double by)
{
    plan_file plan = t->plan;
    plan_moves m;
    issue_list ignored = {0};
    apply(&plan, &t->p->frame, c, by);
    bool ok = plan_moves_set(&plan, t->c, &t->p->points, &m, &ignored);
    issue_list_free(&ignored);
    ok = ok && allows(t, t->first, &m);
    for (int k = 0; ok && k < PARTS; k++) ok = parts[k] == t->first || allows(t, parts[k], &m);
    return ok;
}

/* The least amount that helps, HUGE_VAL if none does; not looked for beyond `limit_by`. */
static double least(const trial *t, change c, double limit_by)
{
    double high = first_step, low = 0, end = fmin(most(&t->plan, c), limit_by);
    if (!(end > 0)) return HUGE_VAL;
    for (; !helps(t, c, fmin(high, end)); high *= stride) {
        if (high >= end) return HUGE_VAL;
        low = high;
    }
    high = fmin(high, end);
    while (high - low > fine_step) {
        double middle = (low + high) / 2;
        if (helps(t, c, middle))
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* Moving the segment can change the finding: it is of it, or of what it carries. */
static bool concerns(const finding *f, segment_id s)
{
    bool any = f->segment_a < 0 && f->segment_b < 0;
    return any || f->segment_a == (int)s || f->segment_b == (int)s ||
           (s == SEGMENT_DISTAL && (f->segment_a == SEGMENT_CHIN || f->segment_b == SEGMENT_CHIN));
}

static void say(change c, double by, char text[REMEDY_TEXT_SIZE])
{
    static const char *const how[RIG_AXES][2] = {[RIG_FORWARD] = {"mm forwards", "mm back"},
                                                 [RIG_UP] = {"mm up", "mm down"},
                                                 [RIG_LEFT] = {"mm to the left", "mm to the right"},
                                                 [RIG_PITCH] = {NULL, "deg less pitch"},
                                                 [RIG_YAW] = {NULL, "deg less yaw"},
                                                 [RIG_ROLL] = {NULL, "deg less roll"}};
    snprintf(text, REMEDY_TEXT_SIZE, "%s %.2f %s", control_piece_name(c.segment), by, how[c.axis][c.back]);
}

bool remedy_find(const judge *j, const case_file *c, const prepared *p, const plan_file *plan, const judgement *now,
                 int which, char text[REMEDY_TEXT_SIZE])
{
    trial t = {.j = j, .c = c, .p = p, .plan = *plan, .now = now, .which = which};
    double best = HUGE_VAL;
    plan_moves m;
    issue_list ignored = {0};
    text[0] = 0;
    plan_vary_open(&t.plan, &p->frame);
    bool made = plan_moves_set(&t.plan, c, &p->points, &m, &ignored);
    issue_list_free(&ignored);
    if (!made) return false;
    t.first = part_of(j, &m, now, which);
    for (int s = SEGMENT_MAXILLA; s < SEGMENT_COUNT; s++) {
        if (!concerns(&now->finding[which], (segment_id)s)) continue;
        for (int k = 0; k < 2 * RIG_AXES; k++) {
            change one = {(segment_id)s, (rig_axis)(k / 2), k % 2};
            if (one.axis >= RIG_PITCH && !one.back) continue;
            double by = least(&t, one, best - fine_step);
            if (by >= best) continue;
            best = by;
            say(one, by, text);
        }
    }
    return best < HUGE_VAL;
}
