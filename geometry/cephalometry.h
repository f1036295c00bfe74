/* cephalometry: angles and distances of bone, teeth and profile, from landmarks.
 *
 * All but the transverse ones are taken in the midsagittal projection of the head frame (Frankfort horizontal): the
 * left component is dropped, forward is -posterior; midpoints stand for pairs (Go = mean of Go_L and Go_R). Signs:
 * positive is forward, up or to the left, the upper jaw in front of the lower (overjet, ANB, Wits), overlap (overbite),
 * lip in front of the E-line, convex profile, front end of a plane tilted down (SN-MP, FMA, palatal plane), left side
 * tilted down (cant).
 *
 * Norms are those of adults as the named sources are commonly quoted; some rest on small samples of one population,
 * and none is a limit. */
#pragma once
#include "geometry/frame.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ceph_norm {
    double mean, sd; /* NaN: none known */
} ceph_norm;

typedef struct ceph_measure {
    const char *name;   /* "SNA", "overjet" */
    const char *group;  /* "Steiner", "COGS", ... */
    const char *what;   /* how it is measured */
    const char *unit;   /* "deg", "mm" or "%" */
    const char *points; /* needed, space-separated; "Go" a midpoint, "Ar|Co": Co where Ar is missing, and said */
    ceph_norm men, women;
    const char *source; /* of the norm; NULL where there is none */
    int rule;           /* how the points are combined; see src/face/ceph_rules.h */
} ceph_measure;

extern const ceph_measure ceph_measures[];
extern const int ceph_measure_count;
enum { CEPH_MEASURES_MAX = 80, CEPH_NOTE_SIZE = 128 };

typedef struct ceph_value {
    double value;              /* NaN: not available */
    char note[CEPH_NOTE_SIZE]; /* "needs L1_apex", or "Co stands for Ar", or "" */
} ceph_value;

/* The landmark, or the mean that a name without a side stands for: Go, Co, Ar, Or, Po, occlusal_3 and occlusal_6 (upper
 * and lower canines, first molars). false: *missing names the landmark that is not there. */
bool ceph_point(const landmarks *l, const char *name, double xyz[3], const char **missing) MUST_CHECK;
/* Fills out[ceph_measure_count]. Both sides of a change are to be taken in one frame, that of before. */
void ceph_evaluate(const landmarks *l, const head_frame *f, ceph_value out[CEPH_MEASURES_MAX]);

#ifdef __cplusplus
}
#endif
