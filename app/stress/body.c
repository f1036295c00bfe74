/* Sound bodies, of one or two materials. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <string.h>

tetmesh stress_grid(const int n[3], const double size[3], int from)
{
    static const int five[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    tetmesh m = tetmesh_new((n[0] + 1) * (n[1] + 1) * (n[2] + 1), 5 * n[0] * n[1] * n[2]);
    for (int k = 0; k <= n[2]; k++)
        for (int j = 0; j <= n[1]; j++)
            for (int i = 0; i <= n[0]; i++) {
                double *x = m.xyz + 3 * (size_t)stress_node(n, i, j, k);
                int at[3] = {i, j, k};
                for (int c = 0; c < 3; c++) x[c] = size[c] * at[c] / n[c];
            }
    int32_t *tet = m.tet;
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++)
                for (int t = 0; t < 5; t++, tet += 4) {
                    bool odd = (i + j + k + (k >= from)) % 2 == 1;
                    for (int a = 0; a < 4; a++) {
                        int corner = five[t][a] ^ (odd ? 1 : 0);
                        tet[a] = stress_node(n, i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
                    }
                    const double *x[4];
                    for (int a = 0; a < 4; a++) x[a] = m.xyz + 3 * (size_t)tet[a];
                    if (vec_six_volume(x[0], x[1], x[2], x[3]) > 0) continue;
                    int32_t swap = tet[2];
                    tet[2] = tet[3];
                    tet[3] = swap;
                }
    return m;
}

void stress_tie(attach_map *a, int32_t v, segment_id segment)
{
    a->kind[v] = NODE_TIED;
    a->segment[v] = (int32_t)segment;
}

void stress_tie_ends(const stress_case *c, stress_scene *s)
{
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1);
    for (int32_t v = 0; v < layer; v++) {
        stress_tie(&s->attach, v, SEGMENT_DISTAL);
        stress_tie(&s->attach, layer * c->cells[2] + v, SEGMENT_MAXILLA);
    }
}

void specimen_block(const stress_case *c, stress_scene *s)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    stress_tie_ends(c, s);
}

void specimen_slab(const stress_case *c, stress_scene *s)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    for (int j = 0; j <= c->cells[1]; j++)
        for (int i = 0; i <= c->cells[0]; i++) {
            double u = fabs(2.0 * i / c->cells[0] - 1), w = fabs(2.0 * j / c->cells[1] - 1), off = fmax(u, w);
            int32_t v = stress_node(c->cells, i, j, 0);
            if (off < 0.4) stress_tie(&s->attach, v, SEGMENT_MAXILLA);
            if (off > 0.65) stress_tie(&s->attach, v, SEGMENT_CRANIUM);
        }
}

void specimen_layers(const stress_case *c, stress_scene *s)
{
    specimen_block(c, s);
    int32_t layer = s->mesh.tet_count / 3;
    for (int32_t t = layer; t < 2 * layer; t++) s->mesh.region[t] = 1;
}

void specimen_skin(const stress_case *c, stress_scene *s)
{
    specimen_slab(c, s);
    int32_t layer = s->mesh.tet_count / c->cells[2];
    for (int32_t t = s->mesh.tet_count - layer; t < s->mesh.tet_count; t++) s->mesh.region[t] = 1;
}

void specimen_grains(const stress_case *c, stress_scene *s)
{
    specimen_block(c, s);
    for (int32_t t = 0; t < s->mesh.tet_count; t += (int32_t)c->p) s->mesh.region[t] = 1;
}

/* One node into every 7th tet at barycentric coordinates w: four tets in its place. */
static void split(const stress_case *c, stress_scene *s, const double w[4])
{
    tetmesh old = stress_grid(c->cells, c->size, c->cells[2]);
    int32_t count = (old.tet_count + 6) / 7, v = old.vertex_count, t = 0;
    tetmesh m = tetmesh_new(v + count, old.tet_count + 3 * count);
    memcpy(m.xyz, old.xyz, 3 * (size_t)v * sizeof *m.xyz);
    for (int32_t i = 0; i < old.tet_count; i++) {
        const int32_t *corner = old.tet + 4 * (size_t)i;
        if (i % 7) {
            memcpy(m.tet + 4 * (size_t)t++, corner, 4 * sizeof *corner);
            continue;
        }
        for (int a = 0; a < 4; a++)
            vec_axpy(m.xyz + 3 * (size_t)v, w[a], old.xyz + 3 * (size_t)corner[a], m.xyz + 3 * (size_t)v);
        for (int a = 0; a < 4; a++, t++) {
            memcpy(m.tet + 4 * (size_t)t, corner, 4 * sizeof *corner);
            m.tet[4 * (size_t)t + a] = v;
        }
        v++;
    }
    tetmesh_free(&old);
    s->mesh = m;
    s->attach = attach_map_new(m.vertex_count, 0);
    stress_tie_ends(c, s);
}

void specimen_caps(const stress_case *c, stress_scene *s)
{
    split(c, s, (double[]){c->p, (1 - c->p) / 3, (1 - c->p) / 3, (1 - c->p) / 3});
}

void specimen_wedges(const stress_case *c, stress_scene *s)
{
    split(c, s, (double[]){c->p, c->p, 0.5 - c->p, 0.5 - c->p});
}

void specimen_needles(const stress_case *c, stress_scene *s)
{
    split(c, s, (double[]){c->p, c->p, c->p, 1 - 3 * c->p});
}

/* Two chequers meet in the middle plane, where their diagonals cross: with one diagonal of each square a
 * little above the other a tet of the four nodes lies between. */
void specimen_slivers(const stress_case *c, stress_scene *s)
{
    const int *n = c->cells;
    int middle = n[2] / 2;
    tetmesh two = stress_grid(n, c->size, middle);
    tetmesh m = tetmesh_new(two.vertex_count, two.tet_count + n[0] * n[1]);
    memcpy(m.xyz, two.xyz, 3 * (size_t)m.vertex_count * sizeof *m.xyz);
    memcpy(m.tet, two.tet, 4 * (size_t)two.tet_count * sizeof *m.tet);
    double half = c->p * c->size[2] / n[2] / 2;
    int below = (middle - 1) % 2; /* parity of i + j of the nodes that the lower diagonals join */
    for (int j = 0; j <= n[1]; j++)
        for (int i = 0; i <= n[0]; i++) {
            double *z = &m.xyz[3 * (size_t)stress_node(n, i, j, middle) + 2];
            *z += (i + j) % 2 == below ? -half : half;
        }
    int32_t *tet = m.tet + 4 * (size_t)two.tet_count;
    for (int j = 0; j < n[1]; j++)
        for (int i = 0; i < n[0]; i++, tet += 4) {
            int32_t q[4] = {stress_node(n, i, j, middle), stress_node(n, i + 1, j, middle),
                            stress_node(n, i + 1, j + 1, middle), stress_node(n, i, j + 1, middle)};
            memcpy(tet, q, sizeof q);
            const double *x[4];
            for (int a = 0; a < 4; a++) x[a] = m.xyz + 3 * (size_t)tet[a];
            if (vec_six_volume(x[0], x[1], x[2], x[3]) > 0) continue;
            tet[2] = q[3];
            tet[3] = q[2];
        }
    tetmesh_free(&two);
    s->mesh = m;
    s->attach = attach_map_new(m.vertex_count, 0);
    stress_tie_ends(c, s);
}

void specimen_graded(const stress_case *c, stress_scene *s)
{
    specimen_block(c, s);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        double *x = s->mesh.xyz + 3 * (size_t)v;
        x[0] = c->size[0] * (pow(c->p, x[0] / c->size[0]) - 1) / (c->p - 1);
    }
}

void specimen_single(const stress_case *c, stress_scene *s)
{
    static const double at[12] = {0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10};
    s->mesh = tetmesh_new(4, 1);
    memcpy(s->mesh.xyz, at, sizeof at);
    for (int a = 0; a < 4; a++) s->mesh.tet[a] = a;
    s->attach = attach_map_new(4, 0);
    for (int32_t v = 0; v < (int32_t)c->p; v++) stress_tie(&s->attach, v, v == 0 ? SEGMENT_MAXILLA : SEGMENT_DISTAL);
}
