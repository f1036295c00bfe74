/* sample_set: judged points of a lattice over some controls, each judged once.
 *
 * A point is a vector of whole numbers; control k has the value base + at[k] * unit[k], so that equal points have
 * equal bits, points on one ray from the base can be told exactly, and a bound found to one step is found to a unit. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>

enum { SAMPLE_AXES_MAX = 8 };

typedef enum verdict_level { VERDICT_FINE, VERDICT_CAUTION, VERDICT_STOP } verdict_level;

typedef struct verdict {
    int32_t level;  /* verdict_level */
    int32_t reason; /* number of the limit that decides here: the worst, of equals the nearest */
    double value;   /* of that limit, in its own unit */
} verdict;

typedef struct sample {
    int32_t at[SAMPLE_AXES_MAX]; /* 0 beyond the set's axes */
    verdict v;
} sample;

typedef struct sample_params {
    int axis_count;
    /* Judges a point. Called from many threads; must depend on the point alone. */
    bool (*judge)(const int32_t at[SAMPLE_AXES_MAX], void *context, verdict *out, err *e);
    /* NULL, or told each newly judged point, one at a time and in any order. */
    bool (*keep)(const sample *s, void *context, err *e);
    /* NULL, or told how many points were judged here so far. */
    void (*progress)(int64_t judged, void *context);
    bool (*interrupted)(void *context); /* NULL, or asked before each point */
    void *context;
} sample_params;

typedef struct sample_set {
    sample_params params;
    int64_t count, judged; /* judged: without those that were put */
    sample *item;          /* [count] in no meaning order: see sample_set_sort */
    int64_t *slot;         /* hash table of 1 + item number, 0 empty */
    int64_t slot_count;
} sample_set;

sample_set sample_set_new(const sample_params *p);
void sample_set_free(sample_set *s); /* idempotent, leaves zero */
/* Takes over a point judged earlier; false (and nothing done) if it is known already. */
bool sample_set_put(sample_set *s, const sample *one);
/* Judges what is not known of at[SAMPLE_AXES_MAX*count], on all threads. Refuses what judge or keep refuses (of several
 * the first point's), and (ERR_INTERRUPTED) an interruption; what was judged until then stays. */
bool sample_set_ask(sample_set *s, const int32_t *at, int64_t count, err *e) MUST_CHECK;
/* NULL where the point is not known. Valid until the next put or ask. */
const verdict *sample_set_find(const sample_set *s, const int32_t at[SAMPLE_AXES_MAX]);
/* Orders the points by their first number, then the second and so on. */
void sample_set_sort(sample_set *s);
