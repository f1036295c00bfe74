/* Private: the frame buffers a picture goes through. */
#pragma once
#include "render/src/gl.h"

typedef struct canvas { /* samples, their mean per pixel, final pixels */
    int width, height;  /* 0: none */
    GLuint many, many_colour, many_depth, one, one_colour, one_depth, final, final_colour;
} canvas;

/* On refusal canvas_close is still to be called; it leaves zero. */
bool canvas_open(const gl *g, int width, int height, canvas *out, err *e) MUST_CHECK;
void canvas_close(const gl *g, canvas *c);
