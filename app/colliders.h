/* colliders: what lips and mucosa can touch, from a prepared case. */
#pragma once
#include "app/prepared.h"
#include "sim/contact.h"

typedef struct colliders {
    surface bone[SEGMENT_COUNT]; /* the wrapped bone under the tissue near the mouth, cut by segment */
    int32_t *upper, *lower, *extra;
    contact_setup setup; /* points into this: not to be copied */
} colliders;

/* attach: of the plan. The bone surfaces are the tissue's own bone side, turned over: in touch with the tissue everywhere at rest, thick,
 * but no finer than its elements: mucosa that slides over cusps and into gaps can be deeper in the scanned bone than
 * the contact's own depth says. Fills *out in place; the caller frees it. Refuses (ERR_GEOMETRY) a
 * case without sliding mucosa and lips. */
bool colliders_make(const prepared *p, const attach_map *attach, colliders *out, err *e) MUST_CHECK;
void colliders_free(colliders *c);
