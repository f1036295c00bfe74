#include "app/planner/bounds/audit_record.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The finding that decides at a step of a line. */
static bool finding_at(const audit *a, const feasible_line *l, int32_t t, finding *out, err *e)
{
    int32_t at[SAMPLE_AXES_MAX];
    judgement j;
    plan_moves moves;
    limit_level level;
    for (int k = 0; k < SAMPLE_AXES_MAX; k++) at[k] = t * l->direction[k];
    if (!audit_judge(a, at, &j, &moves, e)) return false;
    *out = *audit_decisive(a, &j, &level);
    return true;
}

bool audit_bound_of(const audit *a, int request, int end, audit_bound *out, err *e)
{
    const feasible_line *l = &a->line[request];
    int which = a->settings.request[request].axis[0];
    audit_bound b = {.fine = (double)NAN};
    verdict_level level[2] = {VERDICT_CAUTION, VERDICT_STOP};
    for (int i = 0; i < 2; i++) {
        int at = feasible_line_reach(l, end, level[i]);
        if (at < 0) continue;
        double *to = i ? &b.reach : &b.fine;
        *to = audit_value(a, which, end > 0 ? l->piece[at].to : l->piece[at].from);
        b.feasible |= i == 1;
        if (at + end < 0 || at + end >= l->piece_count) continue;
        int32_t beyond = end > 0 ? l->piece[at + end].from : l->piece[at + end].to;
        if (!finding_at(a, l, beyond, i ? &b.stop : &b.caution, e)) return false;
        *(i ? &b.ended : &b.warned) = true;
    }
    if (b.feasible && a->tissue_asked) b.ray = &a->ray[a->request_ray[request][end < 0 ? 1 : 2]];
    if (b.ray && b.ray->limited) { /* the tissue ends it before bone and teeth do */
        b.bones = b.reach;
        b.reach = audit_value(a, which, end * b.ray->reach);
        if (end * (b.fine - b.reach) > 0) b.fine = b.reach;
        b.ended = true;
        b.stop = (finding){.limit = (limit_id)b.ray->v.reason,
                           .where = "",
                           .value = b.ray->v.value,
                           .level = LIMIT_STOP,
                           .segment_a = -1,
                           .segment_b = -1};
    }
    *out = b;
    return true;
}

static audit_finding finding_view(const audit *a, const finding *f)
{
    const limit *l = &limit_default[f->limit];
    audit_finding v = {.limit = l->name,
                       .where = f->where,
                       .unit = l->unit,
                       .value = f->value,
                       .estimated = f->estimated,
                       .has_place = f->has_place};
    memcpy(v.stop, a->patient->limits[f->limit].stop, sizeof v.stop);
    memcpy(v.place, f->place, sizeof v.place);
    return v;
}

/* What holds throughout the box, with its value at the base. */
static bool find_throughout(const audit *a, audit_view *v, err *e)
{
    int32_t base[SAMPLE_AXES_MAX] = {0};
    judgement j;
    plan_moves moves;
    if (!audit_judge(a, base, &j, &moves, e)) return false;
    v->throughout = NEW_ARRAY(audit_finding, FINDINGS_MAX);
    for (int i = 0; i < j.count; i++) {
        const finding *f = &j.finding[i];
        if (a->throughout[f->limit] <= LIMIT_FINE || f->level < a->throughout[f->limit]) continue;
        v->throughout[v->always] = finding_view(a, f);
        v->throughout[v->always++].level = a->throughout[f->limit];
    }
    return true;
}

int64_t audit_points_allowed(const audit *a)
{
    int64_t allowed = 0;
    for (int64_t i = 0; i < a->points.count; i++) allowed += a->points.item[i].v.level != VERDICT_STOP;
    return allowed;
}

static audit_tissue_view tissue_view(const audit *a)
{
    const tissue_set *t = &a->tissue;
    audit_tissue_view v = {
        .contact = "off", .allowed = audit_points_allowed(a), .solves = t->count, .rounds = t->rounds};
    v.left_out = v.allowed - t->count;
    for (int i = 0; i < t->count; i++) {
        v.iterations += t->point[i].iterations;
        v.warm += t->point[i].warm;
    }
    return v;
}

static bool end_view(const audit *a, int request, int end, audit_end *out, err *e)
{
    audit_bound b;
    if (!audit_bound_of(a, request, end, &b, e)) return false;
    *out = (audit_end){.fine = b.fine,
                       .reach = b.feasible ? b.reach : (double)NAN,
                       .has_caution = b.warned,
                       .has_stop = b.ended,
                       .has_ray = b.ray != NULL};
    if (b.warned) out->caution = finding_view(a, &b.caution);
    if (b.ended) out->stop = finding_view(a, &b.stop);
    if (b.ray) out->ray = audit_ray_view_of(a, b.ray);
    return true;
}

static bool line_view(const audit *a, int request, audit_line_view *out, err *e)
{
    int c = a->settings.request[request].axis[0];
    const control *x = &a->settings.control[c];
    const feasible_line *l = &a->line[request];
    *out = (audit_line_view){.of = a,
                             .line = l,
                             .which = c,
                             .control = x->name,
                             .unit = x->unit,
                             .base = a->base_value[c],
                             .box = {audit_value(a, c, a->low[c]), audit_value(a, c, a->high[c])},
                             .base_feasible = l->piece[l->base].level != VERDICT_STOP};
    return end_view(a, request, -1, &out->low, e) && end_view(a, request, 1, &out->high, e);
}

static audit_map_view map_view(const audit *a, int request)
{
    const feasible_map *m = &a->map[request];
    audit_map_view v = {.of = a,
                        .request = request,
                        .map = m,
                        .files = audit_map_name(a, request, ""),
                        .asked = a->tissue_asked,
                        .feasible = {.of = a},
                        .stopped = {.of = a}};
    for (int64_t i = 0; i < m->node_count; i++) {
        v.judged += m->judged[i];
        v.further += a->tissue_asked && a->outside[request][i] == 2;
    }
    if (!m->behind_count) return v;
    feasible_map_place(m, m->example, v.feasible.at);
    memcpy(v.stopped.at, m->before, sizeof v.stopped.at);
    return v;
}

bool audit_json(const audit *a, json_t **out, err *e)
{
    audit_view v = {.of = a,
                    .patient = a->patient,
                    .case_name = a->patient->name,
                    .hash = a->prepared->hash,
                    .spacing = a->settings.spacing,
                    .tolerance = a->settings.tolerance,
                    .step = a->step,
                    .base = {.of = a},
                    .points = a->points.count,
                    .line = NEW_ARRAY(audit_line_view, AUDIT_REQUESTS_MAX),
                    .map = NEW_ARRAY(audit_map_view, AUDIT_REQUESTS_MAX),
                    .has_tissue = a->tissue_asked,
                    .tissue = tissue_view(a)};
    bool ok = find_throughout(a, &v, e) && audit_not_judged(a, v.gap, &v.unknown, e);
    for (int i = 0; ok && i < a->settings.request_count; i++) {
        if (a->map[i].node_count)
            v.map[v.maps++] = map_view(a, i);
        else
            ok = line_view(a, i, &v.line[v.lines++], e);
    }
    if (ok) *out = record_json(&audit_table, &v);
    for (int i = 0; i < v.maps; i++) free(v.map[i].files);
    free(v.line);
    free(v.map);
    free(v.throughout);
    return ok;
}
