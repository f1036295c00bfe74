#include "app/planner/patient/bone_fields.h"
#include "geometry/mem.h"
#include "geometry/rest_gap.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

/* Half a millimetre keeps the relief of crowns: smooth and exact distances differ by 0.04 mm on a cusp of 2 mm radius.
 */
static const double grid_mm = 0.5, known_mm = 3;
static const double about_mm = 0.25; /* of a node: a plan that carries a bone along the tissue asks a few blocks more */
static const double near_mm = 10;    /* farther from bone nothing about a node is within what a field knows */

static distance_field *open_field(const surface *part, const nearest *tree)
{
    double low[3], high[3];
    surface_bounds(part, low, high);
    return distance_field_create(tree, low, high, grid_mm, known_mm);
}

bool bone_fields_make(const segments *s, const tissue *t, bone_fields *out, err *e)
{
    segment_trees trees = {0};
    if (!segment_trees_make(s, NULL, &trees, e)) return false;
    rest_gap gap;
    rest_gap_make(t, &trees, &gap);
    double *asked = NEW_ARRAY(double, 3 * (size_t)t->mesh.vertex_count);
    *out = (bone_fields){0};
    for (int k = 0; k < SEGMENT_COUNT; k++) {
        if (!trees.part[k]) continue;
        int32_t count = 0;
        for (int32_t v = 0; v < t->mesh.vertex_count; v++)
            if (rest_gap_asks(t, v) && fabs(gap.part[k][v]) < near_mm)
                vec_copy(t->mesh.xyz + 3 * (size_t)v, asked + 3 * (size_t)count++);
        distance_field *f = open_field(&s->part[k], trees.part[k]);
        out->part[k] = distance_field_find(f, asked, count, about_mm);
        distance_field_destroy(&f);
    }
    free(asked);
    rest_gap_free(&gap);
    segment_trees_free(&trees);
    return true;
}

void bone_fields_free(bone_fields *f)
{
    for (int k = 0; k < SEGMENT_COUNT; k++) distance_samples_free(&f->part[k]);
}

bool bone_fields_sound(const bone_fields *f, const segments *s)
{
    for (int k = 0; k < SEGMENT_COUNT; k++) {
        double low[3] = {0}, high[3] = {0};
        if (s->part[k].vertex_count) surface_bounds(&s->part[k], low, high);
        if (f->part[k].count && !s->part[k].vertex_count) return false;
        if (!distance_samples_sound(&f->part[k], low, high, grid_mm, known_mm)) return false;
    }
    return true;
}

distance_field *bone_field_open(const surface *part, const nearest *tree, const distance_samples *found)
{
    distance_field *f = open_field(part, tree);
    distance_field_lend(f, found);
    return f;
}
