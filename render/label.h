/* label: text, scale bars, colour bars, side marks and legends on an image.
 *
 * A pen writes on one image with one font file, named and not searched for, so that a system's font settings
 * do not change a picture. Positions are pixels from the top left; sizes are font heights in pixels; colours
 * sRGB 0..1. */
#pragma once
#include "render/camera.h"
#include "render/colormap.h"
#include "render/image.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct label_fonts { /* files */
    const char *regular, *bold;
} label_fonts;

label_fonts label_fonts_default(void); /* DejaVu Sans where Debian's fonts-dejavu-core puts it */

typedef enum label_align { LABEL_LEFT, LABEL_CENTRE, LABEL_RIGHT } label_align;

typedef struct pen pen;

/* Borrows the image until pen_close, which writes the labels into it. Refuses (ERR_RESOURCE) a font file that
 * is missing or not a font. */
bool pen_open(image *im, const label_fonts *fonts, pen **out, err *e) MUST_CHECK;
void pen_close(pen **p); /* idempotent */

/* y is the base line. Text is UTF-8. */
void pen_text(pen *p, double x, double y, label_align align, double size, bool bold, const double rgb[3],
              const char *text);
double pen_text_width(pen *p, double size, bool bold, const char *text);
void pen_box(pen *p, double x, double y, double width, double height, const double rgb[3], double opacity);
void pen_line(pen *p, double x0, double y0, double x1, double y1, double width, const double rgb[3]);
void pen_dot(pen *p, double x, double y, double radius, const double rgb[3]); /* with a white rim */
/* A circle with a letter in it, e.g. "R". */
void pen_badge(pen *p, double x, double y, double radius, const double rgb[3], const char *letter);

/* A bar of exactly length_mm * pixels_per_mm pixels from (x, y) to the right, with end ticks, one tick per 10
 * mm and its length above. True for orthographic cameras. */
void label_scale_bar(pen *p, double x, double y, double pixels_per_mm, double length_mm, double size);
/* The longest of 10, 20, 50, 100 mm that is at most a third of the picture wide; 10 if none is. */
double label_scale_length(double pixels_per_mm, int width);

typedef struct label_map {
    colormap map;
    double low, high;
    double fade_end; /* as in layer: from low to here the bar passes from fade_rgb into the map */
    double fade_rgb[3];
    const char *caption; /* with the unit, e.g. "displacement, mm" */
} label_map;

/* A horizontal bar with ticks and numbers above. */
void label_color_bar(pen *p, double x, double y, double width, double height, double size, const label_map *m);

/* R and L at the borders of the area (x, y, width, height) where the view shows the patient's two sides; in a
 * profile the one side that faces the viewer, at the left border. Goes by the camera, so that a mirrored
 * camera is found out. */
void label_sides(pen *p, double x, double y, double width, double height, double size, const camera *c,
                 const head_frame *frame);

typedef struct label_point {
    const char *text;
    double xyz[3];
} label_point;

/* Names of points in two columns at the borders of a picture that fills the image, half of them each, with a
 * thin line to the point. seen[count] (may be NULL) leaves out the hidden ones; see picture_render. */
void label_points(pen *p, const image *im, double size, const camera *c, const label_point *points, int count,
                  const uint8_t *seen);

/* Names in one column to the left of all points, each on a thin line to its point; for profiles that look
 * left. */
void label_column(pen *p, int width, int height, double size, const camera *c, const label_point *points, int count);

typedef struct label_entry {
    const char *text;
    double rgb[3];
} label_entry;

/* Colour swatches with names, one below the other; y is the top. Returns the height used. */
double label_legend(pen *p, double x, double y, double size, const label_entry *entries, int count);

#ifdef __cplusplus
}
#endif
