/* signed_picture: the signed distance between two faces as pictures. Needs GNATHOS_RENDER. */
#pragma once
#include "app/face_compare.h"

enum { SIGNED_PICTURES = 3 };
extern const char *const signed_picture_name[SIGNED_PICTURES]; /* "signed_front.png", ... */

/* The predicted face from the front and both sides; red where the actual one lies in front, blue behind, one range
 * symmetric about 0. paths[SIGNED_PICTURES]. Refuses what studio_open and png_file_write refuse. */
bool signed_pictures_write(const face_compare *c, char *const paths[SIGNED_PICTURES], err *e) MUST_CHECK;
