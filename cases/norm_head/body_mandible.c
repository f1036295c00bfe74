#include "bodies.h"
#include "sdf.h"
#include "teeth.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

enum { BODY_0, BODY_1, BODY_2, BODY_3, OBLIQUE, CREST, CORONOID, MANDIBLE_TUBE_COUNT };
_Static_assert((int)MANDIBLE_TUBE_COUNT <= (int)MANDIBLE_TUBES, "room in bodies");

void body_mandible_tubes(tube *t)
{
    /* from the lower border to the alveolar crest, symphysis to angle; four layers */
    static const double lower[][4] = {{0, -75.3, -81, 5.6},  {8, -75, -81, 5.5},  {15, -71.5, -80, 5.2},
                                      {22, -64, -77.5, 5},   {29, -53, -73, 4.8}, {35, -41, -67.5, 4.6},
                                      {40, -28, -61.5, 4.2}, {43, -19, -57, 4}};
    static const double upper[][4] = {{0, -78.8, -60.5, 3.7},  {6, -78.3, -60.5, 3.7},  {11.5, -75.5, -60.3, 3.9},
                                      {15.5, -69.5, -59, 4.4}, {18.5, -60, -57.6, 5.2}, {21.5, -49, -56.6, 5.4},
                                      {26, -39, -55.6, 4.6},   {33, -30, -53, 3.6}};
    for (int k = 0; k < 4; k++) {
        double mix[COUNT(lower)][4];
        for (int i = 0; i < COUNT(lower); i++)
            for (int c = 0; c < 4; c++) mix[i][c] = sdf_mix(lower[i][c], upper[i][c], k / 3.0);
        t[BODY_0 + k] = tube_round((const double(*)[4])mix, COUNT(lower));
    }
    static const double oblique[][4] = {
        {41.5, -40.5, -34, 2.8}, {39.8, -42.5, -46, 3.2}, {36, -47, -56, 3.4}, {31, -55, -64, 3}, {26, -63, -70, 2.4}};
    t[OBLIQUE] = tube_round(oblique, COUNT(oblique));
    static const double crest[][4] = {
        {22.5, -43, -55.5, 4}, {28, -38.5, -51, 3}, {36, -36, -42, 2.6}, {40.5, -37, -30, 2.2}};
    t[CREST] = tube_round(crest, COUNT(crest));
    static const double coronoid[][4] = {{43, -37, -30, 3}, {43.8, -39, -18, 2.5}, {44.3, -39.6, -9.5, 1.8}};
    t[CORONOID] = tube_flat(coronoid, COUNT(coronoid), (double[]){0, 1, 0}, 1.6);
}

static double ramus(const double p[3])
{
    static const double outline[][2] = {
        {-8, -10},    {-8, -18},  {-8.8, -28}, {-9.8, -38},  {-9.8, -47},  {-10.5, -53}, {-13.5, -57.5}, {-20, -61},
        {-30, -65.5}, {-40, -70}, {-44, -66},  {-44, -56},   {-41.5, -48}, {-40, -40},   {-39.5, -30},   {-40.8, -20},
        {-41, -11},   {-39, -11}, {-35, -13},  {-30.5, -17}, {-26, -19},   {-21, -18},   {-16.5, -14.5}, {-13, -10}};
    double flat = sdf_polygon(p[1], p[2], outline, COUNT(outline)) - 1.5;
    /* the plate: it leans out towards the condyle and runs outwards going back */
    double x = 43.2 + 0.085 * (p[2] + 57) + 0.07 * (p[1] + 25);
    x += 1.6 * sdf_step(-50, -60, p[2]) * sdf_step(-32, -14, p[1]); /* the angle flares */
    x -= 3.2 * sdf_step(-33, -46, p[1]) * sdf_step(-40, -58, p[2]);
    double half = 4.2 + 0.8 * sdf_step(-35, -55, p[2]) - 1.2 * sdf_step(-30, -16, p[2]);
    return sdf_meet(flat, fabs(p[0] - x) - half, 6.5);
}

double body_mandible(const bodies *b, const double point[3])
{
    const tube *t = b->mandible;
    double p[3] = {fabs(point[0]), point[1], point[2]};
    double d = HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        double layer = tube_distance(&t[BODY_0 + k], p);
        d = k == 0 ? layer : sdf_union(d, layer, 9);
    }
    d = sdf_union(d, ramus(p), 9);
    if (d > 40) return d - 20;
    d = tube_union(d, &t[OBLIQUE], p, 4);
    d = tube_union(d, &t[CREST], p, 4);
    d = tube_union(d, &t[CORONOID], p, 3);
    static const double condyle_at[3] = {49.5, -10.8, -3.2}, condyle[3] = {8.8, 4.3, 3.6};
    static const double neck_a[3] = {48.5, -10.6, -5}, neck_b[3] = {47.3, -11.5, -20};
    double joint = sdf_cone(p, neck_a, 3.4, neck_b, 3.6);
    joint = sdf_union(joint, sdf_ellipsoid_turned(p, condyle_at, condyle, 0, -0.25, 0), 3.5);
    d = sdf_union(d, joint, 4);
    d = sdf_union(d, sdf_ellipsoid(p, 0, -77.4, -79, 9, 6.0, 6.5), 5); /* chin */
    d = sdf_union(d, sdf_sphere(p, 11.5, -74.5, -81.5, 4.6), 6);
    for (int i = 0; i < TEETH_PER_SIDE; i++) {
        const tooth *q = &lower_teeth[i];
        if (fabs(p[0] - q->tip[0]) > 14 || fabs(p[1] - q->tip[1]) > 16) continue;
        double axis[3], neck[3], apex[3];
        vec_copy(q->axis, axis);
        vec_normalize(axis);
        vec_axpy(q->tip, q->crown_mm + 3.0, axis, neck);
        vec_axpy(neck, q->root_mm - 3, axis, apex);
        d = sdf_union(d, sdf_cone(p, neck, sdf_min(0.48 * q->depth_mm, 4.2), apex, 1.9), 3);
    }
    static const double lingula_a[3] = {39.8, -24, -35}, lingula_b[3] = {40.6, -23.5, -32.5};
    d = sdf_union(d, sdf_cone(p, lingula_a, 1.4, lingula_b, 0.9), 1.5);
    d = sdf_cut(d, sdf_ellipsoid(p, 40.2, -22.5, -35.5, 2, 2.2, 2.6), 1.2); /* mandibular foramen */
    d = sdf_cut(d, sdf_ellipsoid(p, 25.8, -68.5, -67.8, 3, 1.9, 1.6), 1.2); /* mental foramen */
    return d;
}
