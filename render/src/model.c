#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

model_params model_params_skin(void) { return (model_params){180, 3, 5}; }
model_params model_params_bone(void) { return (model_params){50, 2, 1}; }

/* Unit normals of the triangles; zero for a triangle without area. */
static double *face_normals(const surface *s)
{
    double *n = NEW_ARRAY(double, 3 * (size_t)s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        double a[3], b[3];
        vec_sub(s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[0], a);
        vec_sub(s->xyz + 3 * (size_t)v[2], s->xyz + 3 * (size_t)v[0], b);
        vec_cross(a, b, n + 3 * (size_t)t);
        vec_normalize(n + 3 * (size_t)t);
    }
    return n;
}

/* corner[first[v] .. first[v+1]) are the positions of vertex v in tri, in ascending order. */
static void corners_of_vertices(const surface *s, int32_t **first, int32_t **corner)
{
    int32_t *f = NEW_ARRAY(int32_t, s->vertex_count + 2), *c = NEW_ARRAY(int32_t, 3 * (size_t)s->triangle_count);
    for (int32_t i = 0; i < 3 * s->triangle_count; i++) f[s->tri[i] + 2]++;
    for (int32_t v = 0; v <= s->vertex_count; v++) f[v + 1] += f[v];
    for (int32_t i = 0; i < 3 * s->triangle_count; i++) c[f[s->tri[i] + 1]++] = i;
    *first = f;
    *corner = c;
}

/* Do the triangles of corners a and b share an edge that ends in their common vertex? */
static bool share_edge(const surface *s, int32_t a, int32_t b)
{
    int32_t v = s->tri[a];
    const int32_t *x = s->tri + a / 3 * 3, *y = s->tri + b / 3 * 3;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (x[i] != v && x[i] == y[j]) return true;
    return false;
}

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/* At a vertex inside a surface the vertices that follow it in its triangles are those that precede it in
 * them; where a border passes, their sums differ. */
static bool border_passes(const surface *s, const int32_t *corner, int32_t count)
{
    int64_t sum = 0;
    for (int32_t i = 0; i < count; i++) {
        const int32_t *t = s->tri + corner[i] / 3 * 3;
        sum += t[(corner[i] + 1) % 3] - t[(corner[i] + 2) % 3];
    }
    return sum != 0;
}

/* Gives every group of triangles around a vertex that hangs together without a crease a vertex of its own. */
static void split_creases(const surface *s, const double *face, double crease_rad, model *m)
{
    int32_t *first, *corner, *parent = NULL, capacity = s->vertex_count, parent_size = 0;
    double least = cos(crease_rad);
    corners_of_vertices(s, &first, &corner);
    m->tri = COPY_ARRAY(int32_t, s->tri, 3 * (size_t)s->triangle_count);
    m->triangle_count = s->triangle_count;
    m->source = NEW_ARRAY(int32_t, capacity);
    m->vertex_count = 0;
    m->closed = true;
    for (int32_t v = 0; v < s->vertex_count; v++) {
        const int32_t *c = corner + first[v];
        int32_t n = first[v + 1] - first[v];
        m->closed &= !border_passes(s, c, n);
        if (n > parent_size) parent = GROW_ARRAY(int32_t, parent, parent_size = 2 * n);
        for (int32_t i = 0; i < n; i++) parent[i] = crease_rad < M_PI ? i : 0;
        if (crease_rad < M_PI)
            for (int32_t i = 0; i < n; i++)
                for (int32_t j = i + 1; j < n; j++) {
                    int32_t a = root_of(parent, i), b = root_of(parent, j);
                    const double *fa = face + 3 * (size_t)(c[i] / 3), *fb = face + 3 * (size_t)(c[j] / 3);
                    if (a == b || !share_edge(s, c[i], c[j])) continue;
                    if (vec_dot(fa, fb) < least && vec_dot(fa, fa) > 0 && vec_dot(fb, fb) > 0) continue;
                    if (a < b)
                        parent[b] = a;
                    else
                        parent[a] = b;
                }
        for (int32_t i = 0; i < n; i++) {
            if (root_of(parent, i) != i) continue;
            if (m->vertex_count == capacity) m->source = GROW_ARRAY(int32_t, m->source, capacity *= 2);
            for (int32_t j = i; j < n; j++)
                if (root_of(parent, j) == i) m->tri[c[j]] = m->vertex_count;
            m->source[m->vertex_count++] = v;
        }
    }
    free(parent);
    free(first);
    free(corner);
}

/* Normals weighted by the angle of each triangle at the vertex (Thuermer and Wuethrich 1998): they do not
 * depend on how a flat face is cut into triangles. */
static void angle_weighted_normals(const surface *s, const double *face, model *m)
{
    for (int32_t i = 0; i < 3 * m->triangle_count; i++) {
        int32_t t = i / 3;
        const double *p = s->xyz + 3 * (size_t)s->tri[i], *q = s->xyz + 3 * (size_t)s->tri[3 * t + (i + 1) % 3],
                     *r = s->xyz + 3 * (size_t)s->tri[3 * t + (i + 2) % 3];
        double a[3], b[3];
        vec_sub(q, p, a);
        vec_sub(r, p, b);
        vec_normalize(a);
        vec_normalize(b);
        double angle = acos(fmin(1, fmax(-1, vec_dot(a, b))));
        for (int k = 0; k < 3; k++)
            m->normal[3 * (size_t)m->tri[i] + (size_t)k] += (float)(angle * face[3 * (size_t)t + (size_t)k]);
    }
}

static void unit_normals(model *m)
{
    for (int32_t v = 0; v < m->vertex_count; v++) {
        float *n = m->normal + 3 * (size_t)v;
        double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] + (double)n[2] * (double)n[2]);
        for (int k = 0; k < 3; k++) n[k] = length > 0 ? (float)((double)n[k] / length) : (k == 2);
    }
}

void model_smooth(const model *m, float *values, int components, int passes)
{
    size_t n = (size_t)components;
    float *sum = NEW_ARRAY(float, n *(size_t)m->vertex_count), *count = NEW_ARRAY(float, m->vertex_count);
    for (int32_t i = 0; i < 3 * m->triangle_count; i++) count[m->tri[i]] += 2;
    for (int pass = 0; pass < passes; pass++) {
        memset(sum, 0, n * (size_t)m->vertex_count * sizeof *sum);
        for (int32_t t = 0; t < m->triangle_count; t++) {
            const int32_t *v = m->tri + 3 * (size_t)t;
            for (int k = 0; k < 3; k++) {
                float *to = sum + n * (size_t)v[k];
                const float *a = values + n * (size_t)v[(k + 1) % 3], *b = values + n * (size_t)v[(k + 2) % 3];
                for (size_t c = 0; c < n; c++) to[c] += a[c] + b[c];
            }
        }
        for (int32_t v = 0; v < m->vertex_count; v++)
            for (size_t c = 0; c < n; c++)
                values[n * (size_t)v + c] = 0.5f * (values[n * (size_t)v + c] + sum[n * (size_t)v + c] / count[v]);
    }
    free(sum);
    free(count);
}

static GLuint upload(const gl *g, GLenum target, const void *bytes, size_t size)
{
    GLuint buffer;
    g->GenBuffers(1, &buffer);
    g->BindBuffer(target, buffer);
    g->BufferData(target, (GLsizeiptr)size, bytes, GL_STATIC_DRAW);
    return buffer;
}

bool model_create(studio *s, const surface *from, const model_params *params, model **out, err *e)
{
    assert(params->normal_passes >= 0 && params->scatter_passes >= 0 && params->crease_deg >= 0);
    if (!surface_check(from, e) || !studio_use(s, e)) return false;
    model *m = mem_alloc(1, sizeof *m);
    m->home = s;
    m->source_count = from->vertex_count;
    m->scatter_passes = params->scatter_passes;
    double *face = face_normals(from);
    split_creases(from, face, params->crease_deg * M_PI / 180, m);
    m->xyz = NEW_ARRAY(float, 3 * (size_t)m->vertex_count);
    m->normal = NEW_ARRAY(float, 3 * (size_t)m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++)
        for (size_t k = 0; k < 3; k++) m->xyz[3 * (size_t)v + k] = (float)from->xyz[3 * (size_t)m->source[v] + k];
    angle_weighted_normals(from, face, m);
    unit_normals(m);
    model_smooth(m, m->normal, 3, params->normal_passes);
    unit_normals(m);
    free(face);
    m->sharp = NEW_ARRAY(float, HARMONICS *(size_t)m->vertex_count);
    for (size_t v = 0; v < (size_t)m->vertex_count; v++) lobe_at(m->normal + 3 * v, m->sharp + HARMONICS * v);
    m->soft = COPY_ARRAY(float, m->sharp, HARMONICS *(size_t)m->vertex_count);

    const gl *g = &s->gl;
    size_t bytes = 3 * (size_t)m->vertex_count * sizeof(float);
    g->GenVertexArrays(1, &m->array);
    g->BindVertexArray(m->array);
    m->point_buffer = upload(g, GL_ARRAY_BUFFER, m->xyz, bytes);
    g->EnableVertexAttribArray(0);
    g->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    m->index_buffer = upload(g, GL_ELEMENT_ARRAY_BUFFER, m->tri, 3 * (size_t)m->triangle_count * sizeof *m->tri);
    g->BindVertexArray(0);
    if (!studio_check(s, "loading a surface", e)) {
        model_free(&m);
        return false;
    }
    *out = m;
    return true;
}

void model_free(model **m)
{
    if (!*m) return;
    model *it = *m;
    const gl *g = &it->home->gl;
    err e = {0};
    bool bound = studio_use(it->home, &e);
    assert(bound);
    g->DeleteVertexArrays(1, &it->array);
    g->DeleteBuffers(2, (GLuint[2]){it->point_buffer, it->index_buffer});
    free(it->source);
    free(it->tri);
    free(it->xyz);
    free(it->normal);
    free(it->sharp);
    free(it->soft);
    free(it);
    *m = NULL;
}

int32_t model_vertex_count(const model *m) { return m->source_count; }
