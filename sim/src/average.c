#include "sim/src/average.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>

/* The nodes of the tets around node v, ascending. */
static int32_t ring_of(const int32_t *start, const int32_t *source, const int32_t *tet, int32_t v,
                       int32_t *ring)
{
    int32_t count = 0;
    for (int32_t k = start[v]; k < start[v + 1]; k++)
        for (int c = 0; c < 4; c++) {
            int32_t u = tet[4 * (size_t)(source[k] / 4) + c], at = count;
            while (at > 0 && ring[at - 1] >= u) at--;
            if (at < count && ring[at] == u) continue;
            for (int32_t i = count++; i > at; i--) ring[i] = ring[i - 1];
            ring[at] = u;
        }
    return count;
}

int32_t average_couplings(const tetmesh *m, int32_t **pairs)
{
    int32_t *start = NEW_ARRAY(int32_t, (size_t)m->vertex_count + 2),
            *source = NEW_ARRAY(int32_t, 4 * (size_t)m->tet_count);
    for (int64_t i = 0; i < 4 * (int64_t)m->tet_count; i++) start[m->tet[i] + 2]++;
    for (int32_t v = 0; v < m->vertex_count; v++) start[v + 2] += start[v + 1];
    for (int32_t i = 0; i < 4 * m->tet_count; i++) source[start[m->tet[i] + 1]++] = i;
    int32_t count = 0, room = 0, ring_room = 0;
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (4 * (start[v + 1] - start[v]) > ring_room) ring_room = 4 * (start[v + 1] - start[v]);
    int32_t *ring = NEW_ARRAY(int32_t, ring_room), *out = NEW_ARRAY(int32_t, 0);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        int32_t n = ring_of(start, source, m->tet, v, ring);
        if (count + n * (n - 1) / 2 > room) {
            room = 2 * room + n * n;
            out = GROW_ARRAY(int32_t, out, 2 * (size_t)room);
        }
        for (int32_t i = 0; i < n; i++)
            for (int32_t j = i + 1; j < n; j++, count++) {
                out[2 * (size_t)count] = ring[i];
                out[2 * (size_t)count + 1] = ring[j];
            }
    }
    free(start);
    free(source);
    free(ring);
    *pairs = out;
    return count;
}

bool average_make(assembly *a, err *e)
{
    if (a->el.material_count != 1)
        return err_set(e, ERR_INPUT, "averaged volume changes need one material, got %d",
                       a->el.material_count);
    material *m = &a->el.materials[0];
    if (m->model != MATERIAL_SNH_LOG && m->model != MATERIAL_SNH)
        return err_set(e, ERR_INPUT, "averaged volume changes need snhlog or snh, got %s",
                       material_model_name(m->model));
    a->average_lambda_kpa = m->lambda_kpa;
    m->lambda_kpa = 0;
    a->node_volume = NEW_ARRAY(double, a->node_count);
    a->node_pressure = NEW_ARRAY(double, a->node_count);
    for (int32_t t = 0; t < a->tet_count; t++)
        for (int k = 0; k < 4; k++) a->node_volume[a->tet[4 * (size_t)t + k]] += a->el.volume[t] / 4;
    return true;
}

void average_free(assembly *a)
{
    free(a->node_volume);
    free(a->node_pressure);
}

static void gradient_at(const assembly *a, int64_t t, const double *x, double F[9])
{
    double x_e[12];
    for (int k = 0; k < 4; k++) vec_copy(x + 3 * (size_t)a->tet[4 * t + k], x_e + 3 * k);
    element_gradient_F(a->el.gradient + 12 * t, x_e, F);
}

double average_energy(assembly *a, const double *x)
{
    double sum = 0;
    for (int32_t v = 0; v < a->node_count; v++) a->node_pressure[v] = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double F[9];
        gradient_at(a, t, x, F);
        double part = a->el.volume[t] / 4 * (mat_det(F) - 1);
        for (int k = 0; k < 4; k++) a->node_pressure[a->tet[4 * (size_t)t + k]] += part;
    }
    for (int32_t v = 0; v < a->node_count; v++) {
        double change = a->node_pressure[v] / a->node_volume[v];
        a->node_pressure[v] = a->average_lambda_kpa * change;
        sum += a->node_volume[v] * a->average_lambda_kpa / 2 * change * change;
    }
    return sum;
}

material average_material(const assembly *a, int64_t t)
{
    material m = a->el.materials[0];
    for (int k = 0; k < 4; k++) m.pressure_kpa += a->node_pressure[a->tet[4 * t + k]] / 4;
    return m;
}

static int32_t find_edge(const assembly *a, int32_t low, int32_t high)
{
    int32_t from = 0, to = a->edge_count - 1;
    while (from < to) {
        int32_t mid = from + (to - from) / 2, u = a->edge_node[2 * (size_t)mid];
        if (u < low || (u == low && a->edge_node[2 * (size_t)mid + 1] < high))
            from = mid + 1;
        else
            to = mid;
    }
    assert(a->edge_node[2 * (size_t)from] == low && a->edge_node[2 * (size_t)from + 1] == high);
    return from;
}

void average_stiffness(assembly *a, const double *x)
{
    double *slope = NEW_ARRAY(double, 12 * (size_t)a->tet_count); /* d(V_e/4 J_e) / dx of its nodes */
    int32_t room = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double F[9], C[9];
        gradient_at(a, t, x, F);
        material_cofactor(F, C);
        for (int k = 0; k < 4; k++) {
            double *s = slope + 12 * (size_t)t + 3 * k;
            mat_apply(C, a->el.gradient + 12 * (size_t)t + 3 * k, s);
            vec_scale(s, a->el.volume[t] / 4, s);
        }
    }
    for (int32_t v = 0; v < a->node_count; v++)
        if (4 * (a->node_start[v + 1] - a->node_start[v]) > room)
            room = 4 * (a->node_start[v + 1] - a->node_start[v]);
    int32_t *ring = NEW_ARRAY(int32_t, room);
    double *g = NEW_ARRAY(double, 3 * (size_t)room);
    for (int32_t v = 0; v < a->node_count; v++) {
        int32_t n = ring_of(a->node_start, a->node_source, a->tet, v, ring);
        for (int32_t i = 0; i < 3 * n; i++) g[i] = 0;
        for (int32_t k = a->node_start[v]; k < a->node_start[v + 1]; k++)
            for (int c = 0; c < 4; c++) {
                int64_t corner = 4 * (int64_t)(a->node_source[k] / 4) + c;
                int32_t i = 0;
                while (ring[i] != a->tet[corner]) i++;
                vec_add(g + 3 * i, slope + 3 * corner, g + 3 * i);
            }
        double scale = a->average_lambda_kpa / a->node_volume[v];
        for (int32_t i = 0; i < n; i++)
            for (int32_t j = i; j < n; j++) {
                double *block = a->edge_block + 9 * (size_t)find_edge(a, ring[i], ring[j]);
                for (int c = 0; c < 9; c++) block[c] += scale * g[3 * i + c / 3] * g[3 * j + c % 3];
            }
    }
    free(slope);
    free(ring);
    free(g);
}
