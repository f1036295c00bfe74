/* plane_file: cut planes as 3D Slicer plane markups (.mrk.json). */
#pragma once
#include "geometry/err.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct cut_plane {
    char label[64];
    double point[3];  /* LPS mm */
    double normal[3]; /* unit */
} cut_plane;

/* Reads all planes of the file (planeType 3Points or PointNormal, LPS or RAS). A plane is named by "name",
 * which our files have, else by the file. The caller frees *out. Refuses (ERR_INPUT, with file and line)
 * fitted planes, points on one line, equal names. */
bool planes_read(const char *path, cut_plane **out, int *count, err *e) MUST_CHECK;
/* Writes three-point planes without matrices, which every version of the reader understands alike. */
bool planes_write(const cut_plane *planes, int count, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
