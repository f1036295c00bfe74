#include "bodies.h"
#include "sdf.h"
#include <stdbool.h>
#include "teeth.h"

/* Braincase: the skin over it less the thickness of the scalp; at the temples less that of the temporal
 * muscle. */
static const double vault_points[][3] = {
    {0, -90.5, 38}, {0, -91, 50},    {0, -87.5, 70},  {0, -77, 89},  {0, -57, 103},   {0, -23, 112.5}, {0, 8, 113.5},
    {0, 40, 106},   {0, 66, 86},     {0, 82, 56},     {0, 85, 28},   {0, 76, 2},      {0, 58, -17},    {0, 34, -25},
    {0, 8, -20},    {0, -20, -5},    {0, -40, 8},     {0, -62, 20},  {0, -80, 26},    {28, -57, 93},   {40, -20, 99},
    {43, 15, 99},   {33, 50, 93},    {23, -81, 74},   {41, -67, 74}, {54.5, -37, 75}, {61, 0, 75},     {60.5, 30, 74},
    {46, 60, 72},   {19, -88.5, 51}, {37, -79.5, 51}, {49, -61, 52}, {57, -38, 52},   {65, -5, 52},    {67.5, 25, 50},
    {57, 56, 50},   {31, 77, 50},    {15, -87, 38},   {30, -84, 39}, {43, -74, 38},   {47.5, -62, 37}, {49, -50, 32},
    {55, -30, 32},  {62, -5, 34},    {66, 20, 32},    {58, 54, 28},  {34, 76, 27},    {20, -72, 30},   {36, -64, 30},
    {43, -46, 16},  {50, -28, 12},   {57, -5, 14},    {62, 18, 10},  {55, 48, 5},     {31, 68, 3},     {25, -38, 2},
    {40, -24, -1},  {50, -4, -2},    {54, 16, -9},    {44, 38, -15}, {24, 54, -17},   {22, 10, -19},   {25, -12, -8},
    {24, 34, -24}};

enum { /* tubes of the skull */
       BROW,
       GLABELLA,
       NASAL_SIDE,
       LATERAL_RIM,
       LOWER_RIM,
       ARCH,
       ARCH_ROOT,
       MAXILLA_FRONTAL,
       NASAL,
       ALVEOLUS,
       BUTTRESS,
       PTERYGOID,
       PTERYGOID_INNER,
       CLIVUS,
       SPINE,
       TEMPORAL_LINE,
       SKULL_TUBE_COUNT
};
_Static_assert((int)SKULL_TUBE_COUNT <= (int)SKULL_TUBES, "room in bodies");

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

radial body_skull_vault(void)
{
    static const double centre[3] = {0, 0, 38};
    return radial_through(centre, vault_points, COUNT(vault_points));
}

void body_skull_tubes(tube *t)
{
    static const double brow[][4] = {
        {7, -86, 30.5, 4.2}, {16, -85.5, 34, 4}, {28, -83, 36.5, 3.6}, {39, -77, 35.5, 3.4}, {46.5, -68.5, 30.5, 3.6}};
    t[BROW] = tube_round(brow, COUNT(brow));
    static const double glabella[][4] = {{0, -84, 40, 6}, {0, -82.5, 32, 6}, {0, -81.3, 26, 5.7}};
    t[GLABELLA] = tube_round(glabella, COUNT(glabella));
    static const double lateral_rim[][4] = {
        {47.3, -67, 31, 3.4}, {50.3, -64, 22, 3.1}, {50.3, -62, 13, 3.3}, {48.8, -64, 3, 4.5}, {46, -67, -5, 6}};
    t[LATERAL_RIM] = tube_flat(lateral_rim, COUNT(lateral_rim), (double[]){-0.35, 1, 0}, 1.5);
    static const double lower_rim[][4] = {{11, -78, 11, 2.6},     {15.5, -78.2, 4, 3.4}, {23, -77.8, -2.5, 4.4},
                                          {31, -76.0, -5.0, 5.0}, {39, -72.0, -5, 5.8},  {45, -67.5, -1, 5.2}};
    t[LOWER_RIM] = tube_round(lower_rim, COUNT(lower_rim));
    static const double arch[][4] = {{46, -66, -7, 6.0},   {52, -60, -6.5, 3.6}, {57.5, -49, -4, 2.5},
                                     {60, -35, -1.5, 2.2}, {60, -22, 0.5, 2.2},  {58.5, -11, 2.5, 2.6},
                                     {57, 0, 4, 2.6}};
    t[ARCH] = tube_flat(arch, COUNT(arch), (double[]){0, 0, 1}, 1.9);
    static const double arch_root[][4] = {{58, -20, 0.5, 3}, {51, -21, 0.5, 4}, {43, -20, 1, 4}};
    t[ARCH_ROOT] = tube_round(arch_root, COUNT(arch_root));
    static const double frontal[][4] = {{6.5, -81, 25, 4},      {8, -82.5, 15, 3.8},   {10.5, -83.0, 5, 4.2},
                                        {14.6, -81.0, -7, 4.2}, {16.5, -79, -18, 4.8}, {14, -78.5, -26, 5.4}};
    t[MAXILLA_FRONTAL] = tube_round(frontal, COUNT(frontal));
    static const double nasal[][4] = {{0, -83.2, 27, 4.2}, {0, -85, 20, 3.8}, {0, -89, 13, 3.6}, {0, -93.5, 7, 3.2}};
    t[NASAL] = tube_flat(nasal, COUNT(nasal), (double[]){1, 0, 0}, 1.75);
    static const double side[][4] = {{5.5, -85.5, 20, 2.4},
                                     {6.3, -88.3, 13, 2.2},
                                     {7.8, -90, 6, 2.0},
                                     {10.8, -87.5, -2, 2.2},
                                     {13.2, -84.5, -10, 2.4}};
    t[NASAL_SIDE] = tube_flat(side, COUNT(side), (double[]){0.35, 1, 0}, 1.6);
    static const double alveolus[][4] = {{0, -82.2, -34, 4.9},  {5, -81.8, -34, 4.9},     {11, -79.3, -34, 5.0},
                                         {16, -75, -34, 5.0},   {19, -69, -33.5, 5.1},    {21.5, -60, -33, 5.6},
                                         {23.5, -50, -32, 5.8}, {24.3, -42.5, -30.5, 5.2}};
    t[ALVEOLUS] = tube_flat(alveolus, COUNT(alveolus), (double[]){0, 0.06, 1}, 1.95);
    static const double buttress[][4] = {
        {44, -64.5, -8, 7.4}, {38, -64.5, -17, 6.5}, {31, -62.5, -24, 6}, {27, -60, -30, 5}};
    t[BUTTRESS] = tube_round(buttress, COUNT(buttress));
    static const double pterygoid[][4] = {
        {19, -30, 2, 3.4}, {20, -34, -12, 2.6}, {22.5, -34.5, -24, 2.4}, {23, -34.5, -30, 2}};
    t[PTERYGOID] = tube_flat(pterygoid, COUNT(pterygoid), (double[]){0.25, 1, 0}, 2.4);
    static const double inner[][4] = {{14, -32, 2, 3}, {14.5, -35, -16, 2.2}, {14.5, -35.5, -29, 1.8}};
    t[PTERYGOID_INNER] = tube_flat(inner, COUNT(inner), (double[]){0, 1, 0}, 2);
    static const double clivus[][4] = {{0, -30, 2, 14}, {0, -18, -4, 11}, {0, -4, -14, 7}};
    t[CLIVUS] = tube_flat(clivus, COUNT(clivus), (double[]){1, 0, 0}, 1.5);
    static const double spine[][4] = {{0, -78, -26, 5}, {0, -84, -25.5, 3}, {0, -88.8, -24, 1.2}};
    t[SPINE] = tube_round(spine, COUNT(spine));
    static const double temporal[][4] = {
        {47.5, -68, 31, 3}, {45.5, -65, 41, 3}, {46.5, -56, 54, 2.6}, {50, -40, 64, 2.0}, {54, -22, 69, 1}};
    t[TEMPORAL_LINE] = tube_round(temporal, COUNT(temporal));
}

/* Rounded-square cone from the rim of the orbit to its apex, grown by `grow` mm. */
static double orbit(const double p[3], double grow)
{
    static const double rim[3] = {29.5, -75, 16.5}, apex[3] = {15, -34, 15};
    double axis[3], d[3];
    vec_sub(apex, rim, axis);
    double length = vec_normalize(axis);
    vec_sub(p, rim, d);
    double t = vec_dot(d, axis);
    double side[3] = {-axis[1], axis[0], 0}, up[3];
    vec_normalize(side);
    vec_cross(axis, side, up);
    double u = vec_dot(d, side), v = vec_dot(d, up);
    double s = sdf_clamp(t / length, -0.2, 1);
    double shrink = s > 0 ? 1 - 0.97 * pow(s, 1.6) : 1 + 0.12 * -s;
    double a = 19.0 * shrink + grow, b = 16.6 * shrink + grow;
    u += 0.08 * v; /* the roof leans out, the floor in */
    double q = pow(pow(fabs(u) / a, 3) + pow(fabs(v) / b, 3), 1 / 3.0);
    double section = (q - 1) * b * 0.92;
    return sdf_max(section, t - length - grow);
}

static double nasal_cavity(const double p[3])
{
    static const double pear[][2] = {{0, 5},       {3, 4},       {6.5, -1},  {9, -8},     {11, -14.5},
                                     {11.3, -19},  {8.5, -22},   {2, -22.8}, {-2, -22.8}, {-8.5, -22},
                                     {-11.3, -19}, {-11, -14.5}, {-9, -8},   {-6.5, -1},  {-3, 4}};
    double d = sdf_polygon(p[0], p[2], pear, COUNT(pear)) - 0.8;
    d = sdf_meet(d, p[1] + 34, 4);
    /* septum and lower turbinates stay */
    static const double septum[][2] = {{-84, -30}, {-80, -14}, {-83, 2}, {-88, 14}, {-30, 14}, {-36, -30}};
    double bone = sdf_max(fabs(p[0] + 0.6 * sin(p[2] * 0.12)) - 0.9, sdf_polygon(p[1], p[2], septum, COUNT(septum)));
    bone = sdf_min(bone, sdf_ellipsoid(p, 10, -62, -13, 3.4, 15, 3.6));
    return sdf_cut(d, bone, 1.2);
}

static double roots(const double p[3], double d)
{
    for (int i = 0; i < TEETH_PER_SIDE; i++) {
        const tooth *t = &upper_teeth[i];
        if (fabs(p[0] - t->tip[0]) > 14 || fabs(p[1] - t->tip[1]) > 16) continue;
        double axis[3], neck[3], apex[3];
        vec_copy(t->axis, axis);
        vec_normalize(axis);
        double a = t->yaw_deg * 0.017453292519943295, shift = t->depth_mm * (i < 5 ? 0.04 : 0.14);
        double out[3] = {sin(a) * shift, -cos(a) * shift, 0};
        vec_axpy(t->tip, t->crown_mm + 1.0, axis, neck);
        vec_axpy(neck, t->root_mm, axis, apex);
        vec_add(neck, out, neck);
        vec_add(apex, out, apex);
        d = sdf_union(d, sdf_cone(p, neck, sdf_min(0.46 * t->depth_mm, 3.8), apex, 2.2), 2.6);
    }
    return d;
}

double body_skull(const bodies *b, const double point[3])
{
    const tube *t = b->skull;
    double p[3] = {fabs(point[0]), point[1], point[2]};
    double d = radial_distance(&b->vault, p);
    if (d > 90) return d - 60;
    bool face = p[1] < -12 && p[2] < 75;
    if (face) {
        double shell = sdf_max(orbit(p, 3.2), p[1] - (-30));
        shell = sdf_max(shell, -(p[1] - (-70 + 0.42 * (p[0] - 30))));
        d = sdf_union(d, shell, 5);
        d = sdf_union(d, sdf_ellipsoid(p, 0, -58, 13, 11, 26, 17), 5);
        d = tube_union(d, &t[BROW], p, 7);
        d = tube_union(d, &t[GLABELLA], p, 6);
        d = tube_union(d, &t[TEMPORAL_LINE], p, 9);
        d = tube_union(d, &t[LATERAL_RIM], p, 3);
        d = tube_union(d, &t[MAXILLA_FRONTAL], p, 4);
        double body = sdf_ellipsoid(p, 18, -58, -13, 18, 21.5, 17);
        body = sdf_union(body, sdf_ellipsoid(p, 30, -66, -10, 15, 11.5, 13), 9);
        body = sdf_union(body, sdf_ellipsoid(p, 41.5, -64, -8, 10, 8.5, 10), 5);
        d = sdf_union(d, body, 4);
        d = tube_union(d, &t[BUTTRESS], p, 5);
        d = tube_union(d, &t[LOWER_RIM], p, 6);
        d = sdf_union(d, sdf_ellipsoid(p, 0, -60, -26.5, 24, 22.5, 3.6), 4);
        d = tube_union(d, &t[ALVEOLUS], p, 6);
        d = tube_union(d, &t[NASAL], p, 3);
        d = tube_union(d, &t[NASAL_SIDE], p, 4);
        d = tube_union(d, &t[PTERYGOID], p, 3);
        d = tube_union(d, &t[PTERYGOID_INNER], p, 2);
        d = roots(p, d);
    }
    d = tube_union(d, &t[ARCH], p, 4);
    d = tube_union(d, &t[ARCH_ROOT], p, 3);
    if (p[2] < 30 && p[1] > -50) {
        d = tube_union(d, &t[CLIVUS], p, 6);
        static const double mastoid_at[3] = {54, 9, -13}, mastoid[3] = {7.5, 11, 15};
        d = sdf_union(d, sdf_ellipsoid_turned(p, mastoid_at, mastoid, 0.3, 0, 0.12), 6);
        d = sdf_union(d, sdf_ellipsoid(p, 46, -2, 2, 12, 13, 8), 5);
        static const double styloid_a[3] = {46, -1, -10}, styloid_b[3] = {42, -8, -34};
        d = sdf_union(d, sdf_cone(p, styloid_a, 2.6, styloid_b, 0.9), 3);
        d = sdf_cut(d, sdf_ellipsoid(p, 50, -11.5, -4.5, 11.5, 7.8, 7), 3); /* jaw joint */
        d = sdf_cut(d, sdf_ellipsoid(p, 62, -1, -3.6, 8, 3.2, 3.6), 2);     /* ear canal: its roof is porion */
        d = sdf_cut(d, sdf_ellipsoid(p, 0, 16, -27, 13.5, 17, 14), 4);      /* foramen magnum */
    }
    if (face) {
        d = sdf_cut(d, orbit(p, 0), 2.5);
        d = sdf_cut(d, nasal_cavity(p), 1.6);
        d = sdf_cut(d, sdf_ellipsoid(p, 28, -85, -16, 8, 9, 8), 9);        /* canine fossa */
        d = sdf_cut(d, sdf_ellipsoid(p, 26, -82, -8.3, 2.2, 5, 1.7), 1.5); /* infraorbital foramen */
        d = tube_union(d, &t[SPINE], p, 2);
    }
    return d;
}
