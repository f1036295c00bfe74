/* vtk_xml: what the writers of VTK's XML files with raw appended data share. Private. */
#pragma once
#include "geometry/mesh_file.h"
#include <stdint.h>
#include <stdio.h>

/* Announces a block of the appended part; returns the offset past it (an 8-byte length, then the data). */
uint64_t vtk_announce(FILE *to, const char *type, const char *name, int components, uint64_t bytes, uint64_t offset);
void vtk_put_block(FILE *to, const void *data, uint64_t bytes);
/* The same for arrays of doubles on `points` points, whose names must be plain. */
uint64_t vtk_announce_arrays(FILE *to, const point_array *arrays, int count, uint64_t points, uint64_t offset);
void vtk_put_arrays(FILE *to, const point_array *arrays, int count, uint64_t points);
