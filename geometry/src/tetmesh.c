#include "geometry/tetmesh.h"
#include "geometry/mem.h"
#include "geometry/tet_volume.h"
#include "geometry/vec.h"
#include <stdlib.h>

const int tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

tetmesh tetmesh_new(int32_t vertex_count, int32_t tet_count)
{
    return (tetmesh){.vertex_count = vertex_count,
                     .tet_count = tet_count,
                     .xyz = NEW_ARRAY(double, 3 * (size_t)vertex_count),
                     .tet = NEW_ARRAY(int32_t, 4 * (size_t)tet_count),
                     .region = NEW_ARRAY(int32_t, tet_count)};
}

void tetmesh_free(tetmesh *m)
{
    free(m->xyz);
    free(m->tet);
    free(m->region);
    *m = (tetmesh){0};
}

tetmesh tetmesh_copy(const tetmesh *m)
{
    tetmesh c = *m;
    c.xyz = COPY_ARRAY(double, m->xyz, 3 * (size_t)m->vertex_count);
    c.tet = COPY_ARRAY(int32_t, m->tet, 4 * (size_t)m->tet_count);
    c.region = COPY_ARRAY(int32_t, m->region, m->tet_count);
    return c;
}

static const double *corner(const tetmesh *m, int32_t t, int k)
{
    return m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + k];
}

static double six_volume(const tetmesh *m, int32_t t) { return tet_six_volume(m->xyz, m->tet + 4 * (size_t)t); }

bool tetmesh_check(const tetmesh *m, err *e)
{
    if (m->vertex_count < 4 || m->tet_count < 1)
        return err_set(e, ERR_GEOMETRY, "the tetrahedral mesh is empty (%d vertices, %d tets)", m->vertex_count,
                       m->tet_count);
    for (int64_t i = 0; i < 3 * (int64_t)m->vertex_count; i++)
        if (!isfinite(m->xyz[i]))
            return err_set(e, ERR_GEOMETRY, "node %lld has a coordinate that is not a finite number",
                           (long long)(i / 3));
    for (int32_t t = 0; t < m->tet_count; t++) {
        for (int k = 0; k < 4; k++) {
            int32_t v = m->tet[4 * (size_t)t + k];
            if (v < 0 || v >= m->vertex_count)
                return err_set(e, ERR_GEOMETRY, "tet %d names node %d of %d", t, v, m->vertex_count);
        }
        if (!(six_volume(m, t) > 0))
            return err_set(e, ERR_GEOMETRY, "tet %d has volume %g mm^3, must be > 0", t, six_volume(m, t) / 6);
    }
    return true;
}

/* Radius ratio 3 r_in / r_circum and dihedral cosines of one tet. */
static void shape_of(const double *p[4], double six_vol, double *radius_ratio, double *min_cos, double *max_cos)
{
    double n[4][3], area = 0;
    for (int k = 0; k < 4; k++) {
        double a[3], b[3];
        vec_sub(p[tet_face[k][1]], p[tet_face[k][0]], a);
        vec_sub(p[tet_face[k][2]], p[tet_face[k][0]], b);
        vec_cross(a, b, n[k]);
        area += vec_normalize(n[k]) / 2;
    }
    *min_cos = 1;
    *max_cos = -1;
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++) {
            double c = fmax(-1, fmin(1, -vec_dot(n[i], n[j]))); /* cos of the interior angle */
            *min_cos = fmin(*min_cos, c);
            *max_cos = fmax(*max_cos, c);
        }
    double a[3], b[3], c[3], bc[3], ca[3], ab[3], s[3];
    vec_sub(p[1], p[0], a);
    vec_sub(p[2], p[0], b);
    vec_sub(p[3], p[0], c);
    vec_cross(b, c, bc);
    vec_cross(c, a, ca);
    vec_cross(a, b, ab);
    for (int i = 0; i < 3; i++) s[i] = vec_dot(a, a) * bc[i] + vec_dot(b, b) * ca[i] + vec_dot(c, c) * ab[i];
    double circum = vec_norm(s) / (2 * fabs(six_vol)), in = fabs(six_vol) / (2 * area);
    *radius_ratio = circum > 0 ? 3 * in / circum : 0;
}

tetmesh_quality tetmesh_measure(const tetmesh *m)
{
    static const int edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    const double degrees = 180 / acos(-1.0);
    double low_cos = 1, high_cos = -1, ratio_sum = 0, edge_sum = 0;
    tetmesh_quality q = {.min_radius_ratio = 1, .min_volume_mm3 = HUGE_VAL, .min_edge_mm = HUGE_VAL};
    for (int32_t t = 0; t < m->tet_count; t++) {
        const double *p[4] = {corner(m, t, 0), corner(m, t, 1), corner(m, t, 2), corner(m, t, 3)};
        double v = six_volume(m, t), ratio, lo, hi;
        shape_of(p, v, &ratio, &lo, &hi);
        low_cos = fmin(low_cos, lo);
        high_cos = fmax(high_cos, hi);
        ratio_sum += ratio;
        q.min_radius_ratio = fmin(q.min_radius_ratio, ratio);
        q.min_volume_mm3 = fmin(q.min_volume_mm3, v / 6);
        q.volume_mm3 += v / 6;
        for (int k = 0; k < 6; k++) {
            double l = vec_distance(p[edge[k][0]], p[edge[k][1]]);
            q.min_edge_mm = fmin(q.min_edge_mm, l);
            q.max_edge_mm = fmax(q.max_edge_mm, l);
            edge_sum += l;
        }
    }
    q.min_dihedral_deg = acos(high_cos) * degrees;
    q.max_dihedral_deg = acos(low_cos) * degrees;
    q.mean_radius_ratio = m->tet_count ? ratio_sum / m->tet_count : 0;
    q.mean_edge_mm = m->tet_count ? edge_sum / (6.0 * m->tet_count) : 0;
    return q;
}

typedef struct half_face {
    int32_t v[3]; /* sorted */
    int32_t tet, face;
} half_face;

static int compare_half_faces(const void *a, const void *b)
{
    const half_face *x = a, *y = b;
    for (int k = 0; k < 3; k++)
        if (x->v[k] != y->v[k]) return x->v[k] < y->v[k] ? -1 : 1;
    if (x->tet != y->tet) return x->tet < y->tet ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

static void sort_three(int32_t v[3])
{
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2 - i; j++)
            if (v[j] > v[j + 1]) {
                int32_t keep = v[j];
                v[j] = v[j + 1];
                v[j + 1] = keep;
            }
}

int32_t *tetmesh_neighbours(const tetmesh *m)
{
    size_t count = 4 * (size_t)m->tet_count;
    half_face *h = NEW_ARRAY(half_face, count);
    for (size_t i = 0; i < count; i++) {
        h[i].tet = (int32_t)(i / 4);
        h[i].face = (int32_t)(i % 4);
        for (int k = 0; k < 3; k++) h[i].v[k] = m->tet[4 * (size_t)h[i].tet + (size_t)tet_face[h[i].face][k]];
        sort_three(h[i].v);
    }
    qsort(h, count, sizeof *h, compare_half_faces);
    int32_t *across = NEW_ARRAY(int32_t, count);
    for (size_t i = 0; i < count; i++) across[i] = -1;
    for (size_t i = 0; i + 1 < count; i++) {
        const half_face *a = h + i, *b = h + i + 1;
        if (a->v[0] != b->v[0] || a->v[1] != b->v[1] || a->v[2] != b->v[2]) continue;
        across[4 * (size_t)a->tet + (size_t)a->face] = b->tet;
        across[4 * (size_t)b->tet + (size_t)b->face] = a->tet;
    }
    free(h);
    return across;
}

int32_t tetmesh_boundary(const tetmesh *m, int32_t **face, int32_t **tet_of)
{
    int32_t *across = tetmesh_neighbours(m), count = 0;
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) count += across[i] < 0;
    *face = NEW_ARRAY(int32_t, 3 * (size_t)count);
    if (tet_of) *tet_of = NEW_ARRAY(int32_t, count);
    count = 0;
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) {
        if (across[i] >= 0) continue;
        for (int k = 0; k < 3; k++)
            (*face)[3 * (size_t)count + (size_t)k] = m->tet[4 * (i / 4) + (size_t)tet_face[i % 4][k]];
        if (tet_of) (*tet_of)[count] = (int32_t)(i / 4);
        count++;
    }
    free(across);
    return count;
}
