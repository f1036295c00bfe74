/* teeth: the 28 teeth of the mean head: where they stand, and their shapes as closed surfaces. */
#pragma once
#include "geometry/surface.h"
#include <stdbool.h>

enum { TEETH_PER_SIDE = 7 }; /* central incisor ... second molar; no third molars */

typedef struct tooth {
    double tip[3];  /* middle of the edge or of the occlusal table, template frame, left side */
    double axis[3]; /* from the tip towards the root apex */
    double yaw_deg; /* direction of the outer (lip or cheek) face: 0 forwards, 90 to the side */
    double width_mm, depth_mm, crown_mm, root_mm; /* mesiodistal, outer-inner, Wheeler/Ash */
} tooth;

extern const tooth upper_teeth[TEETH_PER_SIDE], lower_teeth[TEETH_PER_SIDE];

/* One closed outward shell: crown and a single conical root (roots of molars are not divided). `place` is the
 * number in the quadrant, 0 the central incisor. right: mirrored to -x. The caller frees it. */
surface tooth_surface(const tooth *t, int place, bool right);
/* A point of the tooth in the template: `along` mm from the tip towards the apex, `outer` mm towards lip or
 * cheek, `mesial` mm towards the midline. */
void tooth_point(const tooth *t, double along, double outer, double mesial, bool right, double p[3]);
