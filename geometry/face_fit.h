/* face_fit: an actual face laid onto a predicted one, and whether the two are one face in one system of axes. */
#pragma once
#include "geometry/face_regions.h"
#include "geometry/surface_compare.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Turns the triangles of a skin over if they face inwards, by the normals of the face's front against `posterior` (unit
 * vector): a scan is open, so that its volume tells nothing. True: they were turned. */
bool face_outward(surface *skin, const face_map *m, const double posterior[3]);

/* surface_fit_rigid on m->stable. Refuses (ERR_GEOMETRY) what it refuses, and faces that do not fit then: more than 2
 * mm RMS apart on the stable skin, or more than 8 mm on average at the nose, which no operation of the jaws moves so
 * far (own limits). Names the change of the actual face's axes that would mend it, where one does. */
bool face_fit(const surface *actual, const surface *predicted, const face_map *m, surface_fit *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
