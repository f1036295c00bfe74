#include "app/pictures/subject.h"
#include "render/standard_set.h"
#include <stddef.h>

bool pictures_write(const pictures_input *in, const char *folder, err *e)
{
    pictures_subject p;
    gallery_style style = gallery_style_default();
    gallery *g = NULL;
    pictures_subject_make(in, &p);
    bool ok = gallery_open(&p.shown, &style, &g, e) &&
              standard_set_write(g, PICTURES_WIDTH, PICTURES_HEIGHT, folder, NULL, e);
    gallery_close(&g);
    pictures_subject_free(&p);
    return ok;
}
