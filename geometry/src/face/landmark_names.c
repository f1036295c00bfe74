#include "geometry/landmark_names.h"
#include "geometry/vec.h"
#include <string.h>

const landmark_alias landmark_aliases[] = {
    {"Po_L", "LPo"},     {"Po_R", "RPo"},     {"Or_L", "LOr"},          {"Or_R", "ROr"},         {"Co_L", "LCo"},
    {"Co_R", "RCo"},     {"Go_L", "LGo"},     {"Go_R", "RGo"},          {"MF_L", "LMeF"},        {"MF_R", "RMeF"},
    {"SN_L", "LSig"},    {"SN_R", "RSig"},    {"U6_L", "UL6MB"},        {"U6_R", "UR6MB"},       {"L6_L", "LL6MB"},
    {"L6_R", "LR6MB"},   {"U3_L", "UL3O"},    {"U3_R", "UR3O"},         {"L3_L", "LL3O"},        {"L3_R", "LR3O"},
    {"U1", "UR1O UL1O"}, {"L1", "LR1O LL1O"}, {"U1_apex", "UR1R UL1R"}, {"L1_apex", "LR1R LL1R"}};
const int landmark_alias_count = sizeof landmark_aliases / sizeof *landmark_aliases;

static void remove_point(landmarks *l, const char *label)
{
    const landmark *p = landmarks_find(l, label);
    size_t at = (size_t)(p - l->point);
    memmove(l->point + at, l->point + at + 1, ((size_t)l->count - at - 1) * sizeof *l->point);
    l->count--;
}

void landmark_names_resolve(landmarks *l)
{
    for (int i = 0; i < landmark_alias_count; i++) {
        const landmark_alias *row = landmark_aliases + i;
        char first[LANDMARK_LABEL_SIZE] = "";
        const char *second = strchr(row->names, ' ');
        memcpy(first, row->names, second ? (size_t)(second - row->names) : strlen(row->names));
        const landmark *a = landmarks_find(l, first), *b = second ? landmarks_find(l, second + 1) : a;
        if (!a || !b || landmarks_find(l, row->label)) continue;
        double xyz[3];
        for (int c = 0; c < 3; c++) xyz[c] = a == b ? a->xyz[c] : (a->xyz[c] + b->xyz[c]) / 2;
        remove_point(l, first);
        if (second) remove_point(l, second + 1);
        landmarks_set(l, row->label, xyz);
    }
}
