/* fcsv: the older point lists of 3D Slicer (comma separated, read only). Private. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>

typedef struct fcsv_row {
    char label[256];
    double xyz[3]; /* LPS mm */
    bool defined;  /* its position was placed */
    int line;
} fcsv_row;

typedef struct fcsv_file {
    int32_t count;
    fcsv_row *row;
} fcsv_file;

/* Needs the line "# CoordinateSystem = LPS|RAS|0|1" (0 is RAS, 1 is LPS): without it the side of a point is a
 * guess. Columns are found by the line "# columns = id,x,y,z,...", or have that standard order. The caller
 * frees *out. */
bool fcsv_read(const char *path, fcsv_file *out, err *e) MUST_CHECK;
void fcsv_free(fcsv_file *f);
