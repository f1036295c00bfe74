/* ply_check: whether the header of a .ply file is one that CGAL reads right, and the file large enough for what it
 * promises. CGAL 5.5 trusts both: it takes room for a false length, runs past its own arrays for a property without an
 * element, and reads past types and names that it does not know. */
#pragma once
#include "geometry/err.h"

/* Refuses (ERR_INPUT), with the line, what is not a header of vertices with x, y, z and faces; counts that the file
 * cannot hold; and lists of a face that end behind the file. */
bool ply_check(const char *path, err *e) MUST_CHECK;
