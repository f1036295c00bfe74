/* Bodies that meet each other. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include <stdlib.h>
#include <string.h>

/* Two blocks, the upper one p above the lower one, paired node by node. */
void specimen_lips(const stress_case *c, stress_scene *s)
{
    const int *n = c->cells;
    int cut = n[2] / 2;
    tetmesh whole = stress_grid(n, c->size, n[2]);
    int32_t layer = (n[0] + 1) * (n[1] + 1), first = layer * cut, all = whole.vertex_count;
    int32_t upper = 5 * n[0] * n[1] * cut;
    tetmesh m = tetmesh_new(all + layer, whole.tet_count);
    memcpy(m.xyz, whole.xyz, 3 * (size_t)all * sizeof *m.xyz);
    memcpy(m.tet, whole.tet, 4 * (size_t)m.tet_count * sizeof *m.tet);
    memcpy(m.xyz + 3 * (size_t)all, m.xyz + 3 * (size_t)first, 3 * (size_t)layer * sizeof *m.xyz);
    for (int32_t v = first; v < all; v++) m.xyz[3 * (size_t)v + 2] += c->p;
    for (int32_t i = 0; i < 4 * upper; i++)
        if (m.tet[i] >= first) m.tet[i] += all - first;
    tetmesh_free(&whole);
    s->mesh = m;
    s->attach = attach_map_new(m.vertex_count, layer);
    stress_tie_ends(c, s);
    for (int32_t i = 0; i < layer; i++) {
        s->attach.pair[2 * i] = first + i;
        s->attach.pair[2 * i + 1] = all + i;
        s->attach.pair_normal[3 * (size_t)i + 2] = 1;
    }
    int32_t *face, count = tetmesh_boundary(&m, &face, NULL);
    s->upper = NEW_ARRAY(int32_t, 3 * (size_t)count);
    s->lower = NEW_ARRAY(int32_t, 3 * (size_t)count);
    for (int32_t f = 0; f < count; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        int above = 0, below = 0;
        for (int k = 0; k < 3; k++) {
            above += v[k] >= first && v[k] < first + layer;
            below += v[k] >= all;
        }
        if (above == 3) memcpy(s->upper + 3 * (size_t)s->contact.upper_count++, v, 3 * sizeof *v);
        if (below == 3) memcpy(s->lower + 3 * (size_t)s->contact.lower_count++, v, 3 * sizeof *v);
    }
    free(face);
    s->contact.upper_lip = s->upper;
    s->contact.lower_lip = s->lower;
    s->contact.params = contact_params_default();
    s->touches = true;
}
