/* check_parts: the surfaces of a head against each other: which bone holds the teeth, lies above, is there twice, faces
 * inwards. What names and label numbers say is not believed. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "geometry/nearest.h"

/* mesh[i] without triangles: not there. name[i]: its file, for messages. Makes tree[i] over each that is there, NULL
 * for the others and where that is refused, which is an error among the issues; the caller destroys them. */
void check_trees(const surface mesh[CASE_SURFACE_COUNT], const char *const name[CASE_SURFACE_COUNT],
                 nearest *tree[CASE_SURFACE_COUNT], issue_list *issues);
/* A part that its file holds twice or of two people, and stairs of thick slices. */
void check_pieces(const surface *s, const char *file, case_surface part, issue_list *issues);
void check_slices(const surface *s, const char *file, case_surface part, issue_list *issues);
/* Whether the head lies in LPS, as its jaws show; tree: over the mandible. sure: an error, not a warning. False: told.
 */
bool check_axes(const surface *skull, const surface *mandible, const nearest *tree, bool sure, const char *file,
                issue_list *issues);
void check_parts(const surface mesh[CASE_SURFACE_COUNT], const char *const name[CASE_SURFACE_COUNT],
                 nearest *const tree[CASE_SURFACE_COUNT], issue_list *issues);
