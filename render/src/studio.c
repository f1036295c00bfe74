#include "render/src/studio.h"
#include "render/src/shaders.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

bool studio_check(studio *s, const char *doing, err *e)
{
    GLenum code = s->gl.GetError();
    if (code == GL_NO_ERROR) return true;
    while (s->gl.GetError() != GL_NO_ERROR) {}
    return err_set(e, ERR_RESOURCE, "no picture: OpenGL error 0x%04x while %s", code, doing);
}

bool studio_use(studio *s, err *e) { return backend_bind(s->context, e); }

static bool set_up(studio *s, err *e)
{
    const gl *g = &s->gl;
    if (!gl_load(s->context, &s->gl, e)) return false;
    s->shade = gl_program(g, shader_shade_vertex, shader_shade_fragment, e);
    s->map = gl_program(g, shader_shade_vertex, shader_map_fragment, e);
    s->ball = gl_program(g, shader_ball_vertex, shader_ball_fragment, e);
    s->ribbon = gl_program(g, shader_ribbon_vertex, shader_ribbon_fragment, e);
    s->finish = gl_program(g, shader_finish_vertex, shader_finish_fragment, e);
    if (!s->shade || !s->map || !s->ball || !s->ribbon || !s->finish) return false;
    g->GenVertexArrays(1, &s->empty_array);
    snprintf(s->description, sizeof s->description, "%s, %s, %s", backend_name(s->context),
             (const char *)g->GetString(GL_RENDERER), (const char *)g->GetString(GL_VERSION));
    return studio_check(s, "opening the studio", e);
}

bool studio_open(studio **out, err *e)
{
    studio *s = mem_alloc(1, sizeof *s);
    if (!backend_open(&s->context, e) || !backend_bind(s->context, e) || !set_up(s, e)) {
        if (s->context) backend_unbind(s->context);
        backend_close(&s->context);
        free(s);
        return false;
    }
    *out = s;
    return true;
}

void studio_close(studio **s)
{
    if (!*s) return;
    /* Programs and arrays go with the context. */
    backend_unbind((*s)->context);
    backend_close(&(*s)->context);
    free(*s);
    *s = NULL;
}

const char *studio_description(const studio *s) { return s->description; }
