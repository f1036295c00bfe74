#include "geometry/segments.h"
#include <string.h>

static const char *const names[SEGMENT_COUNT] = {"cranium",       "maxilla",        "distal",
                                                 "proximal_left", "proximal_right", "chin"};

const char *segment_name(segment_id id) { return names[id]; }

int segment_from_name(const char *name)
{
    for (int i = 0; i < SEGMENT_COUNT; i++)
        if (!strcmp(names[i], name)) return i;
    return -1;
}

void segments_free(segments *s)
{
    for (int i = 0; i < SEGMENT_COUNT; i++) surface_free(&s->part[i]);
    surface_free(&s->kerf);
}
