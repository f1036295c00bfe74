#include "geometry/src/face/ceph_rules.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS_MAX = 6, TOKEN_SIZE = 64 };

typedef struct point { /* in the midsagittal plane; left counts in the transverse measures alone */
    double forward, up, left;
} point;

static point minus(point a, point b) { return (point){a.forward - b.forward, a.up - b.up, a.left - b.left}; }
static double dot(point a, point b) { return a.forward * b.forward + a.up * b.up; }
/* Positive where b is turned up from a, for a that looks forward. */
static double cross(point a, point b) { return a.forward * b.up - a.up * b.forward; }
static double degrees(double radians) { return radians * (180 / 3.14159265358979323846); }
static double angle(point a, point b) { return degrees(fabs(atan2(cross(a, b), dot(a, b)))); }

/* Midpoints: the name, and the suffixes of the landmarks that it is the mean of. */
static const struct {
    const char *name;
    const char *of[4];
} midpoint[] = {{"Go", {"Go_L", "Go_R"}},
                {"Co", {"Co_L", "Co_R"}},
                {"Ar", {"Ar_L", "Ar_R"}},
                {"U6", {"U6_L", "U6_R"}},
                {"L6", {"L6_L", "L6_R"}},
                {"Or", {"Or_L", "Or_R"}},
                {"Po", {"Po_L", "Po_R"}},
                {"occlusal_3", {"U3_L", "U3_R", "L3_L", "L3_R"}},
                {"occlusal_6", {"U6_L", "U6_R", "L6_L", "L6_R"}}};

bool ceph_point(const landmarks *l, const char *name, double xyz[3], const char **missing)
{
    const char *single[4] = {name};
    const char *const *of = single;
    if (!landmarks_find(l, name))
        for (size_t i = 0; i < sizeof midpoint / sizeof *midpoint; i++)
            if (!strcmp(midpoint[i].name, name)) of = midpoint[i].of;
    double mean[3] = {0};
    int n = 0;
    for (; n < 4 && of[n]; n++) {
        const landmark *p = landmarks_find(l, of[n]);
        *missing = of[n];
        if (!p) return false;
        vec_add(mean, p->xyz, mean);
    }
    vec_scale(mean, 1.0 / n, xyz);
    return true;
}

static bool find(const landmarks *l, const head_frame *f, const char *name, point *out, const char **missing)
{
    double xyz[3], local[3];
    if (!ceph_point(l, name, xyz, missing)) return false;
    head_frame_to_local(f, xyz, local);
    *out = (point){-local[1], local[2], local[0]};
    return true;
}

/* Splits "Ar|Co Go" and finds the points; false with a note where one is missing. */
static bool gather(const landmarks *l, const head_frame *f, const char *names, point p[POINTS_MAX], char *note)
{
    char text[TOKEN_SIZE], *rest = text;
    assert(strlen(names) < sizeof text);
    strcpy(text, names);
    for (char *token; (token = strsep(&rest, " ")); p++) {
        const char *missing = NULL, *other_missing = NULL;
        char *other = strchr(token, '|');
        if (other) *other++ = 0;
        if (find(l, f, token, p, &missing)) continue;
        if (other && find(l, f, other, p, &other_missing)) {
            /* lips that touch have one stomion: nothing is lost */
            if (strcmp(other, "Stm")) snprintf(note, CEPH_NOTE_SIZE, "%s stands for %s", other, token);
            continue;
        }
        if (other)
            snprintf(note, CEPH_NOTE_SIZE, "needs %s or %s", missing, other_missing);
        else
            snprintf(note, CEPH_NOTE_SIZE, "needs %s", missing);
        return false;
    }
    return true;
}

static double combine(ceph_rule rule, const point p[POINTS_MAX])
{
    const point forward = {.forward = 1}, back = {.forward = -1};
    /* S-N turned 7 degrees down in front (Burstone et al. 1978) */
    double c = cos(7 / degrees(1)), s = sin(7 / degrees(1));
    point sn = minus(p[1], p[0]), hp = {c * sn.forward + s * sn.up, c * sn.up - s * sn.forward, 0}, d;
    double hp_length = sqrt(dot(hp, hp));
    switch (rule) {
    case ANGLE: return angle(minus(p[0], p[1]), minus(p[2], p[1]));
    case CONVEXITY:
        d = minus(p[1], p[0]);
        return degrees(atan2(cross(minus(p[2], p[1]), d), dot(minus(p[2], p[1]), d)));
    case ANGLE_CHANGE: return combine(ANGLE, p) - combine(ANGLE, (point[POINTS_MAX]){p[0], p[1], p[3]});
    case VECTORS: return angle(minus(p[1], p[0]), minus(p[3], p[2]));
    case TILT: d = minus(p[3], p[2]); return degrees(atan2(-cross(sn, d), dot(sn, d)));
    case TILT_FH: return degrees(atan2(-cross(forward, sn), dot(forward, sn)));
    case ANGLE_BACK_FH: return angle(back, sn);
    case DISTANCE: return sqrt(dot(sn, sn));
    case FORWARD: return sn.forward;
    case UP: return sn.up;
    case HP_ALONG: return dot(minus(p[3], p[2]), hp) / hp_length;
    case HP_DOWN: return -cross(hp, minus(p[3], p[2])) / hp_length;
    case IN_FRONT: d = minus(p[2], p[0]); return cross(sn, d) / sqrt(dot(sn, sn));
    case WITS: d = minus(p[0], p[1]); return dot(minus(p[2], p[3]), d) / sqrt(dot(d, d));
    case SHARE: return 100 * sn.up / (p[2].up - p[0].up);
    case WIDTH: return sqrt(dot(sn, sn) + sn.left * sn.left);
    case LEFT: return sn.left;
    case CANT: return degrees(atan2(sn.up, -sn.left));
    default: assert(!"a rule without a formula"); return (double)NAN;
    }
}

void ceph_evaluate(const landmarks *l, const head_frame *f, ceph_value out[CEPH_MEASURES_MAX])
{
    for (int i = 0; i < ceph_measure_count; i++) {
        point p[POINTS_MAX] = {{0}};
        out[i] = (ceph_value){.value = (double)NAN};
        if (gather(l, f, ceph_measures[i].points, p, out[i].note))
            out[i].value = combine((ceph_rule)ceph_measures[i].rule, p);
    }
}
