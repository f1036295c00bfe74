#include "sim/src/linear/node_blocks.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

node_blocks node_blocks_make(const boundary *b)
{
    node_blocks f = {.unknown_count = b->unknown_count, .place = NEW_ARRAY(int32_t, b->unknown_count)};
    int32_t next = 0;
    for (int32_t v = 0; v < b->node_count; v++) {
        int32_t first = next;
        for (int k = 0; k < 3; k++)
            if (b->unknown[3 * (size_t)v + k] == next) { /* not shared with a node before */
                f.place[next] = 3 * f.block_count + next - first;
                next++;
            }
        f.block_count += next > first;
    }
    assert(next == b->unknown_count);
    return f;
}

void node_blocks_free(node_blocks *f)
{
    free(f->place);
    *f = (node_blocks){0};
}

/* The blocks below and on the diagonal in block column `block` whose first unknown is *q, ascending; *q moves
 * on. met[block_count] holds marks of earlier columns. */
static int32_t lower_blocks(const node_blocks *f, const assembly *a, int32_t block, int32_t *q, int32_t *met,
                            int32_t *list)
{
    int32_t count = 0;
    for (; *q < f->unknown_count && f->place[*q] / 3 == block; ++*q)
        for (int64_t k = a->column_start[*q]; k < a->column_start[*q + 1]; k++) {
            int32_t i = f->place[a->row[k]] / 3;
            if (met[i] == block + 1) continue;
            met[i] = block + 1;
            list[count++] = i;
        }
    qsort(list, (size_t)count, sizeof *list, blocks_by_number);
    return count;
}

blocks node_blocks_matrix(const node_blocks *f, const assembly *a)
{
    int32_t n = f->block_count, *met = NEW_ARRAY(int32_t, n), *list = NEW_ARRAY(int32_t, n);
    blocks out = {.rows = n, .columns = n, .start = NEW_ARRAY(int64_t, (size_t)n + 2)};
    for (int32_t j = 0, q = 0; j < n; j++) {
        int32_t count = lower_blocks(f, a, j, &q, met, list);
        for (int32_t k = 0; k < count; k++) {
            out.start[list[k] + 2]++;
            if (list[k] != j) out.start[j + 2]++;
        }
    }
    for (int32_t i = 0; i < n; i++) out.start[i + 2] += out.start[i + 1];
    out.column = NEW_ARRAY(int32_t, out.start[n + 1]);
    out.value = NEW_ARRAY(double, 9 * out.start[n + 1]);
    memset(met, 0, (size_t)n * sizeof *met);
    for (int32_t j = 0, q = 0; j < n; j++) { /* columns before j are in row j already */
        int32_t count = lower_blocks(f, a, j, &q, met, list);
        for (int32_t k = 0; k < count; k++) {
            out.column[out.start[list[k] + 1]++] = j;
            if (list[k] != j) out.column[out.start[j + 1]++] = list[k];
        }
    }
    free(met);
    free(list);
    return out;
}

void node_blocks_fill(const node_blocks *f, const assembly *a, const double *value, blocks *out)
{
    int32_t n = f->block_count;
    int64_t *below = COPY_ARRAY(int64_t, out->start, n); /* next block of each row left of the diagonal */
    int64_t *place = NEW_ARRAY(int64_t, n);
    memset(out->value, 0, 9 * (size_t)out->start[n] * sizeof *out->value);
    for (int32_t j = 0, q = 0; j < n; j++) {
        for (int64_t k = below[j]; k < out->start[j + 1]; k++) place[out->column[k]] = k;
        for (; q < f->unknown_count && f->place[q] / 3 == j; q++)
            for (int64_t k = a->column_start[q]; k < a->column_start[q + 1]; k++) {
                int32_t p = f->place[a->row[k]];
                int r = p % 3, c = f->place[q] % 3;
                out->value[9 * place[p / 3] + 3 * c + r] = value[k];
                out->value[9 * below[p / 3] + 3 * r + c] = value[k];
            }
        for (int64_t k = below[j] + 1; k < out->start[j + 1]; k++) below[out->column[k]]++;
    }
    free(below);
    free(place);
}

double *node_blocks_modes(const node_blocks *f, const boundary *b, const double *x)
{
    double *modes = NEW_ARRAY(double, 18 * (size_t)f->block_count), *z = NEW_ARRAY(double, f->unknown_count);
    double *y = NEW_ARRAY(double, 3 * (size_t)b->node_count), centre[3] = {0};
    for (int32_t v = 0; v < b->node_count; v++) vec_axpy(centre, 1.0 / b->node_count, x + 3 * (size_t)v, centre);
    for (int mode = 0; mode < 6; mode++) {
        double axis[3] = {mode % 3 == 0, mode % 3 == 1, mode % 3 == 2}, arm[3], move[3];
        for (size_t v = 0; v < (size_t)b->node_count; v++) {
            vec_sub(x + 3 * v, centre, arm);
            if (mode < 3)
                vec_copy(axis, move);
            else
                vec_cross(axis, arm, move);
            vec_add(b->origin + 3 * v, move, y + 3 * v);
        }
        boundary_project(b, y, z);
        for (int32_t q = 0; q < f->unknown_count; q++) modes[6 * (size_t)f->place[q] + (size_t)mode] = z[q];
    }
    free(z);
    free(y);
    return modes;
}

void node_blocks_scatter(const node_blocks *f, const double *z, double *v)
{
    memset(v, 0, 3 * (size_t)f->block_count * sizeof *v);
    for (int32_t q = 0; q < f->unknown_count; q++) v[f->place[q]] = z[q];
}

void node_blocks_gather(const node_blocks *f, const double *v, double *z)
{
    for (int32_t q = 0; q < f->unknown_count; q++) z[q] = v[f->place[q]];
}
