#include "app/planner/judge/remedy.h"
#include "app/planner/judge/parts.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

static const double fine_step = 0.05, first_step = 0.5, stride = 3, reach_mm = 4.5;

enum { TURNS = 3, SHIFTS = 6 };

typedef struct change {
    segment_id segment;
    int kind; /* 0..5: shift forwards, back, up, down, left, right; 6..8: less pitch, yaw, roll */
} change;

/* All segments in long form, so that every move can be changed. */
static plan_file opened(const plan_file *plan, const head_frame *f)
{
    plan_file p = *plan;
    const double mm[3][2] = {
        {p.maxilla_advance_mm, p.maxilla_impaction_mm}, {p.mandible_advance_mm, 0}, {p.chin_advance_mm, 0}};
    static const segment_id segment[3] = {SEGMENT_MAXILLA, SEGMENT_DISTAL, SEGMENT_CHIN};
    for (int i = 0; i < 3; i++) {
        plan_segment *s = &p.segment[segment[i]];
        if (s->form != FORM_SHORT) continue;
        s->form = FORM_ANGLES;
        vec_scale(f->posterior, -mm[i][0], s->translate_mm);
        vec_axpy(s->translate_mm, mm[i][1], f->up, s->translate_mm);
    }
    p.maxilla_advance_mm = p.maxilla_impaction_mm = p.mandible_advance_mm = p.chin_advance_mm = 0;
    return p;
}

static double *angle(plan_segment *s, int kind)
{
    double *const angles[TURNS] = {&s->pitch_deg, &s->yaw_deg, &s->roll_deg};
    return angles[kind - SHIFTS];
}

/* The most that this change can be; 0: it cannot. */
static double most(const plan_file *p, change c)
{
    plan_segment s = p->segment[c.segment];
    if (s.form == FORM_NONE) return 0;
    if (c.kind < SHIFTS) return reach_mm;
    return s.form == FORM_ANGLES ? fabs(*angle(&s, c.kind)) : 0;
}

static void apply(plan_file *p, const head_frame *f, change c, double by)
{
    plan_segment *s = &p->segment[c.segment];
    if (c.kind >= SHIFTS) {
        double *a = angle(s, c.kind);
        *a -= copysign(by, *a);
        return;
    }
    const double *axis = c.kind < 2 ? f->posterior : c.kind < 4 ? f->up : f->left;
    double *t = s->form == FORM_MATRIX ? s->motion.t : s->translate_mm;
    static const double sign[SHIFTS] = {-1, 1, 1, -1, 1, -1};
    vec_axpy(t, sign[c.kind] * by, axis, t);
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
    static const char *const how[SHIFTS + TURNS] = {"mm forwards",    "mm back",        "mm up",
                                                    "mm down",        "mm to the left", "mm to the right",
                                                    "deg less pitch", "deg less yaw",   "deg less roll"};
    const char *bone = c.segment == SEGMENT_DISTAL ? "mandible" : segment_name(c.segment);
    snprintf(text, REMEDY_TEXT_SIZE, "%s %.2f %s", bone, by, how[c.kind]);
}

bool remedy_find(const judge *j, const case_file *c, const prepared *p, const plan_file *plan, const judgement *now,
                 int which, char text[REMEDY_TEXT_SIZE])
{
    trial t = {.j = j, .c = c, .p = p, .plan = opened(plan, &p->frame), .now = now, .which = which};
    double best = HUGE_VAL;
    plan_moves m;
    issue_list ignored = {0};
    text[0] = 0;
    bool made = plan_moves_set(&t.plan, c, &p->points, &m, &ignored);
    issue_list_free(&ignored);
    if (!made) return false;
    t.first = part_of(j, &m, now, which);
    for (int s = SEGMENT_MAXILLA; s < SEGMENT_COUNT; s++) {
        if (!concerns(&now->finding[which], (segment_id)s)) continue;
        for (int k = 0; k < SHIFTS + TURNS; k++) {
            change one = {(segment_id)s, k};
            double by = least(&t, one, best - fine_step);
            if (by >= best) continue;
            best = by;
            say(one, by, text);
        }
    }
    return best < HUGE_VAL;
}
