/* Where bone and teeth leave a question to the soft tissue: only at the rim of what they allow. On rays from the base
 * to the ends, sides and corners of the box the outermost allowed point is solved; where the tissue stops it, the ray
 * is halved. Between neighbouring rays the rim runs straight. */
#include "app/planner/bounds/audit.h"
#include "geometry/mem.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static void place_on(const audit_ray *r, int k, int32_t at[SAMPLE_AXES_MAX])
{
    for (int i = 0; i < SAMPLE_AXES_MAX; i++) at[i] = (int32_t)lround((double)r->target[i] * k / r->steps);
}

void audit_ray_place(const audit_ray *r, int32_t at[SAMPLE_AXES_MAX]) { place_on(r, r->reach, at); }

/* ---- the rays of all requests, each direction once ---- */

static int add_ray(audit *a, const int32_t target[SAMPLE_AXES_MAX], bool axis)
{
    audit_ray r = {.finest = axis ? 1 : a->spacing / 4 > 1 ? a->spacing / 4 : 1};
    for (int i = 0; i < SAMPLE_AXES_MAX; i++) {
        r.target[i] = target[i];
        r.steps = abs(target[i]) > r.steps ? abs(target[i]) : r.steps;
    }
    for (int i = 0; i < a->ray_count; i++)
        if (!memcmp(a->ray[i].target, r.target, sizeof r.target)) return i;
    a->ray = GROW_ARRAY(audit_ray, a->ray, a->ray_count + 1);
    a->ray[a->ray_count] = r;
    return a->ray_count++;
}

/* Directions of {-1, 0, 1}^n but none; number d in base 3. */
static void make_rays(audit *a)
{
    for (int i = 0; i < a->settings.request_count; i++) {
        const audit_request *q = &a->settings.request[i];
        int all = q->axis_count == 1 ? 3 : q->axis_count == 2 ? 9 : 27;
        for (int d = 0; d < all; d++) {
            int32_t target[SAMPLE_AXES_MAX] = {0};
            int moved = 0;
            for (int k = 0, rest = d; k < q->axis_count; k++, rest /= 3) {
                target[q->axis[k]] = rest % 3 == 0 ? 0 : rest % 3 == 1 ? a->low[q->axis[k]] : a->high[q->axis[k]];
                moved += rest % 3 != 0;
            }
            a->request_ray[i][d] = moved ? add_ray(a, target, moved == 1) : -1;
        }
    }
}

struct halving { /* of many rays side by side */
    audit *a;
    int *good, *bad; /* [ray_count] last step known to be allowed, first one known not to be; -1: not at work */
};

/* The steps in the middle of all rays at work whose gap is wider than one; returns how many. */
static int middles(const struct halving *h, int32_t *at, int *ray)
{
    int n = 0;
    for (int i = 0; i < h->a->ray_count; i++) {
        if (h->bad[i] < 0 || h->bad[i] - h->good[i] <= 1) continue;
        place_on(&h->a->ray[i], (h->good[i] + h->bad[i]) / 2, at + SAMPLE_AXES_MAX * (int64_t)n);
        ray[n++] = i;
    }
    return n;
}

/* How far bone and teeth allow each ray. */
static bool find_allowed(audit *a, struct halving *h, int32_t *at, int *ray, err *e)
{
    int64_t n = 0;
    int32_t *coarse = NULL;
    for (int i = 0; i < a->ray_count; i++) {
        int wide = a->spacing, more = a->ray[i].steps / wide + 2;
        coarse = GROW_ARRAY(int32_t, coarse, SAMPLE_AXES_MAX * (n + more));
        for (int k = 0; k < a->ray[i].steps + wide; k += wide)
            place_on(&a->ray[i], k < a->ray[i].steps ? k : a->ray[i].steps, coarse + SAMPLE_AXES_MAX * n++);
    }
    bool ok = sample_set_ask(&a->points, coarse, n, e);
    free(coarse);
    for (int i = 0; ok && i < a->ray_count; i++) {
        h->good[i] = 0;
        h->bad[i] = -1;
        for (int k = 0; h->bad[i] < 0 && k < a->ray[i].steps + a->spacing; k += a->spacing) {
            int32_t p[SAMPLE_AXES_MAX];
            int step = k < a->ray[i].steps ? k : a->ray[i].steps;
            place_on(&a->ray[i], step, p);
            if (sample_set_find(&a->points, p)->level == VERDICT_STOP)
                h->bad[i] = step;
            else
                h->good[i] = step;
        }
    }
    for (int count; ok && (count = middles(h, at, ray)) > 0;) {
        ok = sample_set_ask(&a->points, at, count, e);
        for (int k = 0; ok && k < count; k++) {
            bool stopped = sample_set_find(&a->points, at + SAMPLE_AXES_MAX * (int64_t)k)->level == VERDICT_STOP;
            *(stopped ? &h->bad[ray[k]] : &h->good[ray[k]]) = (h->good[ray[k]] + h->bad[ray[k]]) / 2;
        }
    }
    for (int i = 0; ok && i < a->ray_count; i++) a->ray[i].reach = a->ray[i].allowed = h->good[i];
    return ok;
}

/* Where the tissue's stop is looked for on a ray. The smallest volume ratio changes smoothly along it: two points
 * close to where the line through its values at both ends meets the limit; half way where that did not halve the gap.
 */
struct search {
    int good, bad, tried[2];
    double good_value, bad_value; /* margin of the smallest volume ratio; NaN: something else stops */
    bool halve;
};

static void try_next(struct search *s, int finest)
{
    int gap = s->bad - s->good, near = gap / 32 > finest ? gap / 32 : finest;
    double share = s->good_value / (s->good_value - s->bad_value);
    if (s->halve || !(share > 0 && share < 1)) {
        s->tried[0] = s->tried[1] = s->good + gap / 2;
        return;
    }
    int guess = s->good + (int)lround(share * gap);
    for (int k = 0; k < 2; k++) {
        int t = guess + (k ? (near + 1) / 2 : -(near / 2));
        s->tried[k] = t <= s->good ? s->good + 1 : t >= s->bad ? s->bad - 1 : t;
    }
}

static void learn(const audit *a, struct search *s, audit_ray *r, int step, const tissue_point *p)
{
    double value = limit_margin(&a->patient->limits[LIMIT_SMALLEST_J], p->min_j);
    if (p->v.level == VERDICT_STOP && step <= s->bad) {
        s->bad = step;
        s->bad_value = p->v.reason == LIMIT_SMALLEST_J ? value : (double)NAN;
        r->v = p->v;
    } else if (p->v.level != VERDICT_STOP && step >= s->good) {
        s->good = step;
        s->good_value = value;
    }
}

/* Solves the outermost allowed point of every ray, and on those that it stops looks for where. */
static bool find_reach(audit *a, struct search *s, err *e)
{
    int32_t *at = NEW_ARRAY(int32_t, 2 * SAMPLE_AXES_MAX * (int64_t)a->ray_count);
    int *ray = NEW_ARRAY(int, 2 * a->ray_count), *step = NEW_ARRAY(int, 2 * a->ray_count), count = 0;
    bool ok = true;
    for (int i = 0; i < a->ray_count; i++) {
        s[i] = (struct search){.bad = a->ray[i].allowed + 1, .tried = {a->ray[i].allowed, a->ray[i].allowed}};
        s[i].good_value = s[i].bad_value = (double)NAN;
    }
    for (bool first = true; ok; first = false, count = 0) {
        for (int i = 0; i < a->ray_count; i++) {
            audit_ray *r = &a->ray[i];
            if (first ? !r->allowed : !r->limited || s[i].bad - s[i].good <= r->finest) continue;
            if (!first) try_next(&s[i], r->finest);
            for (int k = 0; k < (s[i].tried[0] == s[i].tried[1] ? 1 : 2); k++) {
                place_on(r, s[i].tried[k], at + SAMPLE_AXES_MAX * (int64_t)count);
                step[count] = s[i].tried[k];
                ray[count++] = i;
            }
        }
        if (!count) break;
        ok = tissue_set_ask(&a->tissue, at, count, e);
        for (int k = 0, gap = 0; ok && k < count; k++) {
            struct search *mine = &s[ray[k]];
            audit_ray *r = &a->ray[ray[k]];
            const tissue_point *p = tissue_set_find(&a->tissue, at + SAMPLE_AXES_MAX * (int64_t)k);
            if (k == 0 || ray[k] != ray[k - 1]) gap = mine->bad - mine->good;
            learn(a, mine, r, step[k], p);
            if (first) {
                r->v = p->v;
                r->limited = p->v.level == VERDICT_STOP;
                mine->good = 0;
                mine->good_value = 1; /* at rest nothing is strained: the smallest volume ratio is 1 */
            } else {
                mine->halve = 2 * (mine->bad - mine->good) > gap;
            }
        }
    }
    for (int i = 0; ok && i < a->ray_count; i++)
        if (a->ray[i].limited) a->ray[i].reach = s[i].good;
    free(at);
    free(ray);
    free(step);
    return ok;
}

/* ---- the journal ---- */

static bool keep_tissue(const tissue_point *p, void *context, err *e)
{
    audit *a = context;
    size_t head = offsetof(tissue_point, shift),
           shift = 3 * (size_t)a->prepared->tissue.mesh.vertex_count * sizeof(float);
    char *bytes = NEW_ARRAY(char, head + shift);
    memcpy(bytes, p, head);
    memcpy(bytes + head, p->shift, shift);
    bool ok = journal_add(a->journal, AUDIT_RECORD_TISSUE, bytes, head + shift, e);
    free(bytes);
    return ok;
}

bool audit_read_tissue(audit *a, const void *bytes, size_t size, err *e)
{
    size_t head = offsetof(tissue_point, shift),
           shift = 3 * (size_t)a->prepared->tissue.mesh.vertex_count * sizeof(float);
    if (size != head + shift) return err_set(e, ERR_INPUT, "a record of unknown kind");
    tissue_point p = {0};
    memcpy(&p, bytes, head);
    p.shift = NEW_ARRAY(float, shift / sizeof(float));
    memcpy(p.shift, (const char *)bytes + head, shift);
    tissue_set_put(&a->tissue, &p);
    free(p.shift);
    return true;
}

/* ---- */

static prediction_options without_face(int load_steps)
{
    prediction_options o = prediction_options_default();
    o.least_j = 0; /* where the model ends is what is asked */
    o.contact = CONTACT_OFF;
    o.load_steps = load_steps;
    o.skin = o.points = o.depth = false;
    return o;
}

/* Solves what predict --contact off --full solves, tets left to turn inside out: contact would take five times as long.
 * What needs the face (incisor show, lower face) only cautions and is left to predict. */
static bool solve_point(const int32_t *at, const double *start_xyz, void *context, equilibrium *out, verdict *v, err *e)
{
    audit *a = context;
    judgement bones;
    plan_moves moves;
    prediction made;
    const task watch = {.interrupted = audit_stopped, .context = a};
    if (!audit_judge(a, at, &bones, &moves, e) ||
        !live_pool_predict(&a->predictions, &moves, start_xyz, &watch, &made, e))
        return false;
    *v = audit_verdict(a, &made.limits);
    *out = made.solve;
    made.solve = (equilibrium){0};
    prediction_free(&made);
    return true;
}

static void tell_round(int done, int count, void *context)
{
    audit *a = context;
    if (a->solved) a->solved(a->tissue.rounds, done, count, a->context);
}

void audit_tissue_start(audit *a)
{
    a->tissue = (tissue_set){.mesh = &a->prepared->tissue.mesh,
                             .solve = solve_point,
                             .keep = keep_tissue,
                             .progress = tell_round,
                             .context = a};
    tissue_set_start(&a->tissue);
}

/* Asks all rays, with what predicts at hand. */
static bool ask(audit *a, err *e)
{
    int32_t base[SAMPLE_AXES_MAX] = {0};
    judgement j;
    plan_moves moves;
    if (!audit_judge(a, base, &j, &moves, e)) return false;
    a->tissue.starts_at_rest = true;
    for (int s = 0; s < SEGMENT_COUNT; s++) a->tissue.starts_at_rest &= rigid_is_identity(&moves.move[s]);
    if (!a->tissue.starts_at_rest && !tissue_set_ask(&a->tissue, base, 1, e)) return false;
    make_rays(a);
    struct halving h = {.a = a, .good = NEW_ARRAY(int, a->ray_count), .bad = NEW_ARRAY(int, a->ray_count)};
    int32_t *at = NEW_ARRAY(int32_t, SAMPLE_AXES_MAX * (int64_t)a->ray_count);
    int *ray = NEW_ARRAY(int, a->ray_count);
    struct search *search = NEW_ARRAY(struct search, a->ray_count);
    bool ok = find_allowed(a, &h, at, ray, e) && find_reach(a, search, e);
    for (int i = 0; ok && i < a->settings.request_count; i++)
        if (a->map[i].node_count) audit_rim_mark(a, i);
    free(search);
    free(h.good);
    free(h.bad);
    free(at);
    free(ray);
    return ok;
}

bool audit_tissue(audit *a, journal *to, err *e)
{
    bone_shapes shapes;
    const prediction_options options = without_face(a->base.load_steps);
    a->journal = to;
    a->tissue_asked = true;
    if (!bone_shapes_make(a->prepared, &shapes, e)) return false;
    live_pool_start(&a->predictions, a->patient, a->prepared, &shapes, &options);
    bool ok = ask(a, e);
    live_pool_free(&a->predictions);
    bone_shapes_free(&shapes);
    return ok;
}
