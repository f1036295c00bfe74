#include "app/planner/identity/head.h"
#include "geometry/mem.h"
#include "geometry/tet_volume.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A point inside moves with the part's vertices around it; their weight falls with the distance over as much as lies
 * between it and the part, at least this. */
static const double least_reach_mm = 15;

void head_template_free(head_template *t)
{
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        surface_free(&t->part[p]);
        free(t->tooth[p]);
    }
    tissue_free(&t->tissue);
    free(t->rest);
    embedding_free(&t->skin_on_tissue);
    free(t->point);
    *t = (head_template){0};
}

head_shape head_shape_of(const head_template *t)
{
    head_shape s = {0};
    size_t nodes = 3 * (size_t)t->tissue.mesh.vertex_count;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        s.part[p] = COPY_ARRAY(double, t->part[p].xyz, 3 * (size_t)t->part[p].vertex_count);
    s.rest = COPY_ARRAY(double, t->rest, nodes);
    s.neutral = COPY_ARRAY(double, t->tissue.mesh.xyz, nodes);
    return s;
}

void head_shape_free(head_shape *s)
{
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) free(s->part[p]);
    free(s->rest);
    free(s->neutral);
    *s = (head_shape){0};
}

double head_min_j(const head_template *t, const head_shape *s, int32_t *inverted)
{
    tetmesh rest = t->tissue.mesh;
    int32_t at_rest, at_neutral;
    rest.xyz = t->rest;
    double j = fmin(tets_min_j(&rest, s->rest, &at_rest), tets_min_j(&t->tissue.mesh, s->neutral, &at_neutral));
    *inverted = at_rest + at_neutral;
    return j;
}

surface head_part(const head_template *t, const head_shape *s, case_surface part)
{
    surface copy = surface_copy(&t->part[part]);
    memcpy(copy.xyz, s->part[part], 3 * (size_t)copy.vertex_count * sizeof *copy.xyz);
    return copy;
}

static void on_triangle(const head_point *p, const int32_t *tri, const double *xyz, double out[3])
{
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            out[c] += p->weight[k] * xyz[3 * (size_t)tri[3 * (size_t)p->triangle + (size_t)k] + (size_t)c];
}

/* out = b a^-1; a is symmetric and positive definite. */
static void divide_right(double b[3][3], double a[3][3], double out[3][3])
{
    double l[3][3] = {{0}}; /* Cholesky */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double sum = a[i][j];
            for (int k = 0; k < j; k++) sum -= l[i][k] * l[j][k];
            l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
        }
    for (int r = 0; r < 3; r++) {
        double y[3], *x = out[r];
        for (int i = 0; i < 3; i++) {
            y[i] = b[r][i];
            for (int k = 0; k < i; k++) y[i] -= l[i][k] * y[k];
            y[i] /= l[i][i];
        }
        for (int i = 2; i >= 0; i--) {
            x[i] = y[i];
            for (int k = i + 1; k < 3; k++) x[i] -= l[k][i] * x[k];
            x[i] /= l[i][i];
        }
    }
}

static double distance2(const double *a, const double *b)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

/* The affine map that takes the vertices around `at` from before to after with the least weighted squares, at `at`. */
static void among_vertices(const double at[3], const double *before, const double *after, int32_t count, double out[3])
{
    double nearest2 = HUGE_VAL, mass = 0, from[3] = {0}, to[3] = {0}, a[3][3] = {{0}}, b[3][3] = {{0}}, map[3][3];
    for (int32_t v = 0; v < count; v++) nearest2 = fmin(nearest2, distance2(before + 3 * (size_t)v, at));
    double reach2 = fmax(nearest2, least_reach_mm * least_reach_mm), *weight = NEW_ARRAY(double, count);
    for (int32_t v = 0; v < count; v++) {
        weight[v] = exp(-0.5 * (distance2(before + 3 * (size_t)v, at) - nearest2) / reach2);
        mass += weight[v];
        for (size_t c = 0; c < 3; c++) {
            from[c] += weight[v] * before[3 * (size_t)v + c];
            to[c] += weight[v] * after[3 * (size_t)v + c];
        }
    }
    for (int c = 0; c < 3; c++) {
        from[c] /= mass;
        to[c] /= mass;
    }
    for (int32_t v = 0; v < count; v++)
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++) {
                double y = weight[v] * (before[3 * (size_t)v + j] - from[j]);
                a[i][j] += y * (before[3 * (size_t)v + i] - from[i]);
                b[i][j] += y * (after[3 * (size_t)v + i] - to[i]);
            }
    divide_right(b, a, map);
    for (int c = 0; c < 3; c++) {
        out[c] = to[c];
        for (int k = 0; k < 3; k++) out[c] += map[c][k] * (at[k] - from[k]);
    }
    free(weight);
}

landmarks head_points(const head_template *t, const head_shape *s)
{
    landmarks l = {0};
    for (int32_t i = 0; i < t->point_count; i++) {
        const head_point *p = &t->point[i];
        const surface *part = &t->part[p->part];
        double at[3];
        if (p->triangle >= 0)
            on_triangle(p, part->tri, s->part[p->part], at);
        else
            among_vertices(p->at, part->xyz, s->part[p->part], part->vertex_count, at);
        landmarks_set(&l, p->label, at);
    }
    return l;
}
