#include "sim/assemble.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "sim/src/average.h"
#include "sim/src/svd3.h"
#include <assert.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { ELEMENT_GRAIN = 256, NODE_GRAIN = 512, EDGE_GRAIN = 1024 };

/* order[] = 0..count-1 sorted by key, stable; keys in [0, key_count). */
static void stable_sort(const int32_t *key, int64_t count, int32_t key_count, const int32_t *in,
                        int32_t *order)
{
    int64_t *start = NEW_ARRAY(int64_t, (size_t)key_count + 1);
    for (int64_t i = 0; i < count; i++) start[key[i] + 1]++;
    for (int32_t k = 0; k < key_count; k++) start[k + 1] += start[k];
    for (int64_t i = 0; i < count; i++) {
        int32_t item = in ? in[i] : (int32_t)i;
        order[start[key[item]]++] = item;
    }
    free(start);
}

/* Items sorted by (major, minor), ties in their own order. Caller frees. */
static int32_t *sort_by_two(const int32_t *major, const int32_t *minor, int64_t count, int32_t key_count)
{
    int32_t *half = NEW_ARRAY(int32_t, count), *full = NEW_ARRAY(int32_t, count);
    stable_sort(minor, count, key_count, NULL, half);
    stable_sort(major, count, key_count, half, full);
    free(half);
    return full;
}

static void make_node_lists(assembly *a)
{
    a->node_start = NEW_ARRAY(int32_t, (size_t)a->node_count + 1);
    a->node_source = NEW_ARRAY(int32_t, 4 * (size_t)a->tet_count);
    stable_sort(a->tet, 4 * (int64_t)a->tet_count, a->node_count, NULL, a->node_source);
    for (int64_t i = 0; i < 4 * (int64_t)a->tet_count; i++) a->node_start[a->tet[i] + 1]++;
    for (int32_t v = 0; v < a->node_count; v++) a->node_start[v + 1] += a->node_start[v];
}

static void make_edges(assembly *a, const int32_t *coupling, int32_t coupling_count)
{
    int64_t own = ELEMENT_PAIRS * (int64_t)a->tet_count, count = own + coupling_count;
    int32_t *low = NEW_ARRAY(int32_t, count), *high = NEW_ARRAY(int32_t, count);
    for (int64_t i = own; i < count; i++) {
        low[i] = coupling[2 * (i - own)];
        high[i] = coupling[2 * (i - own) + 1];
    }
    for (int64_t i = 0; i < own; i++) {
        const int32_t *tet = a->tet + 4 * (i / ELEMENT_PAIRS);
        int32_t u = tet[element_pair[i % ELEMENT_PAIRS][0]], v = tet[element_pair[i % ELEMENT_PAIRS][1]];
        low[i] = u < v ? u : v;
        high[i] = u < v ? v : u;
    }
    int32_t *order = sort_by_two(low, high, count, a->node_count);
    a->edge_start = NEW_ARRAY(int32_t, (size_t)count + 1);
    a->edge_node = NEW_ARRAY(int32_t, 2 * (size_t)count);
    a->edge_source = NEW_ARRAY(int32_t, count);
    int32_t edges = 0;
    for (int64_t k = 0; k < count; k++) {
        int32_t i = order[k];
        if (k == 0 || low[i] != low[order[k - 1]] || high[i] != high[order[k - 1]]) {
            a->edge_start[edges] = (int32_t)k;
            a->edge_node[2 * (size_t)edges] = low[i];
            a->edge_node[2 * (size_t)edges + 1] = high[i];
            edges++;
        }
        if (i >= own) {
            a->edge_source[k] = -1;
            continue;
        }
        int32_t first = a->tet[4 * (size_t)(i / ELEMENT_PAIRS) + element_pair[i % ELEMENT_PAIRS][0]];
        a->edge_source[k] = 2 * i + (first != low[i]);
    }
    a->edge_start[edges] = (int32_t)count;
    a->edge_count = edges;
    a->edge_start = GROW_ARRAY(int32_t, a->edge_start, edges + 1);
    a->edge_node = GROW_ARRAY(int32_t, a->edge_node, 2 * (size_t)edges);
    free(order);
    free(low);
    free(high);
}

static void make_pattern(assembly *a, const boundary *b)
{
    int64_t blocks = 9 * (int64_t)a->edge_count, claims = 0;
    int32_t *block = NEW_ARRAY(int32_t, blocks), *row = NEW_ARRAY(int32_t, blocks),
            *column = NEW_ARRAY(int32_t, blocks);
    a->slot = NEW_ARRAY(int32_t, blocks);
    for (int64_t i = 0; i < blocks; i++) {
        a->slot[i] = -1;
        const int32_t *edge = a->edge_node + 2 * (i / 9);
        int32_t p = b->unknown[3 * (size_t)edge[0] + (i % 9) / 3],
                q = b->unknown[3 * (size_t)edge[1] + i % 3];
        if (p < 0 || q < 0 || (edge[0] == edge[1] && p < q)) continue;
        block[claims] = (int32_t)i;
        row[claims] = p > q ? p : q;
        column[claims] = p > q ? q : p;
        claims++;
    }
    int32_t *order = sort_by_two(column, row, claims, a->unknown_count);
    a->column_start = NEW_ARRAY(int64_t, (size_t)a->unknown_count + 1);
    a->row = NEW_ARRAY(int64_t, claims);
    a->shared_block = NEW_ARRAY(int32_t, 0);
    a->shared_slot = NEW_ARRAY(int32_t, 0);
    int32_t entries = 0, room = 0;
    for (int64_t k = 0; k < claims; k++) {
        int32_t i = order[k];
        if (k == 0 || row[i] != row[order[k - 1]] || column[i] != column[order[k - 1]]) {
            a->row[entries] = row[i];
            a->column_start[column[i] + 1]++;
            a->slot[block[i]] = entries++;
            continue;
        }
        if (a->shared_count == room) {
            room = 2 * room + 64;
            a->shared_block = GROW_ARRAY(int32_t, a->shared_block, room);
            a->shared_slot = GROW_ARRAY(int32_t, a->shared_slot, room);
        }
        a->shared_block[a->shared_count] = block[i];
        a->shared_slot[a->shared_count++] = entries - 1;
    }
    for (int32_t j = 0; j < a->unknown_count; j++) a->column_start[j + 1] += a->column_start[j];
    a->row = GROW_ARRAY(int64_t, a->row, entries);
    a->value = NEW_ARRAY(double, entries);
    free(order);
    free(block);
    free(row);
    free(column);
}

bool assembly_make(const tetmesh *m, elements *el, const boundary *b, const int32_t *coupling,
                   int32_t coupling_count, assembly *out, err *e)
{
    assert(el->count == m->tet_count && b->node_count == m->vertex_count);
    /* 2 * 10 * tets and 9 * edges must fit 31 bits; a tet mesh has fewer than 8 edges and nodes per tet */
    if ((int64_t)m->tet_count + coupling_count > INT32_MAX / 72)
        return err_set(e, ERR_RESOURCE, "%d tets are too many, the limit is %d", m->tet_count,
                       INT32_MAX / 72);
    assembly a = {.node_count = m->vertex_count,
                  .unknown_count = b->unknown_count,
                  .tet_count = m->tet_count,
                  .tet = m->tet,
                  .el = *el,
                  .element_energy = NEW_ARRAY(double, m->tet_count),
                  .element_force = NEW_ARRAY(double, 12 * (size_t)m->tet_count),
                  .element_block = NEW_ARRAY(double, 9 * ELEMENT_PAIRS * (size_t)m->tet_count)};
    *el = (elements){0};
    make_node_lists(&a);
    make_edges(&a, coupling, coupling_count);
    a.edge_block = NEW_ARRAY(double, 9 * (size_t)a.edge_count);
    make_pattern(&a, b);
    *out = a;
    return true;
}

void assembly_free(assembly *a)
{
    elements_free(&a->el);
    average_free(a);
    free(a->node_start);
    free(a->node_source);
    free(a->edge_node);
    free(a->edge_start);
    free(a->edge_source);
    free(a->column_start);
    free(a->row);
    free(a->value);
    free(a->slot);
    free(a->shared_block);
    free(a->shared_slot);
    free(a->element_energy);
    free(a->element_force);
    free(a->element_block);
    free(a->edge_block);
    *a = (assembly){0};
}

static void element_nodes(const assembly *a, int64_t t, const double *x, double x_e[12])
{
    for (int k = 0; k < 4; k++) vec_copy(x + 3 * (size_t)a->tet[4 * t + k], x_e + 3 * k);
}

typedef struct element_job {
    assembly *a;
    const double *x;
    double *force;
    projection how;
} element_job;

static void energy_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    assembly *a = job->a;
    for (int64_t t = begin; t < end; t++) {
        double x_e[12];
        element_nodes(a, t, job->x, x_e);
        material under;
        if (a->node_pressure && job->force) {
            under = average_material(a, t);
            element_energy(&under, a->el.gradient + 12 * t, a->el.volume[t], x_e, a->element_force + 12 * t);
        }
        a->element_energy[t] =
            element_energy(&a->el.materials[a->el.material[t]], a->el.gradient + 12 * t, a->el.volume[t], x_e,
                           job->force && !a->node_pressure ? a->element_force + 12 * t : NULL);
    }
}

static void force_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    const assembly *a = job->a;
    for (int64_t v = begin; v < end; v++) {
        double sum[3] = {0};
        for (int32_t k = a->node_start[v]; k < a->node_start[v + 1]; k++)
            vec_add(sum, a->element_force + 3 * (size_t)a->node_source[k], sum);
        vec_copy(sum, job->force + 3 * v);
    }
}

double assembly_energy(assembly *a, const double *x, double *force)
{
    element_job job = {.a = a, .x = x, .force = force};
    double average = a->node_pressure ? average_energy(a, x) : 0;
    parallel_for(a->tet_count, ELEMENT_GRAIN, energy_body, &job);
    if (force) parallel_for(a->node_count, NODE_GRAIN, force_body, &job);
    double sum = average, carry = 0; /* Kahan: Newton compares energies to the last digits */
    for (int32_t t = 0; t < a->tet_count; t++) {
        double y = a->element_energy[t] - carry, next = sum + y;
        if (!isfinite(next)) return HUGE_VAL;
        carry = (next - sum) - y;
        sum = next;
    }
    return sum;
}

static void stiffness_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    assembly *a = job->a;
    for (int64_t t = begin; t < end; t++) {
        double x_e[12];
        element_nodes(a, t, job->x, x_e);
        material m = a->node_pressure ? average_material(a, t) : a->el.materials[a->el.material[t]];
        element_stiffness(&m, a->el.gradient + 12 * t, a->el.volume[t], x_e, job->how,
                          a->element_block + 9 * ELEMENT_PAIRS * t);
    }
}

static void edge_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    assembly *a = job->a;
    for (int64_t i = begin; i < end; i++) {
        double sum[9] = {0};
        for (int32_t k = a->edge_start[i]; k < a->edge_start[i + 1]; k++) {
            if (a->edge_source[k] < 0) continue; /* a coupling: no element feeds it */
            const double *block = a->element_block + 9 * (size_t)(a->edge_source[k] / 2);
            if (a->edge_source[k] % 2 == 0)
                for (int c = 0; c < 9; c++) sum[c] += block[c];
            else
                for (int c = 0; c < 9; c++) sum[c] += block[3 * (c % 3) + c / 3];
        }
        memcpy(a->edge_block + 9 * i, sum, sizeof sum);
    }
}

void assembly_stiffness(assembly *a, const double *x, projection how)
{
    element_job job = {.a = a, .x = x, .how = how};
    if (a->node_pressure) average_energy(a, x);
    parallel_for(a->tet_count, ELEMENT_GRAIN, stiffness_body, &job);
    parallel_for(a->edge_count, EDGE_GRAIN, edge_body, &job);
    if (a->node_pressure) average_stiffness(a, x);
}

/* The block of edge i between the directions of its nodes: B_u K B_v^T, rows of B the unit vectors. */
static void transform_block(const assembly *a, const boundary *b, int64_t i, double out[9])
{
    const double *k = a->edge_block + 9 * i;
    int32_t u = a->edge_node[2 * i], v = a->edge_node[2 * i + 1];
    if (b->plain[u] && b->plain[v]) {
        memcpy(out, k, 9 * sizeof *out);
        return;
    }
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            double w[3];
            mat_apply(k, b->basis + 9 * (size_t)v + 3 * c, w);
            out[3 * r + c] = vec_dot(b->basis + 9 * (size_t)u + 3 * r, w);
        }
}

typedef struct matrix_job {
    assembly *a;
    const boundary *b;
} matrix_job;

static void matrix_body(int64_t begin, int64_t end, void *context)
{
    const matrix_job *job = context;
    for (int64_t i = begin; i < end; i++) {
        const int32_t *slot = job->a->slot + 9 * i;
        double block[9];
        transform_block(job->a, job->b, i, block);
        for (int c = 0; c < 9; c++)
            if (slot[c] >= 0) job->a->value[slot[c]] = block[c];
    }
}

void assembly_matrix(assembly *a, const boundary *b)
{
    matrix_job job = {a, b};
    parallel_for(a->edge_count, EDGE_GRAIN, matrix_body, &job);
    for (int32_t s = 0; s < a->shared_count; s++) {
        double block[9];
        transform_block(a, b, a->shared_block[s] / 9, block);
        a->value[a->shared_slot[s]] += block[a->shared_block[s] % 9];
    }
}

void assembly_multiply(const assembly *a, const double *d, double *out)
{
    memset(out, 0, 3 * (size_t)a->node_count * sizeof *out);
    for (int64_t i = 0; i < a->edge_count; i++) {
        const double *k = a->edge_block + 9 * i;
        size_t u = 3 * (size_t)a->edge_node[2 * i], v = 3 * (size_t)a->edge_node[2 * i + 1];
        double w[3];
        mat_apply(k, d + v, w);
        vec_add(out + u, w, out + u);
        if (u == v) continue;
        mat_apply_transposed(k, d + u, w);
        vec_add(out + v, w, out + v);
    }
}

/* Rounding of F: coordinates lose eps |x|, divided by the size of the tet. */
static double element_noise(const assembly *a, int32_t t, const double *x, double *stiffness,
                            double *steepest)
{
    double reach = 0, g = 0, x_e[12];
    element_nodes(a, t, x, x_e);
    for (int c = 0; c < 12; c++) reach = fmax(reach, fabs(x_e[c]));
    for (int k = 0; k < 4; k++) g = fmax(g, vec_norm(a->el.gradient + 12 * (size_t)t + 3 * k));
    const struct material *m = &a->el.materials[a->el.material[t]];
    *stiffness = (2 * m->mu_kpa + fabs(m->lambda_kpa) + a->average_lambda_kpa) * a->el.volume[t];
    *steepest = g;
    return 4 * DBL_EPSILON * (1 + reach * g);
}

double assembly_force_noise(const assembly *a, const double *x)
{
    double sum = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double stiffness, g, noise = element_noise(a, t, x, &stiffness, &g);
        sum += stiffness * g * noise * stiffness * g * noise;
    }
    return 4 * sqrt(sum);
}

double assembly_energy_noise(const assembly *a, const double *x)
{
    double sum = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double stiffness, g, x_e[12], F[9];
        double noise = element_noise(a, t, x, &stiffness, &g), strain = noise;
        element_nodes(a, t, x, x_e);
        element_gradient_F(a->el.gradient + 12 * (size_t)t, x_e, F);
        for (int i = 0; i < 9; i++) strain = fmax(strain, fabs(F[i] - (i % 4 == 0)));
        sum += stiffness * strain * noise * stiffness * strain * noise;
    }
    return sqrt(sum);
}

/* No singular value is larger: Gershgorin on F^T F. */
static double stretch_bound(const double F[9])
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int j = 0; j < 3; j++) sum += fabs(F[i] * F[j] + F[3 + i] * F[3 + j] + F[6 + i] * F[6 + j]);
        most = fmax(most, sum);
    }
    return sqrt(most);
}

deformation_extremes assembly_extremes(const assembly *a, const double *x, bool with_stretch)
{
    deformation_extremes d = {.min_j = HUGE_VAL, .min_j_tet = -1, .max_stretch_tet = -1};
    for (int32_t t = 0; t < a->tet_count; t++) {
        double x_e[12], F[9], U[9], s[3], V[9];
        element_nodes(a, t, x, x_e);
        element_gradient_F(a->el.gradient + 12 * (size_t)t, x_e, F);
        double J = mat_det(F);
        if (!(J > 0)) d.inverted_count++;
        if (J < d.min_j) {
            d.min_j = J;
            d.min_j_tet = t;
        }
        if (!with_stretch || stretch_bound(F) <= d.max_stretch) continue;
        svd3(F, U, s, V);
        if (s[0] > d.max_stretch) {
            d.max_stretch = s[0];
            d.max_stretch_tet = t;
        }
    }
    return d;
}
