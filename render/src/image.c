#include "render/image.h"
#include "geometry/mem.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

image image_new(int width, int height)
{
    assert(width > 0 && height > 0 && width <= IMAGE_SIZE_MAX && height <= IMAGE_SIZE_MAX);
    return (image){.width = width, .height = height, .rgba = NEW_ARRAY(uint8_t, 4 * (size_t)width * (size_t)height)};
}

void image_free(image *im)
{
    free(im->rgba);
    *im = (image){0};
}

uint8_t *image_pixel(const image *im, int x, int y)
{
    assert(x >= 0 && y >= 0 && x < im->width && y < im->height);
    return im->rgba + 4 * ((size_t)y * (size_t)im->width + (size_t)x);
}

static uint8_t byte_of(double c) { return (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5); }

void image_fill(image *im, const double rgb[3])
{
    uint8_t pixel[4] = {byte_of(rgb[0]), byte_of(rgb[1]), byte_of(rgb[2]), 255};
    for (size_t i = 0; i < (size_t)im->width * (size_t)im->height; i++) memcpy(im->rgba + 4 * i, pixel, 4);
}

void image_paste(image *to, const image *from, int x, int y)
{
    int first = x < 0 ? -x : 0, last = from->width < to->width - x ? from->width : to->width - x;
    if (last <= first) return;
    for (int row = 0; row < from->height; row++)
        if (row + y >= 0 && row + y < to->height)
            memcpy(image_pixel(to, x + first, row + y), image_pixel(from, first, row), 4 * (size_t)(last - first));
}

image image_half(const image *im)
{
    image half = image_new(im->width / 2, im->height / 2);
    for (int y = 0; y < half.height; y++)
        for (int x = 0; x < half.width; x++) {
            const uint8_t *a = image_pixel(im, 2 * x, 2 * y), *b = image_pixel(im, 2 * x, 2 * y + 1);
            uint8_t *to = image_pixel(&half, x, y);
            for (int c = 0; c < 4; c++) to[c] = (uint8_t)((a[c] + a[c + 4] + b[c] + b[c + 4] + 2) / 4);
        }
    return half;
}

int64_t image_difference(const image *a, const image *b, int tolerance)
{
    if (a->width != b->width || a->height != b->height) return -1;
    int64_t count = 0;
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height; i++) {
        bool differs = false;
        for (size_t c = 0; c < 4; c++) differs |= abs(a->rgba[4 * i + c] - b->rgba[4 * i + c]) > tolerance;
        count += differs;
    }
    return count;
}
