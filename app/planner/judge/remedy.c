#include "app/planner/judge/remedy.h"
#include "app/planner/judge/nearest_move.h"
#include "app/planner/plan/plan_vary.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_MAX = 20, HALVINGS = 6, KEPT_MAX = 512, ROWS_MAX = KEPT_MAX + FINDINGS_MAX };
static const double probe = 0.2;                 /* mm or degrees, to see how a margin changes */
static const double first_reach = 4, calm = 0.8; /* of a step, along each axis; less from step to step */
static const double clear = 0.03;                /* kept from every limit, so that rounding stays inside */
static const double least_slope = 1e-3, settled = 0.01;

_Static_assert((int)CONTROL_PIECE_MAX <= (int)MOVE_AXES_MAX, "every control has an axis");

typedef struct freedom { /* of one control; how much it may change */
    int control;         /* number of control_of_piece */
    segment_id segment;
    rig_axis axis;
    double low, high;
} freedom;

typedef struct search {
    const judge *j;
    const case_file *c;
    const prepared *p;
    plan_file wanted; /* opened */
    int axes;
    freedom free[CONTROL_PIECE_MAX];
    const double *x;        /* of the probes */
    judgement *here, *near; /* [1], [axes]: at x and a probe away along each axis */
    int rows;
    move_limit *row; /* [ROWS_MAX] the limits as straight ones: of the turns, then of each place that was stopped */
} search;

static void find_freedoms(search *s)
{
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control one;
        control_of_piece(i, &one);
        segment_move m = s->wanted.segment[one.segment].move;
        freedom f = {i, one.segment, one.axis, -HUGE_VAL, HUGE_VAL};
        if (m.kind == MOVE_NONE) continue;
        if (one.axis >= RIG_PITCH) {
            double turn = m.kind == MOVE_ANGLES ? *rig_angle(&m, one.axis) : 0;
            if (turn == 0) continue;
            f.low = fmin(-turn, 0);
            f.high = fmax(-turn, 0);
        }
        s->free[s->axes++] = f;
    }
}

static plan_file changed(const search *s, const double x[])
{
    plan_file p = s->wanted;
    for (int k = 0; k < s->axes; k++)
        if (x[k] != 0) rig_move(&p.segment[s->free[k].segment].move, s->free[k].axis, x[k], &s->p->frame);
    return p;
}

static void judge_at(const search *s, const double x[], judgement *out)
{
    const plan_file p = changed(s, x);
    plan_moves m;
    issue_list none = {0};
    bool made = plan_moves_set(&p, s->c, &s->p->points, &m, &none);
    assert(made); /* the wanted plan was, and it names the same landmarks */
    issue_list_free(&none);
    if (made) judge_plan(s->j, &m, out);
}

static double probe_along(const freedom *f, double x) { return x + probe > f->high ? -probe : probe; }

static void judge_probes(int64_t begin, int64_t end, void *context)
{
    const search *s = context;
    for (int64_t k = begin; k < end; k++) {
        double x[CONTROL_PIECE_MAX];
        if (k == s->axes) {
            judge_at(s, s->x, s->here);
            continue;
        }
        memcpy(x, s->x, sizeof *x * (size_t)s->axes);
        x[k] += probe_along(&s->free[k], x[k]);
        judge_at(s, x, &s->near[k]);
    }
}

/* A limit that can stop this plan, and how far it is from doing so. */
static bool binds(const finding *f)
{
    return f->level != LIMIT_NOT_JUDGED && !f->estimated && isfinite(f->margin) &&
           (f->margin >= 0 || f->level == LIMIT_STOP);
}

/* Finding i about x as a straight limit; false: no change of the plan changes it here. */
static bool straight(const search *s, const double x[], int i, move_limit *out)
{
    const finding *f = &s->here->finding[i];
    double square = 0, at = 0;
    if (!binds(f)) return false;
    *out = (move_limit){0};
    for (int k = 0; k < s->axes; k++) {
        const finding *g = &s->near[k].finding[i];
        if (binds(g)) out->towards[k] = (g->margin - f->margin) / probe_along(&s->free[k], x[k]);
        square += out->towards[k] * out->towards[k];
    }
    const double slope = sqrt(square);
    if (slope < least_slope) return false;
    for (int k = 0; k < s->axes; k++) {
        out->towards[k] /= slope;
        at += out->towards[k] * x[k];
    }
    out->least = at - f->margin / slope + clear;
    return true;
}

/* Adds the limits about x; returns how many there are. What stops here stays for the steps to come: a depth is the
 * largest of many, and moving out of one cusp's way into another's would never end. */
static int add_limits(search *s, const double x[])
{
    int rows = s->rows;
    for (int kept = 1; kept >= 0; kept--) {
        for (int i = 0; i < s->here->count && rows < ROWS_MAX; i++)
            rows += (s->here->finding[i].level == LIMIT_STOP) == kept && straight(s, x, i, &s->row[rows]);
        if (kept) s->rows = rows < KEPT_MAX ? rows : KEPT_MAX;
    }
    return rows;
}

/* A turn only becomes less. */
static void add_turns(search *s)
{
    for (int k = 0; k < s->axes; k++) {
        const freedom *f = &s->free[k];
        if (!isfinite(f->low)) continue;
        s->row[s->rows] = (move_limit){.least = f->low};
        s->row[s->rows++].towards[k] = 1;
        s->row[s->rows] = (move_limit){.least = -f->high};
        s->row[s->rows++].towards[k] = -1;
    }
}

static double length_of(const double x[], int axes)
{
    double square = 0;
    for (int k = 0; k < axes; k++) square += x[k] * x[k];
    return sqrt(square);
}

/* From x towards the nearest place that has all limits; the largest part of the step. */
static double step(search *s, double x[], double reach)
{
    double to[CONTROL_PIECE_MAX], largest = 0;
    nearest_move(s->row, add_limits(s, x), s->axes, to);
    for (int k = 0; k < s->axes; k++) {
        to[k] = fmin(fmax(to[k], s->free[k].low), s->free[k].high);
        largest = fmax(largest, fabs(to[k] - x[k]));
    }
    const double part = largest > reach ? reach / largest : 1;
    for (int k = 0; k < s->axes; k++) x[k] += part * (to[k] - x[k]);
    return part * largest;
}

/* x, or less of it, in whole steps of `grid`: of the controls' values, or away from what is wanted. */
static void rounded(const search *s, const double x[], double part, double grid, bool away, double out[])
{
    for (int k = 0; k < s->axes; k++) {
        const freedom *f = &s->free[k];
        double steps = part * x[k] / grid;
        out[k] = grid * (away ? copysign(ceil(fabs(steps) - 0.1), steps) : round(steps));
        out[k] = fmin(fmax(out[k], f->low), f->high);
    }
}

/* The first of the rounded ones, from coarse to fine, that nothing stops. */
static bool round_off(const search *s, const double x[], double part, double out[], judgement *after)
{
    static const double grid[] = {0.1, 0.05, 0.01};
    for (int i = 0; i < 6; i++) {
        rounded(s, x, part, grid[i / 2], i % 2, out);
        judge_at(s, out, after);
        if (after->worst < LIMIT_STOP) return true;
    }
    return false;
}

/* Leaves out the changes that are not needed. */
static void leave_out(const search *s, double x[], judgement *after)
{
    judgement *less = NEW_ARRAY(judgement, 1);
    for (int k = 0; k < s->axes; k++) {
        const double was = x[k];
        if (was == 0) continue;
        x[k] = 0;
        judge_at(s, x, less);
        if (less->worst < LIMIT_STOP)
            *after = *less;
        else
            x[k] = was;
    }
    free(less);
}

/* The least part of x that nothing stops, rounded; false if rounding meets a limit at any. */
static bool finish(const search *s, const double x[], double out[], judgement *after)
{
    double low = 0, high = 1, less[CONTROL_PIECE_MAX];
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        for (int k = 0; k < s->axes; k++) less[k] = middle * x[k];
        judge_at(s, less, after);
        if (after->worst < LIMIT_STOP)
            high = middle;
        else
            low = middle;
    }
    if (!round_off(s, x, high, out, after) && !round_off(s, x, 1, out, after)) return false;
    leave_out(s, out, after);
    return true;
}

/* The nearest x that nothing stops; false: none was seen, and the judgement is of the last. */
static bool look(search *s, double best[], judgement *last)
{
    double x[CONTROL_PIECE_MAX] = {0}, reach = first_reach;
    bool found = false;
    s->near = NEW_ARRAY(judgement, s->axes + 1);
    s->here = &s->near[s->axes];
    s->x = x;
    s->row = NEW_ARRAY(move_limit, ROWS_MAX);
    add_turns(s);
    for (int i = 0; i < STEPS_MAX; i++, reach *= calm) {
        parallel_for(s->axes + 1, 1, judge_probes, s);
        *last = *s->here;
        if (last->worst < LIMIT_STOP && (!found || length_of(x, s->axes) < length_of(best, s->axes))) {
            memcpy(best, x, sizeof x);
            found = true;
        }
        if (step(s, x, reach) < settled) break;
    }
    free(s->row);
    free(s->near);
    return found;
}

static void tell(const search *s, const double x[], remedy *out)
{
    out->plan = changed(s, x);
    *out->plan.override = 0;
    for (int k = 0; k < s->axes; k++) {
        const freedom *f = &s->free[k];
        const segment_move *m = &s->wanted.segment[f->segment].move;
        remedy_change *r = &out->change[out->change_count];
        control one;
        if (x[k] == 0) continue;
        control_of_piece(f->control, &one);
        double wanted = m->kind == MOVE_RIGID ? (double)NAN : rig_moved(m, f->axis, &s->p->frame);
        *r = (remedy_change){.unit = one.unit, .by = x[k], .wanted = wanted, .proposed = wanted + x[k]};
        memcpy(r->control, one.name, sizeof r->control);
        out->change_count++;
    }
}

void remedy_find(const judge *j, const case_file *c, const prepared *p, const plan_file *plan, const judgement *now,
                 remedy *out)
{
    double x[CONTROL_PIECE_MAX], best[CONTROL_PIECE_MAX] = {0};
    *out = (remedy){.sought = now->worst == LIMIT_STOP, .after = *now};
    if (!out->sought) return;
    search *s = NEW_ARRAY(search, 1);
    judgement *after = NEW_ARRAY(judgement, 1);
    s->j = j;
    s->c = c;
    s->p = p;
    s->wanted = *plan;
    plan_vary_open(&s->wanted, &p->frame);
    find_freedoms(s);
    out->found = s->axes && look(s, best, &out->after) && finish(s, best, x, after);
    if (out->found) {
        out->after = *after;
        tell(s, x, out);
    }
    free(after);
    free(s);
}
