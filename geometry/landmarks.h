/* landmarks: named anatomical points. Coordinates LPS mm. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

enum { LANDMARK_LABEL_SIZE = 32 };

typedef struct landmark {
    char label[LANDMARK_LABEL_SIZE]; /* "N", "Or_L", "Pg'" ... */
    double xyz[3];
} landmark;

typedef struct landmarks {
    int32_t count;
    landmark *point; /* [count] labels are unique */
} landmarks;

void landmarks_free(landmarks *l);
landmarks landmarks_copy(const landmarks *l);
/* NULL if there is none. */
const landmark *landmarks_find(const landmarks *l, const char *label);
/* Appends or replaces. The label has 1 to 31 bytes. */
void landmarks_set(landmarks *l, const char *label, const double xyz[3]);

/* 3D Slicer Markups JSON (.mrk.json, Fiducial lists and curves, LPS or RAS, mm) and legacy .fcsv (read only; must name
 * its coordinate system). Names of automatic tools become ours (landmark_names.h). Points whose positionStatus is not
 * "defined" are skipped and counted in *skipped (may be NULL). Refuses (ERR_INPUT, with file and line) duplicate, empty
 * or longer than 31-byte labels, non-finite or missing positions, units other than mm, a file without any defined
 * point. */
bool landmarks_read(const char *path, landmarks *out, int32_t *skipped, err *e) MUST_CHECK;
bool landmarks_write(const landmarks *l, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
