/* landmarks: named anatomical points. Coordinates LPS mm. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

enum { LANDMARK_LABEL_SIZE = 32 };
/* Beyond this doubt a point that gnathos placed is not used without being looked at. */
#define LANDMARK_DOUBT_MOST_MM 5.0

typedef struct landmark {
    char label[LANDMARK_LABEL_SIZE]; /* "N", "Or_L", "Pg'" ... */
    double xyz[3];
    double doubt_mm; /* 0: placed by hand; else by gnathos, which takes it to be about so far off */
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
/* How many gnathos placed, with their labels in a line (at most size bytes with the end; size 0: none). */
int32_t landmarks_automatic(const landmarks *l, char *names, size_t size);

/* 3D Slicer Markups JSON (.mrk.json, Fiducial lists and curves, LPS or RAS, mm) and legacy .fcsv (read only; must name
 * its coordinate system). Names of automatic tools become ours (landmark_names.h). Points whose positionStatus is not
 * "defined" are skipped and counted in *skipped (may be NULL). Refuses (ERR_INPUT, with file and line) duplicate, empty
 * or longer than 31-byte labels, non-finite or missing positions, units other than mm, a file without any defined
 * point. */
bool landmarks_read(const char *path, landmarks *out, int32_t *skipped, err *e) MUST_CHECK;
/* A doubt is told in the point's description, from which it is read again: "placed by gnathos, about 1.3 mm". Points
 * with more than most_mm of doubt are written as not placed ("preview" in Slicer), so that nothing uses them unseen. */
bool landmarks_write(const landmarks *l, const char *path, err *e) MUST_CHECK;
bool landmarks_write_sure(const landmarks *l, double most_mm, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
