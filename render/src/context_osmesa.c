/* Off-screen OpenGL through OSMesa, Mesa's software rasteriser without a window system (Mesa < 25.1). */
#include "render/src/backend.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <GL/osmesa.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 16 }; /* OSMesa wants a buffer to bind; all drawing goes to our own frame buffers */

struct backend {
    OSMesaContext context;
    unsigned char buffer[4 * SIDE * SIDE];
};

/* The rasteriser has threads of its own, as many as LP_NUM_THREADS says (0: none but the caller's) when the process
 * first draws; pictures do not depend on it. What the user has set stays. */
static void share_threads(void)
{
    char text[16];
    snprintf(text, sizeof text, "%d", parallel_threads() > 1 ? parallel_threads() : 0);
    setenv("LP_NUM_THREADS", text, 0);
}

bool backend_open(backend **out, err *e)
{
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     24,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    backend *b = mem_alloc(1, sizeof *b);
    share_threads();
    b->context = OSMesaCreateContextAttribs(attributes, NULL);
    if (!b->context) {
        free(b);
        return err_set(e, ERR_RESOURCE, "no pictures: OSMesa gives no OpenGL 3.3 core context (is libosmesa6 whole?)");
    }
    *out = b;
    return true;
}

void backend_close(backend **b)
{
    if (!*b) return;
    OSMesaDestroyContext((*b)->context);
    free(*b);
    *b = NULL;
}

bool backend_bind(backend *b, err *e)
{
    if (!OSMesaMakeCurrent(b->context, b->buffer, GL_UNSIGNED_BYTE, SIDE, SIDE))
        return err_set(e, ERR_RESOURCE, "no pictures: OSMesa cannot make its context current");
    return true;
}

void backend_unbind(backend *b)
{
    (void)b;
    OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
}

backend_function backend_proc(const backend *b, const char *name)
{
    (void)b;
    return (backend_function)OSMesaGetProcAddress(name);
}

const char *backend_name(const backend *b)
{
    (void)b;
    return "OSMesa";
}
