#include "geometry/cephalometry.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS_MAX = 6, TOKEN_SIZE = 64 };
/* p0, p1 ... are the points in the order of the table. */
enum {
    ANGLE,         /* at p1 between p0 and p2 */
    CONVEXITY,     /* 180 - angle at p1, positive where p1 lies in front of p0 p2 */
    ANGLE_CHANGE,  /* angle p0 p1 p2 less angle p0 p1 p3 */
    VECTORS,       /* between p0->p1 and p2->p3 */
    TILT,          /* of p2->p3 against p0->p1, positive: downward */
    TILT_FH,       /* of p0->p1 against Frankfort, positive: downward */
    ANGLE_BACK_FH, /* between Frankfort backward and p0->p1 */
    DISTANCE,      /* p0 p1 */
    FORWARD,       /* of p1 from p0, along Frankfort */
    UP,            /* of p1 from p0 */
    HP_ALONG,      /* of p3 from p2 along COGS' horizontal: p0->p1 = S->N turned 7 degrees down */
    HP_DOWN,       /* of p3 below p2, perpendicular to it */
    IN_FRONT,      /* of p2 in front of the line p0 p1 */
    WITS,          /* p2 in front of p3 along p1->p0 */
    SHARE          /* of the height p0 p2 that p0 p1 takes, % */
};

#define STEINER "Steiner 1953; WebCeph norms"
#define COGS_S "Burstone et al. 1978 (COGS)"
#define MCNAMARA_S "McNamara 1984"
#define ARNETT_S "Arnett et al. 1999"
#define PETERSON "Peterson's Principles of Oral and Maxillofacial Surgery 2022, ch. 60"
#define SOFTWARE "norms that cephalometric programs use"
#define NONE {(double)NAN, (double)NAN}, {(double)NAN, (double)NAN}, NULL

const ceph_measure ceph_measures[] = {
    {"SNA", "Steiner", "angle S-N-A", "deg", "S N A", {82, 2}, {82, 2}, STEINER, ANGLE},
    {"SNB", "Steiner", "angle S-N-B", "deg", "S N B", {80, 2}, {80, 2}, STEINER, ANGLE},
    {"ANB", "Steiner", "SNA - SNB", "deg", "S N A B", {2, 2}, {2, 2}, STEINER, ANGLE_CHANGE},
    {"SN-MP", "Steiner", "Go-Me against S-N", "deg", "S N Go Me", {33.5, 5}, {33.5, 5}, STEINER, TILT},
    {"U1-SN", "Steiner", "upper incisor's axis to N-S", "deg", "N S U1_apex U1", {103, 5}, {103, 5}, STEINER, VECTORS},
    {"IMPA", "Steiner", "lower incisor's axis to Me-Go", "deg", "Me Go L1_apex L1", {90, 5}, {90, 5}, STEINER, VECTORS},
    {"interincisal",
     "Steiner",
     "between the axes of the incisors",
     "deg",
     "U1 U1_apex L1 L1_apex",
     {132.5, 7.5},
     {132.5, 7.5},
     SOFTWARE ", 130 to 135, deviation 5 to 10",
     VECTORS},
    {"SN-PP", "Steiner", "PNS-ANS against S-N", "deg", "S N PNS ANS", {8, 3}, {8, 3}, SOFTWARE, TILT},
    {"FMA", "Frankfort", "Go-Me against Frankfort", "deg", "Go Me", {25, 5}, {25, 5}, PETERSON, TILT_FH},
    {"facial angle", "Frankfort", "N-Pog to Frankfort", "deg", "N Pog", {88, 2}, {88, 2}, PETERSON, ANGLE_BACK_FH},
    {"maxillary depth", "Frankfort", "N-A to Frankfort", "deg", "N A", {90, 2}, {90, 2}, PETERSON, ANGLE_BACK_FH},
    {"palatal plane", "Frankfort", "PNS-ANS against Frankfort", "deg", "PNS ANS", NONE, TILT_FH},
    {"PP-MP", "Frankfort", "Go-Me against PNS-ANS", "deg", "PNS ANS Go Me", {27, 5}, {27, 5}, SOFTWARE, TILT},
    {"OP-FH",
     "Frankfort",
     "occlusal plane of canines and first molars against Frankfort",
     "deg",
     "occlusal_6 occlusal_3",
     {8, 4},
     {8, 4},
     PETERSON,
     TILT_FH},
    {"U1-FH",
     "Frankfort",
     "upper incisor's axis to Frankfort",
     "deg",
     "U1_apex U1",
     {111, 6},
     {111, 6},
     "WebCeph norms",
     ANGLE_BACK_FH},
    {"N-A", "McNamara", "A in front of the perpendicular through N", "mm", "N A", NONE, FORWARD},
    {"N-Pog", "McNamara", "Pog in front of the perpendicular through N", "mm", "N Pog", NONE, FORWARD},
    {"Co-A", "McNamara", "effective midface", "mm", "Co A", {99.8, 6.0}, {91.0, 4.3}, MCNAMARA_S, DISTANCE},
    {"Co-Gn", "McNamara", "effective mandible", "mm", "Co Gn", {134.3, 6.8}, {120.2, 5.3}, MCNAMARA_S, DISTANCE},
    {"LAFH", "McNamara", "ANS-Me, lower face height", "mm", "ANS Me", {74.6, 5.0}, {66.7, 4.1}, MCNAMARA_S, DISTANCE},
    {"Wits",
     "Wits",
     "A in front of B along the occlusal plane of canines and first molars",
     "mm",
     "occlusal_3 occlusal_6 A B",
     {-1.17, 1.9},
     {-0.10, 1.8},
     "Jacobson 1975",
     WITS},
    {"N-ANS",
     "COGS",
     "perpendicular to the horizontal (S-N turned 7 deg)",
     "mm",
     "S N N ANS",
     {54.7, 3.2},
     {50.0, 2.4},
     COGS_S,
     HP_DOWN},
    {"ANS-Gn",
     "COGS",
     "perpendicular to the horizontal",
     "mm",
     "S N ANS Gn",
     {68.6, 3.8},
     {61.3, 3.3},
     COGS_S,
     HP_DOWN},
    {"PNS-N", "COGS", "perpendicular to the horizontal", "mm", "S N N PNS", {53.9, 1.7}, {50.6, 2.2}, COGS_S, HP_DOWN},
    {"ANS-PNS", "COGS", "along the horizontal", "mm", "S N PNS ANS", {57.7, 2.5}, {52.6, 3.5}, COGS_S, HP_ALONG},
    {"Ar-Go", "COGS", "length of the ramus", "mm", "Ar|Co Go", {52.0, 4.2}, {46.8, 2.5}, COGS_S, DISTANCE},
    {"Go-Pg", "COGS", "length of the mandible's body", "mm", "Go Pog", {83.7, 4.6}, {74.3, 5.8}, COGS_S, DISTANCE},
    {"gonial angle", "COGS", "angle Ar-Go-Gn", "deg", "Ar|Co Go Gn", {119.1, 6.5}, {122.0, 6.9}, COGS_S, ANGLE},
    {"N-A (HP)",
     "COGS",
     "A in front of N, along the horizontal",
     "mm",
     "S N N A",
     {0.0, 3.7},
     {-2.0, 3.7},
     COGS_S,
     HP_ALONG},
    {"N-B (HP)",
     "COGS",
     "B in front of N, along the horizontal",
     "mm",
     "S N N B",
     {-5.3, 6.7},
     {-6.9, 4.3},
     COGS_S,
     HP_ALONG},
    {"N-Pg (HP)",
     "COGS",
     "Pog in front of N, along the horizontal",
     "mm",
     "S N N Pog",
     {-4.3, 8.5},
     {-6.5, 5.1},
     COGS_S,
     HP_ALONG},
    {"B-Pg",
     "COGS",
     "Pog in front of B along Go-Gn: the chin",
     "mm",
     "Gn Go Pog B",
     {8.9, 1.7},
     {7.2, 1.9},
     COGS_S,
     WITS},
    {"U1-NF", "COGS", "U1 below ANS-PNS", "mm", "ANS PNS U1", {30.5, 2.1}, {27.5, 1.7}, COGS_S, IN_FRONT},
    {"U6-NF", "COGS", "U6 below ANS-PNS", "mm", "ANS PNS U6", {26.2, 2.0}, {23.0, 1.3}, COGS_S, IN_FRONT},
    {"L1-MP", "COGS", "L1 above Go-Gn", "mm", "Go Gn L1", {45.0, 2.1}, {40.8, 1.8}, COGS_S, IN_FRONT},
    {"L6-MP", "COGS", "L6 above Go-Gn", "mm", "Go Gn L6", {35.8, 2.6}, {32.1, 1.9}, COGS_S, IN_FRONT},
    {"overjet",
     "teeth",
     "U1 in front of L1, along Frankfort",
     "mm",
     "L1 U1",
     {3.2, 0.6},
     {3.2, 0.4},
     ARNETT_S,
     FORWARD},
    {"overbite", "teeth", "L1 above U1", "mm", "U1 L1", {3.2, 0.7}, {3.2, 0.7}, ARNETT_S, UP},
    {"nasolabial angle",
     "profile",
     "angle columella-Sn-Ls",
     "deg",
     "Cm|Pn Sn Ls",
     {107.7, 6.7},
     {105.0, 7.7},
     "Bergman, in the statistics of Cliniface",
     ANGLE},
    {"nasofrontal angle",
     "profile",
     "angle G'-N'-Pn",
     "deg",
     "G' N' Pn",
     {133.4, 10.5},
     {137.5, 9.5},
     "statistics of Cliniface",
     ANGLE},
    {"mentolabial angle", "profile", "angle Li_soft-B'-Pg'", "deg", "Li_soft B' Pg'", NONE, ANGLE},
    {"facial convexity",
     "profile",
     "180 - angle G'-Sn-Pg'",
     "deg",
     "G' Sn Pg'",
     {12.0, 3.5},
     {13.0, 3.8},
     "Bergman, in the statistics of Cliniface",
     CONVEXITY},
    {"total convexity",
     "profile",
     "angle G'-Pn-Pg'",
     "deg",
     "G' Pn Pg'",
     {142.6, 6.1},
     {142.6, 6.1},
     "statistics of Cliniface, men and women together",
     ANGLE},
    {"Ls to E-line",
     "profile",
     "Ls in front of Pn-Pg'",
     "mm",
     "Pn Pg' Ls",
     {-4, 2.5},
     {-4, 2.5},
     "WebCeph norms, deviation 2 to 3",
     IN_FRONT},
    {"Li to E-line",
     "profile",
     "Li_soft in front of Pn-Pg'",
     "mm",
     "Pn Pg' Li_soft",
     {-2, 2.5},
     {-2, 2.5},
     "WebCeph norms, deviation 2 to 3",
     IN_FRONT},
    {"upper lip length",
     "profile",
     "Sn to stomion, vertical",
     "mm",
     "Stms|Stm Sn",
     {24.4, 2.5},
     {21.0, 1.9},
     ARNETT_S,
     UP},
    {"lower lip length",
     "profile",
     "stomion to Me', vertical",
     "mm",
     "Me' Stmi|Stm",
     {54.3, 2.4},
     {46.9, 2.3},
     ARNETT_S,
     UP},
    {"interlabial gap", "profile", "Stms above Stmi", "mm", "Stmi Stms", {2.4, 1.1}, {3.3, 1.3}, ARNETT_S, UP},
    {"U1 show", "profile", "U1 below the upper lip", "mm", "U1 Stms|Stm", {3.9, 1.2}, {4.7, 1.6}, ARNETT_S, UP},
    {"chin thickness", "profile", "Pg' in front of Pog", "mm", "Pog Pg'", {13.5, 2.3}, {11.8, 1.5}, ARNETT_S, FORWARD},
    {"menton thickness", "profile", "Me' below Me", "mm", "Me' Me", {8.8, 1.3}, {7.4, 1.6}, ARNETT_S, UP},
    {"facial length", "proportions", "N'-Me', vertical", "mm", "Me' N'", {137.7, 6.5}, {124.6, 4.7}, ARNETT_S, UP},
    {"lower third", "proportions", "Sn-Me', vertical", "mm", "Me' Sn", {81.1, 4.7}, {71.1, 3.5}, ARNETT_S, UP},
    {"lower face share", "proportions", "of Sn-Me' in G'-Me', vertical; 48 to 54 is rated normal by orthodontists", "%",
     "Me' Sn G'", NONE, SHARE},
    {"upper lip share", "proportions", "of Sn-stomion in Sn-Me', vertical", "%", "Sn Stms|Stm Me'", NONE, SHARE},
    {"TVL Pn",
     "Arnett",
     "Pn in front of the true vertical through Sn",
     "mm",
     "Sn Pn",
     {17.4, 1.7},
     {16.0, 1.4},
     ARNETT_S,
     FORWARD},
    {"TVL Ls", "Arnett", "Ls in front of it", "mm", "Sn Ls", {3.3, 1.7}, {3.7, 1.2}, ARNETT_S, FORWARD},
    {"TVL Li", "Arnett", "Li_soft in front of it", "mm", "Sn Li_soft", {1.0, 2.2}, {1.9, 1.4}, ARNETT_S, FORWARD},
    {"TVL B'", "Arnett", "B' in front of it", "mm", "Sn B'", {-7.1, 1.6}, {-5.3, 1.5}, ARNETT_S, FORWARD},
    {"TVL Pg'", "Arnett", "Pg' in front of it", "mm", "Sn Pg'", {-3.5, 1.8}, {-2.6, 1.9}, ARNETT_S, FORWARD},
};
const int ceph_measure_count = sizeof ceph_measures / sizeof ceph_measures[0];
_Static_assert(sizeof ceph_measures / sizeof ceph_measures[0] <= CEPH_MEASURES_MAX,
               "more measures than the callers hold");

typedef struct point { /* in the midsagittal plane */
    double forward, up;
} point;

static point minus(point a, point b) { return (point){a.forward - b.forward, a.up - b.up}; }
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
    *out = (point){-local[1], local[2]};
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

static double combine(int rule, const point p[POINTS_MAX])
{
    const point forward = {1, 0}, back = {-1, 0};
    /* S-N turned 7 degrees down in front (Burstone et al. 1978) */
    double c = cos(7 / degrees(1)), s = sin(7 / degrees(1));
    point sn = minus(p[1], p[0]), hp = {c * sn.forward + s * sn.up, c * sn.up - s * sn.forward}, d;
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
    default: assert(!"a rule without a formula"); return (double)NAN;
    }
}

void ceph_evaluate(const landmarks *l, const head_frame *f, ceph_value out[CEPH_MEASURES_MAX])
{
    for (int i = 0; i < ceph_measure_count; i++) {
        point p[POINTS_MAX] = {{0, 0}};
        out[i] = (ceph_value){.value = (double)NAN};
        if (gather(l, f, ceph_measures[i].points, p, out[i].note)) out[i].value = combine(ceph_measures[i].rule, p);
    }
}
