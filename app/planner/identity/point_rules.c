/* Definitions: Swennen, Schutyser and Hausamen, "Three-Dimensional Cephalometry", Springer 2006; how far each may leave
 * its carried place was chosen on norm heads and two scans with placed landmarks. */
#include "app/planner/identity/point_rules.h"
#include <string.h>

#define ROW(label_, both_, on_, dir, chord_, facing_, reach, pull_, ...)                                               \
    {                                                                                                                  \
        .label = label_, .both = both_, .on = on_, .direction = dir, .chord = chord_, .facing = facing_,               \
        .reach_mm = reach, .pull = TOWARDS pull_, __VA_ARGS__                                                          \
    }
#define TOWARDS(l, p, u)                                                                                               \
    {                                                                                                                  \
        l, p, u                                                                                                        \
    }
#define NO_CHORD                                                                                                       \
    {                                                                                                                  \
        NULL, NULL                                                                                                     \
    }
#define MIDDLE(label, on, dir, facing, reach, ...)                                                                     \
    ROW(label, false, on, TOWARDS dir, NO_CHORD, facing, reach, __VA_ARGS__)
#define SIDES(label, on, dir, facing, reach, ...)                                                                      \
    ROW(label, true, on, TOWARDS dir, NO_CHORD, facing, reach, __VA_ARGS__)
#define PAIR(a, b)                                                                                                     \
    {                                                                                                                  \
        a, b                                                                                                           \
    }
#define FOLD(label, on, upper, lower, reach, ...)                                                                      \
    ROW(label, false, on, TOWARDS(0, 1, 0), PAIR(upper, lower), -1, reach, __VA_ARGS__)

const point_rule point_rules[] = {
    SIDES("Or", CASE_SKULL, (0, -0.7, 0.7), 1, 5, (0.3, 0.15, 0.15)),
    MIDDLE("ANS", CASE_SKULL, (0, -1, 0), 1, 5, (1.5, 0.05, 0.2)),
    MIDDLE("PNS", CASE_SKULL, (0, 1, 0), 1, 6, (1.5, 0.05, 0.15)),
    MIDDLE("U1", CASE_UPPER_TEETH, (0, 0, -1), 1, 8, (1.5, 0.1, 0.03)),
    MIDDLE("L1", CASE_LOWER_TEETH, (0, 0, 1), 1, 8, (1.5, 0.1, 0.03)),
    SIDES("U3", CASE_UPPER_TEETH, (0, 0, -1), 1, 5, (0.15, 0.15, 0.03)),
    SIDES("L3", CASE_LOWER_TEETH, (0, 0, 1), 1, 5, (0.15, 0.15, 0.03)),
    SIDES("U6", CASE_UPPER_TEETH, (0.3, -0.3, -0.9), 1, 5, (0.15, 0.15, 0.05)),
    SIDES("L6", CASE_LOWER_TEETH, (0.3, -0.3, 0.9), 1, 6, (0.15, 0.2, 0.05), .doubt_mm = 1),
    MIDDLE("Me", CASE_MANDIBLE, (0, 0, -1), 1, 8, (1.5, 0.06, 0.02)),
    MIDDLE("Pog", CASE_MANDIBLE, (0, -1, 0), 1, 6, (1.5, 0.06, 0.15), .doubt_mm = 1.5, .turns = true),
    MIDDLE("Gn", CASE_MANDIBLE, (0, -0.7, -0.7), 1, 8, (1.5, 0.06, 0.06), .turns = true),
    MIDDLE("N", CASE_SKULL, (0, 0.95, -0.3), -1, 5, (1.5, 0.05, 0.12)),
    MIDDLE("A", CASE_SKULL, (0, 1, 0), -1, 4, (1.5, 0.08, 0.2), .anchor = "ANS"),
    FOLD("B", CASE_MANDIBLE, "L1", "Pog", 6, (1.5, 0.05, 0.08), .doubt_mm = 2.5),
    MIDDLE("Ba", CASE_SKULL, (0, 0.3, -0.95), 1, 8, (1.5, 0.06, 0.03), .doubt_mm = 2.5),
    SIDES("PR", CASE_SKULL, (-0.5, -0.85, 0), 1, 4, (0.25, 0.15, 0.5), .doubt_mm = 1.5),
    SIDES("PM", CASE_SKULL, (-1, 0, 0), -1, 5, (0.25, 0.25, 5), .anchor = "PR", .axes = 4, .offset = {0, 0, -1.5},
          .doubt_mm = 2.5),
    SIDES("ZB", CASE_SKULL, (1, 0, 0), 1, 6, (0.15, 0.3, 5), .anchor = "PR", .axes = 4, .offset = {0, 0, -3},
          .doubt_mm = 2.5),
    SIDES("Zy", CASE_SKULL, (1, 0, 0), 1, 8, (0.02, 0.03, 0.06)),
    SIDES("Co", CASE_MANDIBLE, (0, 0, 1), 1, 6, (0.08, 0.12, 0.03), .doubt_mm = 1),
    SIDES("Cor", CASE_MANDIBLE, (0, 0, 1), 1, 8, (0.1, 0.1, 0.02)),
    SIDES("SN", CASE_MANDIBLE, (0, 0, 1), 1, 6, (0.06, 1, 0.03), .saddle = true, .saddle_axis = 1),
    SIDES("Go", CASE_MANDIBLE, (0, 0.77, -0.64), 1, 8, (0.1, 0.06, 0.06), .doubt_mm = 1.5),
    SIDES("RP", CASE_MANDIBLE, (0, 1, 0), 1, 6, (0.1, 0.03, 0.5), .occlusal = true, .doubt_mm = 2),
    SIDES("RA", CASE_MANDIBLE, (0, -1, 0), 1, 6, (0.1, 0.03, 0.5), .occlusal = true, .doubt_mm = 2),
    SIDES("L7", CASE_LOWER_TEETH, (0.5, 0.6, 0.6), 1, 4, (0.3, 0.3, 0.3), .row_ends = true, .doubt_mm = 4),
    SIDES("Li", CASE_MANDIBLE, (0, 0, 0), 0, 8, (1, 1, 1), .anchor = "RP", .doubt_mm = 2.5),
    MIDDLE("G'", CASE_SKIN, (0, -1, 0), 1, 8, (1.5, 0.04, 0.15), .doubt_mm = 1.5),
    MIDDLE("Pn", CASE_SKIN, (0, -1, 0), 1, 8, (0.15, 0.02, 0.05)),
    MIDDLE("Ls", CASE_SKIN, (0, -1, 0), 1, 6, (1.5, 0.02, 0.06)),
    MIDDLE("Stms", CASE_SKIN, (0, 0, -1), 1, 8, (1.5, 0.1, 0.03), .anchor = "Ls", .axes = 6, .offset = {0, 5, -7}),
    MIDDLE("Li_soft", CASE_SKIN, (0, -1, 0), 1, 6, (1.5, 0.04, 0.12), .below = "Stms"),
    MIDDLE("Pg'", CASE_SKIN, (0, -1, 0), 1, 7, (1.5, 0.02, 5), .anchor = "Pog", .axes = 4, .offset = {0, 0, -0.5},
           .doubt_mm = 1.5),
    MIDDLE("Gn'", CASE_SKIN, (0, -0.7, -0.7), 1, 8, (1.5, 0.06, 0.06)),
    MIDDLE("Me'", CASE_SKIN, (0, 0, -1), 1, 8, (1.5, 0.06, 0.02)),
    FOLD("N'", CASE_SKIN, "G'", "Pn", 7, (1.5, 0.05, 0.25), .anchor = "N", .axes = 4, .offset = {0, 0, 1.5},
         .doubt_mm = 2),
    FOLD("Sn", CASE_SKIN, "Pn", "Ls", 5, (1.5, 0.2, 0.2)),
    FOLD("A'", CASE_SKIN, "Sn", "Ls", 5, (1.5, 0.1, 0.2)),
    MIDDLE("Stmi", CASE_SKIN, (0, 0, 1), 1, 8, (1.5, 0.1, 0.03), .anchor = "Li_soft", .axes = 6, .offset = {0, 2, 7}),
    FOLD("Stm", CASE_SKIN, "Ls", "Li_soft", 5, (1.5, 0.15, 0.06)),
    FOLD("B'", CASE_SKIN, "Li_soft", "Pg'", 5, (1.5, 0.05, 0.1)),
    MIDDLE("C", CASE_SKIN, (0, 0.7, 0.7), -1, 6, (1.5, 0.15, 0.15), .doubt_mm = 5),
    SIDES("Al", CASE_SKIN, (0.9, -0.4, 0), 1, 4, (0.4, 0.4, 0.4)),
    SIDES("Zy'", CASE_SKIN, (1, 0, 0), 1, 10, (0.01, 5, 5), .anchor = "Zy", .axes = 6, .offset = {0, 0, 0.3}),
    SIDES("Go'", CASE_SKIN, (1, 0, 0), 1, 14, (0.01, 5, 5), .anchor = "Go", .axes = 7, .offset = {8, 2, -3.5}),
};
const int point_rule_count = sizeof point_rules / sizeof point_rules[0];

const point_rule *point_rule_find(const char *label, int *side)
{
    for (int i = 0; i < point_rule_count; i++) {
        const point_rule *r = point_rules + i;
        size_t n = strlen(r->label);
        *side = 0;
        if (!r->both && !strcmp(label, r->label)) return r;
        if (!r->both || strncmp(label, r->label, n) || label[n] != '_' || label[n + 1] == 0 || label[n + 2]) continue;
        *side = label[n + 1] == 'L' ? 1 : -1;
        return r;
    }
    return NULL;
}
