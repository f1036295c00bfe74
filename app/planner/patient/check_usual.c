/* Landmarks and bones against norms: a landmark that slid along its surface, bones that were scaled or moved with their
 * landmarks against the skin. What a norm resolves is told with it: people differ. */
#include "app/planner/patient/check.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/vec.h"
#include <string.h>

/* The mean of a man's and a woman's norm head of class I (gnathos new --norm --class 1), of a pair the left one: +x
 * left, +y posterior, +z up, about the middle of the porions, mm. */
static const struct usual {
    const char *label;
    double at[3];
} usual_place[] = {
    {"N", {0, -89.5, 28.6}},         {"Or_L", {30.3, -81, 0}},       {"Po_L", {59.5, 0, -0}},
    {"Ba", {0, -3.3, -21.3}},        {"ANS", {0, -91.3, -23.9}},     {"PNS", {0, -38.7, -22.9}},
    {"A", {0, -88.2, -29.1}},        {"PR_L", {12.2, -83.1, -19}},   {"ZB_L", {40.1, -69.3, -23.3}},
    {"PM_L", {25.2, -38, -18.6}},    {"IOF_L", {26.2, -78, -7.2}},   {"Zy_L", {66.3, -30.1, -0}},
    {"S", {0, -20.6, 19.3}},         {"U1", {0, -92.5, -51.9}},      {"U1_apex", {0, -82.5, -30.1}},
    {"U3_L", {16.7, -83.9, -51.5}},  {"U6_L", {26.1, -61.9, -46.4}}, {"Co_L", {50.1, -9.9, 1.1}},
    {"Cor_L", {45.3, -39.7, -7.1}},  {"SN_L", {46, -25, -18.7}},     {"Go_L", {47.7, -11.7, -57.5}},
    {"RP_L", {48.6, -8.2, -37.9}},   {"RA_L", {44.2, -44.1, -41.9}}, {"Li_L", {41.5, -23.8, -32.9}},
    {"B", {0, -84.4, -70.4}},        {"Pog", {0, -90.1, -77.7}},     {"Gn", {0, -87.5, -84.6}},
    {"Me", {0, -81.8, -87.1}},       {"MF_L", {26.5, -71.1, -69.4}}, {"L1", {0, -89.9, -48.8}},
    {"L1_apex", {0, -82.5, -69.5}},  {"L3_L", {13.2, -84.8, -49}},   {"L6_L", {22.1, -63.7, -46.1}},
    {"L7_L", {26.1, -46.7, -46.2}},  {"G'", {0, -98.3, 43.3}},       {"N'", {0, -95.9, 31.9}},
    {"Pn", {0, -116.1, -17.5}},      {"Sn", {0, -100.8, -29.9}},     {"Al_L", {17.8, -95, -19.9}},
    {"A'", {0, -98.5, -34.1}},       {"Ls", {0, -104.8, -46.6}},     {"Stm", {0, -101.3, -51}},
    {"Li_soft", {0, -103.3, -55.3}}, {"B'", {0, -96, -64.3}},        {"Pg'", {0, -101.7, -79}},
    {"Gn'", {0, -96.8, -89.6}},      {"Me'", {0, -81.2, -95.6}},     {"C", {0, -34.5, -90.4}},
    {"Ch_L", {25.4, -90.9, -51.4}},  {"En_L", {16.4, -84.9, 16.3}},  {"Ex_L", {46.2, -81.6, 16.2}},
    {"Zy'_L", {72.2, -30.7, 0.9}},   {"Go'_L", {61.5, -11.6, -62}},  {"T_L", {71.9, -3.1, 4.5}},
};
enum { USUAL = sizeof usual_place / sizeof *usual_place, KNOWN_MOST = 2 * USUAL };

typedef struct known { /* a landmark that is there, and its usual place */
    const landmark *point;
    double usual[3], weight, off_mm;
} known;

/* Cranium, mandible and skin each by itself: how the jaws and chin lie to each other differs most between people. */
static int group_of(const char *label)
{
    static const int group[] = {[CASE_SKULL] = 0,       [CASE_UPPER_TEETH] = 0,    [CASE_MANDIBLE] = 1,
                                [CASE_LOWER_TEETH] = 1, [CASE_SURFACE_COUNT] = -1, [CASE_SKIN] = 2};
    const landmark_row *row = landmark_row_find(label);
    return row ? group[row->on] : -1;
}

static int find_known(const landmarks *l, int group, known out[KNOWN_MOST])
{
    int count = 0;
    for (int i = 0; i < USUAL; i++)
        for (int side = 0; side < 2; side++) {
            char label[LANDMARK_LABEL_SIZE];
            size_t n = strlen(usual_place[i].label);
            bool pair = n > 2 && !strcmp(usual_place[i].label + n - 2, "_L");
            snprintf(label, sizeof label, "%s", usual_place[i].label);
            if ((side && !pair) || group_of(usual_place[i].label) != group) continue;
            if (side) label[n - 1] = 'R';
            const landmark *p = landmarks_find(l, label);
            if (!p) continue;
            out[count] = (known){.point = p, .weight = 1};
            vec_copy(usual_place[i].at, out[count].usual);
            if (side) out[count].usual[0] *= -1;
            count++;
        }
    return count;
}

/* The size and place, weighed, at which the usual head meets this one in the head's own axes; *scale: its size. */
static void fit_usual(const head_frame *f, known *k, int count, double *scale)
{
    double sum = 0, here[3] = {0}, there[3] = {0}, above = 0, below = 0, local[3], a[3], b[3];
    for (int i = 0; i < count; i++) {
        head_frame_to_local(f, k[i].point->xyz, local);
        vec_axpy(here, k[i].weight, local, here);
        vec_axpy(there, k[i].weight, k[i].usual, there);
        sum += k[i].weight;
    }
    for (int i = 0; i < count; i++) {
        head_frame_to_local(f, k[i].point->xyz, local);
        vec_axpy(local, -1 / sum, here, a);
        vec_axpy(k[i].usual, -1 / sum, there, b);
        above += k[i].weight * vec_dot(a, b);
        below += k[i].weight * vec_dot(b, b);
    }
    *scale = above / below;
    for (int i = 0; i < count; i++) {
        head_frame_to_local(f, k[i].point->xyz, local);
        vec_axpy(local, -1 / sum, here, a);
        vec_axpy(k[i].usual, -1 / sum, there, b);
        vec_axpy(a, -*scale, b, a);
        k[i].off_mm = vec_norm(a);
    }
}

/* Two real heads and seven made from norms, of all classes, stay within 8, 16 and 22 mm. */
void check_usual(const case_file *c, const check_found *found, issue_list *issues)
{
    enum { GROUPS = 3, LEAST = 8, ROUNDS = 10 };
    const double most_mm[GROUPS] = {14, 20, 26}, wide_mm = 5, small = 0.85, large = 1.15; /* of adults: 0.9 to 1.1 */
    head_frame f;
    err e = {0};
    if (!found->has_frame || !head_frame_from_landmarks(&found->points, &f, &e)) return;
    for (int group = 0; group < GROUPS; group++) {
        known k[KNOWN_MOST];
        double scale = 1;
        int count = find_known(&found->points, group, k);
        for (int round = 0; count >= LEAST && round < ROUNDS; round++) {
            fit_usual(&f, k, count, &scale);
            for (int i = 0; i < count; i++) k[i].weight = 1 / (1 + k[i].off_mm * k[i].off_mm / (wide_mm * wide_mm));
        }
        if (group == 0 && (scale < small || scale > large)) {
            issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, NULL,
                      "the landmarks are those of a head %.2f times as large as the mean adult's (%g to %g would be "
                      "right): is the scale right?",
                      scale, small, large);
            return;
        }
        int off = 0;
        for (int i = 0; i < count; i++) off += k[i].off_mm > most_mm[group];
        if (4 * off > count) continue; /* not a usual head at all: nothing to compare one landmark with */
        for (int i = 0; count >= LEAST && i < count; i++)
            if (k[i].off_mm > most_mm[group])
                issue_add(
                    issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, k[i].point->label,
                    "lies %.0f mm from where it is on a usual head of this size; within %g mm would be right: was "
                    "another place meant?",
                    k[i].off_mm, most_mm[group]);
    }
}

/* Depth of the bone's landmarks below the skin: means of adults (Stephan and Simpson 2008, update of 2018), mm. */
void check_depth(const case_file *c, const check_found *found, issue_list *issues)
{
    static const struct {
        const char *label;
        double mm;
    } depth[] = {{"N", 6.5}, {"A", 12}, {"B", 11}, {"Pog", 11}, {"Me", 7}, {"Gn", 8.5}, {"Or_L", 6.5}, {"Or_R", 6.5}};
    enum { LEAST = 5 };
    const double thin = 0.62, thick = 1.38;
    double is = 0, usual = 0;
    int count = 0;
    if (!found->tree[CASE_SKIN] || found->wrong_size[CASE_SKIN]) return;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (found->misplaced[i]) return; /* told already */
    for (size_t i = 0; i < sizeof depth / sizeof *depth; i++) {
        const landmark *p = landmarks_find(&found->points, depth[i].label);
        if (!p) continue;
        is += nearest_point(found->tree[CASE_SKIN], p->xyz, NULL, NULL);
        usual += depth[i].mm;
        count++;
    }
    if (count < LEAST || (is > thin * usual && is < thick * usual)) return;
    issue_add(
        issues, ISSUE_WARNING, ERR_NONE, c->surface[CASE_SKIN], 0, NULL,
        "the skin lies %.1f mm from the bones' landmarks at the front, on average; %.1f to %.1f mm would be right "
        "(norm %.1f): were bones and skin scaled or moved against each other? A scale of 1.05 or a move of 4 mm shows "
        "so; of 1.02 or 2 mm it cannot be told from people",
        is / count, thin * usual / count, thick * usual / count, usual / count);
}
