/* head_vector: a head as one vector, phi of the specification (1.2): the tissue at rest, the tissue at neutral, skull,
 * mandible, upper and lower teeth, in the head's own Frankfort frame, and the skin. The skin is there whole, though
 * most of it hangs on the tissue: that behind the ears and at the crown does not, and a head without it is none. */
#pragma once
#include "app/planner/identity/head.h"

typedef enum head_block {
    HEAD_REST,
    HEAD_NEUTRAL,
    HEAD_SKULL,
    HEAD_MANDIBLE,
    HEAD_UPPER_TEETH,
    HEAD_LOWER_TEETH,
    HEAD_SKIN,
    HEAD_BLOCK_COUNT
} head_block;

const char *head_block_name(head_block b); /* "tissue at rest", ... */
int head_block_surface(head_block b);      /* a case_surface; -1: tissue */

typedef struct head_layout {
    int32_t start[HEAD_BLOCK_COUNT + 1]; /* first coordinate of each block; the last is the length */
} head_layout;

head_layout head_layout_of(const head_template *t);
/* Turns and shifts the shape, nothing else: the middle between its porions becomes the origin, its Frankfort plane z =
 * 0. *move (may be NULL) is what was done. Refuses what head_frame_from_landmarks refuses. */
bool head_shape_to_frankfort(const head_template *t, head_shape *s, rigid *move, err *e) MUST_CHECK;
/* phi[length]; and back, which the caller frees. */
void head_vector_of(const head_template *t, const head_shape *s, double *phi);
head_shape head_vector_shape(const head_template *t, const double *phi);
/* What each coordinate stands for: a third of the area of a surface around its vertex or a quarter of the volume of the
 * tetrahedra around its node, as a share of its block, so that no block counts for more because it is finer or because
 * mm^3 are not mm^2; tissue at rest and at neutral count as one. |phi|^2 is then the sum over skull, mandible, the two
 * rows of teeth, skin and tissue of their mean square. The caller frees. */
double *head_vector_weights(const head_template *t);

typedef struct head_gap { /* between two heads of one numbering: of vertices to the same vertices */
    double mean_mm, p95_mm, max_mm;
} head_gap;
enum { HEAD_FACE = HEAD_BLOCK_COUNT, HEAD_GAP_COUNT };
/* For each block, and for the face: that part of the skin that hangs on the tissue. Vertices of which known[length] is
 * 0 do not count; NULL: all do. NaN where none does. */
void head_vector_gaps(const head_template *t, const double *a, const double *b, const double *known,
                      head_gap out[HEAD_GAP_COUNT]);
const char *head_gap_name(int block); /* of a block, or "face" */
