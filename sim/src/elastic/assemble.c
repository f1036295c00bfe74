#include "geometry/parallel.h"
#include "sim/src/elastic/assemble_parts.h"
#include <string.h>

typedef struct element_job {
    assembly *a;
    const double *x;
    double *force;
    projection how;
} element_job;

static material material_of(const assembly *a, int64_t t)
{
    return a->average ? average_material(a->average, &a->el, t) : a->el.materials[a->el.material[t]];
}

static void energy_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    assembly *a = job->a;
    for (int64_t t = begin; t < end; t++) {
        double x_e[12];
        element_nodes(a->tet, t, job->x, x_e);
        material m = material_of(a, t);
        a->element_energy[t] = element_energy(&m, a->el.gradient + 12 * t, a->el.volume[t], x_e,
                                              job->force ? a->element_force + 12 * t : NULL);
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
    double twice = a->average ? average_update(a->average, &a->el, x) : 0;
    parallel_for(a->tet_count, ELEMENT_GRAIN, energy_body, &job);
    if (force) parallel_for(a->node_count, NODE_GRAIN, force_body, &job);
    double sum = -twice, carry = 0; /* Kahan: Newton compares energies to the last digits */
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
        element_nodes(a->tet, t, job->x, x_e);
        material m = material_of(a, t);
        element_stiffness(&m, a->el.gradient + 12 * t, a->el.volume[t], x_e, job->how,
                          a->element_block + 9 * ELEMENT_PAIRS * t);
    }
}

static void edge_body(int64_t begin, int64_t end, void *context)
{
    const element_job *job = context;
    assembly *a = job->a;
    int64_t averaged = a->average ? a->average->pair_count : 0;
    for (int64_t i = begin; i < end; i++) {
        double sum[9] = {0};
        for (int32_t k = a->edge_start[i]; k < a->edge_start[i + 1]; k++) {
            int64_t pair = -1 - (int64_t)a->edge_source[k];
            if (pair >= 0) { /* a coupling; those beyond the averages' are fed by others */
                if (pair < averaged) average_add(a->average, pair, sum);
                continue;
            }
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
    if (a->average) {
        average_update(a->average, &a->el, x);
        average_slopes(a->average, &a->el, x);
    }
    parallel_for(a->tet_count, ELEMENT_GRAIN, stiffness_body, &job);
    parallel_for(a->edge_count, EDGE_GRAIN, edge_body, &job);
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

int32_t assembly_edge(const assembly *a, int32_t u, int32_t v)
{
    int32_t low = 0, high = a->edge_count; /* pairs ascend */
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        const int32_t *pair = a->edge_node + 2 * (size_t)middle;
        if (pair[0] < u || (pair[0] == u && pair[1] < v))
            low = middle + 1;
        else
            high = middle;
    }
    const int32_t *pair = a->edge_node + 2 * (size_t)low;
    return low < a->edge_count && pair[0] == u && pair[1] == v ? low : -1;
}

double *assembly_block(const assembly *a, int32_t u, int32_t v)
{
    int32_t edge = assembly_edge(a, u, v);
    return edge < 0 ? NULL : a->edge_block + 9 * (size_t)edge;
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
