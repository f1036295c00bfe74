#include "app/planner/patient/check.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/frame.h"
#include "geometry/incisor.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include <stdlib.h>
#include <string.h>

/* Of the labels in `words` all are there, or all of one alternative. */
static bool all_there(const landmarks *l, const char *words)
{
    char copy[128];
    bool there = true;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *save, *w = strtok_r(copy, " ", &save); w; w = strtok_r(NULL, " ", &save)) {
        if (!strcmp(w, "or")) {
            if (there) return true;
            there = true;
        } else if (!landmarks_find(l, w))
            there = false;
    }
    return there;
}

/* Teeth that are missing, where others or the crest tell their places. */
static void check_missing_teeth(const case_file *c, const landmarks *l, issue_list *issues)
{
    for (int upper = 1; upper >= 0; upper--) {
        incisor edge;
        if (incisor_find(l, upper, &edge) && edge.stands_in)
            issue_add(issues, ISSUE_WARNING, ERR_INPUT, c->landmarks, 0, upper ? "U1" : "L1",
                      "is missing: its place is estimated from %s; no root is looked for there, and overjet, "
                      "overbite%s and the dental midline are not judged",
                      edge.by, upper ? ", incisor show, the bite's inclination" : "");
    }
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark_row *r = &landmark_rows[i];
        molar m;
        bool first = !strncmp(r->label, "U6_", 3) || !strncmp(r->label, "L6_", 3);
        if (!first || !landmark_is_needed(r, c) || landmarks_find(l, r->label)) continue;
        if (molar_find(l, r->label[0] == 'U', r->label[3] == 'L' ? 1 : -1, &m))
            issue_add(issues, ISSUE_WARNING, ERR_INPUT, c->landmarks, 0, r->label,
                      "is missing (%s): its place is estimated from %s; no root is looked for there", r->help, m.by);
    }
}

static bool is_missing(const landmark_row *r, const landmarks *l)
{
    return !landmarks_find(l, r->label) && !(r->instead && all_there(l, r->instead));
}

static void check_set(const case_file *c, const landmarks *l, issue_list *issues)
{
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark_row *r = &landmark_rows[i], *next = r + 1;
        char both[2 * LANDMARK_LABEL_SIZE];
        if (!is_missing(r, l)) continue;
        snprintf(both, sizeof both, "%s", r->label);
        if (i + 1 < landmark_row_count && !strcmp(next->help, r->help) && is_missing(next, l)) {
            snprintf(both, sizeof both, "%s, %s", r->label, next->label); /* left and right in one line */
            i++;
        }
        const char *are = strchr(both, ',') ? "are" : "is";
        if (landmark_is_needed(r, c) && r->instead && strstr(both, r->instead))
            issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, both, "are missing, one of them is needed (%s)",
                      r->help);
        else if (landmark_is_needed(r, c))
            issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, both, "%s missing (%s)%s%s%s", are, r->help,
                      r->instead ? "; " : "", r->instead ? r->instead : "", r->instead ? " would do as well" : "");
        else if (r->lost && !r->instead)
            issue_add(issues, ISSUE_INFO, ERR_NONE, c->landmarks, 0, both, "is missing (%s); lost: %s", r->help,
                      r->lost);
    }
    check_missing_teeth(c, l, issues);
    char unknown[600] = "";
    int count = 0;
    for (int32_t i = 0; i < l->count; i++) {
        if (landmark_row_find(l->point[i].label)) continue;
        size_t used = strlen(unknown);
        snprintf(unknown + used, sizeof unknown - used, "%s%s", count++ ? ", " : "", l->point[i].label);
    }
    if (count)
        issue_add(issues, ISSUE_INFO, ERR_NONE, c->landmarks, 0, NULL, "%d unknown labels are ignored: %s", count,
                  unknown);
}

/* The surface that should carry the landmark. Teeth that are not a file of their own are part of the bone. */
static case_surface carrier(const landmark_row *r, const check_found *found)
{
    if (r->on == CASE_UPPER_TEETH && !found->mesh[r->on].vertex_count) return CASE_SKULL;
    if (r->on == CASE_LOWER_TEETH && !found->mesh[r->on].vertex_count) return CASE_MANDIBLE;
    return r->on;
}

/* From a jaw or its teeth, whichever is nearer: crowns of a file of their own lie inside the bone on some scans. */
static double distance_to(const check_found *found, case_surface on, const double p[3])
{
    static const case_surface other[] = {[CASE_SKIN] = CASE_SKIN,
                                         [CASE_SKULL] = CASE_UPPER_TEETH,
                                         [CASE_MANDIBLE] = CASE_LOWER_TEETH,
                                         [CASE_UPPER_TEETH] = CASE_SKULL,
                                         [CASE_LOWER_TEETH] = CASE_MANDIBLE};
    double d = nearest_point(found->tree[on], p, NULL, NULL);
    return other[on] != on && found->tree[other[on]] ? fmin(d, nearest_point(found->tree[other[on]], p, NULL, NULL))
                                                     : d;
}

/* A landmark far from its surface is a slip of the hand; many of them mean that a piece of the surface is missing, or
 * that they belong to another patient, frame or unit. */
static void check_distance_to(const case_file *c, const check_found *found, case_surface on, issue_list *issues)
{
    enum { MANY = 6, MANY_WRONG = 3, LEFT_OUT_AFTER = 6 };
    const double doubtful_mm = 2, stop_mm = 10, wrong_mm = 50, many_share = 0.35;
    const char *word = case_surface_name(on);
    char list[200] = "";
    const landmark *off[2 * LANDMARK_LABEL_SIZE];
    double off_mm[2 * LANDMARK_LABEL_SIZE], farthest = 0;
    int all = 0, count = 0, wrong = 0;
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark *p = landmarks_find(&found->points, landmark_rows[i].label);
        if (!p || carrier(&landmark_rows[i], found) != on) continue;
        double d = distance_to(found, on, p->xyz);
        all++;
        if (!(d > doubtful_mm) || count == 2 * LANDMARK_LABEL_SIZE) continue;
        size_t used = strlen(list);
        if (count <= LEFT_OUT_AFTER)
            snprintf(list + used, sizeof list - used, "%s%s", count ? ", " : "",
                     count < LEFT_OUT_AFTER ? p->label : "...");
        farthest = fmax(farthest, d);
        wrong += d > wrong_mm;
        off[count] = p;
        off_mm[count++] = d;
    }
    if (count >= MANY_WRONG && wrong == count)
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, NULL,
                  "%d of %d landmarks lie more than %g mm from the %s; are both of one patient, in one frame "
                  "and in mm? (%s)",
                  wrong, all, wrong_mm, word, list);
    else if (count >= MANY && count > many_share * all)
        issue_add(issues, found->has_frame && farthest > stop_mm ? ISSUE_ERROR : ISSUE_WARNING, ERR_INPUT, c->landmarks,
                  0, NULL,
                  "%d of %d landmarks lie off the %s, by up to %.1f mm (%s): is a piece of it missing, or are they "
                  "another head's?",
                  count, all, word, farthest, list);
    else
        for (int i = 0; i < count; i++)
            issue_add(issues, off_mm[i] > wrong_mm ? ISSUE_ERROR : ISSUE_WARNING, ERR_INPUT, c->landmarks, 0,
                      off[i]->label, "lies %.1f mm from the %s; it should lie on it", off_mm[i], word);
}

static void check_sides(const case_file *c, const landmarks *l, issue_list *issues)
{
    int pairs = 0, swapped = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t i = 0; i < l->count; i++) {
            char other[LANDMARK_LABEL_SIZE];
            const landmark *left = &l->point[i];
            size_t n = strlen(left->label);
            if (n < 3 || strcmp(left->label + n - 2, "_L")) continue;
            strcpy(other, left->label);
            other[n - 1] = 'R';
            const landmark *right = landmarks_find(l, other);
            if (!right) continue;
            bool wrong = left->xyz[0] < right->xyz[0];
            pairs += pass == 0;
            swapped += pass == 0 && wrong;
            if (pass && wrong && swapped < pairs) /* all of them: the head is turned, the frame's own message says so */
                issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->landmarks, 0, left->label,
                          "lies to the right of %s (x = %.1f and %.1f mm, +x is the patient's left); are the "
                          "two labels swapped?",
                          other, left->xyz[0], right->xyz[0]);
        }
    }
}

static void check_frame(const case_file *c, check_found *found, issue_list *issues)
{
    const double uneven_mm = 2; /* of four points measured on a head: 1 to 2 mm */
    const landmarks *l = &found->points;
    head_frame f;
    err e = {0};
    bool points = landmarks_find(l, "Po_L") && landmarks_find(l, "Po_R") &&
                  (landmarks_find(l, "Or_L") || landmarks_find(l, "Or_R"));
    if (!points) return; /* already named as missing */
    found->has_frame = head_frame_from_landmarks(l, &f, &e);
    if (!found->has_frame) {
        issue_add(issues, ISSUE_ERROR, e.code, c->landmarks, 0, NULL, "%s", e.text);
        return;
    }
    found->frame_residual_mm = f.residual_mm;
    if (f.residual_mm > uneven_mm)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, NULL,
                  "porions and orbitales lie up to %.1f mm off one plane; is one of them misplaced?", f.residual_mm);
}

void check_landmarks(const case_file *c, check_found *found, issue_list *issues)
{
    err e = {0};
    int32_t skipped = 0;
    if (!*c->landmarks) return;
    if (!landmarks_read(c->landmarks, &found->points, &skipped, &e)) {
        issue_add_err(issues, ISSUE_ERROR, &e, c->landmarks);
        return;
    }
    if (skipped)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, NULL,
                  "%d points are not placed (positionStatus is not \"defined\") and are ignored", skipped);
    char automatic[600];
    int32_t count = landmarks_automatic(&found->points, automatic, sizeof automatic);
    if (count)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, NULL,
                  "%d of %d landmarks were placed by gnathos and not by hand: look at them (%s)", count,
                  found->points.count, automatic);
    check_set(c, &found->points, issues);
    check_frame(c, found, issues);
    check_sides(c, &found->points, issues);
    check_order(c, found, issues);
    check_place(c, found, issues);
    if (!found->misplaced[CASE_SKULL] && !found->misplaced[CASE_MANDIBLE]) check_jaws(c, found, issues);
    check_usual(c, found, issues);
    check_depth(c, found, issues);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (found->tree[i] && !found->wrong_size[i] && !found->misplaced[i])
            check_distance_to(c, found, (case_surface)i, issues);
}
