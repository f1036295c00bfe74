/* signed_picture: the signed distance between two faces as a picture. Needs GNATHOS_RENDER. */
#pragma once
#include "app/planner/predict/face_compare.h"

/* The predicted face from the front and both sides; red where the actual one lies in front, blue behind, over
 * -range_mm to range_mm. Refuses what gallery_open and gallery_write refuse. */
bool signed_picture_write(const face_compare *c, const char *title, double range_mm, const char *path,
                          err *e) MUST_CHECK;
