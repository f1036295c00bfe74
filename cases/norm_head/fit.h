/* fit: last corrections of a shaped head: teeth that meet without overlap, skin that keeps clear of the
 * bones. */
#pragma once
#include "geometry/surface.h"

/* Largest depth in mm to which vertices of `lower` lie inside shells of `upper`, only those behind y =
 * front_mm (the incisors overlap from the front, which the overjet decides). */
bool fit_overlap(const surface *upper, const surface *lower, double front_mm, double *depth_mm, err *e) MUST_CHECK;

/* Moves the skin outwards, smoothly, until no vertex lies closer to bone than least_mm (to 0.1 mm, at most 8
 * rounds). exempt[vertex_count]: the walls of the nostrils may be nearer; they move along. *left_mm: the
 * smallest distance that remains. */
bool fit_clear(surface *skin, const bool *exempt, const surface *const *bones, int bone_count, double least_mm,
               double *left_mm, err *e) MUST_CHECK;
