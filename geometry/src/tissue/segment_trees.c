#include "geometry/segment_trees.h"

bool segment_trees_make(const segments *s, const surface *skin, segment_trees *out, err *e)
{
    segment_trees t = {0};
    bool ok = true;
    for (int k = 0; ok && k < SEGMENT_COUNT; k++)
        if (s->part[k].triangle_count) ok = nearest_create(&s->part[k], &t.part[k], e);
    if (ok && s->kerf.triangle_count) ok = nearest_create(&s->kerf, &t.kerf, e);
    if (ok && skin) ok = nearest_create(skin, &t.skin, e);
    if (ok)
        *out = t;
    else
        segment_trees_free(&t);
    return ok;
}

void segment_trees_free(segment_trees *t)
{
    for (int k = 0; k < SEGMENT_COUNT; k++) nearest_destroy(&t->part[k]);
    nearest_destroy(&t->kerf);
    nearest_destroy(&t->skin);
}
