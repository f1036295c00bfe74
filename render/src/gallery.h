/* Private: what a gallery keeps. */
#pragma once
#include "render/gallery.h"

struct gallery {
    const subject *s;
    const gallery_style *style;
    studio *room;
    model *skin[2], **bone[2];   /* before, after; lit; NULL until needed */
    double *displacement;        /* its own, where the subject has none */
    double *moved;               /* 0..1: how clearly a vertex of the skin moves */
    double centre[3], radius_mm; /* of the face; radius 0: not known */
};

/* The models of a pose, lit; made when first needed. */
bool gallery_skin(gallery *g, bool after, err *e) MUST_CHECK;
bool gallery_bones(gallery *g, bool after, err *e) MUST_CHECK;
/* Values of a map, their colour map and caption. */
const double *gallery_map(const gallery *g, panel_show show, label_map *bar);
/* Does the plan move it? */
bool part_moves(const subject_part *p);
/* Seen from there, with the gallery's zoom, centre and perspective. */
camera gallery_camera(const gallery *g, const panel *p, int width, int height);
