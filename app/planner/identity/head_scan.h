/* head_scan: the surfaces of a patient as they were read, for whoever needs no landmark: no repair, no cuts. LPS mm. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "geometry/landmarks.h"

typedef struct head_scan {
    surface part[CASE_SURFACE_COUNT]; /* empty where the patient has none; may be open, torn, of several layers */
    landmarks points;                 /* none, or those that the case names */
} head_scan;

/* Reads what the case names; of its landmarks only where with_points. Refuses (ERR_INPUT) a case without a skin, and
 * what mesh_file_read and landmarks_read refuse. The caller frees *out. */
bool head_scan_read(const case_file *c, bool with_points, head_scan *out, err *e) MUST_CHECK;
void head_scan_free(head_scan *s);
