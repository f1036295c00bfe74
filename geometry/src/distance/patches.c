#include "geometry/src/distance/patches.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double patch_mm = 2;
enum { GROUP = 4 }; /* patches along a group */

typedef struct sort_key {
    int32_t group[3], box[3], triangle;
} sort_key;

static int by_box(const void *a, const void *b)
{
    const sort_key *x = a, *y = b;
    for (int c = 2; c >= 0; c--)
        if (x->group[c] != y->group[c]) return x->group[c] < y->group[c] ? -1 : 1;
    for (int c = 2; c >= 0; c--)
        if (x->box[c] != y->box[c]) return x->box[c] < y->box[c] ? -1 : 1;
    return x->triangle < y->triangle ? -1 : 1;
}

static const double *corner(const surface *s, int32_t t, int k)
{
    return s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
}

static void close_patch(patches *l, const surface *s, const uint8_t *kind, const double *box, int32_t first,
                        int32_t end)
{
    patch p = {.first = first, .count = end - first};
    bool outside = false;
    for (int32_t i = first; i < end; i++)
        for (int k = 0; k < 3; k++) vec_axpy(p.centre, 1 / (3.0 * p.count), corner(s, l->order[i], k), p.centre);
    for (int32_t i = first; i < end; i++) {
        p.kinds |= kind ? kind[l->order[i]] : 1;
        for (int k = 0; k < 3; k++) p.radius = fmax(p.radius, vec_distance(p.centre, corner(s, l->order[i], k)));
    }
    for (int c = 0; c < 3 && box; c++)
        outside |= p.centre[c] + p.radius < box[c] || p.centre[c] - p.radius > box[3 + c];
    if (!outside) l->patch[l->count++] = p;
}

static void close_group(patches *l, int32_t first)
{
    patch g = {.first = first, .count = l->count - first};
    if (!g.count) return;
    for (int32_t i = first; i < l->count; i++) vec_axpy(g.centre, 1.0 / g.count, l->patch[i].centre, g.centre);
    for (int32_t i = first; i < l->count; i++) {
        g.kinds |= l->patch[i].kinds;
        g.radius = fmax(g.radius, vec_distance(g.centre, l->patch[i].centre) + l->patch[i].radius);
    }
    l->group[l->group_count++] = g;
}

static sort_key key_of(const surface *s, int32_t t)
{
    sort_key k = {.triangle = t};
    for (int c = 0; c < 3; c++) {
        double middle = (corner(s, t, 0)[c] + corner(s, t, 1)[c] + corner(s, t, 2)[c]) / 3;
        k.box[c] = (int32_t)floor(middle / patch_mm);
        k.group[c] = (int32_t)floor(middle / (GROUP * patch_mm));
    }
    return k;
}

patches patches_make(const surface *s, const uint8_t *kind, const double *box)
{
    int32_t count = s->triangle_count, first = 0, group = 0;
    patches l = {
        .patch = NEW_ARRAY(patch, count), .group = NEW_ARRAY(patch, count), .order = NEW_ARRAY(int32_t, count)};
    sort_key *key = NEW_ARRAY(sort_key, count);
    for (int32_t t = 0; t < count; t++) key[t] = key_of(s, t);
    qsort(key, (size_t)count, sizeof *key, by_box);
    for (int32_t i = 0; i < count; i++) l.order[i] = key[i].triangle;
    for (int32_t i = 1; i <= count; i++) {
        bool end = i == count || memcmp(key[i].group, key[first].group, sizeof key[i].group);
        if (!end && !memcmp(key[i].box, key[first].box, sizeof key[i].box)) continue;
        close_patch(&l, s, kind, box, first, i);
        first = i;
        if (!end) continue;
        close_group(&l, group);
        group = l.count;
    }
    free(key);
    l.patch = GROW_ARRAY(patch, l.patch, l.count + 1);
    l.group = GROW_ARRAY(patch, l.group, l.group_count + 1);
    return l;
}

void patches_free(patches *p)
{
    free(p->patch);
    free(p->group);
    free(p->order);
    *p = (patches){0};
}
