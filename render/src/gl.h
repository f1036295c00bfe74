/* gl: the OpenGL 3.3 core functions in use, looked up through the backend. */
#pragma once
#include "render/src/backend.h"
#include <GL/glcorearb.h>

#define GL_FUNCTIONS(X)                                                                                                \
    X(GETSTRING, GetString)                                                                                            \
    X(GETINTEGERV, GetIntegerv)                                                                                        \
    X(GETERROR, GetError)                                                                                              \
    X(VIEWPORT, Viewport)                                                                                              \
    X(ENABLE, Enable)                                                                                                  \
    X(DISABLE, Disable)                                                                                                \
    X(DEPTHFUNC, DepthFunc)                                                                                            \
    X(DEPTHMASK, DepthMask)                                                                                            \
    X(COLORMASK, ColorMask)                                                                                            \
    X(BLENDFUNC, BlendFunc)                                                                                            \
    X(CULLFACE, CullFace)                                                                                              \
    X(CLEARCOLOR, ClearColor)                                                                                          \
    X(CLEAR, Clear)                                                                                                    \
    X(READPIXELS, ReadPixels)                                                                                          \
    X(CREATESHADER, CreateShader)                                                                                      \
    X(SHADERSOURCE, ShaderSource)                                                                                      \
    X(COMPILESHADER, CompileShader)                                                                                    \
    X(GETSHADERIV, GetShaderiv)                                                                                        \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                                              \
    X(DELETESHADER, DeleteShader)                                                                                      \
    X(CREATEPROGRAM, CreateProgram)                                                                                    \
    X(ATTACHSHADER, AttachShader)                                                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                                      \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                                            \
    X(USEPROGRAM, UseProgram)                                                                                          \
    X(DELETEPROGRAM, DeleteProgram)                                                                                    \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                                          \
    X(UNIFORM1I, Uniform1i)                                                                                            \
    X(UNIFORM1F, Uniform1f)                                                                                            \
    X(UNIFORM2F, Uniform2f)                                                                                            \
    X(UNIFORM3F, Uniform3f)                                                                                            \
    X(UNIFORM3FV, Uniform3fv)                                                                                          \
    X(UNIFORMMATRIX3FV, UniformMatrix3fv)                                                                              \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                                              \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                                                \
    X(BINDVERTEXARRAY, BindVertexArray)                                                                                \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                                          \
    X(GENBUFFERS, GenBuffers)                                                                                          \
    X(BINDBUFFER, BindBuffer)                                                                                          \
    X(BUFFERDATA, BufferData)                                                                                          \
    X(DELETEBUFFERS, DeleteBuffers)                                                                                    \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                                        \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                                                \
    X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)                                                              \
    X(VERTEXATTRIB3F, VertexAttrib3f)                                                                                  \
    X(DRAWELEMENTS, DrawElements)                                                                                      \
    X(DRAWARRAYS, DrawArrays)                                                                                          \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                                                \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                                          \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                                                \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                                      \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                                                  \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                                                \
    X(DRAWBUFFER, DrawBuffer)                                                                                          \
    X(READBUFFER, ReadBuffer)                                                                                          \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                                              \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                                              \
    X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                                        \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                                                  \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                                        \
    X(GENTEXTURES, GenTextures)                                                                                        \
    X(BINDTEXTURE, BindTexture)                                                                                        \
    X(TEXIMAGE2D, TexImage2D)                                                                                          \
    X(TEXPARAMETERI, TexParameteri)                                                                                    \
    X(DELETETEXTURES, DeleteTextures)

typedef struct gl {
#define X(upper, name) PFNGL##upper##PROC name;
    GL_FUNCTIONS(X)
#undef X
} gl;

/* The context must be bound. Refuses (ERR_RESOURCE) a missing function by name. */
bool gl_load(const backend *b, gl *out, err *e) MUST_CHECK;
/* 0 and *e filled if the program does not compile or link. */
GLuint gl_program(const gl *g, const char *vertex, const char *fragment, err *e);
