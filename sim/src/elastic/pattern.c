#include "geometry/mem.h"
#include "sim/src/elastic/assemble_parts.h"
#include <assert.h>
#include <stdlib.h>

/* order[] = 0..count-1 sorted by key, stable; keys in [0, key_count). */
static void stable_sort(const int32_t *key, int64_t count, int32_t key_count, const int32_t *in, int32_t *order)
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
    int64_t own = ELEMENT_PAIRS * (int64_t)a->tet_count, averaged = a->average ? a->average->pair_count : 0,
            count = own + averaged + coupling_count;
    int32_t *low = NEW_ARRAY(int32_t, count), *high = NEW_ARRAY(int32_t, count);
    for (int64_t i = 0; i < averaged; i++) {
        low[own + i] = a->average->ring[a->average->pair[2 * i]];
        high[own + i] = a->average->ring[a->average->pair[2 * i + 1]];
    }
    for (int64_t i = 0; i < coupling_count; i++) {
        low[own + averaged + i] = coupling[2 * i];
        high[own + averaged + i] = coupling[2 * i + 1];
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
            a->edge_source[k] = (int32_t)(own - 1 - i);
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
        int32_t p = b->unknown[3 * (size_t)edge[0] + (i % 9) / 3], q = b->unknown[3 * (size_t)edge[1] + i % 3];
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

static bool check_size(const tetmesh *m, int64_t entries, err *e)
{
    return entries <= INT32_MAX || err_set(e, ERR_RESOURCE, "%d tets are too many: %lld entries, the limit is %d",
                                           m->tet_count, (long long)entries, INT32_MAX);
}

bool assembly_make(const tetmesh *m, elements *el, const boundary *b, const int32_t *coupling, int32_t coupling_count,
                   assembly *out, err *e)
{
    assert(el->count == m->tet_count && b->node_count == m->vertex_count);
    if (!check_size(m, 2 * ELEMENT_PAIRS * (int64_t)m->tet_count, e)) return false;
    averages *average = average_make(m, el);
    int64_t pairs = coupling_count + (average ? average->pair_count : 0);
    if (!check_size(m, 2 * ELEMENT_PAIRS * (int64_t)m->tet_count + pairs, e)) {
        average_free(average);
        return false;
    }
    assembly a = {.node_count = m->vertex_count,
                  .unknown_count = b->unknown_count,
                  .tet_count = m->tet_count,
                  .tet = m->tet,
                  .average = average};
    make_node_lists(&a);
    make_edges(&a, coupling, coupling_count);
    if (!check_size(m, 9 * (int64_t)a.edge_count, e)) {
        assembly_free(&a);
        return false;
    }
    a.el = *el;
    *el = (elements){0};
    a.element_energy = NEW_ARRAY(double, m->tet_count);
    a.element_force = NEW_ARRAY(double, 12 * (size_t)m->tet_count);
    a.element_block = NEW_ARRAY(double, 9 * ELEMENT_PAIRS * (size_t)m->tet_count);
    a.edge_block = NEW_ARRAY(double, 9 * (size_t)a.edge_count);
    make_pattern(&a, b);
    *out = a;
    return true;
}

void assembly_free(assembly *a)
{
    elements_free(&a->el);
    average_free(a->average);
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
