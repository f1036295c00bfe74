#include "render/src/gl.h"
#include <stddef.h>

bool gl_load(const backend *b, gl *out, err *e)
{
#define X(upper, name)                                                                                                 \
    out->name = (PFNGL##upper##PROC)backend_proc(b, "gl" #name);                                                       \
    if (!out->name) return err_set(e, ERR_RESOURCE, "no pictures: %s lacks gl%s", backend_name(b), #name);
    GL_FUNCTIONS(X)
#undef X
    return true;
}

static GLuint compile(const gl *g, GLenum kind, const char *source, err *e)
{
    GLuint shader = g->CreateShader(kind);
    GLint ok = 0;
    g->ShaderSource(shader, 1, &source, NULL);
    g->CompileShader(shader);
    g->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    char log[600] = "";
    g->GetShaderInfoLog(shader, sizeof log, NULL, log);
    g->DeleteShader(shader);
    for (char *c = log; *c; c++)
        if (*c == '\n') *c = ' ';
    err_set(e, ERR_INTERNAL, "a shader does not compile: %s", log);
    return 0;
}

GLuint gl_program(const gl *g, const char *vertex, const char *fragment, err *e)
{
    GLuint v = compile(g, GL_VERTEX_SHADER, vertex, e), f = compile(g, GL_FRAGMENT_SHADER, fragment, e), program = 0;
    if (v && f) {
        GLint ok = 0;
        program = g->CreateProgram();
        g->AttachShader(program, v);
        g->AttachShader(program, f);
        g->LinkProgram(program);
        g->GetProgramiv(program, GL_LINK_STATUS, &ok);
        if (!ok) {
            char log[600] = "";
            g->GetProgramInfoLog(program, sizeof log, NULL, log);
            err_set(e, ERR_INTERNAL, "a shader does not link: %s", log);
            g->DeleteProgram(program);
            program = 0;
        }
    }
    if (v) g->DeleteShader(v);
    if (f) g->DeleteShader(f);
    return program;
}
