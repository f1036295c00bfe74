#include "geometry/src/cut/breach.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/union_find.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double on_cutter_mm = 1e-4; /* vertices of a cut face are rounded to doubles, nothing more */

static bool cut_face_of(const surface *piece, const surface *cutter, surface *out, err *e)
{
    nearest *tree = NULL;
    if (!nearest_create(cutter, &tree, e)) return false;
    uint8_t *keep = NEW_ARRAY(uint8_t, piece->triangle_count);
    for (int32_t t = 0; t < piece->triangle_count; t++) {
        double middle[3] = {0};
        for (int k = 0; k < 3; k++) vec_axpy(middle, 1 / 3.0, piece->xyz + 3 * (size_t)piece->tri[3 * t + k], middle);
        keep[t] = nearest_point(tree, middle, NULL, NULL) < on_cutter_mm;
    }
    *out = surface_select(piece, keep);
    free(keep);
    nearest_destroy(&tree);
    return true;
}

typedef struct edge {
    int32_t low, high, part;
} edge;

static int by_ends(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return (x->high > y->high) - (x->high < y->high);
}

/* The edges of one triangle only, at the front of the array that the caller frees. */
static edge *border_of(const surface *s, int32_t *count)
{
    int32_t *part, all = 3 * s->triangle_count, found = 0;
    surface_components(s, &part);
    edge *list = NEW_ARRAY(edge, all);
    for (int32_t i = 0; i < all; i++) {
        int32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        list[i] = (edge){a < b ? a : b, a < b ? b : a, part[i / 3]};
    }
    qsort(list, (size_t)all, sizeof *list, by_ends);
    for (int32_t i = 0, k; i < all; i = k) {
        for (k = i + 1; k < all && !by_ends(list + i, list + k); k++) {}
        if (k == i + 1) list[found++] = list[i];
    }
    free(part);
    *count = found;
    return list;
}

typedef struct border { /* a closed line of border edges */
    double length, low[3], high[3];
    int32_t part;
} border;

static border *borders_of(const surface *s, const edge *list, int32_t count)
{
    int32_t *parent = NEW_ARRAY(int32_t, s->vertex_count);
    border *all = NEW_ARRAY(border, s->vertex_count); /* at the root of each line; length 0: none */
    for (int32_t v = 0; v < s->vertex_count; v++) parent[v] = v;
    for (int32_t i = 0; i < count; i++) parent[union_root(parent, list[i].low)] = union_root(parent, list[i].high);
    for (int32_t i = 0; i < count; i++) {
        border *b = &all[union_root(parent, list[i].low)];
        const double *p = s->xyz + 3 * (size_t)list[i].low, *q = s->xyz + 3 * (size_t)list[i].high;
        for (int c = 0; c < 3; c++) {
            b->low[c] = fmin(b->length > 0 ? b->low[c] : HUGE_VAL, fmin(p[c], q[c]));
            b->high[c] = fmax(b->length > 0 ? b->high[c] : -HUGE_VAL, fmax(p[c], q[c]));
        }
        b->length += vec_distance(p, q);
        b->part = list[i].part;
    }
    free(parent);
    return all;
}

const char *breach_landmark(const breach *b, const landmarks *points)
{
    const landmark *best = NULL;
    for (int32_t i = 0; i < points->count; i++)
        if (!best || vec_distance(points->point[i].xyz, b->place) < vec_distance(best->xyz, b->place))
            best = points->point + i;
    return best ? best->label : "no landmark";
}

bool breach_find(const surface *piece, const surface *cutter, breach *out, err *e)
{
    surface face = {0};
    *out = (breach){0};
    if (!cut_face_of(piece, cutter, &face, e)) return false;
    int32_t count;
    edge *list = border_of(&face, &count);
    border *all = borders_of(&face, list, count);
    int32_t *rim = NEW_ARRAY(int32_t, face.triangle_count); /* of each part: 1 + the longest border */
    for (int32_t v = 0; v < face.vertex_count; v++) {
        if (!(all[v].length > 0)) continue;
        int32_t *longest = &rim[all[v].part];
        if (!*longest || all[v].length > all[*longest - 1].length) *longest = v + 1;
    }
    for (int32_t v = 0; v < face.vertex_count; v++) {
        double wide = all[v].length > 0 ? vec_distance(all[v].low, all[v].high) : 0;
        if (rim[all[v].part] == v + 1 || !(wide > out->wide_mm)) continue;
        out->wide_mm = wide;
        for (int c = 0; c < 3; c++) out->place[c] = (all[v].low[c] + all[v].high[c]) / 2;
    }
    free(rim);
    free(all);
    free(list);
    surface_free(&face);
    return true;
}
