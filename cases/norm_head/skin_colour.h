/* skin_colour: the colour of the skin of the mean head. */
#pragma once
#include "geometry/surface.h"

/* rgb[3*vertex_count], 0..255: lips, cheeks, brows, lash lines and cropped hair. Of the unwarped skin. The caller frees
 * it.
 */
uint8_t *skin_colours(const surface *skin);
