#include "render/src/canvas.h"
#include <stddef.h>

enum { SAMPLES_PER_PIXEL = 4 }; /* the most that OSMesa has */

bool canvas_open(const gl *g, int width, int height, canvas *out, err *e)
{
    canvas c = {.width = width, .height = height};
    g->GenFramebuffers(1, &c.many);
    g->GenFramebuffers(1, &c.one);
    g->GenFramebuffers(1, &c.final);
    g->GenRenderbuffers(1, &c.many_colour);
    g->GenRenderbuffers(1, &c.many_depth);
    g->GenRenderbuffers(1, &c.one_depth);
    g->GenRenderbuffers(1, &c.final_colour);
    g->GenTextures(1, &c.one_colour);

    g->BindRenderbuffer(GL_RENDERBUFFER, c.many_colour);
    g->RenderbufferStorageMultisample(GL_RENDERBUFFER, SAMPLES_PER_PIXEL, GL_RGBA16F, width, height);
    g->BindRenderbuffer(GL_RENDERBUFFER, c.many_depth);
    g->RenderbufferStorageMultisample(GL_RENDERBUFFER, SAMPLES_PER_PIXEL, GL_DEPTH_COMPONENT32F, width, height);
    g->BindRenderbuffer(GL_RENDERBUFFER, c.one_depth);
    g->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    g->BindRenderbuffer(GL_RENDERBUFFER, c.final_colour);
    g->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    g->BindTexture(GL_TEXTURE_2D, c.one_colour);
    g->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, NULL);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

    bool ok = true;
    g->BindFramebuffer(GL_FRAMEBUFFER, c.final);
    g->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, c.final_colour);
    ok &= g->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    g->BindFramebuffer(GL_FRAMEBUFFER, c.one);
    g->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, c.one_colour, 0);
    g->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, c.one_depth);
    ok &= g->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    g->BindFramebuffer(GL_FRAMEBUFFER, c.many);
    g->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, c.many_colour);
    g->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, c.many_depth);
    ok &= g->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    *out = c;
    return ok || err_set(e, ERR_RESOURCE, "no picture: a frame buffer of %d x %d pixels with %d samples cannot be made",
                         width, height, SAMPLES_PER_PIXEL);
}

void canvas_close(const gl *g, canvas *c)
{
    g->BindFramebuffer(GL_FRAMEBUFFER, 0);
    g->DeleteFramebuffers(3, (GLuint[3]){c->many, c->one, c->final});
    g->DeleteRenderbuffers(4, (GLuint[4]){c->many_colour, c->many_depth, c->one_depth, c->final_colour});
    g->DeleteTextures(1, &c->one_colour);
    *c = (canvas){0};
}
