#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/surface_compare.h"
#include "geometry/triangle.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

enum { POINTS_MIN = 100, ITERATIONS_MAX = 60 };
static const double kept_share = 0.8, far_mm = 20, still_mm = 1e-9, open_motion = 1e-6;

typedef struct pair { /* a point of the still surface, taken into the moving one's place, and its closest point */
    double at[3], normal[3], gap; /* gap: along the normal of the triangle; mm */
    double distance;
} pair;

typedef struct fit_job {
    const double *point; /* [3*count] */
    const nearest *tree;
    const surface *moving;
    rigid back; /* from the still surface's place into the moving one's */
    pair *out;
} fit_job;

static void pair_up(int64_t begin, int64_t end, void *context)
{
    const fit_job *j = context;
    for (int64_t i = begin; i < end; i++) {
        pair *p = j->out + i;
        double q[3], d[3];
        int32_t triangle;
        rigid_apply(&j->back, j->point + 3 * i, p->at);
        p->distance = nearest_point(j->tree, p->at, q, &triangle);
        triangle_normal(j->moving, triangle, p->normal);
        vec_sub(q, p->at, d);
        p->gap = vec_dot(d, p->normal);
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Distance that kept_share of the pairs do not exceed; *half: the median. */
static double trim_at(const pair *p, int32_t count, double *half)
{
    double *d = NEW_ARRAY(double, count);
    for (int32_t i = 0; i < count; i++) d[i] = p[i].distance;
    qsort(d, (size_t)count, sizeof *d, by_size);
    double limit = d[(int32_t)(kept_share * (count - 1))];
    *half = d[count / 2];
    free(d);
    return limit;
}

/* Solves the symmetric 6x6 system in place (LDL^T without pivots; the unknowns are scaled alike). false: singular. */
static bool solve_6(double a[6][6], double x[6])
{
    double largest = 0;
    for (int i = 0; i < 6; i++) largest = fmax(largest, a[i][i]);
    for (int k = 0; k < 6; k++) {
        if (!(a[k][k] > open_motion * largest)) return false;
        for (int i = k + 1; i < 6; i++) {
            double f = a[i][k] / a[k][k];
            for (int c = k; c < 6; c++) a[i][c] -= f * a[k][c];
            x[i] -= f * x[k];
        }
    }
    for (int k = 5; k >= 0; k--) {
        for (int c = k + 1; c < 6; c++) x[k] -= a[k][c] * x[c];
        x[k] /= a[k][k];
    }
    return true;
}

/* The small motion of the points that closes the gaps best. Rotation about their middle, in units of their spread. */
static bool step(const pair *p, int32_t count, double limit, rigid *out, double *length)
{
    double middle[3] = {0}, spread = 0, a[6][6] = {{0}}, x[6] = {0};
    int32_t used = 0;
    for (int32_t i = 0; i < count; i++)
        if (p[i].distance <= limit) {
            vec_add(middle, p[i].at, middle);
            used++;
        }
    vec_scale(middle, 1.0 / used, middle);
    for (int32_t i = 0; i < count; i++)
        if (p[i].distance <= limit) spread += vec_distance(p[i].at, middle) / used;
    if (!(spread > 0)) return false;
    for (int32_t i = 0; i < count; i++) {
        if (p[i].distance > limit) continue;
        double arm[3], row[6];
        vec_sub(p[i].at, middle, arm);
        vec_cross(arm, p[i].normal, row);
        vec_scale(row, 1 / spread, row);
        vec_copy(p[i].normal, row + 3);
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) a[r][c] += row[r] * row[c];
            x[r] += row[r] * p[i].gap;
        }
    }
    if (!solve_6(a, x)) return false;
    double axis[3] = {x[0] / spread, x[1] / spread, x[2] / spread}, turn = vec_normalize(axis);
    rigid shift = rigid_translation(x + 3), rotation = turn > 0 ? rigid_rotation(middle, axis, turn) : rigid_identity();
    *out = rigid_compose(&shift, &rotation);
    *length = turn * spread + vec_norm(x + 3);
    return true;
}

static double rms_of(const pair *p, int32_t count, double limit, int32_t *used)
{
    double sum = 0;
    *used = 0;
    for (int32_t i = 0; i < count; i++)
        if (p[i].distance <= limit) {
            sum += p[i].distance * p[i].distance;
            ++*used;
        }
    return sqrt(sum / *used);
}

static bool iterate(fit_job *j, int32_t count, surface_fit *fit, err *e)
{
    for (double length = HUGE_VAL;; fit->iterations++) {
        double half, limit;
        rigid move;
        parallel_for(count, 256, pair_up, j);
        limit = trim_at(j->out, count, &half);
        fit->rms_after_mm = rms_of(j->out, count, limit, &fit->used);
        if (!fit->iterations) fit->rms_before_mm = fit->rms_after_mm;
        if (half > far_mm)
            return err_set(e, ERR_GEOMETRY,
                           "the faces cannot be aligned: half of the forehead lies more than %g mm from the other "
                           "surface; bring them roughly into one place first",
                           far_mm);
        if (!(length > still_mm) || fit->iterations == ITERATIONS_MAX) return true;
        if (!step(j->out, count, limit, &move, &length))
            return err_set(e, ERR_GEOMETRY, "the faces cannot be aligned: the forehead alone leaves their motion open");
        j->back = rigid_compose(&move, &j->back);
    }
}

bool surface_fit_rigid(const surface *moving, const surface *still, const uint8_t *selected, surface_fit *out, err *e)
{
    surface_fit fit = {0};
    nearest *tree = NULL;
    if (!surface_check(moving, e) || !surface_check(still, e)) return false;
    for (int32_t v = 0; v < still->vertex_count; v++) fit.points += selected[v] != 0;
    if (fit.points < POINTS_MIN)
        return err_set(e, ERR_GEOMETRY, "the faces cannot be aligned: the forehead has %d points, needed are %d",
                       fit.points, POINTS_MIN);
    if (!nearest_create(moving, &tree, e)) return false;
    double *point = NEW_ARRAY(double, 3 * fit.points), *next = point;
    for (int32_t v = 0; v < still->vertex_count; v++)
        if (selected[v]) {
            vec_copy(still->xyz + 3 * (size_t)v, next);
            next += 3;
        }
    fit_job job = {point, tree, moving, rigid_identity(), NEW_ARRAY(pair, fit.points)};
    bool ok = iterate(&job, fit.points, &fit, e);
    fit.move = rigid_inverse(&job.back);
    free(point);
    free(job.out);
    nearest_destroy(&tree);
    if (ok) *out = fit;
    return ok;
}
