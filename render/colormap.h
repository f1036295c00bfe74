/* colormap: numbers to colours, 256 entries, perceptually ordered.
 *
 * VIRIDIS (dark violet to yellow), for magnitudes: S. van der Walt and N. Smith 2015, released under CC0;
 * here the public-domain (CC0) degree-6 polynomial fit by M. Zucker, within 0.025 of the original at its
 * quarter points. COOLWARM (blue - light grey - red), for signed values, symmetric about 0: K. Moreland,
 * "Diverging Color Maps for Scientific Visualization", ISVC 2009, the Msh interpolation between (59,76,192)
 * and (180,4,38). */
#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

enum { COLORMAP_SIZE = 256 };

typedef enum colormap { COLORMAP_VIRIDIS, COLORMAP_COOLWARM } colormap;

/* sRGB, [3*COLORMAP_SIZE]; made once, lives as long as the program. */
const uint8_t *colormap_table(colormap map);
/* sRGB colour of value in [low, high]; beyond an end the colour of that end, for NaN
 * colormap_no_data. */
void colormap_color(colormap map, double value, double low, double high, double rgb[3]);
extern const double colormap_no_data[3]; /* a neutral grey that neither map holds */
/* One channel between sRGB and linear light, 0..1. */
double colormap_linear(double srgb);
double colormap_encode(double linear);
/* The smallest of 1, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is >= x; 1 for x <= 0 or not finite. */
double colormap_nice_ceiling(double x);

#ifdef __cplusplus
}
#endif
