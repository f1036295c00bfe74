#include "bodies.h"
#include "sdf.h"

/* To the axes of the ear: q[0] out of the head, q[1] back, q[2] up. */
static void to_ear(const double p[3], const double centre[3], double yaw, double tilt, double q[3])
{
    double d[3];
    vec_sub(p, centre, d);
    double c = cos(yaw), s = sin(yaw);
    double x = c * d[0] - s * d[1], y = s * d[0] + c * d[1];
    c = cos(tilt), s = sin(tilt);
    q[0] = x;
    q[1] = c * y - s * d[2];
    q[2] = s * y + c * d[2];
}

enum { /* tubes of the skin */
       HELIX,
       ANTIHELIX,
       RIDGE,
       WALL,
       UPPER_LIP,
       LOWER_LIP,
       LID_LINE,
       LID_CREASE,
       NECK_MUSCLE,
       SKIN_TUBE_COUNT
};
_Static_assert((int)SKIN_TUBE_COUNT <= (int)SKIN_TUBES, "room in bodies");

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

void body_skin_tubes(tube *t)
{
    /* the ear in its own axes: out, back, up */
    static const double helix[][4] = {
        {-1, -7, 2, 2.4},   {1.5, -9.0, 12, 2.6}, {4.5, -5.5, 23, 2.6}, {6, 3, 29, 2.5},    {7, 12, 26, 2.6},
        {7.5, 17, 15, 2.5}, {6.5, 16.5, 3, 2.4},  {5, 12.5, -9, 2.4},   {3.5, 7, -19, 2.8}, {2.5, 1, -24, 2.5}};
    t[HELIX] = tube_round(helix, COUNT(helix));
    static const double antihelix[][4] = {
        {4, 3, 20, 1.2}, {5, 8, 12, 2.0}, {5, 9.5, 2, 2.3}, {4.2, 7, -8, 2.2}, {3.4, 1.5, -13, 2.2}};
    t[ANTIHELIX] = tube_round(antihelix, COUNT(antihelix));
    static const double ridge[][4] = {
        {0, -85.6, 25, 6.0}, {0, -90.9, 13, 6.4}, {0, -97.2, 0, 6.6}, {0, -102.6, -10, 7.0}, {0, -106.9, -16.8, 7.5}};
    t[RIDGE] = tube_round(ridge, COUNT(ridge));
    static const double wall[][4] = {
        {5.5, -83.5, 19, 5.8}, {6.3, -87.2, 6, 6.2}, {7, -92, -7, 7.0}, {8.2, -95.5, -16, 7.2}};
    t[WALL] = tube_round(wall, COUNT(wall));
    static const double upper[][4] = {{-5, -95.1, -46.2, 4.7}, {0, -94.9, -46.5, 4.6},  {5, -95.1, -46.2, 4.7},
                                      {11, -93.0, -46.8, 4.2}, {17, -89.9, -48.0, 3.2}, {24, -85.6, -50.0, 1.6}};
    t[UPPER_LIP] = tube_round(upper, COUNT(upper));
    static const double lower[][4] = {{-6, -93.2, -54.5, 5.4}, {0, -93.5, -54.6, 5.4},  {6, -93.2, -54.5, 5.4},
                                      {12, -91.3, -54.1, 4.8}, {18, -88.4, -53.3, 3.5}, {24, -85.4, -51.6, 1.7}};
    t[LOWER_LIP] = tube_round(lower, COUNT(lower));
    static const double muscle[][4] = {
        {49, 14, -32, 6}, {44, 8, -60, 6.5}, {34.5, -6, -95, 6.5}, {24, -15, -125, 6}, {14, -19.5, -155, 6}};
    t[NECK_MUSCLE] = tube_round(muscle, COUNT(muscle));
}

/* A groove of given radii along z = height(x), with its middle on the surface that `distance` tells. */
static tube groove_on(const bodies *b, double (*distance)(const bodies *, const double[3]), double from, double to,
                      double (*height)(double), double radius)
{
    enum { POINTS = 9 };
    double control[POINTS][4];
    for (int i = 0; i < POINTS; i++) {
        double s = (double)i / (POINTS - 1), p[3] = {sdf_mix(from, to, s), -115, 0};
        p[2] = height(p[0]);
        double high = -60; /* between the air in front and the head */
        while (high - p[1] > 0.01) {
            double middle[3] = {p[0], (p[1] + high) / 2, p[2]};
            if (distance(b, middle) < 0)
                high = middle[1];
            else
                p[1] = middle[1];
        }
        vec_copy(p, control[i]);
        control[i][3] = radius * (0.55 + 0.45 * sin(M_PI * sdf_clamp(s, 0.05, 0.95)));
    }
    return tube_round((const double(*)[4])control, POINTS);
}

static double bare_lids(const bodies *b, const double p[3]);
double skin_lid_line(double x)
{
    double u = (x - 30.5) / 14.5;
    return 8.4 + 4.8 * u * u + 0.5 * u;
}
static double crease_line(double x)
{
    double u = (x - 30.5) / 15.5;
    return 21.8 - 4.6 * u * u + 0.2 * u;
}

void body_skin_lids(bodies *b)
{
    b->skin[LID_LINE] = groove_on(b, bare_lids, 16.5, 44.5, skin_lid_line, 0.75);
    b->skin[LID_CREASE] = groove_on(b, bare_lids, 19, 43.5, crease_line, 0.45);
}

static double ear(const bodies *b, const double p[3])
{
    static const double centre[3] = {70, 6, 3};
    double q[3];
    to_ear(p, centre, -0.42, 0.2, q);
    if (vec_norm(q) > 55) return vec_norm(q) - 40;
    static const double lobe_at[3] = {2.5, 1.5, -22}, lobe[3] = {2.7, 6, 7.5};
    static const double plate_at[3] = {2.6, 4.0, 4.5}, plate[3] = {3.4, 15, 26.5};
    double d = sdf_ellipsoid_turned(q, plate_at, plate, 0.12, 0, 0.04);
    d = tube_union(d, &b->skin[HELIX], q, 3.5);
    d = tube_union(d, &b->skin[ANTIHELIX], q, 3);
    d = sdf_union(d, sdf_ellipsoid_turned(q, lobe_at, lobe, 0.2, 0, 0), 4);
    d = sdf_cut(d, sdf_ellipsoid(q, 6.0, 0.5, -2, 5.5, 6.5, 8.5), 3);
    static const double tragus_a[3] = {1, -8, -2}, tragus_b[3] = {2.5, -6.5, -7};
    return sdf_union(d, sdf_cone(q, tragus_a, 2.6, tragus_b, 3.0), 3);
}

static double nose(const bodies *b, const double p[3])
{
    static const double ala_at[3] = {11.0, -98, -21.3}, ala[3] = {5.4, 8.8, 6.4};
    static const double columella_a[3] = {0, -107.5, -21.5}, columella_b[3] = {0, -97, -26.3};
    static const double lobule[3] = {3.8, -106.3, -18}, lobule_semi[3] = {5.2, 6.3, 6};
    double d = sdf_union(tube_distance(&b->skin[RIDGE], p), tube_distance(&b->skin[WALL], p), 14);
    d = sdf_union(d, sdf_ellipsoid_turned(p, ala_at, ala, 0.25, -0.35, 0.1), 4.5);
    d = sdf_union(d, sdf_cone(p, columella_a, 4.2, columella_b, 3.8), 5);
    return sdf_union(d, sdf_ellipsoid_turned(p, lobule, lobule_semi, 0, 0, 0), 5);
}

static double nostrils(const double p[3])
{
    static const double at[3] = {6.5, -102.0, -27.0}, semi[3] = {2.5, 4.7, 4.6};
    return sdf_ellipsoid_turned(p, at, semi, 0.1, -0.35, -0.15);
}

double skin_lip_line(double x) { return -50.2 - 0.6 * (x / 25) * (x / 25); }
double skin_lip_top(double x)
{
    double arch = sdf_max(1 - (x / 25) * (x / 25), 0);
    return skin_lip_line(x) + 7.6 * pow(arch, 0.8) - 1.2 * exp(-x * x / 7);
}
double skin_lip_bottom(double x)
{
    double arch = sdf_max(1 - (x / 25) * (x / 25), 0);
    return skin_lip_line(x) - 8.6 * pow(arch, 0.75);
}

static double bump(double x, double width) { return exp(-0.5 * (x / width) * (x / width)); }

/* The lips touch: between them is a groove no deeper than they are round, so that nothing overhangs. */
static double lips(const bodies *b, const double p[3], double d)
{
    /* the lower lip meets the upper one in a crease and the chin in a soft fold */
    d = tube_union(d, &b->skin[UPPER_LIP], p, 3);
    d = tube_union(d, &b->skin[LOWER_LIP], p, sdf_mix(5, 0.8, sdf_step(-59, -53, p[2])));
    double x = p[0], z = p[2];
    if (p[1] > -75 || d < -8 || d > 8 || z < -68 || z > -26) return d;
    double inner = 1 - sdf_step(16, 25, x);
    d += 0.6 * (1 - sdf_step(14, 25.5, x)) * bump(z - skin_lip_line(x), 0.9);
    d -= inner * (0.25 * bump(z - skin_lip_top(x), 1.3) + 0.15 * bump(z - skin_lip_bottom(x), 1.4));
    d += 0.9 * bump(x - 26, 1.8) * bump(z + 50.8, 1.8);
    double philtrum = sdf_step(-44, -41, z) * (1 - sdf_step(-33, -28, z)), out = 3.6 - 0.08 * (z + 43);
    return d + philtrum * (0.4 * bump(x, 2) - 0.4 * bump(x - out, 1.7));
}

static double bare_lids(const bodies *b, const double p[3])
{
    double d = radial_distance(&b->face, p);
    return sdf_union(d, sdf_ellipsoid(p, 30.5, -75.0, 13.0, 15.5, 12.2, 12.0), 9);
}

static double eyes(const bodies *b, const double p[3], double d)
{
    d = sdf_union(d, sdf_ellipsoid(p, 30.5, -75.0, 13.0, 15.5, 12.2, 12.0), 9);
    d = tube_cut(d, &b->skin[LID_LINE], p, 0.9);
    return tube_cut(d, &b->skin[LID_CREASE], p, 4);
}

static double neck(const bodies *b, const double p[3])
{
    /* elliptic column that leans forwards going up, a little waisted, with the two muscles to the breastbone
     */
    double t = sdf_clamp((p[2] + 150) / 90, 0, 1.3), waist = 3.5 * (1 - 2 * t) * (1 - 2 * t);
    double q[3] = {p[0], p[1], 0};
    double d = sdf_ellipsoid(q, 0, 22 - 10 * t, 0, 45 + waist, 44 + 0.5 * waist, 1e3);
    d = tube_union(d, &b->skin[NECK_MUSCLE], p, 12);
    return sdf_meet(d, p[2] + 30, 30);
}

double body_skin(const bodies *b, const double point[3])
{
    double p[3] = {fabs(point[0]), point[1], point[2]};
    double d = sdf_union(radial_distance(&b->face, p), neck(b, p), 14);
    if (d > 45) return d - 20;
    if (p[1] < -60) {
        d = eyes(b, p, d);
        d = sdf_union(d, nose(b, p), 6);
        d = sdf_cut(d, nostrils(p), 1.8);
        d = lips(b, p, d);
    } else {
        d = sdf_union(d, ear(b, p), 6);
    }
    return sdf_meet(d, -150 - p[2], 2);
}

bool body_skin_fold(const double point[3])
{
    double p[3] = {fabs(point[0]), point[1], point[2]};
    return p[1] < -80 && nostrils(p) < 0.9;
}
