/* Landmarks against each other: what lies in front of, above or on the same jaw as what, on any head. */
#include "app/planner/patient/check.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/frame.h"
#include "geometry/vec.h"
#include <string.h>

typedef enum direction { IN_FRONT, ABOVE } direction;

/* The first lies in front of or above the second by more than -slack_mm, in the head's own axes. */
static const struct order_row {
    const char *first, *second;
    direction how;
    double slack_mm;
} order_rows[] = {
    {"N", "ANS", ABOVE, 0},
    {"ANS", "PNS", IN_FRONT, 0},
    {"A", "B", ABOVE, 0},
    {"A", "Pr", ABOVE, 0},
    {"Pr", "U1", ABOVE, 0},
    {"L1", "Id", ABOVE, 0},
    {"Id", "B", ABOVE, 0},
    {"Pr", "U6_crest_L", IN_FRONT, 0},
    {"Pr", "U6_crest_R", IN_FRONT, 0},
    {"Id", "L6_crest_L", IN_FRONT, 0},
    {"Id", "L6_crest_R", IN_FRONT, 0},
    {"ANS", "A", ABOVE, 3},
    {"A", "U1", ABOVE, 0},
    {"L1", "B", ABOVE, 0},
    {"B", "Me", ABOVE, 0},
    {"Pog", "Me", ABOVE, 0},
    {"B", "Pog", ABOVE, 0},
    {"U3_L", "U6_L", IN_FRONT, 0},
    {"U3_R", "U6_R", IN_FRONT, 0},
    {"L3_L", "L6_L", IN_FRONT, 0},
    {"L3_R", "L6_R", IN_FRONT, 0},
    {"L6_L", "L7_L", IN_FRONT, 0},
    {"L6_R", "L7_R", IN_FRONT, 0},
    {"RA_L", "RP_L", IN_FRONT, 0},
    {"RA_R", "RP_R", IN_FRONT, 0},
    {"Co_L", "Go_L", ABOVE, 0},
    {"Co_R", "Go_R", ABOVE, 0},
    {"SN_L", "Go_L", ABOVE, 0},
    {"SN_R", "Go_R", ABOVE, 0},
    {"Or_L", "ZB_L", ABOVE, 0},
    {"Or_R", "ZB_R", ABOVE, 0},
    {"PR_L", "PM_L", IN_FRONT, 0},
    {"PR_R", "PM_R", IN_FRONT, 0},
    {"U1_apex", "U1", ABOVE, 0},
    {"L1", "L1_apex", ABOVE, 0},
    {"G'", "N'", ABOVE, 0},
    {"N'", "Pn", ABOVE, 0},
    {"Pn", "Sn", IN_FRONT, 0},
    {"Sn", "Ls", ABOVE, 0},
    {"Ls", "Li_soft", ABOVE, 0},
    {"Li_soft", "B'", ABOVE, 0},
    {"B'", "Pg'", ABOVE, 0},
    {"Pg'", "Me'", ABOVE, 0},
    {"Stms", "Stmi", ABOVE, 0},
    {"Pn", "T_L", IN_FRONT, 0},
    {"Pn", "T_R", IN_FRONT, 0},
    {"U4_L", "U5_L", IN_FRONT, 0},
    {"U4_R", "U5_R", IN_FRONT, 0},
    {"U5_L", "U6_L", IN_FRONT, 0},
    {"U5_R", "U6_R", IN_FRONT, 0},
    {"U5_L", "U7_L", IN_FRONT, 0},
    {"U5_R", "U7_R", IN_FRONT, 0},
    {"U6_L", "U7_L", IN_FRONT, 0},
    {"U6_R", "U7_R", IN_FRONT, 0},
    {"L4_L", "L5_L", IN_FRONT, 0},
    {"L4_R", "L5_R", IN_FRONT, 0},
    {"L5_L", "L6_L", IN_FRONT, 0},
    {"L5_R", "L6_R", IN_FRONT, 0},
    {"L5_L", "L7_L", IN_FRONT, 0},
    {"L5_R", "L7_R", IN_FRONT, 0},
};

/* Two labels on one point: one of them was meant for another place. */
static void check_apart(const case_file *c, const landmarks *l, issue_list *issues)
{
    const double one_place_mm = 0.05;
    for (int i = 0; i < landmark_row_count; i++)
        for (int k = i + 1; k < landmark_row_count; k++) {
            const landmark *a = landmarks_find(l, landmark_rows[i].label);
            const landmark *b = landmarks_find(l, landmark_rows[k].label);
            if (a && b && vec_distance(a->xyz, b->xyz) < one_place_mm)
                issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, a->label,
                          "lies on %s; one of them belongs elsewhere", b->label);
        }
}

/* Molars of both sides: a lower arch that is much wider than the upper one, which a cross-bite of both sides is too. */
static void check_widths(const case_file *c, const landmarks *l, issue_list *issues)
{
    const double most_mm = 3; /* norm: the upper arch is 7 mm wider */
    const landmark *u[2] = {landmarks_find(l, "U6_L"), landmarks_find(l, "U6_R")};
    const landmark *d[2] = {landmarks_find(l, "L6_L"), landmarks_find(l, "L6_R")};
    if (!u[0] || !u[1] || !d[0] || !d[1]) return;
    double upper = vec_distance(u[0]->xyz, u[1]->xyz), lower = vec_distance(d[0]->xyz, d[1]->xyz);
    if (lower > upper + most_mm)
        issue_add(
            issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, "U6_L, U6_R",
            "are %.1f mm apart and L6_L, L6_R %.1f mm; the upper molars should be the wider ones: exchanged, or a "
            "cross-bite of both sides?",
            upper, lower);
}

void check_order(const case_file *c, const check_found *found, issue_list *issues)
{
    head_frame f;
    err e = {0};
    check_apart(c, &found->points, issues);
    check_widths(c, &found->points, issues);
    if (!found->has_frame || !head_frame_from_landmarks(&found->points, &f, &e)) return;
    for (size_t i = 0; i < sizeof order_rows / sizeof *order_rows; i++) {
        const struct order_row *r = &order_rows[i];
        const landmark *first = landmarks_find(&found->points, r->first),
                       *second = landmarks_find(&found->points, r->second);
        double a[3], b[3];
        if (!first || !second) continue;
        head_frame_to_local(&f, first->xyz, a);
        head_frame_to_local(&f, second->xyz, b);
        double by = r->how == ABOVE ? a[2] - b[2] : b[1] - a[1];
        if (by > -r->slack_mm) continue;
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, r->first,
                  "lies %.1f mm %s %s; are the two exchanged?", -by, r->how == ABOVE ? "below" : "behind", r->second);
    }
}

/* The jaw a landmark's surface belongs to: CASE_SKULL, CASE_MANDIBLE or neither (CASE_SURFACE_COUNT). */
static int jaw_of(const landmark_row *r)
{
    if (r->on == CASE_SKULL || r->on == CASE_UPPER_TEETH) return CASE_SKULL;
    if (r->on == CASE_MANDIBLE || r->on == CASE_LOWER_TEETH) return CASE_MANDIBLE;
    return CASE_SURFACE_COUNT;
}

/* A point of one jaw that lies on the other one: the edges of upper and lower incisors above all. */
void check_jaws(const case_file *c, const check_found *found, issue_list *issues)
{
    const double off_mm = 1, on_mm = 5, nearer = 2; /* times: a point between two jaws that touch is near to both */
    static const int own_teeth[] = {[CASE_SKULL] = CASE_UPPER_TEETH, [CASE_MANDIBLE] = CASE_LOWER_TEETH};
    nearest *const *tree = found->tree;
    for (int i = 0; i < landmark_row_count && tree[CASE_SKULL] && tree[CASE_MANDIBLE]; i++) {
        const landmark_row *r = &landmark_rows[i];
        const landmark *p = landmarks_find(&found->points, r->label);
        int own = jaw_of(r), other = own == CASE_SKULL ? CASE_MANDIBLE : CASE_SKULL;
        if (!p || own == CASE_SURFACE_COUNT) continue;
        double gap[2];
        for (int k = 0; k < 2; k++) {
            int jaw = k ? other : own;
            gap[k] = nearest_point(tree[jaw], p->xyz, NULL, NULL);
            if (tree[own_teeth[jaw]]) gap[k] = fmin(gap[k], nearest_point(tree[own_teeth[jaw]], p->xyz, NULL, NULL));
        }
        if (gap[0] > off_mm && gap[1] < on_mm && gap[0] > nearer * gap[1])
            issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, r->label,
                      "lies %.1f mm from the %s and %.1f mm from the %s, where it belongs (%s)", gap[1],
                      other == CASE_SKULL ? "upper jaw" : "lower jaw", gap[0],
                      own == CASE_SKULL ? "upper jaw" : "lower jaw", r->help);
    }
}
