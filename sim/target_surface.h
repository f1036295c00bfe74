/* target_surface: where on a surface a point of another one belongs, or that it belongs nowhere on it. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct target_surface target_surface; /* queries are const and thread-safe */

/* Copies what it needs of s, which may be open, torn or empty. A plane piece of it, 400 mm^2 or more, is where a scan
 * was cut: what lies nearest to it lies on the open border. */
target_surface *target_surface_make(const surface *s);
void target_surface_free(target_surface **t); /* idempotent */

typedef struct target_rules {
    double reach_mm;   /* farther is nowhere */
    double facing_cos; /* normals farther apart than this belong to different sides */
} target_rules;

typedef struct target_point {
    double at[3], normal[3]; /* on the surface; unit, of its vertices, smoothed across the triangle */
    int32_t triangle;
} target_point;

/* Distance from p, whose own surface has the unit normal n there (NULL: any will do), to the nearest point of the
 * surface that looks the same way, mm. HUGE_VAL where p belongs nowhere: nothing of the kind is within reach, or it is
 * the open border, so that the surface might go on there. */
double target_surface_ask(const target_surface *t, const double p[3], const double n[3], const target_rules *rules,
                          target_point *out);

#ifdef __cplusplus
}
#endif
