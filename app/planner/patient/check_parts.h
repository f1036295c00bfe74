/* check_parts: the surfaces of a head against each other: which bone holds the teeth, lies above, is there twice, faces
 * inwards. What names and label numbers say is not believed. */
#pragma once
#include "app/planner/patient/case_file.h"

/* mesh[i] with vertex_count 0: not there. name[i]: its file, for messages. */
void check_parts(const surface mesh[CASE_SURFACE_COUNT], const char *const name[CASE_SURFACE_COUNT],
                 issue_list *issues);
