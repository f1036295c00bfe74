/* registration: an elastic body drawn onto surfaces, until surfaces that it carries lie on them.
 *
 * Least elastic energy of the body under springs from the carried vertices to the nearest places of the targets, one
 * after the other: found anew round after round, and stiffer from stage to stage. The energy is measured against the
 * body's own rest throughout. A spring draws along the target's normal fully and across it little, so that surfaces may
 * slide; its weight falls to 0 towards the reach (Tukey's biweight), and a vertex that belongs nowhere (target_surface)
 * is held, a thousandth as stiff, where the last round left it. Springs about a tet that would turn inside out give
 * way. Allen, Curless, Popovic 2003; Amberg, Romdhani, Vetter 2007. */
#pragma once
#include "geometry/embed.h"
#include "sim/target_surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct registration_part {
    const surface *moving;        /* at the body's rest */
    const embedding *carried;     /* its vertices in the body; those off it are not drawn */
    const target_surface *target; /* NULL: is only carried */
    const uint8_t *mute;          /* [vertices] 1: not drawn; NULL: all are */
    double weight;                /* of a mm^2 of it, against the other parts */
} registration_part;

/* Points whose places are known. */
typedef struct registration_anchors {
    const embedding *carried;
    const double *place; /* [3*point_count] mm */
    double area_mm2;     /* each is drawn to its place as so much surface would be */
} registration_anchors;

typedef struct registration_problem {
    const tetmesh *body;
    const double *start_xyz; /* [3*nodes] or NULL: rest */
    int32_t part_count;
    const registration_part *part;
    const registration_anchors *anchors; /* or NULL */
} registration_problem;

typedef struct registration_params {
    double poisson;
    int stages, rounds;              /* targets are found so often in each stage */
    double soft_mm, stiff_mm;        /* a mm^2 is drawn with Young's modulus over this, in the first and last stage */
    double reach_first_mm, reach_mm; /* in the first and last stage */
    double facing_cos;
    double across;                      /* share of a spring across the normal */
    double min_j;                       /* springs give way where a tet would get below this */
    bool (*interrupted)(void *context); /* NULL or asked before each round */
    void *context;
} registration_params;

registration_params registration_params_default(void);

typedef struct registration_gaps { /* of the vertices that had a target in the last round */
    int32_t vertices, with_target;
    double mean_mm, p95_mm, max_mm;
} registration_gaps;

/* Of gap[count] in mm, which is sorted. */
registration_gaps registration_gaps_of(double *gap, int32_t count, int32_t vertices);

typedef struct registration {
    double *xyz;             /* [3*nodes] */
    registration_gaps *gaps; /* [part_count] */
    double min_j;
    int32_t inverted_tets;
    int32_t given_way; /* springs that did */
    int rounds, iterations, factorisations;
    double factor_s, total_s; /* wall */
} registration;

/* Refuses (ERR_INPUT) parameters out of range, (ERR_GEOMETRY) a body that nothing carried lies in,
 * (ERR_NOT_CONVERGED) a solve that fails, (ERR_INTERRUPTED). Tets that turned inside out are told, not refused. The
 * caller frees *out. */
bool registration_run(const registration_problem *problem, const registration_params *params, registration *out,
                      err *e) MUST_CHECK;
void registration_free(registration *r);

#ifdef __cplusplus
}
#endif
