#include "app/planner/identity/point_carry.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>

static const double trusted_mm = 8;

void point_carry_by_anchor(const point_rule *r, int side, const landmarks *carried, const landmarks *now, double x[3])
{
    char label[LANDMARK_LABEL_SIZE];
    snprintf(label, sizeof label, "%s%s", r->anchor, side > 0 ? "_L" : side < 0 ? "_R" : "");
    const landmark *before = landmarks_find(carried, label), *after = landmarks_find(now, label);
    if (!before || !after) return;
    double moved[3];
    vec_copy(x, moved);
    for (int c = 0; c < 3; c++)
        if (r->axes >> c & 1)
            moved[c] = after->xyz[c] + r->offset[c] * (c == 0 && side < 0 ? -1 : 1);
        else if (!r->axes)
            moved[c] += after->xyz[c] - before->xyz[c];
    if (fabs(moved[2] - x[2]) < trusted_mm) vec_copy(moved, x); /* else the anchor itself is astray */
}

/* z = plane[0] + plane[1] x + plane[2] y, through the lower first molars and the incisors of an open mouth. False: it
 * is closed, and its plane of occlusion is where the ramus that was carried has it, or they are not there. */
static bool lower_row_plane(const landmarks *l, double plane[3])
{
    static const double open_mm = 3;
    const landmark *a = landmarks_find(l, "L1"), *b = landmarks_find(l, "L6_L"), *c = landmarks_find(l, "L6_R"),
                   *upper = landmarks_find(l, "U1");
    double u[3], w[3], n[3];
    if (!a || !b || !c || !upper || upper->xyz[2] - a->xyz[2] < open_mm) return false;
    vec_sub(b->xyz, a->xyz, u);
    vec_sub(c->xyz, a->xyz, w);
    vec_cross(u, w, n);
    if (fabs(n[2]) < 0.5 * vec_norm(n)) return false; /* a row that stands upright is none */
    plane[1] = -n[0] / n[2];
    plane[2] = -n[1] / n[2];
    plane[0] = a->xyz[2] - plane[1] * a->xyz[0] - plane[2] * a->xyz[1];
    return true;
}

void point_carry_to_occlusion(const landmarks *now, double x[3])
{
    double plane[3];
    if (!lower_row_plane(now, plane)) return;
    double z = plane[0] + plane[1] * x[0] + plane[2] * x[1];
    if (fabs(z - x[2]) < trusted_mm) x[2] = z;
}

void point_carry_to_ramus(const landmarks *now, int side, double x[3])
{
    static const double most = 2.5;
    const landmark *front = landmarks_find(now, "L1"), *left = landmarks_find(now, "L6_L"),
                   *right = landmarks_find(now, "L6_R"), *ramus = landmarks_find(now, side > 0 ? "RA_L" : "RA_R");
    if (!front || !left || !right || !ramus) return;
    const landmark *molar = side > 0 ? left : right;
    double middle = (left->xyz[0] + right->xyz[0]) / 2,
           share = (ramus->xyz[1] - front->xyz[1]) / (molar->xyz[1] - front->xyz[1]);
    if (!(molar->xyz[1] > front->xyz[1] && share > 1 && share < most)) return;
    x[0] = middle + (molar->xyz[0] - middle) * sqrt(share);
    x[1] = ramus->xyz[1];
}
