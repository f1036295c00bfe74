/* head: one head in the numbering of the template. The template says how vertices and nodes hang together; a shape says
 * where they are in one patient. Specification 1.1 to 1.3. All coordinates LPS mm; a shape in the template's own frame
 * has the middle between the porions as origin and the Frankfort plane at z = 0. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "app/planner/store/content_hash.h"
#include "geometry/landmarks.h"
#include "geometry/tissue.h"

/* Where a landmark hangs. */
typedef struct head_point {
    char label[LANDMARK_LABEL_SIZE];
    int32_t part;     /* case_surface that carries it */
    int32_t triangle; /* of that part; -1: inside the head, moved as the part's vertices around it (affine) */
    double weight[3]; /* barycentric in the triangle, sum 1 */
    double at[3];     /* in the template */
} head_point;

typedef struct head_template {
    int32_t version;                    /* of the numbering: never the same number for another one */
    char numbering[HASH_TEXT_SIZE];     /* hash of every whole number below: what hangs together with what */
    char hash[HASH_TEXT_SIZE];          /* of everything below */
    surface part[CASE_SURFACE_COUNT];   /* skin, skull, mandible, teeth, at neutral; closed, outward */
    int32_t *tooth[CASE_SURFACE_COUNT]; /* [vertex_count] number of its tooth from 0; NULL for what are no teeth */
    tissue tissue;                      /* ST at neutral, lips in contact and not one in the other */
    double *rest;                       /* [3*nodes] ST at rest: the lips overlap slightly */
    embedding skin_on_tissue;           /* a point for each vertex of the skin; those off the tissue are not carried */
    int32_t point_count;
    head_point *point;
} head_template;

/* What differs from head to head: owned arrays in the template's numbering. */
typedef struct head_shape {
    double *part[CASE_SURFACE_COUNT]; /* [3*vertex_count] */
    double *rest, *neutral;           /* [3*nodes] of the tissue */
} head_shape;

void head_template_free(head_template *t);
head_shape head_shape_of(const head_template *t); /* the template's own; the caller frees */
void head_shape_free(head_shape *s);
/* The smallest J of a tet in this shape against the template, at rest and at neutral; *inverted: how many are inside
 * out. */
double head_min_j(const head_template *t, const head_shape *s, int32_t *inverted);
/* The surface of a part in this shape; the caller frees. */
surface head_part(const head_template *t, const head_shape *s, case_surface part);
/* Every landmark of the template on this shape; the caller frees. */
landmarks head_points(const head_template *t, const head_shape *s);
