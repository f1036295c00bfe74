/* box_mandible: a mandible of boxes with the landmarks that its cuts need. */
#pragma once
#include "geometry/boolean.h"
#include "geometry/landmarks.h"
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include <stdio.h>

typedef struct model {
    surface mandible;
    landmarks points;
} model;

static inline void model_set(landmarks *l, const char *label, double x, double y, double z)
{
    landmarks_set(l, label, (double[3]){x, y, z});
}

/* Arch of boxes with two rami; not quite level, so that no two faces fall together. */
static inline model box_mandible(void)
{
    err e = {0};
    surface part[9] = {body_box(-32, -80, -15, 32, -66, 15),     body_box(21, -79.5, -14.5, 34, -15, 14.5),
                       body_box(24, -30, -14.8, 34.5, 10, 45),   body_box(-34, -79.5, -14.5, -21, -15, 14.5),
                       body_box(-34.5, -30, -14.8, -24, 10, 45), body_box(20, -6, 43, 38, 9, 55),
                       body_box(-38, -6, 43, -20, 9, 55),        body_box(25, -29, 44, 33, -20, 56),
                       body_box(-33, -29, 44, -25, -20, 56)};
    model m = {0};
    bool ok = boolean_unite(part, 9, &m.mandible, &e);
    assert_true(ok);
    for (int i = 0; i < 9; i++) surface_free(&part[i]);
    model_set(&m.points, "L1", 0, -78, 15);
    model_set(&m.points, "L1_apex", 0, -74, 1);
    model_set(&m.points, "Me", 0, -74, -15);
    model_set(&m.points, "Pog", 0, -80, -9);
    model_set(&m.points, "B", 0, -80, 5);
    for (int side = -1; side <= 1; side += 2) {
        const struct {
            const char *base;
            double x, y, z;
        } p[] = {{"L3", 14, -78, 15},   {"L3_apex", 14, -74, 0}, {"L6", 28, -58, 14.5}, {"L7", 28, -41, 14.5},
                 {"Go", 30, 10, -14.8}, {"SN", 30, -13, 45},     {"RA", 30, -30, 16},   {"RP", 30, 10, 16},
                 {"Co", 29, 2, 55},     {"Cor", 29, -24, 56},    {"Li", 24, -8, 25},    {"MF", 34, -66, 0}};
        for (size_t k = 0; k < sizeof p / sizeof *p; k++) {
            char label[LANDMARK_LABEL_SIZE];
            snprintf(label, sizeof label, "%s_%c", p[k].base, side > 0 ? 'L' : 'R');
            model_set(&m.points, label, side * p[k].x, p[k].y, p[k].z);
        }
    }
    return m;
}

static inline void model_free(model *m)
{
    surface_free(&m->mandible);
    landmarks_free(&m->points);
}
