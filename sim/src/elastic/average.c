#include "sim/src/elastic/average.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/src/elastic/assemble_parts.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Corner by corner; the patches of one node are a list. */
static void make_patches(averages *g, const elements *el, int32_t node_count)
{
    int32_t *first = NEW_ARRAY(int32_t, node_count), room = node_count + 16;
    int32_t *next = NEW_ARRAY(int32_t, room), *material_of = NEW_ARRAY(int32_t, room);
    for (int32_t v = 0; v < node_count; v++) first[v] = -1;
    for (int64_t i = 0; i < 4 * (int64_t)g->tet_count; i++) {
        int32_t own = el->material[i / 4], p = first[g->tet[i]];
        g->patch[i] = -1;
        if (!(el->materials[own].averaged_kpa > 0)) continue;
        while (p >= 0 && material_of[p] != own) p = next[p];
        if (p < 0) {
            p = g->patch_count++;
            if (p == room) {
                room *= 2;
                next = GROW_ARRAY(int32_t, next, room);
                material_of = GROW_ARRAY(int32_t, material_of, room);
            }
            material_of[p] = own;
            next[p] = first[g->tet[i]];
            first[g->tet[i]] = p;
        }
        g->patch[i] = p;
    }
    g->volume = NEW_ARRAY(double, g->patch_count);
    g->pressure = NEW_ARRAY(double, g->patch_count);
    g->kpa = NEW_ARRAY(double, g->patch_count);
    for (int32_t p = 0; p < g->patch_count; p++) g->kpa[p] = el->materials[material_of[p]].averaged_kpa;
    free(first);
    free(next);
    free(material_of);
}

static void list_corners(averages *g, const elements *el)
{
    g->start = NEW_ARRAY(int32_t, (size_t)g->patch_count + 2);
    for (int64_t i = 0; i < 4 * (int64_t)g->tet_count; i++) {
        if (g->patch[i] < 0) continue;
        g->start[g->patch[i] + 2]++;
        g->volume[g->patch[i]] += el->volume[i / 4] / 4;
    }
    for (int32_t p = 0; p < g->patch_count; p++) g->start[p + 2] += g->start[p + 1];
    g->source = NEW_ARRAY(int32_t, g->start[g->patch_count + 1]);
    for (int32_t i = 0; i < 4 * g->tet_count; i++)
        if (g->patch[i] >= 0) g->source[g->start[g->patch[i] + 1]++] = i;
}

/* The nodes of the tets of patch p, ascending. */
static int32_t ring_of(const averages *g, int32_t p, int32_t *ring)
{
    int32_t count = 0;
    for (int32_t k = g->start[p]; k < g->start[p + 1]; k++)
        for (int c = 0; c < 4; c++) {
            int32_t u = g->tet[4 * (size_t)(g->source[k] / 4) + c], at = count;
            while (at > 0 && ring[at - 1] >= u) at--;
            if (at < count && ring[at] == u) continue;
            for (int32_t i = count++; i > at; i--) ring[i] = ring[i - 1];
            ring[at] = u;
        }
    return count;
}

static void list_rings(averages *g)
{
    g->ring_start = NEW_ARRAY(int32_t, (size_t)g->patch_count + 1);
    g->ring = NEW_ARRAY(int32_t, 4 * (size_t)g->start[g->patch_count]);
    for (int32_t p = 0; p < g->patch_count; p++) {
        int64_t n = ring_of(g, p, g->ring + g->ring_start[p]);
        g->ring_start[p + 1] = g->ring_start[p] + (int32_t)n;
        g->pair_count += n * (n + 1) / 2;
    }
    g->ring = GROW_ARRAY(int32_t, g->ring, g->ring_start[g->patch_count]);
    g->slope = NEW_ARRAY(double, 3 * (size_t)g->ring_start[g->patch_count]);
    g->pair = NEW_ARRAY(int32_t, 2 * (size_t)g->pair_count);
    int32_t *pair = g->pair;
    for (int32_t p = 0; p < g->patch_count; p++)
        for (int32_t i = g->ring_start[p]; i < g->ring_start[p + 1]; i++)
            for (int32_t j = i; j < g->ring_start[p + 1]; j++) {
                *pair++ = i;
                *pair++ = j;
            }
}

averages *average_make(const tetmesh *m, const elements *el)
{
    bool any = false;
    for (int32_t k = 0; k < el->material_count; k++) {
        const struct material *law = &el->materials[k];
        assert(!(law->averaged_kpa > 0) || law->model == MATERIAL_SNH_LOG || law->model == MATERIAL_SNH);
        any = any || law->averaged_kpa > 0;
    }
    if (!any) return NULL;
    averages *g = NEW_ARRAY(averages, 1);
    *g = (averages){.tet_count = m->tet_count,
                    .tet = m->tet,
                    .patch = NEW_ARRAY(int32_t, 4 * (size_t)m->tet_count),
                    .change = NEW_ARRAY(double, m->tet_count)};
    make_patches(g, el, m->vertex_count);
    list_corners(g, el);
    list_rings(g);
    return g;
}

void average_free(averages *g)
{
    if (!g) return;
    void *all[] = {g->patch,    g->start,      g->source, g->volume, g->kpa, g->change,
                   g->pressure, g->ring_start, g->ring,   g->slope,  g->pair};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
    free(g);
}

typedef struct average_job {
    averages *g;
    const elements *el;
    const double *x;
} average_job;

static void gradient_at(const average_job *job, int64_t t, double F[9])
{
    double x_e[12];
    element_nodes(job->g->tet, t, job->x, x_e);
    element_gradient_F(job->el->gradient + 12 * t, x_e, F);
}

static void change_body(int64_t begin, int64_t end, void *context)
{
    const average_job *job = context;
    for (int64_t t = begin; t < end; t++) {
        double F[9];
        if (job->g->patch[4 * t] < 0) continue;
        gradient_at(job, t, F);
        job->g->change[t] = job->el->volume[t] / 4 * (mat_det(F) - 1);
    }
}

static void pressure_body(int64_t begin, int64_t end, void *context)
{
    const average_job *job = context;
    averages *g = job->g;
    for (int64_t p = begin; p < end; p++) {
        double sum = 0;
        for (int32_t k = g->start[p]; k < g->start[p + 1]; k++) sum += g->change[g->source[k] / 4];
        g->pressure[p] = g->kpa[p] * sum / g->volume[p];
    }
}

double average_update(averages *g, const elements *el, const double *x)
{
    average_job job = {g, el, x};
    double sum = 0;
    parallel_for(g->tet_count, ELEMENT_GRAIN, change_body, &job);
    parallel_for(g->patch_count, NODE_GRAIN, pressure_body, &job);
    for (int32_t p = 0; p < g->patch_count; p++)
        sum += g->volume[p] / (2 * g->kpa[p]) * g->pressure[p] * g->pressure[p];
    return sum;
}

material average_material(const averages *g, const elements *el, int64_t t)
{
    material m = el->materials[el->material[t]];
    m.lambda_kpa -= m.averaged_kpa;
    for (int k = 0; k < 4 && g->patch[4 * t] >= 0; k++) m.pressure_kpa += g->pressure[g->patch[4 * t + k]] / 4;
    return m;
}

static void slope_body(int64_t begin, int64_t end, void *context)
{
    const average_job *job = context;
    averages *g = job->g;
    for (int64_t p = begin; p < end; p++) {
        const int32_t *ring = g->ring + g->ring_start[p];
        double *slope = g->slope + 3 * (size_t)g->ring_start[p], scale = sqrt(g->kpa[p] / g->volume[p]) / 4;
        memset(slope, 0, 3 * (size_t)(g->ring_start[p + 1] - g->ring_start[p]) * sizeof *slope);
        for (int32_t k = g->start[p]; k < g->start[p + 1]; k++) {
            int64_t t = g->source[k] / 4;
            double F[9], C[9], s[3];
            gradient_at(job, t, F);
            material_cofactor(F, C);
            for (int c = 0; c < 4; c++) {
                int32_t i = 0;
                while (ring[i] != g->tet[4 * t + c]) i++;
                mat_apply(C, job->el->gradient + 12 * t + 3 * c, s);
                vec_axpy(slope + 3 * i, scale * job->el->volume[t], s, slope + 3 * i);
            }
        }
    }
}

void average_slopes(averages *g, const elements *el, const double *x)
{
    average_job job = {g, el, x};
    parallel_for(g->patch_count, NODE_GRAIN, slope_body, &job);
}

void average_add(const averages *g, int64_t pair, double block[9])
{
    const double *low = g->slope + 3 * (size_t)g->pair[2 * pair], *high = g->slope + 3 * (size_t)g->pair[2 * pair + 1];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) block[3 * i + j] += low[i] * high[j];
}
