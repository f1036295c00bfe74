/* The sagittal cut of a split: a smooth sheet inside the outer cortex. */
#include "geometry/src/cut/jaw_side.h"
#include <math.h>

enum { TERMS = SAGITTAL_TERMS };
static const double crown_mm = 1.5;       /* sagittal cut outside the molar landmarks */
static const double least_plate_mm = 1.5; /* least bone on either side of the sagittal cut */

static void terms(double y, double z, double t[TERMS])
{
    t[0] = 1;
    t[1] = y;
    t[2] = z;
    t[3] = y * y;
    t[4] = y * z;
}

/* Gauss with pivoting; false if singular. */
static bool solve(double a[TERMS][TERMS + 1])
{
    for (int c = 0; c < TERMS; c++) {
        int pivot = c;
        for (int r = c + 1; r < TERMS; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        if (!(fabs(a[pivot][c]) > 1e-9)) return false;
        for (int k = 0; k <= TERMS; k++) {
            double keep = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = keep;
        }
        for (int r = 0; r < TERMS; r++) {
            if (r == c) continue;
            double f = a[r][c] / a[c][c];
            for (int k = c; k <= TERMS; k++) a[r][k] -= f * a[c][k];
        }
    }
    return true;
}

/* The sagittal cut follows the outer cortex at the depth of the lateral plate. Above the external oblique
 * ridge (the outermost bone at this y) it stays just inside the ridge instead of following the alveolus
 * inwards. */
bool jaw_side_fit_sagittal(jaw_side *j, const osteotomy_params *p)
{
    double a[TERMS][TERMS + 1] = {{0}};
    int used = 0;
    for (int s = 0; s <= 24; s++) {
        double y = jaw_side_buccal_y(j, j->top) +
                   s / 24.0 * (jaw_side_lingual_y(j, j->top) - jaw_side_buccal_y(j, j->top)),
               ridge = -HUGE_VAL, low = jaw_side_border(j, y);
        for (int h = 0; h <= 24; h++) { /* upwards */
            double z = low + 1 + h / 24.0 * (j->top - low - 1), out, in, t[TERMS];
            if (y < jaw_side_buccal_y(j, z) - 2 || y > jaw_side_lingual_y(j, z) + 2 ||
                !jaw_side_cross(j, y, z, &out, &in))
                continue;
            bool above_ridge = out < ridge - 1;
            ridge = fmax(ridge, out);
            double depth = fmin(p->buccal_depth_mm, p->ramus_depth_share * (out - in));
            if (above_ridge) continue;
            terms(y, z, t);
            for (int r = 0; r < TERMS; r++) {
                for (int c = 0; c < TERMS; c++) a[r][c] += t[r] * t[c];
                a[r][TERMS] += t[r] * (out - depth);
            }
            used++;
        }
    }
    if (used < 4 * TERMS) return false;
    double scale = 1e-9 * a[0][0];
    for (int r = 0; r < TERMS; r++) a[r][r] += scale;
    if (!solve(a)) return false;
    for (int r = 0; r < TERMS; r++) j->fit[r] = a[r][TERMS] / a[r][r];
    return true;
}

/* How far the cut at x must move inwards to leave the plate, over the part of the sheet that hangs on a corner of it.
 * No farther than the plate's reach: where the sheet lies farther outside, it passes the alveolus and no plate is
 * meant.
 */
static double into_plate(const jaw_side *j, double x, double y, double z)
{
    static const double around_mm = 3;
    double most = HUGE_VAL, out, in;
    for (int a = -1; a <= 1; a++)
        for (int b = -1; b <= 1; b++)
            if (jaw_side_cross(j, y + a * around_mm, z + b * around_mm, &out, &in))
                most = fmin(most, out - fmin(j->plate.least_mm, (out - in) / 2));
    return fmax(fmin(x - most, 2 * j->plate.reach_mm - (x - most)), 0);
}

double jaw_side_sagittal_x(const jaw_side *j, const osteotomy_params *p, double y, double z)
{
    double t[TERMS], x = 0, out, in, canal[3];
    double low = jaw_side_border(j, y), inside_bone = fmax(z, low + 0.5);
    terms(y, inside_bone, t);
    for (int k = 0; k < TERMS; k++) x += t[k] * j->fit[k];
    for (int k = -3; k <= 3; k++) /* up to halfway to the next stations, because the sheet is straight between them */
        if (jaw_side_canal_at(j, y + k, canal) && fabs(z - canal[1]) < 6)
            x = fmax(x, canal[0] + canal[2] * p->canal_clearance_mm);
    if (j->plate.least_mm > 0) x -= into_plate(j, x, y, inside_bone);
    double u = fmin(fmax((y - j->l6[1]) / (j->l7[1] - j->l6[1]), 0),
                    1), /* beside the molars, fading behind and below */
        away = fmax(y - j->l7[1], 0) + fmax(j->l7[2] - 10 - z, 0);
    x = fmax(x, j->l6[0] + u * (j->l7[0] - j->l6[0]) + crown_mm - away / 2);
    if (jaw_side_cross(j, y, inside_bone, &out, &in) && out - in > 2 * least_plate_mm) x = fmax(x, in + least_plate_mm);
    return x;
}
