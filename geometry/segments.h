/* segments: the pieces of bone after the osteotomies. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum segment_id {
    SEGMENT_CRANIUM, /* skull above Le Fort I; never moves */
    SEGMENT_MAXILLA, /* with the upper teeth */
    SEGMENT_DISTAL,  /* tooth-bearing mandible; the whole mandible where no BSSO is cut */
    SEGMENT_PROXIMAL_LEFT,
    SEGMENT_PROXIMAL_RIGHT, /* condyle, coronoid, lateral plate */
    SEGMENT_CHIN,           /* rides on the distal segment */
    SEGMENT_COUNT
} segment_id;

typedef struct segments {
    surface part[SEGMENT_COUNT]; /* closed, outward; vertex_count 0 where the case has no such segment */
    surface kerf;                /* the bone removed by the saw, all cuts together (closed pieces) */
} segments;

const char *segment_name(segment_id id); /* "cranium", "maxilla", "distal", "proximal_left", ... */
/* Segment number for a name, -1 if there is none. */
int segment_from_name(const char *name);
/* The fixed colour of each, sRGB 0..1: cranium ivory, the others told apart by hue and lightness. */
void segment_color(segment_id id, double rgb[3]);
const char *segment_title(segment_id id); /* for legends: "distal mandible" */
void segments_free(segments *s);

#ifdef __cplusplus
}
#endif
