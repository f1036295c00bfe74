#include "teeth.h"
#include "sdf.h"
#include <math.h>

const tooth upper_teeth[TEETH_PER_SIDE] = {{{4.2, -90.3, -51.5}, {0.03, 0.36, 0.93}, 6, 8.2, 7, 10.2, 13},
                                           {{11.2, -87.6, -50.8}, {0.06, 0.34, 0.93}, 24, 6.5, 6, 9, 13},
                                           {{16.9, -82.2, -51.0}, {0.02, 0.22, 0.97}, 48, 7.4, 8, 10, 17},
                                           {{18.9, -74.6, -48.9}, {0.03, 0.10, 0.99}, 74, 7, 9, 8.4, 14},
                                           {{20.5, -67.3, -48.2}, {0.02, 0.06, 0.99}, 78, 6.8, 9, 8.2, 14},
                                           {{22.4, -58.3, -47.0}, {-0.02, 0.03, 0.99}, 81, 10, 11, 7.5, 11.5},
                                           {{24.2, -48.5, -45.8}, {-0.04, -0.04, 0.99}, 82, 9.2, 11, 7, 11.5}};

const tooth lower_teeth[TEETH_PER_SIDE] = {{{2.7, -87.3, -48.4}, {0.00, 0.40, -0.92}, 5, 5.2, 6, 8.8, 12.5},
                                           {{8.0, -86.0, -48.2}, {0.04, 0.37, -0.93}, 15, 5.6, 6.3, 9.2, 14},
                                           {{13.2, -82.6, -47.8}, {0.06, 0.24, -0.97}, 42, 6.8, 7.5, 10, 14.2},
                                           {{15.6, -76.0, -47.0}, {0.08, 0.12, -0.99}, 70, 7, 7.8, 8.4, 14},
                                           {{17.0, -69.0, -46.6}, {0.10, 0.06, -0.99}, 76, 7, 8.2, 8, 14.5},
                                           {{18.7, -59.8, -45.8}, {0.14, -0.02, -0.99}, 81, 11, 10.3, 7.5, 14},
                                           {{20.7, -49.3, -44.8}, {0.18, -0.10, -0.98}, 81, 10.4, 10, 7, 13}};

enum { RING = 30, TABLE_RINGS = 5, CROWN_RINGS = 8, ROOT_RINGS = 7, RINGS = TABLE_RINGS + CROWN_RINGS + ROOT_RINGS };

/* Half width and half depth as shares of width and depth at rows of `share` of the crown's height. */
typedef struct crown_form {
    double share[5], wide[5], deep[5];
    double square; /* exponent of the section: 2 round, larger squarer */
    double cusp_mm;
} crown_form;

static const crown_form forms[4] = {
    {{0, 0.07, 0.4, 0.85, 1}, {0.45, 0.49, 0.485, 0.42, 0.39}, {0.08, 0.17, 0.33, 0.49, 0.46}, 2.6, 0},
    {{0, 0.16, 0.42, 0.8, 1}, {0.10, 0.33, 0.495, 0.45, 0.41}, {0.10, 0.22, 0.38, 0.50, 0.46}, 2.3, 0},
    {{0, 0.2, 0.45, 0.8, 1}, {0.38, 0.46, 0.495, 0.46, 0.42}, {0.30, 0.42, 0.50, 0.47, 0.43}, 2.5, 1.4},
    {{0, 0.2, 0.45, 0.8, 1}, {0.42, 0.48, 0.495, 0.47, 0.44}, {0.34, 0.44, 0.50, 0.48, 0.45}, 3.2, 1.2}};

static const crown_form *form_of(int place) { return &forms[place < 2 ? 0 : place == 2 ? 1 : place < 5 ? 2 : 3]; }

static void crown_section(const crown_form *f, double s, double *wide, double *deep)
{
    int i = 0;
    while (i < 3 && s > f->share[i + 1]) i++;
    double t = (s - f->share[i]) / (f->share[i + 1] - f->share[i]);
    *wide = sdf_mix(f->wide[i], f->wide[i + 1], t);
    *deep = sdf_mix(f->deep[i], f->deep[i + 1], t);
}

/* Depth below the cusp tips of the occlusal table at (w, o), both in shares of width and depth. */
static double table_depth(const crown_form *f, int place, double w, double o)
{
    if (f->cusp_mm == 0) return 0;
    double cusp = 0, columns = place < 5 ? 1 : 2;
    for (int a = 0; a < columns; a++)
        for (int b = -1; b <= 1; b += 2) {
            double dw = columns > 1 ? w - (a ? 0.23 : -0.23) : 0.7 * w, dd = o - 0.27 * b;
            cusp = fmax(cusp, exp(-(dw * dw + dd * dd) / 0.03));
        }
    return f->cusp_mm * (1 - cusp);
}

static double round_power(double c, double n) { return copysign(pow(fabs(c), 2 / n), c); }

static void tooth_axes(const tooth *t, double axis[3], double outer[3], double mesial[3])
{
    double yaw = t->yaw_deg * M_PI / 180;
    vec_copy(t->axis, axis);
    vec_normalize(axis);
    double o[3] = {sin(yaw), -cos(yaw), 0};
    vec_axpy(o, -vec_dot(o, axis), axis, outer);
    vec_normalize(outer);
    vec_cross(axis, outer, mesial);
    if (mesial[0] * cos(yaw) + mesial[1] * sin(yaw) > 0) vec_scale(mesial, -1, mesial);
}

void tooth_point(const tooth *t, double along, double outer_mm, double mesial_mm, bool right, double p[3])
{
    double axis[3], outer[3], mesial[3];
    tooth_axes(t, axis, outer, mesial);
    vec_axpy(t->tip, along, axis, p);
    vec_axpy(p, outer_mm, outer, p);
    vec_axpy(p, mesial_mm, mesial, p);
    if (right) p[0] = -p[0];
}

surface tooth_surface(const tooth *t, int place, bool right)
{
    const crown_form *f = form_of(place);
    surface s = surface_new(2 + RINGS * RING, 2 * RINGS * RING);
    for (int k = 0; k < RINGS; k++) {
        for (int i = 0; i < RING; i++) {
            double angle = 2 * M_PI * i / RING, wide, deep, along, n = f->square;
            double cw = cos(angle), co = sin(angle);
            crown_section(f, 0, &wide, &deep);
            double edge = table_depth(f, place, wide * round_power(cw, n), deep * round_power(co, n));
            if (k < TABLE_RINGS) {
                double share = (k + 1.0) / TABLE_RINGS;
                wide *= share, deep *= share;
                along = table_depth(f, place, wide * round_power(cw, n), deep * round_power(co, n));
                if (f->cusp_mm == 0) along += 0.35 * share * share;
            } else if (k < TABLE_RINGS + CROWN_RINGS) {
                double share = (k - TABLE_RINGS + 1.0) / CROWN_RINGS;
                crown_section(f, share, &wide, &deep);
                along = sdf_mix(f->cusp_mm == 0 ? 0.35 : edge, t->crown_mm, share);
            } else {
                double share = (k - TABLE_RINGS - CROWN_RINGS + 1.0) / ROOT_RINGS;
                crown_section(f, 1, &wide, &deep);
                double taper = 0.97 * sqrt(fmax(1 - pow(share * 0.93, 1.7), 0));
                wide *= taper, deep *= taper;
                n = 2;
                along = t->crown_mm + t->root_mm * share * 0.97;
            }
            tooth_point(t, along, deep * t->depth_mm * round_power(co, n), wide * t->width_mm * round_power(cw, n),
                        right, s.xyz + 3 * (k * RING + i));
        }
    }
    int tip = RINGS * RING, apex = tip + 1;
    tooth_point(t, table_depth(f, place, 0, 0), 0, 0, right, s.xyz + 3 * tip);
    tooth_point(t, t->crown_mm + t->root_mm, 0, 0, right, s.xyz + 3 * apex);
    int m = 0;
    for (int i = 0; i < RING; i++) {
        int j = (i + 1) % RING;
        int32_t first[3] = {tip, i, j}, last[3] = {apex, (RINGS - 1) * RING + j, (RINGS - 1) * RING + i};
        for (int c = 0; c < 3; c++) s.tri[3 * m + c] = first[c], s.tri[3 * m + 3 + c] = last[c];
        m += 2;
        for (int k = 0; k + 1 < RINGS; k++) {
            int32_t a = k * RING + i, b = k * RING + j, c = a + RING, d = b + RING;
            int32_t quad[6] = {a, c, b, b, c, d};
            for (int e = 0; e < 6; e++) s.tri[3 * m + e] = quad[e];
            m += 2;
        }
    }
    s.triangle_count = m;
    if (surface_volume(&s) < 0) surface_flip(&s);
    return s;
}
