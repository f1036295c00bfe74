/* sdf: signed distances of simple bodies and their blends. Negative inside, mm. The blends and the swept
 * bodies are bounds of the distance, true to first order near the surface, which is what meshing needs. */
#pragma once
#include "geometry/vec.h"

/* fmin and fmax of numbers, in one instruction each. */
static inline double sdf_min(double a, double b) { return a < b ? a : b; }
static inline double sdf_max(double a, double b) { return a > b ? a : b; }

/* Union, intersection and difference with a fillet of about `k` mm (polynomial blend; k > 0). */
static inline double sdf_union(double a, double b, double k)
{
    double h = sdf_max(k - fabs(a - b), 0) / k;
    return sdf_min(a, b) - 0.25 * h * h * k;
}
static inline double sdf_cut(double a, double b, double k) { return -sdf_union(-a, b, k); } /* a without b */
static inline double sdf_meet(double a, double b, double k) { return -sdf_union(-a, -b, k); }

static inline double sdf_clamp(double x, double low, double high) { return sdf_min(sdf_max(x, low), high); }
static inline double sdf_mix(double a, double b, double t) { return a + t * (b - a); }
/* 0 below a, 1 above b, smooth between. */
static inline double sdf_step(double a, double b, double x)
{
    double t = sdf_clamp((x - a) / (b - a), 0, 1);
    return t * t * (3 - 2 * t);
}

static inline double sdf_sphere(const double p[3], double x, double y, double z, double r)
{
    return sqrt((p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y) + (p[2] - z) * (p[2] - z)) - r;
}

/* Ellipsoid with semi-axes a, b, c along x, y, z. */
double sdf_ellipsoid(const double p[3], double x, double y, double z, double a, double b, double c);
/* The same turned by yaw about z, then pitch about x (radians): the body's axes are R e. */
double sdf_ellipsoid_turned(const double p[3], const double centre[3], const double semi[3], double pitch, double yaw,
                            double roll);
/* Ball of radius ra at a to ball of radius rb at b, with its tangent cone approximated linearly. */
double sdf_cone(const double p[3], const double a[3], double ra, const double b[3], double rb);

/* A chain of such cones, smoothly joined by sharing its balls: points[4*i] = x, y, z, radius. */
double sdf_chain(const double p[3], const double (*points)[4], int count);

/* A flat strip: like sdf_chain, but its section is an ellipse, `flat` times wider along axis `across`
 * (unit vector). */
double sdf_strip(const double p[3], const double (*points)[4], int count, const double across[3], double flat);

/* Closed polygon in the plane: signed distance of (u, v), negative inside. corners[2*i]. */
double sdf_polygon(double u, double v, const double (*corners)[2], int count);

/* Catmull-Rom through count points of `width` numbers each at parameter s in [0, count-1]. */
void sdf_spline(const double *points, int width, int count, double s, double *out);
