#include "app/planner/bounds/write.h"
#include <math.h>
#include <stdlib.h>

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

static json_t *number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

static json_t *range_json(const double r[2]) { return json_pack("[oo]", number(r[0]), number(r[1])); }

static json_t *finding_json(const audit *a, const finding *f)
{
    json_t *o = json_pack("{ss ss so ss}", "limit", limit_default[f->limit].name, "where", f->where, "value",
                          number(f->value), "unit", limit_default[f->limit].unit);
    json_object_set_new(o, "stop", range_json(a->patient->limits[f->limit].stop));
    if (f->estimated) json_object_set_new(o, "estimated", json_true());
    if (f->has_place) json_object_set_new(o, "place_mm", json_pack("[fff]", f->place[0], f->place[1], f->place[2]));
    return o;
}

/* What holds throughout the box, with its value at the base. */
static bool throughout_json(const audit *a, json_t **out, err *e)
{
    int32_t base[SAMPLE_AXES_MAX] = {0};
    judgement j;
    plan_moves moves;
    if (!audit_judge(a, base, &j, &moves, e)) return false;
    *out = json_array();
    for (int i = 0; i < j.count; i++) {
        const finding *f = &j.finding[i];
        if (a->throughout[f->limit] <= LIMIT_FINE || f->level < a->throughout[f->limit]) continue;
        json_t *o = finding_json(a, f);
        json_object_set_new(o, "level", json_string(limit_level_name(a->throughout[f->limit])));
        json_array_append_new(*out, o);
    }
    return true;
}

static json_t *place_json(const audit *a, const int32_t *at)
{
    json_t *o = json_object();
    for (int k = 0; k < a->settings.control_count; k++)
        json_object_set_new(o, a->settings.control[k].name, json_real(audit_value(a, k, at[k])));
    return o;
}

/* What the tissue says at the end of a ray: the level at the outermost point that bone and teeth allow, or of the stop.
 */
static json_t *ray_json(const audit *a, const audit_ray *r)
{
    int32_t at[SAMPLE_AXES_MAX];
    audit_ray_place(r, at);
    json_t *o = json_pack("{so sb sb}", "reach", place_json(a, at), "solved", r->allowed > 0, "limited", r->limited);
    if (!r->allowed) return o;
    json_object_set_new(o, "level", json_string(audit_level_name(r->v.level)));
    json_object_set_new(o, "limit", json_string(limit_default[r->v.reason].name));
    json_object_set_new(o, "value", number(r->v.value));
    return o;
}

int64_t audit_points_allowed(const audit *a)
{
    int64_t allowed = 0;
    for (int64_t i = 0; i < a->points.count; i++) allowed += a->points.item[i].v.level != VERDICT_STOP;
    return allowed;
}

static json_t *tissue_json(const audit *a)
{
    const tissue_set *t = &a->tissue;
    int64_t allowed = audit_points_allowed(a), iterations = 0, warm = 0;
    for (int i = 0; i < t->count; i++) {
        iterations += t->point[i].iterations;
        warm += t->point[i].warm;
    }
    return json_pack("{ss sI si sI si sI sI}", "contact", "off", "points_that_bone_and_teeth_allow",
                     (json_int_t)allowed, "solves", t->count, "solves_left_out", (json_int_t)(allowed - t->count),
                     "rounds", t->rounds, "started_from_a_neighbour", (json_int_t)warm, "iterations",
                     (json_int_t)iterations);
}

static json_t *pieces_json(const audit *a, const feasible_line *l, int which)
{
    json_t *list = json_array();
    for (int i = 0; i < l->piece_count; i++) {
        const line_piece *p = &l->piece[i];
        json_array_append_new(list, json_pack("{sf sf ss ss sf}", "from", audit_value(a, which, p->from), "to",
                                              audit_value(a, which, p->to), "level", audit_level_name(p->level),
                                              "limit", limit_default[p->reason].name, "value", p->value));
    }
    return list;
}

static bool line_json(const audit *a, int request, json_t **out, err *e)
{
    int c = a->settings.request[request].axis[0];
    const control *x = &a->settings.control[c];
    const feasible_line *l = &a->line[request];
    json_t *o = json_pack("{ss ss sf s[ff] sb}", "control", x->name, "unit", x->unit, "base", a->base_value[c], "box",
                          audit_value(a, c, a->low[c]), audit_value(a, c, a->high[c]), "base_feasible",
                          l->piece[l->base].level != VERDICT_STOP);
    for (int end = -1; end <= 1; end += 2) {
        audit_bound b;
        if (!audit_bound_of(a, request, end, &b, e)) {
            json_decref(o);
            return false;
        }
        json_t *one = json_pack("{so so so so}", "fine_to", number(b.fine), "feasible_to",
                                b.feasible ? number(b.reach) : json_null(), "caution_beyond",
                                b.warned ? finding_json(a, &b.caution) : json_null(), "stopped_beyond",
                                b.ended ? finding_json(a, &b.stop) : json_null());
        if (b.ray) json_object_set_new(one, "tissue", ray_json(a, b.ray));
        json_object_set_new(o, end < 0 ? "low" : "high", one);
    }
    json_object_set_new(o, "pieces", pieces_json(a, l, c));
    *out = o;
    return true;
}

static json_t *map_json(const audit *a, int request)
{
    const feasible_map *m = &a->map[request];
    json_t *names = json_array(), *o;
    int64_t judged = 0;
    for (int k = 0; k < m->params.axis_count; k++)
        json_array_append_new(names, json_string(a->settings.control[m->params.axis[k]].name));
    for (int64_t i = 0; i < m->node_count; i++) judged += m->judged[i];
    char *name = audit_map_name(a, request, "");
    o = json_pack("{so ss sI sI s{sI sI sI}}", "controls", names, "files", name, "nodes", (json_int_t)m->node_count,
                  "judged", (json_int_t)judged, "levels", "fine", (json_int_t)m->level_count[VERDICT_FINE], "caution",
                  (json_int_t)m->level_count[VERDICT_CAUTION], "stop", (json_int_t)m->level_count[VERDICT_STOP]);
    free(name);
    json_object_set_new(o, "star_shaped", m->base_stopped ? json_null() : json_boolean(!m->behind_count));
    json_object_set_new(o, "nodes_behind", json_integer(m->behind_count));
    if (m->behind_count) {
        int32_t at[SAMPLE_AXES_MAX];
        feasible_map_place(m, m->example, at);
        json_object_set_new(
            o, "behind_example",
            json_pack("{so so}", "feasible", place_json(a, at), "stopped_before", place_json(a, m->before)));
    }
    if (!a->tissue_asked) return o;
    json_t *rays = json_array();
    int64_t further = 0;
    for (int64_t i = 0; i < m->node_count; i++) further += a->outside[request][i] == 2;
    for (int d = 0; d < 27; d++) {
        int ray = a->request_ray[request][d];
        if (d < (m->params.axis_count == 2 ? 9 : 27) && ray >= 0)
            json_array_append_new(rays, ray_json(a, &a->ray[ray]));
    }
    json_object_set_new(o, "tissue_rim", rays);
    json_object_set_new(o, "nodes_further_out_than_solved", json_integer(further));
    return o;
}

static json_t *limits_json(const audit *a)
{
    json_t *list = json_array();
    for (int i = 0; i < LIMIT_COUNT; i++) {
        const limit *l = &limit_default[i];
        json_t *o =
            json_pack("{si ss ss ss so so ss}", "number", i, "name", l->name, "what", l->what, "unit", l->unit, "fine",
                      range_json(a->patient->limits[i].fine), "stop", range_json(a->patient->limits[i].stop), "source",
                      a->patient->limit_from_case[i] ? "set by the case" : l->source);
        json_array_append_new(list, o);
    }
    return list;
}

bool audit_json(const audit *a, json_t **out, err *e)
{
    int32_t zero[SAMPLE_AXES_MAX] = {0};
    json_t *lines = json_array(), *maps = json_array(), *one, *always = NULL, *unknown = NULL;
    bool ok = throughout_json(a, &always, e) && audit_not_judged(a, &unknown, e);
    for (int i = 0; ok && i < a->settings.request_count; i++) {
        if (a->map[i].node_count)
            json_array_append_new(maps, map_json(a, i));
        else if ((ok = line_json(a, i, &one, e)))
            json_array_append_new(lines, one);
    }
    if (ok) {
        *out =
            json_pack("{ss ss ss ss sf sf sf so sI so so so}", "schema", "gnathos.audit.1", "version", GNATHOS_VERSION,
                      "case", a->patient->name, "hash", a->prepared->hash, "spacing", a->settings.spacing, "tolerance",
                      a->settings.tolerance, "step", a->step, "base", place_json(a, zero), "points",
                      (json_int_t)a->points.count, "bounds", lines, "maps", maps, "limits", limits_json(a));
        json_object_set_new(*out, "throughout", always);
        json_object_set_new(*out, "not_judged", unknown);
        json_object_set_new(*out, "tissue", a->tissue_asked ? tissue_json(a) : json_null());
    } else {
        json_decref(lines);
        json_decref(maps);
        json_decref(always);
        json_decref(unknown);
    }
    return ok;
}
