#include "app/planner/patient/pack_arrays.h"
#include <stdio.h>
#include <stdlib.h>

void *pack_take_array(const pack_file *f, const char *name, size_t element, int32_t *count)
{
    size_t n = 0;
    void *array = pack_take(f, name, element, &n);
    if (array && n > INT32_MAX / 4) {
        free(array);
        return NULL;
    }
    *count = (int32_t)n;
    return array;
}

char *pack_text(const pack_file *f, const char *name)
{
    size_t n = 0;
    char *text = pack_take(f, name, 1, &n);
    if (text && (!n || text[n - 1])) {
        free(text);
        return NULL;
    }
    return text;
}

void pack_put_surface(pack_file *f, const char *name, const surface *s)
{
    char key[PACK_NAME_SIZE];
    snprintf(key, sizeof key, "%.24s.xyz", name);
    pack_put(f, key, s->xyz, 3 * (size_t)s->vertex_count * sizeof *s->xyz);
    snprintf(key, sizeof key, "%.24s.tri", name);
    pack_put(f, key, s->tri, 3 * (size_t)s->triangle_count * sizeof *s->tri);
    snprintf(key, sizeof key, "%.24s.rgb", name);
    if (s->rgb) pack_put(f, key, s->rgb, 3 * (size_t)s->vertex_count);
}

bool pack_take_surface(const pack_file *f, const char *name, surface *s)
{
    char key[PACK_NAME_SIZE];
    int32_t colours = 0;
    snprintf(key, sizeof key, "%.24s.xyz", name);
    s->xyz = pack_take_array(f, key, 3 * sizeof *s->xyz, &s->vertex_count);
    snprintf(key, sizeof key, "%.24s.tri", name);
    s->tri = pack_take_array(f, key, 3 * sizeof *s->tri, &s->triangle_count);
    snprintf(key, sizeof key, "%.24s.rgb", name);
    s->rgb = pack_take_array(f, key, 3, &colours);
    return s->xyz && s->tri && (!s->rgb || colours == s->vertex_count);
}

void pack_put_samples(pack_file *f, const char *name, const distance_samples *s)
{
    char key[PACK_NAME_SIZE];
    snprintf(key, sizeof key, "%.24s.block", name);
    pack_put(f, key, s->block, (size_t)s->count * sizeof *s->block);
    snprintf(key, sizeof key, "%.24s.centre", name);
    pack_put(f, key, s->centre, (size_t)s->count * sizeof *s->centre);
    snprintf(key, sizeof key, "%.24s.value", name);
    pack_put(f, key, s->value, DISTANCE_BLOCK * (size_t)s->count * sizeof *s->value);
}

bool pack_take_samples(const pack_file *f, const char *name, distance_samples *s)
{
    char key[PACK_NAME_SIZE];
    int32_t centres = -1, values = -1;
    snprintf(key, sizeof key, "%.24s.block", name);
    s->block = pack_take_array(f, key, sizeof *s->block, &s->count);
    snprintf(key, sizeof key, "%.24s.centre", name);
    s->centre = pack_take_array(f, key, sizeof *s->centre, &centres);
    snprintf(key, sizeof key, "%.24s.value", name);
    s->value = pack_take_array(f, key, DISTANCE_BLOCK * sizeof *s->value, &values);
    return s->block && s->centre && s->value && centres == s->count && values == s->count;
}

void pack_put_tissue(pack_file *f, const tissue *t)
{
    size_t nodes = (size_t)t->mesh.vertex_count, tets = (size_t)t->mesh.tet_count, pairs = (size_t)t->attach.pair_count;
    pack_put(f, "node.xyz", t->mesh.xyz, 3 * nodes * sizeof(double));
    pack_put(f, "tet.node", t->mesh.tet, 4 * tets * sizeof(int32_t));
    pack_put(f, "tet.region", t->mesh.region, tets * sizeof(int32_t));
    pack_put(f, "node.side", t->side, nodes);
    pack_put(f, "node.kind", t->attach.kind, nodes);
    pack_put(f, "node.segment", t->attach.segment, nodes * sizeof(int32_t));
    pack_put(f, "node.normal", t->attach.normal, 3 * nodes * sizeof(double));
    pack_put(f, "pair.node", t->attach.pair, 2 * pairs * sizeof(int32_t));
    pack_put(f, "pair.normal", t->attach.pair_normal, 3 * pairs * sizeof(double));
    pack_put(f, "lips", &t->lips, sizeof t->lips);
}

bool pack_take_tissue(const pack_file *f, tissue *t)
{
    int32_t n[7] = {0};
    attach_map *a = &t->attach;
    t->mesh.xyz = pack_take_array(f, "node.xyz", 3 * sizeof(double), &t->mesh.vertex_count);
    t->mesh.tet = pack_take_array(f, "tet.node", 4 * sizeof(int32_t), &t->mesh.tet_count);
    t->mesh.region = pack_take_array(f, "tet.region", sizeof(int32_t), &n[0]);
    t->side = pack_take_array(f, "node.side", 1, &n[1]);
    a->kind = pack_take_array(f, "node.kind", 1, &n[2]);
    a->segment = pack_take_array(f, "node.segment", sizeof(int32_t), &n[3]);
    a->normal = pack_take_array(f, "node.normal", 3 * sizeof(double), &n[4]);
    a->pair = pack_take_array(f, "pair.node", 2 * sizeof(int32_t), &a->pair_count);
    a->pair_normal = pack_take_array(f, "pair.normal", 3 * sizeof(double), &n[5]);
    lip_sheet *lips = pack_take_array(f, "lips", sizeof *lips, &n[6]);
    bool ok = lips && n[6] == 1;
    if (ok) t->lips = *lips;
    free(lips);
    a->node_count = t->mesh.vertex_count;
    for (int i = 1; i < 5; i++) ok = ok && n[i] == a->node_count;
    return ok && t->mesh.xyz && t->mesh.tet && t->mesh.region && t->side && a->kind && a->segment && a->normal &&
           a->pair && a->pair_normal && n[0] == t->mesh.tet_count && n[5] == a->pair_count;
}

void pack_put_skin(pack_file *f, const embedding *skin)
{
    size_t points = (size_t)skin->point_count;
    pack_put(f, "skin.tet", skin->tet, points * sizeof *skin->tet);
    pack_put(f, "skin.weight", skin->weight, 4 * points * sizeof *skin->weight);
}

bool pack_take_skin(const pack_file *f, embedding *skin)
{
    int32_t weights = 0;
    skin->tet = pack_take_array(f, "skin.tet", sizeof *skin->tet, &skin->point_count);
    skin->weight = pack_take_array(f, "skin.weight", 4 * sizeof *skin->weight, &weights);
    return skin->tet && skin->weight && weights == skin->point_count;
}
