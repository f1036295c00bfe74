/* backend: six functions between the drawing code and whatever gives it OpenGL 3.3 core without a window. One
 * source file implements them (context_osmesa.c); a build picks exactly one. */
#pragma once
#include "geometry/err.h"

typedef struct backend backend;
typedef void (*backend_function)(void);

/* Refuses (ERR_RESOURCE) with the name of what is missing. */
bool backend_open(backend **out, err *e) MUST_CHECK;
void backend_close(backend **b); /* idempotent */
/* Makes the context current in the calling thread. */
bool backend_bind(backend *b, err *e) MUST_CHECK;
void backend_unbind(backend *b);
backend_function backend_proc(const backend *b, const char *name); /* NULL if there is none */
const char *backend_name(const backend *b);
