#include "app/planner/identity/place_search.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

enum { COARSE_STEPS = 25, MIDDLE_STEPS = 25, FINE_STEPS = 60 };
static const double still_mm = 1e-10, gain = 0.999, least_scale = 0.7, most_scale = 1.4;

typedef struct candidate {
    similarity way;
    double score;
} candidate;

typedef struct search {
    const place_bodies *b;
    place_level level;
    const place_sample *sample;
    int32_t count;
    const task *watch;
    candidate *tried;
    double from[3], to[3]; /* middles that are laid on each other at the start */
} search;

/* The 60 turns of an icosahedron into itself: no turn is farther than 45 degrees from one of them. */
static int icosahedral_turns(double out[PLACE_STARTS][9])
{
    const double g = (1 + sqrt(5)) / 2, zero[3] = {0}, first[2][3] = {{0, 1, g}, {1, 1, 1}};
    const double angle[2] = {2 * M_PI / 5, 2 * M_PI / 3};
    double maker[2][9];
    for (int k = 0; k < 2; k++) {
        double axis[3];
        vec_copy(first[k], axis);
        vec_normalize(axis);
        memcpy(maker[k], rigid_rotation(zero, axis, angle[k]).r, sizeof maker[k]);
    }
    int count = 1;
    memcpy(out[0], rigid_identity().r, sizeof out[0]);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            double m[9], far = 1;
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    m[3 * r + c] = out[i][3 * r] * maker[k][c] + out[i][3 * r + 1] * maker[k][3 + c] +
                                   out[i][3 * r + 2] * maker[k][6 + c];
            for (int j = 0; j < count && far > 1e-6; j++) {
                far = 0;
                for (int c = 0; c < 9; c++) far = fmax(far, fabs(m[c] - out[j][c]));
            }
            if (far > 1e-6 && count < PLACE_STARTS) memcpy(out[count++], m, sizeof m);
        }
    return count;
}

static void middle_of(const search *s, place_side side, double out[3])
{
    int part = s->b->tree[side][CASE_MANDIBLE] ? CASE_MANDIBLE : CASE_SKIN, n = 0;
    memset(out, 0, 3 * sizeof *out);
    for (int32_t i = 0; i < s->count; i++)
        if (s->sample[i].side == side && s->sample[i].part == part) {
            vec_add(out, s->sample[i].at, out);
            n++;
        }
    vec_scale(out, 1.0 / (n ? n : 1), out);
}

/* Points upon points: no size, which would run away while the place is wrong. */
static void walk_points(const search *s, candidate *c)
{
    place_gap *gap = NEW_ARRAY(place_gap, s->count);
    double *from = NEW_ARRAY(double, 3 * s->count), *to = NEW_ARRAY(double, 3 * s->count);
    for (int step = 0; step <= COARSE_STEPS; step++) {
        int32_t n = 0;
        similarity more;
        c->score = place_pair_up(s->b, s->level, s->sample, s->count, &c->way, FACING_ANY, gap);
        for (int32_t i = 0; i < s->count; i++) {
            if (!(gap[i].pair.weight > 0)) continue;
            vec_copy(gap[i].pair.at, from + 3 * (size_t)n);
            vec_copy(gap[i].pair.to, to + 3 * (size_t)n++);
        }
        if (n < 4) break;
        similarity_of_pairs(from, to, NULL, n, false, &more);
        c->way.motion = rigid_compose(&more.motion, &c->way.motion);
    }
    free(gap);
    free(from);
    free(to);
}

static void walk_planes(const search *s, candidate *c, place_facing facing, int steps)
{
    place_gap *gap = NEW_ARRAY(place_gap, s->count);
    plane_pair *pair = NEW_ARRAY(plane_pair, s->count);
    double moved = HUGE_VAL, before = HUGE_VAL;
    for (int step = 0, stuck = 0;; step++) {
        int32_t n = 0;
        c->score = place_pair_up(s->b, s->level, s->sample, s->count, &c->way, facing, gap);
        for (int32_t i = 0; i < s->count; i++)
            if (gap[i].pair.weight > 0) pair[n++] = gap[i].pair;
        stuck += c->score > gain * before;
        before = c->score;
        if (step == steps || stuck > 2 || !(moved > still_mm) || c->way.scale < least_scale ||
            c->way.scale > most_scale)
            break;
        moved = similarity_plane_step(pair, n, true, &c->way);
    }
    free(gap);
    free(pair);
}

static void coarse(int64_t begin, int64_t end, void *context)
{
    const search *s = context;
    for (int64_t i = begin; i < end && !task_interrupted(s->watch); i++) walk_points(s, s->tried + i);
}

static void middle(int64_t begin, int64_t end, void *context)
{
    const search *s = context;
    for (int64_t i = begin; i < end && !task_interrupted(s->watch); i++)
        walk_planes(s, s->tried + i, FACING_ANY, MIDDLE_STEPS);
}

static int by_score(const void *a, const void *b)
{
    double x = ((const candidate *)a)->score, y = ((const candidate *)b)->score;
    return (x > y) - (x < y);
}

static void spread_of(const candidate *c, int count, const double middle_of_template[3], place_found *out)
{
    const double nearly = 1.05;
    double first[3], one[3];
    similarity_apply(&c->way, middle_of_template, first);
    for (int i = 1; i < count && c[i].score <= nearly * c->score; i++) {
        rigid back = rigid_inverse(&c->way.motion), turn = rigid_compose(&c[i].way.motion, &back);
        similarity_apply(&c[i].way, middle_of_template, one);
        out->turn_spread_deg = fmax(out->turn_spread_deg, rigid_angle(&turn) * 180 / M_PI);
        out->shift_spread_mm = fmax(out->shift_spread_mm, vec_distance(first, one));
    }
}

bool place_search(const place_bodies *b, const task *watch, place_found *out)
{
    double turn[PLACE_STARTS][9];
    candidate tried[PLACE_STARTS];
    place_sample *sample;
    search s = {.b = b, .level = PLACE_COARSE, .watch = watch, .tried = tried};
    int starts = icosahedral_turns(turn);
    s.count = place_samples(b, PLACE_COARSE, &sample);
    s.sample = sample;
    middle_of(&s, PLACE_TEMPLATE, s.from);
    middle_of(&s, PLACE_SCAN, s.to);
    for (int i = 0; i < starts; i++) {
        double at[3];
        tried[i] = (candidate){similarity_identity(), HUGE_VAL};
        memcpy(tried[i].way.motion.r, turn[i], sizeof turn[i]);
        rigid_rotate(&tried[i].way.motion, s.from, at);
        vec_sub(s.to, at, tried[i].way.motion.t);
    }
    task_progress(watch, "place of the head", -1);
    parallel_for(starts, 1, coarse, &s);
    free(sample);
    qsort(tried, (size_t)starts, sizeof *tried, by_score);
    s.level = PLACE_MIDDLE;
    s.count = place_samples(b, PLACE_MIDDLE, &sample);
    s.sample = sample;
    parallel_for(PLACE_TRIED, 1, middle, &s);
    free(sample);
    if (task_interrupted(watch)) return false;
    qsort(tried, PLACE_TRIED, sizeof *tried, by_score);
    *out = (place_found){.way = tried[0].way};
    spread_of(tried, PLACE_TRIED, s.from, out);
    place_refine(b, out);
    return true;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure(const search *s, place_found *found)
{
    place_gap *gap = NEW_ARRAY(place_gap, s->count);
    double *d = NEW_ARRAY(double, s->count);
    int32_t n = 0, of[PLACE_PARTS] = {0};
    found->score_mm = place_pair_up(s->b, s->level, s->sample, s->count, &found->way, FACING_ANY, gap);
    memset(found->alike, 0, sizeof found->alike);
    for (int32_t i = 0; i < s->count; i++) {
        if (s->sample[i].side != PLACE_SCAN) continue;
        d[n++] = gap[i].distance_mm;
        if (!(gap[i].pair.weight > 0)) continue;
        found->alike[s->sample[i].part] += gap[i].alike;
        of[s->sample[i].part]++;
    }
    qsort(d, (size_t)n, sizeof *d, by_size);
    found->median_mm = n ? d[n / 2] : HUGE_VAL;
    for (int i = 0; i < PLACE_PARTS; i++)
        if (of[i]) found->alike[i] /= of[i];
    free(gap);
    free(d);
}

void place_measure(const place_bodies *b, place_found *found)
{
    place_sample *sample;
    search s = {.b = b, .level = PLACE_FINE};
    s.count = place_samples(b, PLACE_FINE, &sample);
    s.sample = sample;
    measure(&s, found);
    free(sample);
}

void place_refine(const place_bodies *b, place_found *found)
{
    place_sample *sample;
    search s = {.b = b, .level = PLACE_FINE};
    candidate c = {found->way, 0};
    s.count = place_samples(b, PLACE_FINE, &sample);
    s.sample = sample;
    measure(&s, found);
    double alike = 0;
    for (int i = 0; i < PLACE_PARTS; i++) alike += found->alike[i];
    walk_planes(&s, &c, alike > 0 ? FACING_ALIKE : FACING_ANY, FINE_STEPS);
    found->way = c.way;
    measure(&s, found);
    free(sample);
}
