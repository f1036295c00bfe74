/* point_carry: better places to seek a landmark from than those to which the template carried it, by what is known of
 * others. All in the Frankfort frame, mm; now: the points as far as they are found; x[3] stays where others tell
 * nothing. */
#pragma once
#include "app/planner/identity/point_rules.h"
#include "geometry/landmarks.h"

/* Once the rule's anchor has found its own place. */
void point_carry_by_anchor(const point_rule *r, int side, const landmarks *carried, const landmarks *now, double x[3]);
/* In an open mouth, the height of the lower row of teeth. */
void point_carry_to_occlusion(const landmarks *now, double x[3]);
/* Of how many molars a row is that is one with its bone nobody can see: it ends where the ramus rises, on the parabola
 * through the incisors, its vertex, and the first molars. */
void point_carry_to_ramus(const landmarks *now, int side, double x[3]);
