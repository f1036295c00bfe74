/* contact_state: what could touch what, and what does. */
#pragma once
#include "sim/assemble.h"
#include "sim/boundary.h"
#include "sim/contact.h"
#include "sim/src/contact/contact_imls.h"

enum { COLLIDER_UPPER = SEGMENT_COUNT, COLLIDER_LOWER, COLLIDER_COUNT }; /* after the bones: the lips */

/* One node against one collider. */
typedef struct contact_link {
    int32_t collider;
    bool left_out, near;
    bool guard;   /* no contact: a plane behind which the node must not get, where `near`; of the bone of the
                     link before */
    bool at_face; /* a guard's plane: not inside the bone, but at its face */
    bool flat;    /* a bone's shape is seen as the plane base + m.x: the nearest way out leads to the wrong side */
    bool faced;   /* at rest the node lay over the lip, not beside it: if it gets deep, it is brought back */
    int turns;    /* of flat, since contact_restart */
    double threshold_mm;  /* tau */
    double depth_from_mm; /* what depth is measured from: min(0, gap at rest) */
    double stiffening;
    double off_mm; /* by so much the bone's smooth distance is too large about the node */
    /* frozen at refresh */
    bool lost;                    /* given up, see contact_report */
    double cover;                 /* C(S) of a lip, 1 of a bone */
    double base, m[3];            /* flat: gap = base + m.x in the bone's place at rest; */
    int32_t count, room, *sample; /* lips: gap = base + m.(x - sum weight x_sample) */
    double *weight;
    /* of the last contact_energy */
    double gap, delta, force[3];                     /* delta = tau - gap where positive and covered, else 0; dE/dx */
    double delta_before, delta_factored, delta_here; /* at the last refresh, in the matrix, at contact_mark */
} contact_link;

static inline bool is_lip(const contact_link *link) { return link->collider >= SEGMENT_COUNT; }

typedef struct contact {
    contact_setup setup;
    double k; /* kPa/mm2 */
    int32_t mesh_node_count, node_count;
    int32_t *node;          /* [node_count] mesh numbers */
    double *area, *outward; /* rest: mm2; unit, out of the tissue */
    double *around;         /* stiffness of the tissue at the node when the matrix was filled, mN/mm */
    int8_t *level_segment;  /* [node_count] held: the bone that a sliding node follows, else -1 */
    double *level_mm;       /* its distance from it */
    int32_t *own_sample;    /* [node_count] number in its own lip's cloud, -1: no lip */
    imls_cloud cloud[2];    /* upper lip, lower lip */
    int32_t *lip_node[2], *lip_tri[2], lip_tri_count[2]; /* mesh numbers of samples; triangles of samples */
    double motion_reach_mm;                              /* a node that is deeper in a lip is behind it */
    const double *rest_xyz;                              /* [3*mesh nodes] borrowed */
    rigid motion[SEGMENT_COUNT], back[SEGMENT_COUNT], guide;
    int32_t link_count, *link_start; /* [node_count + 1] */
    contact_link *link;
    double *energy;
    int32_t coupling_count, *coupling; /* [2*count] mesh nodes that lips couple, low < high */
    contact_report report;             /* running counts */
} contact;

/* attach: as the caller gave it, with sliding and paired nodes. Refuses (ERR_INPUT) parameters out of range,
 * sliding nodes whose segment has no shape, one lip without the other, too fine lips and broken face lists. */
bool contact_make(const tetmesh *m, const attach_map *attach, const contact_setup *setup, double young_kpa,
                  contact **out, err *e) MUST_CHECK;
void contact_destroy(contact **c);
/* A copy of the map in which sliding nodes are free, and pairs too where both nodes are in faces of their
 * lips. */
attach_map contact_loosened(const attach_map *attach, const contact_setup *setup);

/* Forgets stiffenings, corrections and counts of the last plan. */
void contact_restart(contact *c);
/* Forgets the counts of the last plan only: guards and stiffenings go on with their bones. */
void contact_resume(contact *c);
/* Takes over the guards and stiffenings of nodes and bones that both have. */
void contact_inherit(contact *c, const contact *before);
void contact_move(contact *c, const rigid motion[SEGMENT_COUNT], const rigid *guide, const double *rest_xyz);
/* Renews what each node sees of bones and lips at x[3*nodes]. */
void contact_refresh(contact *c, const double *x);
/* held: puts sliding nodes at x[3*nodes] back on their levels, to first order. */
void contact_retract(const contact *c, const attach_map *attach, double *x);
/* held: turns and shifts the planes of sliding nodes so that they touch their levels next to x[3*nodes].
 * Returns the farthest move of a node, mm; -1: none follows a level. Unknowns are to be projected anew else. */
double contact_follow(const contact *c, const attach_map *attach, boundary *b, const double *x);
/* Signed distance of a bone from a point at[3] in its own place at rest, HUGE_VAL: nothing is near. */
double contact_bone_gap(const contact *c, const contact_link *link, const double at[3], double grad[3], double *hess);
/* Energy in uJ; adds to force[3*nodes] (may be NULL). */
double contact_energy(contact *c, const double *x, double *force);
/* What rounding of x does to the forces of the last contact_energy, as a norm, mN. */
double contact_force_noise(const contact *c, const double *x);
/* Adds to a->edge_block; force[3*nodes] of the whole energy at x. exact: with the curvature of the distance
 * (indefinite), else Gauss-Newton. */
void contact_stiffness(contact *c, const double *x, const double *force, bool exact, assembly *a);
/* So deep that its curvature only misleads? */
bool contact_is_deep(const contact *c, double delta);
/* The links of the last contact_energy are those of the iterate from which steps are tried. */
void contact_mark(contact *c);
/* Bone contacts of the last contact_energy, at a trial point, whose depth the step did not foresee, new ones
 * above all: adds to z[unknowns] what brings their nodes out to where the tissue around them holds against
 * the contact, of second order in the step. One node of thousands would else cut the steps of all. What was
 * deep before is left to the steps: it is to come out together with the tissue around. Returns the farthest
 * move, mm. */
double contact_yield(const contact *c, const boundary *b, double *z);
/* Adds to force[3*nodes] what the bone contacts of the last contact_energy, at x, come to feel, to first order, where
 * nodes go by carried[3*nodes] and bones by `on`. */
void contact_carry(const contact *c, const rigid on[SEGMENT_COUNT], const double *x, const double *carried,
                   double *force);
/* Did a contact's stiffness change much since contact_stiffness? Both refer to the last contact_energy. */
bool contact_stiffness_is_old(const contact *c);
/* A shape knows its inside, but of a thin bone not the side from which the node came: where a node at
 * x[3*nodes] would be pushed on the way that it went, its link becomes the plane at its way back (flat).
 * Right through a bone it goes unseen. */
void contact_find_side(const contact *c, int32_t i, contact_link *link, const double *x);
/* Nodes outside a bone at x[3*nodes] that, as it seems, came through it. */
int32_t contact_passed(const contact *c, const double *x);
/* held: puts guards before those that hang on no bone, across the way that they should be pushed and just
 * inside the bone's face there, to stay until contact_restart; returns how many are new. */
int32_t contact_guard(contact *c, const double *x);
/* Of active gaps between the energies before and after the last refresh, mm. */
double contact_refresh_change(const contact *c);
/* Do two bones press the node against each other? Where bones overlap no force brings it out of both. */
bool contact_is_pinched(const contact *c, int32_t i);
/* Stiffens what is deeper than the limit, for contact_yield to follow; false: nothing is. */
bool contact_stiffen(contact *c);
/* Corrects the distance where by the exact one a node at x[3*nodes], which is that of the last contact_energy, is
 * deeper than exact_limit_mm; false: nowhere. */
bool contact_correct(contact *c, const double *x);
/* Norm of all contact forces of the last contact_energy, mN. */
double contact_force(const contact *c);
/* Of the last contact_energy. */
contact_report contact_measure(const contact *c);

/* Lips, contact_lips.c. Samples at their nodes, and what they couple; refuses what contact_make does of lips. */
bool contact_make_lips(contact *c, const tetmesh *m, err *e) MUST_CHECK;
/* Their samples at x[3*nodes]. */
void contact_move_lips(contact *c, const double *x);
/* How a node at x[3*nodes] lies to the other lip. */
typedef struct lip_view {
    int32_t nearest;           /* sample that faces it; -1: none, the rest is not known */
    double plane_mm, aside_mm; /* height over that one's plane; off its normal */
    bool deep;                 /* too deep for the plain support */
} lip_view;
lip_view contact_view_lip(const contact *c, int32_t i, const contact_link *link, const double *x);
/* What the node sees of it, frozen. */
void contact_refresh_lip(contact *c, int32_t i, contact_link *link, const double *x);
