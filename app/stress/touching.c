/* Bodies that meet bone or each other. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

double stress_height(const stress_case *c, double x, double y)
{
    double u = x - c->size[0] / 2, w = y - c->size[1] / 2;
    if (c->body == specimen_on_teeth) { /* pyramids every 4 mm */
        double a = fabs(remainder(u, 4)) / 2, b = fabs(remainder(w, 4)) / 2;
        return c->p * (1 - fmax(a, b)) - c->p;
    }
    if (c->body == specimen_kept_off_cusps || c->body == specimen_kept_on_cusps)
        return c->p / 2 * (cos(M_PI / 2 * u) * cos(M_PI / 2 * w) - 1);
    if ((c->body == specimen_kept_off_ball || c->body == specimen_kept_on_ball) && u * u + w * w > c->p * c->p) return -HUGE_VAL;
    if (c->body == specimen_on_ball || c->body == specimen_kept_off_ball || c->body == specimen_kept_on_ball)
        return sqrt(fmax(c->p * c->p - u * u - w * w, 0)) - c->p;
    return -c->p;
}

/* The height field over the block and beyond it, in squares of `cell` mm. */
static surface field(const stress_case *c, double low_x, double cell, double margin)
{
    double lo[2] = {low_x, -margin}, hi[2] = {c->size[0] + margin, c->size[1] + margin};
    int n[2];
    for (int k = 0; k < 2; k++) n[k] = (int)ceil((hi[k] - lo[k]) / cell);
    surface s = surface_new((n[0] + 1) * (n[1] + 1), 2 * n[0] * n[1]);
    for (int j = 0; j <= n[1]; j++)
        for (int i = 0; i <= n[0]; i++) {
            double *x = s.xyz + 3 * ((size_t)j * (size_t)(n[0] + 1) + (size_t)i);
            x[0] = lo[0] + cell * i;
            x[1] = lo[1] + cell * j;
            x[2] = stress_height(c, x[0], x[1]);
        }
    int32_t *t = s.tri;
    for (int j = 0; j < n[1]; j++)
        for (int i = 0; i < n[0]; i++, t += 6) {
            int32_t a = j * (n[0] + 1) + i, b = a + n[0] + 1;
            int32_t two[6] = {a, a + 1, b + 1, a, b + 1, b};
            memcpy(t, two, sizeof two);
        }
    return s;
}

/* A block tied to the maxilla at its top; its bottom may touch the distal bone. */
static void over(const stress_case *c, stress_scene *s, surface bone)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1);
    for (int32_t v = 0; v < layer; v++) {
        stress_tie(&s->attach, layer * c->cells[2] + v, SEGMENT_MAXILLA);
        s->attach.kind[v] = NODE_SLIDING;
        s->attach.segment[v] = SEGMENT_DISTAL;
        s->attach.normal[3 * (size_t)v + 2] = 1;
    }
    s->bone[SEGMENT_DISTAL] = bone;
    s->contact.bone[SEGMENT_DISTAL] = &s->bone[SEGMENT_DISTAL];
    s->contact.params = contact_params_default();
    s->touches = true;
}

void specimen_on_plane(const stress_case *c, stress_scene *s)
{
    over(c, s, field(c, -8, 2, 8));
}
void specimen_on_teeth(const stress_case *c, stress_scene *s)
{
    over(c, s, field(c, c->size[0] / 2 - 24, 1, 8)); /* samples on tips and valleys */
}
void specimen_on_ball(const stress_case *c, stress_scene *s)
{
    over(c, s, field(c, -8, 1, 8));
}
void specimen_on_rim(const stress_case *c, stress_scene *s)
{
    over(c, s, field(c, c->size[0] / 2, 2, 8));
}

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
