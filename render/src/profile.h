/* Private: drawings in the midsagittal plane, seen from the patient's left; planes and curves of both poses.
 */
#pragma once
#include "render/src/gallery.h"

typedef struct profile { /* an area of an image with its camera: what is drawn goes through both */
    gallery *g;
    pen *p;
    camera view;
    int width, height; /* pixels of the area, from the image's top left */
    double middle[3];  /* a point of the midsagittal plane */
    double size;       /* of text */
} profile;

extern const double profile_rgb[2][3], profile_same_rgb[3]; /* before, planned; what is the same in both */

/* A sheet of paper with the midline of the subject's landmarks; the camera shows all points of `labels` (a
 * NULL ends the list) of both poses, and margin_mm more. */
bool profile_open(gallery *g, const char *const *labels, double margin_mm, int width, int height, profile *out,
                  err *e) MUST_CHECK;
double profile_text_size(int height);
/* Is there room for a table beside the drawing? */
bool profile_has_table(const gallery *g, int width, int height);
/* Is the landmark there? A name without sides may be a mean: "Go" of Go_L and Go_R. */
bool profile_point(const profile *f, bool after, const char *label, double xyz[3]);
void profile_line(const profile *f, const double a[3], const double b[3], double width, const double rgb[3]);
void profile_dot(const profile *f, const double at[3], double radius, const double rgb[3]);
/* Where the midsagittal plane cuts the skin or the bones of a pose; what does not move in its own colour. */
void profile_skin(const profile *f, bool after, double width);
void profile_bones(const profile *f, bool after, double width);

/* Whole panels of it, with their labels: profiles over a grid; lines and planes of cephalometry. *out is created; the
 * caller frees it. */
bool contour_draw(gallery *g, int width, int height, image *out, err *e) MUST_CHECK;
bool tracing_draw(gallery *g, int width, int height, image *out, err *e) MUST_CHECK;
