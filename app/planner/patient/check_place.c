/* A surface off which all of its landmarks lie in one and the same way: one line that says what would mend it, in place
 * of one for each landmark. What a fit can resolve: landmarks that lie on their surface to 0.3 mm, 50 mm about their
 * middle, tell 1 % of scale, 1 mm of place and 1 degree; with 1 mm of care it is three times as much. */
#include "app/planner/patient/check.h"
#include "app/planner/patient/check_fit.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/vec.h"
#include <string.h>

enum { BODIES = 3, POINTS_LEAST = 6, POINTS_MOST = 64, AXES = 48 };
static const case_surface bone_of[BODIES] = {CASE_SKIN, CASE_SKULL, CASE_MANDIBLE},
                          teeth_of[BODIES] = {CASE_SKIN, CASE_UPPER_TEETH, CASE_LOWER_TEETH};

typedef enum place_how { AS_IT_IS, MOVED, SCALED, TURNED, MIRRORED, OTHER_AXES, OTHER_UNIT } place_how;

typedef struct place { /* of a surface against its landmarks */
    place_how how;
    int unit;
    double off_mm, left_mm; /* mean distance as it is, and after what would mend it */
    double shift[3], scale, turn_deg, axes[9];
} place;

typedef struct unit_row {
    const char *name;
    double mm;
} unit_row;
static const unit_row units[] = {{"metres", 1000}, {"centimetres", 10}, {"inches", 25.4}};

static const fit_way as_it_is = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0}};

static fit_body body(const check_found *f, int which)
{
    fit_body b = {0};
    for (int k = 0; k < 2; k++) {
        case_surface s = k ? teeth_of[which] : bone_of[which];
        if (!f->tree[s] || (k && s == bone_of[which])) continue;
        b.mesh[b.count] = &f->mesh[s];
        b.tree[b.count++] = f->tree[s];
    }
    return b;
}

static int points_of(const check_found *f, int which, double out[3 * POINTS_MOST])
{
    int count = 0;
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark *p = landmarks_find(&f->points, landmark_rows[i].label);
        case_surface on = landmark_rows[i].on;
        if (p && count < POINTS_MOST && (on == bone_of[which] || on == teeth_of[which]))
            vec_copy(p->xyz, out + 3 * (size_t)count++);
    }
    return count;
}

/* Axis i of the file is axis order[i] of the head, with a sign. */
static void make_axes(int number, double m[9])
{
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < 9; i++) m[i] = 0;
    for (int i = 0; i < 3; i++) m[3 * i + order[number / 8][i]] = number >> i & 1 ? -1 : 1;
}

static bool mirrors(const double m[9]) { return vec_six_volume((const double[3]){0}, m, m + 3, m + 6) < 0; }

/* Takes what explains more, weighed: the more a thing may change, the more it must explain. */
static void take(place *best, double *score, double weight, const place *one)
{
    const double floor_mm = 0.05;
    double s = weight * (one->left_mm + floor_mm);
    if (s >= *score) return;
    *score = s;
    *best = *one;
}

static void try_axes(const fit_body *b, const double *p, int n, place one, place *best, double *score)
{
    double least = HUGE_VAL;
    fit_way at = as_it_is;
    one.how = OTHER_AXES;
    for (int i = 1; i < AXES; i++) {
        fit_way way = as_it_is;
        make_axes(i, way.m);
        double mean = fit_points(b, p, n, FIT_NOTHING, &way) * (mirrors(way.m) ? 2 : 1);
        if (mean >= least) continue;
        least = mean;
        at = way;
    }
    memcpy(one.axes, at.m, sizeof one.axes);
    one.left_mm = fit_points(b, p, n, FIT_SHIFT, &at);
    take(best, score, mirrors(one.axes) ? 2.4 : 1.2, &one);
}

/* From several beginnings, so that walls which lie behind each other do not hold the fit back. *moved: the best shift,
 * from which the others set out too. */
static void try_fit(const fit_body *b, const double *p, int n, place_how how, place one, place *best, double *score,
                    fit_way *moved)
{
    static const fit_freedom freedom[] = {[MOVED] = FIT_SHIFT, [SCALED] = FIT_SCALE, [TURNED] = FIT_TURN};
    static const double weight[] = {[MOVED] = 1, [SCALED] = 1.25, [TURNED] = 1.5}, far_mm = 2, reach_mm[] = {8, 25};
    double middle[3] = {0}, least = HUGE_VAL;
    int tries = how == TURNED || one.off_mm < far_mm ? 1 : how == MOVED ? 13 : 5;
    for (int i = 0; i < n; i++) vec_axpy(middle, 1.0 / n, p + 3 * (size_t)i, middle);
    one.how = how;
    for (int i = 0; i < tries; i++) {
        static const double first_scale[] = {1, 0.96, 1.04, 0.9, 1.1};
        fit_way way = how == MOVED || i ? as_it_is : *moved;
        if (how == MOVED && i) way.t[(i - 1) % 3] = reach_mm[(i - 1) / 6];
        if (how == MOVED && (i - 1) / 3 % 2) vec_scale(way.t, -1, way.t);
        for (int c = 0; how == SCALED && i && c < 3; c++) {
            way.m[4 * c] = first_scale[i];
            way.t[c] = middle[c] * (1 - first_scale[i]);
        }
        one.left_mm = fit_points(b, p, n, freedom[how], &way);
        if (how == MOVED && one.left_mm < least) *moved = way;
        least = fmin(least, one.left_mm);
        vec_copy(way.t, one.shift);
        one.scale = cbrt(vec_six_volume((const double[3]){0}, way.m, way.m + 3, way.m + 6));
        one.turn_deg = acos(fmin(1, (way.m[0] + way.m[4] + way.m[8] - 1) / 2)) * 180 / M_PI;
        if (fabs(log(one.scale)) < 0.3) take(best, score, weight[how], &one); /* else collapsed upon one place */
    }
}

static bool tells(const place *p)
{
    const double least_gain = 0.5, left_most_mm = 1, least_mm = 1.5, least_scale = 0.01, least_deg = 1.5, most_deg = 45;
    if (p->left_mm > least_gain * p->off_mm || p->left_mm > left_most_mm) return false;
    if (p->how == MOVED) return vec_norm(p->shift) > least_mm;
    if (p->how == SCALED) return fabs(p->scale - 1) > least_scale;
    return p->how != TURNED || (p->turn_deg > least_deg && p->turn_deg < most_deg); /* beyond: a fit gone astray */
}

static place find_place(const fit_body *b, const double *p, int n, double middle_x)
{
    const double near_mm = 0.2, mirror_mm = 0.7, axes_mm = 3;
    fit_way way = as_it_is, moved = as_it_is;
    place none = {.how = AS_IT_IS, .off_mm = fit_points(b, p, n, FIT_NOTHING, &way)}, best = none, one = none;
    double score = HUGE_VAL;
    if (n < POINTS_LEAST || none.off_mm < near_mm) return none;
    for (place_how how = MOVED; how <= TURNED; how++) try_fit(b, p, n, how, none, &best, &score, &moved);
    if (none.off_mm > mirror_mm) {
        way = (fit_way){{-1, 0, 0, 0, 1, 0, 0, 0, 1}, {2 * middle_x}};
        one.how = MIRRORED;
        one.left_mm = fit_points(b, p, n, FIT_SHIFT, &way);
        take(&best, &score, 1.5, &one);
    }
    for (one = none; none.off_mm > axes_mm && one.unit < 3; one.unit++) {
        way = as_it_is;
        for (int c = 0; c < 3; c++) way.m[4 * c] = 1 / units[one.unit].mm;
        one.how = OTHER_UNIT;
        one.left_mm = fit_points(b, p, n, FIT_NOTHING, &way) * units[one.unit].mm;
        take(&best, &score, 1, &one);
    }
    if (none.off_mm > axes_mm) try_axes(b, p, n, none, &best, &score);
    return tells(&best) ? best : none;
}

static bool alike(const place *a, const place *b)
{
    const double mm = 1.5, share = 0.005, deg = 1.5;
    if (a->how != b->how || a->unit != b->unit) return false;
    if (a->how == MOVED) return vec_distance(a->shift, b->shift) < mm;
    if (a->how == SCALED) return fabs(a->scale - b->scale) < share;
    if (a->how == TURNED) return fabs(a->turn_deg - b->turn_deg) < deg;
    return a->how != OTHER_AXES || !memcmp(a->axes, b->axes, sizeof a->axes);
}

/* "(-x, -y, z)": what takes the surface back into the axes of the landmarks. */
static void write_axes(const double m[9], char out[24])
{
    size_t n = 0;
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++)
            if (m[3 * r + c] != 0)
                n += (size_t)snprintf(out + n, 24 - n, "%s%s%c", c ? ", " : "(", m[3 * r + c] < 0 ? "-" : "", 'x' + r);
    snprintf(out + n, 24 - n, ")");
}

static const char *axes_name(const double m[9])
{
    if (m[0] == -1 && m[4] == -1 && m[8] == 1) return "in RAS";
    if (m[0] == 1 && m[5] == 1 && m[7] == -1) return "y up";
    if (m[0] == 1 && m[4] == -1 && m[8] == -1) return "upside down";
    return mirrors(m) ? "mirrored" : "in other axes";
}

static void write_shift(const double t[3], char out[80])
{
    static const char *const word[3][2] = {{"to the right", "to the left"}, {"in front", "behind"}, {"below", "above"}};
    size_t n = 0;
    for (int c = 0; c < 3; c++)
        if (fabs(t[c]) >= 0.5 && fabs(t[c]) > 0.2 * vec_norm(t))
            n += (size_t)snprintf(out + n, 80 - n, "%s%.1f mm %s", n ? " and " : "", fabs(t[c]), word[c][t[c] > 0]);
}

/* What it says of the surfaces `who`, all of those that have landmarks or not. */
static void tell(const case_file *c, const place *p, const char *who, bool many, bool all, const char *file,
                 issue_list *issues)
{
    char how[240], axes[24], shift[80] = "";
    const char *is = many ? "are" : "is", *their = many ? "their" : "its", *were = many ? "were they" : "was it";
    bool far = true;
    switch (p->how) {
    case MOVED:
        write_shift(p->shift, shift);
        far = vec_norm(p->shift) >= 5;
        snprintf(how, sizeof how, "%s, all alike: %s", shift,
                 all    ? "were the landmarks placed on another scan?"
                 : many ? "were they moved?"
                        : "was it moved?");
        break;
    case SCALED:
        far = fabs(p->scale - 1) >= 0.05;
        snprintf(how, sizeof how, "and %s %.3f times as large as they say: scale by %.3f, or place them anew", is,
                 p->scale, 1 / p->scale);
        break;
    case TURNED:
        far = p->turn_deg >= 5;
        snprintf(how, sizeof how, "and %s turned by %.1f degrees against them: %s moved after they were placed?", is,
                 p->turn_deg, were);
        break;
    case MIRRORED:
        snprintf(how, sizeof how, "and %s mirrored, left for right: mirror %s back", is, many ? "them" : "it");
        break;
    case OTHER_AXES:
        write_axes(p->axes, axes);
        snprintf(how, sizeof how, "and %s %s: (x, y, z) -> %s would mend it%s", is, axes_name(p->axes), axes,
                 all && !strcmp(axes_name(p->axes), "in RAS") ? ", or \"frame\": \"RAS\" in the case" : "");
        break;
    default:
        snprintf(how, sizeof how, "and %s in %s: save in mm (times %g)", is, units[p->unit].name, units[p->unit].mm);
    }
    issue_add(issues, far ? ISSUE_ERROR : ISSUE_WARNING, ERR_INPUT, all ? c->landmarks : file, 0, NULL,
              "the %s %s off %s landmarks (%.1f mm on average; %.1f mm once mended) %s", who, many ? "lie" : "lies",
              their, p->off_mm, p->left_mm, how);
}

void check_place(const case_file *c, check_found *found, issue_list *issues)
{
    place of[BODIES] = {{0}};
    int there = 0;
    const landmark *left = landmarks_find(&found->points, "Po_L"), *right = landmarks_find(&found->points, "Po_R");
    if (!found->has_frame) return; /* the landmarks themselves are wrong */
    for (int i = 0; i < BODIES; i++) {
        double points[3 * POINTS_MOST];
        fit_body b = body(found, i);
        if (!b.count || found->wrong_size[bone_of[i]]) continue;
        int n = points_of(found, i, points);
        if (n < POINTS_LEAST) continue;
        there++;
        of[i] = find_place(&b, points, n, (left->xyz[0] + right->xyz[0]) / 2);
        found->misplaced[bone_of[i]] = found->misplaced[teeth_of[i]] = of[i].how != AS_IT_IS;
    }
    for (int i = 0; i < BODIES; i++) {
        char who[64] = "";
        int count = 0;
        if (of[i].how == AS_IT_IS) continue;
        place first = of[i];
        for (int k = i; k < BODIES; k++) {
            if (!alike(&first, &of[k])) continue;
            size_t n = strlen(who);
            snprintf(who + n, sizeof who - n, "%s%s", count++ ? ", " : "", case_surface_name(bone_of[k]));
            of[k].how = AS_IT_IS;
        }
        char *comma = strrchr(who, ',');
        if (comma) {
            char last[16];
            snprintf(last, sizeof last, "%s", comma + 2);
            snprintf(comma, sizeof who - (size_t)(comma - who), " and %s", last);
        }
        tell(c, &first, who, count > 1, count > 1 && count == there, c->surface[bone_of[i]], issues);
    }
}
