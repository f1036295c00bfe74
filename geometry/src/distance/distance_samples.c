#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/src/distance/distance_blocks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ASKED = 1, NEEDED = 2 };

void distance_samples_free(distance_samples *s)
{
    free(s->block);
    free(s->centre);
    free(s->value);
    *s = (distance_samples){0};
}

static void place_of(const distance_field *f, int32_t block, int32_t at[3])
{
    at[0] = block % f->blocks[0];
    at[1] = block / f->blocks[0] % f->blocks[1];
    at[2] = block / f->blocks[0] / f->blocks[1];
}

/* Marks the blocks from low to high, as far as there are any. */
static void mark_box(const distance_field *f, const double low[3], const double high[3], uint8_t mark, uint8_t *marks)
{
    int32_t from[3], to[3], at[3];
    for (int c = 0; c < 3; c++) {
        if (!(high[c] >= 0 && low[c] < f->blocks[c])) return;
        from[c] = (int32_t)fmax(0, low[c]);
        to[c] = (int32_t)fmin(f->blocks[c] - 1, high[c]);
    }
    for (at[2] = from[2]; at[2] <= to[2]; at[2]++)
        for (at[1] = from[1]; at[1] <= to[1]; at[1]++)
            for (at[0] = from[0]; at[0] <= to[0]; at[0]++) marks[block_slot(f, at)] |= mark;
}

typedef struct find_job {
    const distance_field *f;
    uint8_t *marks;
    distance_samples *out;
} find_job;

static void look_body(int64_t begin, int64_t end, void *context)
{
    const find_job *job = context;
    for (int64_t b = begin; b < end; b++) {
        int32_t at[3];
        place_of(job->f, (int32_t)b, at);
        if (job->marks[b] && block_is_far(job->f, at)) job->marks[b] = 0;
    }
}

static void fill_body(int64_t begin, int64_t end, void *context)
{
    const find_job *job = context;
    for (int64_t k = begin; k < end; k++) {
        int32_t at[3];
        place_of(job->f, job->out->block[k], at);
        memcpy(job->out->value + BLOCK * k, block_get(job->f, at), BLOCK * sizeof(float));
        (void)block_is_far(job->f, at);
        job->out->centre[k] = atomic_load(&job->f->centre[job->out->block[k]]);
    }
}

distance_samples distance_field_find(const distance_field *f, const double *xyz, int32_t count, double about_mm)
{
    distance_samples out = {0};
    int32_t blocks = f->blocks[0] * f->blocks[1] * f->blocks[2];
    find_job job = {f, NEW_ARRAY(uint8_t, blocks), &out};
    const double side = SIDE * f->step;
    for (int32_t i = 0; i < count; i++) {
        double low[3], high[3];
        for (int c = 0; c < 3; c++) {
            low[c] = (xyz[3 * (size_t)i + (size_t)c] - about_mm - f->low[c]) / side;
            high[c] = low[c] + 2 * about_mm / side;
        }
        mark_box(f, low, high, ASKED, job.marks);
    }
    parallel_for(blocks, 256, look_body, &job);
    for (int32_t b = 0; b < blocks; b++) { /* a spline reaches into the blocks around its own */
        int32_t at[3];
        if (!(job.marks[b] & ASKED)) continue;
        place_of(f, b, at);
        mark_box(f, (double[]){at[0] - 1, at[1] - 1, at[2] - 1}, (double[]){at[0] + 1, at[1] + 1, at[2] + 1}, NEEDED,
                 job.marks);
    }
    for (int32_t b = 0; b < blocks; b++) out.count += job.marks[b] != 0;
    out.block = NEW_ARRAY(int32_t, out.count);
    out.centre = NEW_ARRAY(float, out.count);
    out.value = NEW_ARRAY(float, BLOCK *(size_t)out.count);
    for (int32_t b = 0, k = 0; b < blocks; b++)
        if (job.marks[b]) out.block[k++] = b;
    parallel_for(out.count, 16, fill_body, &job);
    free(job.marks);
    return out;
}

void distance_field_lend(distance_field *f, const distance_samples *s)
{
    for (int32_t k = 0; k < s->count; k++) {
        atomic_store(&f->block[s->block[k]], s->value + BLOCK * (size_t)k);
        atomic_store(&f->centre[s->block[k]], s->centre[k]);
    }
    f->lent = s;
}

bool distance_samples_sound(const distance_samples *s, const double low[3], const double high[3], double step_mm,
                            double reach_mm)
{
    double first[3];
    int32_t blocks[3];
    int64_t count = block_grid(low, high, step_mm, reach_mm, first, blocks);
    for (int32_t k = 0; k < s->count; k++) {
        if (s->block[k] < (k ? s->block[k - 1] + 1 : 0) || s->block[k] >= count || !isfinite(s->centre[k]))
            return false;
        for (int i = 0; i < BLOCK; i++)
            if (!isfinite(s->value[BLOCK * (size_t)k + (size_t)i])) return false;
    }
    return true;
}
