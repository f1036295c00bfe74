/* nearest_move: the smallest change that satisfies linear limits, or comes nearest to doing so. */
#pragma once

enum { MOVE_AXES_MAX = 32 };

typedef struct move_limit { /* towards . x >= least, towards of length 1 */
    double towards[MOVE_AXES_MAX], least;
} move_limit;

/* x[axes] of least length that has all limits; where they contradict, of least squared breach of them. Dual coordinate
 * ascent (Hildreth, "A quadratic programming procedure", Naval Research Logistics Quarterly 4, 1957). */
void nearest_move(const move_limit *limit, int count, int axes, double x[]);
