#include "app/planner/identity/point_refine.h"
#include "app/planner/identity/point_carry.h"
#include "app/planner/identity/point_seek.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/frame.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEGS = 6 };
static const double snap_mm = 8, shaken_mm = 2;

/* The surface that carries it: teeth that are no part of their own are part of their bone. */
static const surface *carrier(const surface part[CASE_SURFACE_COUNT], case_surface on)
{
    if (part[on].triangle_count || on < CASE_UPPER_TEETH) return &part[on];
    return &part[on == CASE_UPPER_TEETH ? CASE_SKULL : CASE_MANDIBLE];
}

static surface surface_in(const surface *s, const head_frame *f)
{
    surface out = surface_copy(s);
    for (int32_t v = 0; v < s->vertex_count; v++)
        head_frame_to_local(f, s->xyz + 3 * (size_t)v, out.xyz + 3 * (size_t)v);
    return out;
}

/* How much steeper than usual (25 degrees to the Frankfort plane) the mandible stands, radians: a chin that recedes, or
 * that an open mouth took down, is most prominent along its own jaw. */
static double steeper(const landmarks *l)
{
    const double usual = 25 * M_PI / 180;
    const landmark *chin = landmarks_find(l, "Me"), *left = landmarks_find(l, "Go_L"),
                   *right = landmarks_find(l, "Go_R");
    if (!chin || !left || !right) return 0;
    return atan2((left->xyz[2] + right->xyz[2]) / 2 - chin->xyz[2], (left->xyz[1] + right->xyz[1]) / 2 - chin->xyz[1]) -
           usual;
}

/* Of the points as far as they are known by now. Without a rule the nearest place on the surface is sought. False: a
 * chord of its rule is not there. */
static bool make_seek(const point_rule *r, int side, const landmarks *now, const double from[3], point_seek *out)
{
    if (!r) {
        *out = (point_seek){.reach_mm = snap_mm, .pull = {1, 1, 1}};
        vec_copy(from, out->from);
        return true;
    }
    *out = (point_seek){.reach_mm = r->reach_mm, .facing = r->facing};
    vec_copy(from, out->from);
    vec_copy(r->pull, out->pull);
    vec_copy(r->direction, out->direction);
    if (r->chord[0]) {
        const landmark *upper = landmarks_find(now, r->chord[0]), *lower = landmarks_find(now, r->chord[1]);
        if (!upper || !lower) return false;
        out->direction[0] = 0; /* posterior, across the chord in the sagittal plane */
        out->direction[1] = upper->xyz[2] - lower->xyz[2];
        out->direction[2] = lower->xyz[1] - upper->xyz[1];
    }
    if (r->turns) {
        double angle = steeper(now), y = out->direction[1], z = out->direction[2];
        out->direction[1] = y * cos(angle) - z * sin(angle);
        out->direction[2] = z * cos(angle) + y * sin(angle);
    }
    if (side < 0) out->direction[0] *= -1;
    vec_normalize(out->direction);
    return true;
}

/* What lies below the place of a label that was found. */
static surface part_below(const surface *s, const char *label, const landmarks *now)
{
    const landmark *top = landmarks_find(now, label);
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (size_t k = 0; k < (size_t)s->triangle_count; k++) {
        keep[k] = 1;
        for (int c = 0; top && c < 3; c++) keep[k] &= s->xyz[3 * (size_t)s->tri[3 * k + (size_t)c] + 2] <= top->xyz[2];
    }
    surface out = surface_select(s, keep);
    free(keep);
    return out;
}

static bool seek_as(const surface *near_by, const point_seek *s, const point_rule *r, double out[3])
{
    return r && r->saddle ? point_seek_saddle(near_by, s, r->saddle_axis, out) : point_seek_on(near_by, s, out);
}

/* rule NULL: none. */
static void refine_one(const surface *on, const point_rule *r, int side, const landmarks *now, point_place *p)
{
    point_seek s;
    double carried[3], sum = 0;
    int found = 0;
    vec_copy(p->at, carried);
    if (!on->triangle_count || !make_seek(r, side, now, carried, &s)) return;
    surface near_by = point_crop(on, carried, s.reach_mm + shaken_mm + (r && r->saddle ? 7 : 1));
    if (r && r->below) {
        surface low = part_below(&near_by, r->below, now);
        surface_free(&near_by);
        near_by = low;
    }
    p->found = seek_as(&near_by, &s, r, p->at);
    for (int leg = 0; p->found && leg < LEGS; leg++) {
        double x[3];
        vec_copy(carried, s.from);
        s.from[leg / 2] += leg % 2 ? -shaken_mm : shaken_mm;
        if (!seek_as(&near_by, &s, r, x)) continue;
        sum += vec_distance(x, p->at) * vec_distance(x, p->at);
        found++;
    }
    p->spread_mm = found ? sqrt(sum / found) : shaken_mm;
    surface_free(&near_by);
}

typedef enum body { SKIN_BODY, UPPER_BODY, LOWER_BODY, BODIES, NO_BODY = BODIES } body;

static body body_of(case_surface on)
{
    return on == CASE_SKIN                                 ? SKIN_BODY
           : on == CASE_SKULL || on == CASE_UPPER_TEETH    ? UPPER_BODY
           : on == CASE_MANDIBLE || on == CASE_LOWER_TEETH ? LOWER_BODY
                                                           : NO_BODY;
}

/* Where a label lies, and whether it is one of the middle. */
static case_surface surface_of(const char *label, bool *middle)
{
    size_t n = strlen(label);
    *middle = n < 3 || label[n - 2] != '_' || (label[n - 1] != 'L' && label[n - 1] != 'R');
    const landmark_row *row = landmark_row_find(label);
    return row ? row->on : CASE_SURFACE_COUNT;
}

/* x = plane[0] + plane[1] y + plane[2] z, least squares of what should lie in the middle of a body: points of the
 * middle, and middles of pairs. */
static bool middle_plane(const landmarks *l, body which, double plane[3])
{
    double a[3][4] = {{0}};
    int count = 0;
    for (int32_t i = 0; i < l->count; i++) {
        bool middle;
        char other[LANDMARK_LABEL_SIZE];
        const landmark *p = l->point + i, *pair = p;
        if (body_of(surface_of(p->label, &middle)) != which) continue;
        if (!middle) {
            size_t n = strlen(strcpy(other, p->label));
            if (other[n - 1] == 'R') continue;
            other[n - 1] = 'R';
            pair = landmarks_find(l, other);
        }
        if (!pair) continue;
        const double row[4] = {1, (p->xyz[1] + pair->xyz[1]) / 2, (p->xyz[2] + pair->xyz[2]) / 2,
                               (p->xyz[0] + pair->xyz[0]) / 2};
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++) a[r][c] += row[r] * row[c];
        count++;
    }
    if (count < 6) return false;
    for (int k = 0; k < 3; k++) {
        if (!(a[k][k] > 1e-9)) return false;
        for (int r = 0; r < 3; r++) {
            double f = a[r][k] / a[k][k];
            for (int c = 0; c < 4 && r != k; c++) a[r][c] -= f * a[k][c];
        }
    }
    for (int k = 0; k < 3; k++) plane[k] = a[k][3] / a[k][k];
    return true;
}

/* What lies in the middle goes into its body's own plane, which knows it better than one point alone: the jaw of an
 * open mouth may stand to one side. */
static void into_middle(landmarks *local)
{
    landmarks carried = landmarks_copy(local);
    for (body k = SKIN_BODY; k < BODIES; k++) {
        double plane[3];
        if (!middle_plane(&carried, k, plane)) continue;
        for (int32_t i = 0; i < local->count; i++) {
            bool middle;
            double *x = local->point[i].xyz;
            if (body_of(surface_of(local->point[i].label, &middle)) == k && middle)
                x[0] = plane[0] + plane[1] * x[1] + plane[2] * x[2];
        }
    }
    landmarks_free(&carried);
}

/* The points with this row of the rules (NULL: with none), on all its sides; `now` gets what is found. */
static void refine_row(const surface part[CASE_SURFACE_COUNT], const point_rule *row, const landmarks *carried,
                       landmarks *now, point_place *out)
{
    for (int32_t i = 0; i < now->count; i++) {
        int side;
        bool middle;
        const point_rule *r = point_rule_find(now->point[i].label, &side);
        case_surface on = r ? r->on : surface_of(now->point[i].label, &middle);
        if (r != row || (on == CASE_SURFACE_COUNT && !r)) continue;
        vec_copy(now->point[i].xyz, out[i].at);
        if (r && r->occlusal) point_carry_to_occlusion(now, out[i].at);
        if (r && r->row_ends && carrier(part, on) != &part[on]) point_carry_to_ramus(now, side, out[i].at);
        if (r && r->anchor) point_carry_by_anchor(r, side, carried, now, out[i].at);
        out[i].by_rule = r;
        out[i].doubt_mm = r ? r->doubt_mm : 0;
        if (on != CASE_SURFACE_COUNT) refine_one(carrier(part, on), r, side, now, out + i);
        vec_copy(out[i].at, now->point[i].xyz);
    }
}

/* Rows [first, first + count) in the frame of the points as they are; a row past the last one: those without a rule. */
static bool refine_rows(const head_scan *s, int first, int count, landmarks *now, point_place *out, err *e)
{
    head_frame f;
    surface part[CASE_SURFACE_COUNT];
    if (!head_frame_from_landmarks(now, &f, e)) return false;
    landmarks local = landmarks_copy(now);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) part[i] = surface_in(&s->part[i], &f);
    for (int32_t i = 0; i < now->count; i++) head_frame_to_local(&f, now->point[i].xyz, local.point[i].xyz);
    if (!first) into_middle(&local);
    landmarks start = landmarks_copy(&local);
    for (int i = first; i < first + count; i++)
        refine_row(part, i < point_rule_count ? point_rules + i : NULL, &start, &local, out);
    for (int32_t i = 0; i < now->count; i++) head_frame_to_world(&f, local.point[i].xyz, now->point[i].xyz);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) surface_free(&part[i]);
    landmarks_free(&start);
    landmarks_free(&local);
    return true;
}

bool point_refine(const head_scan *s, const landmarks *carried, point_place *out, err *e)
{
    landmarks now = landmarks_copy(carried);
    for (int32_t i = 0; i < carried->count; i++) out[i] = (point_place){0};
    bool ok = refine_rows(s, 0, POINT_RULES_OF_FRAME, &now, out, e) &&
              refine_rows(s, POINT_RULES_OF_FRAME, point_rule_count - POINT_RULES_OF_FRAME + 1, &now, out, e);
    for (int32_t i = 0; i < carried->count; i++) {
        vec_copy(now.point[i].xyz, out[i].at);
        out[i].moved_mm = vec_distance(out[i].at, carried->point[i].xyz);
    }
    landmarks_free(&now);
    return ok;
}
