/* image: 8-bit RGBA pixels, rows from the top down, straight (not premultiplied) alpha, sRGB. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

enum { IMAGE_SIZE_MAX = 16384 }; /* pixels along one side */

typedef struct image {
    int width, height;
    uint8_t *rgba; /* [4*width*height] */
} image;

image image_new(int width, int height); /* transparent black */
void image_free(image *im);             /* idempotent, leaves zero */
void image_fill(image *im, const double rgb[3]);
/* First byte of the pixel in column x, row y. */
uint8_t *image_pixel(const image *im, int x, int y);
/* Copies `from` into `to` with its top left corner at (x, y); what falls outside is dropped. */
void image_paste(image *to, const image *from, int x, int y);
/* The mean of each 2 x 2 pixels; an odd last row or column is dropped. */
image image_half(const image *im);
/* The number of pixels of which some channel differs by more than `tolerance` (0..255); -1 if the sizes
 * differ. */
int64_t image_difference(const image *a, const image *b, int tolerance);

#ifdef __cplusplus
}
#endif
