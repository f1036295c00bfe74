/* Private: what picture_render draws into the bound canvas. */
#pragma once
#include "render/picture.h"
#include "render/src/gl.h"
#include <stddef.h>

/* World to clip, column-major, seen `toward_mm` nearer than it is (0 for surfaces; lines lie a little above).
 */
void clip_matrix(const camera *c, int width, int height, double toward_mm, float m[16]);
void set_rgb(const gl *g, GLuint program, const char *name, const double srgb[3], bool to_linear);
void set_float(const gl *g, GLuint program, const char *name, double x);
void set_move(const gl *g, GLuint program, const rigid *a);
GLuint load_floats(const gl *g, const float *values, size_t count); /* a buffer for one picture */

void draw_opaque_layers(studio *s, const picture *p, int width, int height);
void draw_clear_layers(studio *s, const picture *p, int width, int height); /* in their order, after all else */
/* Marks and strokes that are hidden by layers, or those on top. */
void draw_extras(studio *s, const picture *p, int width, int height, bool on_top);
/* Which marks can be seen: nothing lies more than its own lift in front. Reads the depth of what is drawn. */
void look_for_marks(studio *s, const picture *p, int width, int height, uint8_t *seen);
