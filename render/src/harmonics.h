/* Private: spherical harmonics up to degree 2, in which light and what reaches a vertex of it are kept. */
#pragma once

enum { HARMONICS = 9 };

/* Of the unit vector d; real, orthonormal. */
void harmonics_at(const double d[3], double y[HARMONICS]);
/* What a vertex with this unit normal passes on of each when nothing hides the sky from it. */
void lobe_at(const float normal[3], float t[HARMONICS]);
/* Direction i of n, spread evenly over the sphere (Fibonacci spiral). */
void sphere_direction(int i, int n, double d[3]);
