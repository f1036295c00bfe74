#include "fit.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>

bool fit_overlap(const surface *upper, const surface *lower, double front_mm, double *depth_mm, err *e)
{
    nearest *tree = NULL;
    if (!nearest_create(upper, &tree, e)) return false;
    double depth = 0;
    for (int i = 0; i < lower->vertex_count; i++) {
        const double *p = lower->xyz + 3 * i;
        if (p[1] < front_mm || !nearest_inside(tree, p)) continue;
        depth = fmax(depth, nearest_point(tree, p, NULL, NULL));
    }
    nearest_destroy(&tree);
    *depth_mm = depth;
    return true;
}

typedef struct clear_job {
    const nearest *bones;
    const surface *skin;
    const double *normal; /* smoothed, outwards */
    double *gap;          /* distance of each skin vertex from bone, negative inside it */
} clear_job;

static void measure(int64_t begin, int64_t end, void *context)
{
    clear_job *j = context;
    for (int64_t i = begin; i < end; i++) {
        const double *p = j->skin->xyz + 3 * i;
        double q[3], d[3], gap = nearest_point(j->bones, p, q, NULL);
        vec_sub(p, q, d);
        /* close to bone, the side tells: a point under the bone has it outwards */
        if (gap < 4 && vec_dot(d, j->normal + 3 * i) < 0) gap = -gap;
        j->gap[i] = gap;
    }
}

/* Averages over the neighbours, `rounds` times, of `width` numbers per vertex. */
static void spread(const surface *s, double *field, int width, int rounds)
{
    double *sum = NEW_ARRAY(double, width * s->vertex_count), *weight = NEW_ARRAY(double, s->vertex_count);
    for (int r = 0; r < rounds; r++) {
        for (int i = 0; i < s->vertex_count; i++) weight[i] = 1;
        for (int i = 0; i < width * s->vertex_count; i++) sum[i] = field[i];
        for (int t = 0; t < s->triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                int a = s->tri[3 * t + k], b = s->tri[3 * t + (k + 1) % 3];
                for (int c = 0; c < width; c++) {
                    sum[width * a + c] += field[width * b + c];
                    sum[width * b + c] += field[width * a + c];
                }
                weight[a]++;
                weight[b]++;
            }
        for (int i = 0; i < s->vertex_count; i++)
            for (int c = 0; c < width; c++) field[width * i + c] = sum[width * i + c] / weight[i];
    }
    free(sum);
    free(weight);
}

/* Wide averages of the normals: out of the head even on the walls of the groove between the lips. */
static double *outward(const surface *s)
{
    double *n = surface_vertex_normals(s);
    spread(s, n, 3, 12);
    for (int i = 0; i < s->vertex_count; i++) vec_normalize(n + 3 * i);
    return n;
}

/* One push: lack[] widened to its neighbourhood, so that what moves is a gentle swelling. */
static void push(surface *skin, const double *lack, const double *normal)
{
    double *move = COPY_ARRAY(double, lack, skin->vertex_count);
    /* averaging reaches further on coarse meshes: fewer rounds there */
    double edge = sqrt(2.3 * surface_area(skin) / skin->triangle_count);
    int rounds = (int)fmax(1, 3 * (2.5 / edge) * (2.5 / edge) + 0.5);
    for (int round = 0; round < 4; round++) {
        spread(skin, move, 1, rounds);
        for (int i = 0; i < skin->vertex_count; i++) move[i] = fmax(move[i], lack[i]);
    }
    spread(skin, move, 1, 2);
    for (int i = 0; i < skin->vertex_count; i++)
        vec_axpy(skin->xyz + 3 * i, move[i], normal + 3 * i, skin->xyz + 3 * i);
    free(move);
}

bool fit_clear(surface *skin, const bool *exempt, const surface *const *bones, int bone_count, double least_mm,
               double *left_mm, err *e)
{
    surface all = {0};
    for (int i = 0; i < bone_count; i++) {
        surface sum = surface_joined(&all, bones[i]);
        surface_free(&all);
        all = sum;
    }
    nearest *tree = NULL;
    bool ok = nearest_create(&all, &tree, e);
    surface_free(&all);
    if (!ok) return false;
    double *gap = NEW_ARRAY(double, skin->vertex_count), *normal = outward(skin), least = 0;
    for (int round = 0; round < 8; round++) {
        clear_job j = {tree, skin, normal, gap};
        parallel_for(skin->vertex_count, 256, measure, &j);
        least = HUGE_VAL;
        for (int i = 0; i < skin->vertex_count; i++) {
            if (exempt[i]) gap[i] = HUGE_VAL;
            least = fmin(least, gap[i]);
        }
        if (least >= least_mm - 0.1 || round == 7) break;
        for (int i = 0; i < skin->vertex_count; i++) gap[i] = fmax(least_mm - gap[i], 0);
        push(skin, gap, normal);
    }
    nearest_destroy(&tree);
    free(normal);
    free(gap);
    *left_mm = least;
    return true;
}
