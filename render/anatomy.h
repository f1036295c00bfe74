/* anatomy: pictures of a case before any plan: the segments pulled apart, and the landmarks on skin and bone.
 */
#pragma once
#include "render/gallery.h"
#include "geometry/landmarks.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct anatomy_piece {
    subject_part part;  /* drawn at part.before */
    double apart_mm[3]; /* and moved by this, for the exploded picture */
} anatomy_piece;

/* A useful direction to pull a segment: what moves down goes down, the proximal segments to their sides; in
 * the axes of the head, `distance_mm` long. The cranium stays. */
void anatomy_apart(segment_id id, const head_frame *frame, double distance_mm, double out[3]);

/* Three-quarter left | left profile of the pieces pulled apart, with legend, to one file of width x height
 * pixels. `text` is the title. cuts (may be NULL) are drawn as lines where they are on the whole bone.
 * Refuses what gallery_draw refuses. */
bool anatomy_exploded_write(const anatomy_piece *pieces, int count, const stroke *cuts, int cut_count,
                            const head_frame *frame, const char *text, const gallery_style *style, int width,
                            int height, const char *path, err *e) MUST_CHECK;

/* Front | left profile with a ball and the name of every landmark (the profile leaves out those that end in
 * _R). Soft-tissue points (a label that ends in ' or is one of Pn Sn Ls Stm Stms Stmi Li_soft C and the Al,
 * Ch, En, Ex, T pairs) are red, bony ones blue. skin (NULL) or bones (0) may be left out; the skin is clear
 * over the bones. */
bool anatomy_landmarks_write(const surface *skin, const subject_part *parts, int part_count, const landmarks *points,
                             const head_frame *frame, const char *text, const gallery_style *style, int width,
                             int height, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
