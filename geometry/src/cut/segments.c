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

void segment_color(segment_id id, double rgb[3])
{
    static const double color[SEGMENT_COUNT][3] = {
        [SEGMENT_CRANIUM] = {0.905, 0.865, 0.765},     [SEGMENT_MAXILLA] = {0.38, 0.62, 0.82},
        [SEGMENT_DISTAL] = {0.93, 0.69, 0.36},         [SEGMENT_PROXIMAL_LEFT] = {0.48, 0.74, 0.52},
        [SEGMENT_PROXIMAL_RIGHT] = {0.24, 0.60, 0.56}, [SEGMENT_CHIN] = {0.72, 0.52, 0.77},
    };
    memcpy(rgb, color[id], sizeof color[id]);
}

const char *segment_title(segment_id id)
{
    static const char *const title[SEGMENT_COUNT] = {
        [SEGMENT_CRANIUM] = "cranium",
        [SEGMENT_MAXILLA] = "maxilla",
        [SEGMENT_DISTAL] = "distal mandible",
        [SEGMENT_PROXIMAL_LEFT] = "proximal, left",
        [SEGMENT_PROXIMAL_RIGHT] = "proximal, right",
        [SEGMENT_CHIN] = "chin",
    };
    return title[id];
}
