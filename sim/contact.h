/* contact: tissue against bone, and lip against lip.
 *
 * A bone is a shape, a smooth signed distance d(x) given from outside, which is off at sharp edges: where a solve
 * leaves a node deeper by the exact one, d is less by what it was off there (contact_depth.c), and the solve goes on. A
 * node of area A has the energy  A k C (tau - d)^3  where d < tau, else none; tau = min(activation, gap at rest):
 * tissue that lies on a bone at rest feels nothing until it comes nearer than it was, so a plan that moves nothing
 * moves nothing. No friction; no suction. C is 1 but at the rim of a lip.
 *
 * Two kinds. held: sliding and paired nodes keep in touch as their attachments say; a sliding node follows
 * the level set of its own bone's distance on which it lay at rest, not the tangent plane there: before each
 * Newton step the plane that holds it is laid anew to the level, each trial step ends on it (retraction), and
 * the Hessian holds the level's bend (minus reaction times Hessian of d). Everything else is kept out of
 * bones. It comes late: loads before the last are solved without, unless that fails; so a node on a free
 * surface can get right through a thin bone unseen. Where its straight way from rest leads through a bone, a
 * guard brings it back: a plane across the way that it should be pushed, just inside the bone's face, which
 * stays to the end (a bone that is bulked up to its back). Not held: sliding nodes may lift off, lips part
 * and meet.
 *
 * A lip is a signed distance by implicit moving least squares (Kolluri 2008): samples are its nodes with
 * their unit normals n_i and a third a_i of the area around them, d(x) = sum_i w_i n_i.(x - x_i) / S,  w_i =
 * 5 a_i / (pi h_i^2) (1 - |x - x_i|^2 / h_i^2)^4 within h_i, S = sum_i w_i is 1 on an even plane and falls to
 * 0 off the rim of a surface; C(S) rises smoothly from 0 to 1 there. Only samples that face the node are
 * asked (a lip thinner than h would else have no inside). A node that got deeper than 0.4 h under a lip sees
 * with a wider support, renewed at each Newton step, until it is out. Normals and weights are frozen at each
 * refresh, so the gap is linear in the nodes of both lips: equal and opposite forces, a positive semidefinite
 * stiffness. Folds sharper than h are smoothed away, and depths are told below the smoothed lip. */
#pragma once
#include "geometry/rigid.h"
#include "geometry/segments.h"
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct contact_params {
    double support;         /* of lips: h over the longest edge at a node; 1.5 to 2 */
    double activation_mm;   /* where surfaces apart at rest begin to push */
    double depth_mm;        /* expected under pressure_kpa: k = pressure / (3 depth^2) */
    double pressure_kpa;    /* infinity: Young's modulus of the stiffest tissue */
    double depth_limit_mm;  /* deeper contacts are stiffened and solved again; refused as a result */
    int max_stiffenings;    /* of all contacts that are too deep, each by 4 */
    double exact_limit_mm;  /* where a bone's exact distance tells of deeper contacts, the smooth one is corrected and
                               the  load solved again */
    int max_corrections;    /* so often */
    double facing_cos;      /* samples of a lip whose normal is farther from the node's own than this are not asked */
    double slide_mm;        /* how far lips may slide before their coupling leaves the matrix (not the forces) */
    double free_rel_tol;    /* phase A, without contact: tolerance and */
    int free_iterations;    /* most iterations; 0: no phase A */
    int refresh_iterations; /* colliders are renewed in each of so many iterations, then when those converged */
} contact_params;

contact_params contact_params_default(void);

/* A bone at rest as a smooth signed distance, positive outside; queries come from several threads at once. */
typedef struct bone_shape {
    const void *context;
    /* Distance in mm with its derivatives (hess[9] may be NULL); HUGE_VAL: farther than it needs to know. */
    double (*distance)(const void *context, const double x[3], double grad[3], double *hess);
    /* Where the way from x along the unit direction leaves the bone for the last time within reach_mm, and
     * the unit normal there; false: it does not. */
    bool (*leave)(const void *context, const double x[3], const double direction[3], double reach_mm, double hit[3],
                  double normal[3]);
    /* The distance as it is, negative inside, where the smooth one is not exact enough to be the last word; or NULL. */
    double (*exact)(const void *context, const double x[3]);
} bone_shape;

/* Borrowed until solver_destroy. */
typedef struct contact_setup {
    contact_params params;
    bool held; /* sliding and paired nodes keep in touch as without contact, and only bones are met; sliding
                  nodes stay on the level of their own bone's distance that they lay on at rest, where that
                  bone has a shape, else on the tangent plane there */
    const bone_shape *shape[SEGMENT_COUNT]; /* at rest, moves with its segment; NULL: cannot be touched */
    int32_t upper_count, lower_count;
    const int32_t *upper_lip, *lower_lip; /* [3*count] triangles of mesh nodes, out of the tissue. A pair
                                             that is not in both stays together */
    int32_t extra_count;
    const int32_t *extra; /* free nodes that meet bone as well, beside sliding and paired ones */
} contact_setup;

typedef struct contact_report {
    bool on, held;
    int32_t nodes, links; /* that could touch; node-collider combinations */
    int32_t left_out;     /* nodes of one lip that lie deep in the other at rest */
    int32_t pinched;      /* nodes between bones that overlap there: out of one is into the other */
    int32_t passed;       /* nodes that seem to have gone right through a bone */
    int32_t guards;       /* planes that keep nodes from it, or from turning for ever at a thin bone */
    int32_t lost;         /* combinations given up: at a thin bone whose side is not clear, or deeper in a lip than
                             the bones have moved, so taken for behind; not pushed */
    int32_t active_nodes; /* that do touch */
    double depth_mm;      /* deepest penetration: below the surface, or below the gap at rest where that
                             is less than 0; at contacts with C >= 1/2 */
    double bone_area_mm2, lip_area_mm2, pressure_kpa; /* of touching nodes; largest */
    double energy_uj;
    int free_iterations, contact_iterations; /* phases A and B, all loads */
    int refreshes, stiffenings, corrections;
    double refresh_change_mm;               /* of the active gaps in the last refresh */
    double slide_off_mm;                    /* farthest that the last refresh moved a sliding node back to its level */
    int32_t uncoupled;                      /* lip contacts whose coupling was not in the matrix at its last filling */
    double bone_force_mn[SEGMENT_COUNT][3]; /* on the tissue */
} contact_report;

#ifdef __cplusplus
}
#endif
