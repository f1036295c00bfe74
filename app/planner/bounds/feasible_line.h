/* feasible_line: what is feasible along one direction through the base, and what ends it. */
#pragma once
#include "app/planner/bounds/sample_set.h"

typedef struct line_piece { /* points of one level in a row; from and to are judged, the points beyond have another */
    int32_t from, to, level;
    int32_t reason; /* of `from` if that lies away from the base, else of `to`: what the piece begins with */
    double value;
} line_piece;

typedef struct feasible_line {
    int32_t direction[SAMPLE_AXES_MAX];
    int piece_count;
    line_piece *piece; /* in the order of the line, without gaps wider than one step between them */
    int base;          /* the piece that holds the base */
} feasible_line;

/* Judges the base + t * direction for every t in [low, high] that is a multiple of `stride` and for both ends, then
 * halves between neighbours of different levels down to one step. What is narrower than the stride can be missed.
 * low <= 0 <= high. The caller frees *out. Refuses what sample_set_ask refuses. */
bool feasible_line_find(sample_set *s, const int32_t direction[SAMPLE_AXES_MAX], int32_t low, int32_t high,
                        int32_t stride, feasible_line *out, err *e) MUST_CHECK;
void feasible_line_free(feasible_line *l); /* idempotent, leaves zero */

/* The number of the piece at the end (-1 low, +1 high) of the unbroken run of pieces around the base that are below
 * `level`; -1 if the base is not. */
int feasible_line_reach(const feasible_line *l, int end, verdict_level level);
