#include "body_mesh.h"
#include "geometry/label_mesher.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sdf.h"
#include <stdlib.h>

/* Distances on a coarse lattice decide far points; near the surface the body itself is asked. */
static const double step_mm = 4, near_mm = 7;

typedef struct sampled {
    const bodies *b;
    body_id id;
    double coarseness;
    double low[3], high[3];
    int count[3];
    float *value;
} sampled;

static const double boxes[BODY_COUNT][2][3] = {
    {{-102, -126, -156}, {102, 106, 130}}, {{-80, -106, -50}, {80, 98, 124}}, {{-64, -104, -98}, {64, 8, 12}}};

double body_distance(const bodies *b, body_id id, const double p[3])
{
    return id == BODY_SKIN ? body_skin(b, p) : id == BODY_SKULL ? body_skull(b, p) : body_mandible(b, p);
}

void body_normal(const bodies *b, body_id id, const double p[3], double n[3])
{
    const double h = 0.05;
    for (int c = 0; c < 3; c++) {
        double lo[3], hi[3];
        vec_copy(p, lo);
        vec_copy(p, hi);
        lo[c] -= h;
        hi[c] += h;
        n[c] = body_distance(b, id, hi) - body_distance(b, id, lo);
    }
    vec_normalize(n);
}

static void sample_rows(int64_t begin, int64_t end, void *context)
{
    sampled *s = context;
    for (int64_t row = begin; row < end; row++)
        for (int i = 0; i < s->count[0]; i++) {
            int64_t j = row % s->count[1], k = row / s->count[1];
            double p[3] = {s->low[0] + step_mm * i, s->low[1] + step_mm * (double)j, s->low[2] + step_mm * (double)k};
            s->value[row * s->count[0] + i] = (float)body_distance(s->b, s->id, p);
        }
}

static int label(const double p[3], void *context)
{
    const sampled *s = context;
    int64_t at = 0;
    for (int c = 2; c >= 0; c--) {
        double u = (p[c] - s->low[c]) / step_mm;
        if (u < 0 || u > s->count[c] - 1) return 0;
        at = at * s->count[c] + (int64_t)(u + 0.5);
    }
    double rough = (double)s->value[at];
    if (fabs(rough) > near_mm) return rough < 0;
    return body_distance(s->b, s->id, p) < 0;
}

/* Fine where the face moves and where small things are, coarse at the back. */
static double skin_size(const double p[3])
{
    double mouth = sdf_ellipsoid(p, 0, -92, -48, 30, 16, 14), nose = sdf_ellipsoid(p, 0, -104, -20, 20, 16, 16);
    double eyes = sdf_ellipsoid((double[3]){fabs(p[0]), p[1], p[2]}, 31, -84, 14, 20, 12, 13);
    double ears = sdf_ellipsoid((double[3]){fabs(p[0]), p[1], p[2]}, 76, 8, 2, 10, 22, 36);
    double brows = sdf_ellipsoid((double[3]){fabs(p[0]), p[1], p[2]}, 30, -88, 35, 22, 10, 6);
    double fine = sdf_min(sdf_min(mouth, nose), sdf_min(sdf_min(eyes, brows + 4), ears + 3));
    double face = sdf_max(p[1] + 40, 0) * 0.03;
    /* the lips have the smallest relief */
    return sdf_clamp(1.3 + 0.08 * sdf_max(fine, 0) + face, 1.3, 4.5) - 0.3 * sdf_step(4, -2, mouth);
}

static double bone_size(const double p[3])
{
    double back = sdf_max(p[1] + 45, 0), top = sdf_max(p[2] - 42, 0);
    return sdf_clamp(1.7 + 0.04 * back + 0.05 * top, 1.7, 4.5);
}

static double size(const double p[3], int region, void *context)
{
    const sampled *s = context;
    (void)region;
    return s->coarseness * (s->id == BODY_SKIN ? skin_size(p) : s->id == BODY_SKULL ? bone_size(p) : 1.7);
}

bool body_surface(const bodies *b, body_id id, double coarseness, surface *out, err *e)
{
    sampled s = {.b = b, .id = id, .coarseness = coarseness};
    int64_t total = 1;
    for (int c = 0; c < 3; c++) {
        s.low[c] = boxes[id][0][c];
        s.high[c] = boxes[id][1][c];
        s.count[c] = (int)ceil((s.high[c] - s.low[c]) / step_mm) + 1;
        total *= s.count[c];
    }
    s.value = NEW_ARRAY(float, total);
    parallel_for((int64_t)s.count[1] * s.count[2], 8, sample_rows, &s);

    label_mesher_params p = label_mesher_params_default();
    vec_copy(s.low, p.low);
    vec_copy(s.high, p.high);
    p.surface_only = true;
    p.facet_distance_mm = 0.12 * coarseness;
    p.boundary_error_mm = 0.005;
    tetmesh m = {0};
    bool ok = label_mesher_run(label, size, &s, &p, &m, e);
    if (ok) *out = label_mesher_surface(&m, 1);
    tetmesh_free(&m);
    free(s.value);
    return ok;
}
