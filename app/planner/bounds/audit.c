#include "app/planner/bounds/audit.h"
#include "geometry/clock.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COARSE = 2 /* spacings between the points that are judged first */ };

double audit_value(const audit *a, int which, double steps) { return a->base_value[which] + steps * a->step; }

/* The box of one control: past the limits of moves by at least one spacing, so that they show as reasons. */
static bool make_box(audit *a, int k, err *e)
{
    const control *x = &a->settings.control[k];
    double base = a->base_value[k], wide = a->settings.spacing;
    if (!isfinite(x->low) || !isfinite(x->high))
        return err_at(e, ERR_INPUT, a->patient->path, 0, NULL,
                      "leaves limits.%s.stop open, so that there is no end to where %s may be looked at",
                      limit_default[control_limit(x->segment, x->axis)].name, x->name);
    if (!(base >= x->low && base <= x->high))
        return err_at(e, ERR_INPUT, a->base.path, 0, NULL,
                      "has %s %.4g, outside %g to %g: there is nothing to audit around it", x->name, base, x->low,
                      x->high);
    a->low[k] = -((int32_t)ceil((base - x->low) / wide - 1e-9) + 1) * a->spacing;
    a->high[k] = ((int32_t)ceil((x->high - base) / wide - 1e-9) + 1) * a->spacing;
    return true;
}

void audit_free(audit *a)
{
    for (int i = 0; i < AUDIT_REQUESTS_MAX; i++) {
        feasible_line_free(&a->line[i]);
        feasible_map_free(&a->map[i]);
    }
    for (int i = 0; i < AUDIT_REQUESTS_MAX; i++) free(a->outside[i]);
    free(a->ray);
    if (a->judge) tissue_set_free(&a->tissue);
    sample_set_free(&a->points);
    judge_free(&a->judge);
    *a = (audit){0};
}

void audit_key(const audit *a, char key[HASH_TEXT_SIZE])
{
    const audit_settings *s = &a->settings;
    content_hash *h = content_hash_start();
    content_hash_text(h, "version", GNATHOS_VERSION);
    content_hash_text(h, "case", a->prepared->hash);
    content_hash_bytes(h, a->patient->limits, sizeof a->patient->limits);
    content_hash_number(h, "spacing", s->spacing);
    content_hash_number(h, "tolerance", s->tolerance);
    content_hash_number(h, "tissue", s->tissue);
    content_hash_number(h, "load steps", a->base.load_steps);
    for (int k = 0; k < s->control_count; k++) content_hash_number(h, s->control[k].name, a->base_value[k]);
    content_hash_bytes(h, s->request, (size_t)s->request_count * sizeof *s->request);
    plan_moves moves;
    issue_list issues = {0};
    if (plan_moves_set(&a->base, a->patient, &a->prepared->points, &moves, &issues))
        for (int b = 0; b < SEGMENT_COUNT; b++) {
            double m[16];
            rigid_to_matrix(&moves.move[b], m);
            content_hash_bytes(h, m, sizeof m);
        }
    for (int b = 0; b < SEGMENT_COUNT; b++) { /* about what an angle turns */
        content_hash_text(h, "pivot", a->base.segment[b].pivot);
        content_hash_bytes(h, a->base.segment[b].move.pivot_mm, sizeof a->base.segment[b].move.pivot_mm);
    }
    issue_list_free(&issues);
    content_hash_end(h, key);
}

bool audit_judge(const audit *a, const int32_t at[SAMPLE_AXES_MAX], judgement *out, plan_moves *moves, err *e)
{
    plan_file p = a->base;
    issue_list issues = {0};
    for (int k = 0; k < a->settings.control_count; k++)
        if (at[k]) plan_vary_set(&a->settings.control[k], &a->prepared->frame, audit_value(a, k, at[k]), &p);
    bool ok = plan_moves_set(&p, a->patient, &a->prepared->points, moves, &issues);
    if (!ok && issue_none_is_error(&issues, e)) err_set(e, ERR_INTERNAL, "the plan could not be made");
    issue_list_free(&issues);
    if (ok) judge_plan(a->judge, moves, out);
    return ok;
}

const finding *audit_decisive(const audit *a, const judgement *j, limit_level *level)
{
    const finding *best = NULL;
    double least = 0;
    *level = LIMIT_NOT_JUDGED;
    for (int i = 0; i < j->count; i++) {
        const finding *f = &j->finding[i];
        bool usual = f->level > LIMIT_FINE && f->level <= a->throughout[f->limit];
        limit_level mine = usual ? LIMIT_FINE : f->level;
        double margin = usual ? HUGE_VAL : f->margin;
        if (best && (mine < *level || (mine == *level && !(margin < least)))) continue;
        best = f;
        least = margin;
        *level = mine;
    }
    return best;
}

static bool find_throughout(audit *a, err *e)
{
    int n = a->settings.control_count;
    for (int l = 0; l < LIMIT_COUNT; l++) a->throughout[l] = LIMIT_STOP;
    for (int probe = 0; probe < (1 << n) + 2 * n + 1; probe++) {
        int32_t at[SAMPLE_AXES_MAX] = {0};
        int side = probe - (1 << n);
        if (side < 0)
            for (int k = 0; k < n; k++) at[k] = probe >> k & 1 ? a->high[k] : a->low[k];
        else if (side < 2 * n)
            at[side / 2] = side % 2 ? a->high[side / 2] : a->low[side / 2];
        judgement j;
        plan_moves moves;
        limit_level level[LIMIT_COUNT] = {0};
        if (!audit_judge(a, at, &j, &moves, e)) return false;
        for (int i = 0; i < j.count; i++)
            if (j.finding[i].level > level[j.finding[i].limit]) level[j.finding[i].limit] = j.finding[i].level;
        for (int l = 0; l < LIMIT_COUNT; l++)
            if (level[l] < a->throughout[l]) a->throughout[l] = level[l];
    }
    return true;
}

bool audit_make(const case_file *c, const prepared *p, const plan_file *base, const audit_settings *s, audit *out,
                err *e)
{
    audit *a = out;
    *a = (audit){.patient = c, .prepared = p, .settings = *s, .base = base ? *base : plan_file_default(), .spacing = 1};
    while (s->spacing / a->spacing > s->tolerance) a->spacing *= 2;
    a->step = s->spacing / a->spacing;
    bool ok = true;
    for (int k = 0; ok && k < s->control_count; k++) ok = plan_vary_open_for(&s->control[k], &p->frame, &a->base, e);
    for (int k = 0; ok && k < s->control_count; k++) {
        a->base_value[k] = plan_vary_value(&s->control[k], &p->frame, &a->base);
        ok = make_box(a, k, e);
    }
    ok = ok && judge_create(c, p, &a->judge, e) && find_throughout(a, e);
    if (ok)
        audit_tissue_start(a);
    else {
        judge_free(&a->judge);
        *a = (audit){0};
    }
    return ok;
}

verdict audit_verdict(const audit *a, const judgement *j)
{
    limit_level level;
    const finding *f = audit_decisive(a, j, &level);
    return (verdict){.level = level == LIMIT_STOP      ? VERDICT_STOP
                              : level == LIMIT_CAUTION ? VERDICT_CAUTION
                                                       : VERDICT_FINE,
                     .reason = (int32_t)f->limit,
                     .value = f->value};
}

static bool judge_point(const int32_t at[SAMPLE_AXES_MAX], void *context, verdict *out, err *e)
{
    judgement j;
    plan_moves moves;
    if (!audit_judge(context, at, &j, &moves, e)) return false;
    *out = audit_verdict(context, &j);
    return true;
}

static bool keep_point(const sample *s, void *context, err *e)
{
    audit *a = context;
    return !a->journal || journal_add(a->journal, AUDIT_RECORD_POINT, s, sizeof *s, e);
}

static void tell(int64_t judged, void *context)
{
    audit *a = context;
    double now = clock_s();
    if (!a->progress || now - a->told_s < 1) return;
    a->told_s = now;
    int64_t expected = a->expected > judged ? a->expected : judged + 1;
    a->progress(judged, expected, (now - a->start_s) / (double)judged * (double)(expected - judged), a->context);
}

bool audit_stopped(void *context)
{
    const audit *a = context;
    return a->interrupted && a->interrupted(a->context);
}

static sample_params judging(audit *a)
{
    return (sample_params){.axis_count = a->settings.control_count,
                           .judge = judge_point,
                           .keep = keep_point,
                           .progress = tell,
                           .interrupted = audit_stopped,
                           .context = a};
}

bool audit_read_record(uint32_t kind, const void *bytes, size_t size, void *context, err *e)
{
    audit *a = context;
    sample s;
    if (kind == AUDIT_RECORD_TISSUE) return audit_read_tissue(a, bytes, size, e);
    if (kind != AUDIT_RECORD_POINT || size != sizeof s) return err_set(e, ERR_INPUT, "a record of unknown kind");
    if (!a->points.params.judge) a->points = sample_set_new(&(sample_params){.judge = judge_point});
    memcpy(&s, bytes, sizeof s);
    sample_set_put(&a->points, &s);
    return true;
}

/* How many points a request may take: measured on heads, to tell the time left. */
static int64_t guess(const audit *a, const audit_request *r)
{
    double nodes = 1;
    for (int k = 0; k < r->axis_count; k++)
        nodes *= (a->high[r->axis[k]] - a->low[r->axis[k]]) / (double)a->spacing + 1;
    return (int64_t)(nodes * (r->axis_count == 1 ? 1.5 : r->axis_count == 2 ? 0.9 : 0.3));
}

static bool run(audit *a, int i, err *e)
{
    const audit_request *r = &a->settings.request[i];
    if (r->axis_count == 1) {
        int32_t direction[SAMPLE_AXES_MAX] = {0};
        direction[r->axis[0]] = 1;
        return feasible_line_find(&a->points, direction, a->low[r->axis[0]], a->high[r->axis[0]], a->spacing,
                                  &a->line[i], e);
    }
    feasible_map_params p = {.axis_count = r->axis_count,
                             .spacing = a->spacing,
                             .coarse = COARSE * a->spacing,
                             .reasons = r->axis_count == 2,
                             .edges = r->axis_count == 2};
    for (int k = 0; k < r->axis_count; k++) {
        p.axis[k] = r->axis[k];
        p.low[k] = a->low[r->axis[k]];
        p.high[k] = a->high[r->axis[k]];
    }
    return feasible_map_find(&a->points, &p, &a->map[i], e);
}

bool audit_bones(audit *a, journal *j, err *e)
{
    a->journal = j;
    a->points.params = judging(a);
    a->start_s = clock_s();
    int64_t left = 0;
    for (int i = 0; i < a->settings.request_count; i++) left += guess(a, &a->settings.request[i]);
    for (int i = 0; i < a->settings.request_count; i++) {
        a->expected = a->points.judged + left;
        if (!run(a, i, e)) return false;
        left -= guess(a, &a->settings.request[i]);
    }
    return true;
}
