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

/* Reads all planes of the file (three-point and matrix kinds, LPS or RAS). The caller frees *out. */
bool planes_read(const char *path, cut_plane **out, int *count, err *e) MUST_CHECK;
/* Writes three-point planes, which every version of the reader understands alike. */
bool planes_write(const cut_plane *planes, int count, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
