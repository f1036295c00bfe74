#include "geometry/label_surface.h"
#include "geometry/label_mesher.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/repair.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { RADIUS = 3 }; /* of the kernel in voxels, and of the empty rim around each field */

typedef struct part_field {
    int32_t low[3], size[3]; /* first voxel and extent, with the rim */
    float *value;            /* NULL: empty part */
} part_field;

struct label_fields {
    double origin[3], step[3][3], inverse[9]; /* index = inverse (p - origin) */
    int count;
    part_field *part;
};

label_surface_params label_surface_params_default(void)
{
    return (label_surface_params){.sigma_voxels = 0.7, .edge_mm = 1.6, .distance_mm = 0.2, .least_mm3 = 20};
}

static void invert_steps(double step[3][3], double inverse[9])
{
    double m[9], c[3];
    for (int r = 0; r < 3; r++)
        for (int a = 0; a < 3; a++) m[3 * r + a] = step[a][r];
    double det = mat_det(m);
    for (int a = 0; a < 3; a++) { /* row a of the inverse: cross product of the other two steps / det */
        vec_cross(step[(a + 1) % 3], step[(a + 2) % 3], c);
        vec_scale(c, 1 / det, inverse + 3 * a);
    }
}

typedef struct smooth_pass {
    const float *in;
    float *out;
    const int32_t *size;
    const double *weight; /* [RADIUS+1] */
    int axis;
} smooth_pass;

static void smooth_slices(int64_t begin, int64_t end, void *context)
{
    const smooth_pass *p = context;
    int64_t nx = p->size[0], ny = p->size[1], stride = p->axis == 0 ? 1 : p->axis == 1 ? nx : nx * ny;
    for (int64_t at = begin * nx * ny; at < end * nx * ny; at++) {
        int64_t place[3] = {at % nx, at / nx % ny, at / (nx * ny)};
        double sum = p->weight[0] * (double)p->in[at];
        for (int r = 1; r <= RADIUS; r++) {
            if (place[p->axis] >= r) sum += p->weight[r] * (double)p->in[at - r * stride];
            if (place[p->axis] + r < p->size[p->axis]) sum += p->weight[r] * (double)p->in[at + r * stride];
        }
        p->out[at] = (float)sum;
    }
}

static part_field smooth_part(const mask *m, double sigma)
{
    part_field f = {0};
    int32_t high[3];
    if (!mask_bounds(m, f.low, high)) return f;
    double weight[RADIUS + 1], total = 0;
    for (int r = 0; r <= RADIUS; r++) {
        weight[r] = exp(-r * r / (2 * sigma * sigma));
        total += r ? 2 * weight[r] : weight[r];
    }
    for (int r = 0; r <= RADIUS; r++) weight[r] /= total;
    for (int c = 0; c < 3; c++) {
        f.low[c] -= RADIUS;
        f.size[c] = high[c] + RADIUS + 1 - f.low[c];
    }
    size_t voxels = (size_t)f.size[0] * (size_t)f.size[1] * (size_t)f.size[2];
    float *other = NEW_ARRAY(float, voxels);
    f.value = NEW_ARRAY(float, voxels);
    for (int32_t k = RADIUS; k < f.size[2] - RADIUS; k++)
        for (int32_t j = RADIUS; j < f.size[1] - RADIUS; j++)
            for (int32_t i = RADIUS; i < f.size[0] - RADIUS; i++) {
                int64_t from = ((int64_t)(k + f.low[2]) * m->size[1] + (j + f.low[1])) * m->size[0] + (i + f.low[0]);
                f.value[((int64_t)k * f.size[1] + j) * f.size[0] + i] = (float)m->on[from];
            }
    for (int axis = 0; axis < 3; axis++) {
        smooth_pass pass = {f.value, other, f.size, weight, axis};
        parallel_for(f.size[2], 1, smooth_slices, &pass);
        float *swap = f.value;
        f.value = other;
        other = swap;
    }
    free(other);
    return f;
}

label_fields *label_fields_create(const volume *grid, const mask *parts, int part_count, double sigma_voxels)
{
    assert(part_count > 0 && sigma_voxels > 0);
    label_fields *f = NEW_ARRAY(label_fields, 1);
    vec_copy(grid->origin, f->origin);
    memcpy(f->step, grid->step, sizeof f->step);
    invert_steps(f->step, f->inverse);
    f->count = part_count;
    f->part = NEW_ARRAY(part_field, part_count);
    for (int i = 0; i < part_count; i++) f->part[i] = smooth_part(parts + i, sigma_voxels);
    return f;
}

void label_fields_destroy(label_fields **f)
{
    if (!*f) return;
    for (int i = 0; i < (*f)->count; i++) free((*f)->part[i].value);
    free((*f)->part);
    free(*f);
    *f = NULL;
}

/* Trilinear value at a voxel index with fractions; 0 outside. */
static double part_at(const part_field *f, const double index[3])
{
    int32_t cell[3];
    double t[3];
    if (!f->value) return 0;
    for (int c = 0; c < 3; c++) {
        double x = index[c] - f->low[c], below = floor(x);
        if (!(below >= 0 && below < f->size[c] - 1)) return 0;
        cell[c] = (int32_t)below;
        t[c] = x - below;
    }
    int64_t nx = f->size[0], plane = nx * f->size[1];
    const float *v = f->value + cell[2] * plane + cell[1] * nx + cell[0];
    double sum = 0;
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 2; j++) {
            const float *row = v + k * plane + j * nx;
            double w = (k ? t[2] : 1 - t[2]) * (j ? t[1] : 1 - t[1]);
            sum += w * ((1 - t[0]) * (double)row[0] + t[0] * (double)row[1]);
        }
    return sum;
}

int label_fields_at(const label_fields *f, const double p[3])
{
    double d[3], index[3], rest = 1, most = 0;
    int part = -1;
    vec_sub(p, f->origin, d);
    mat_apply(f->inverse, d, index);
    for (int i = 0; i < f->count; i++) {
        double value = part_at(f->part + i, index);
        rest -= value;
        if (value <= most) continue;
        most = value;
        part = i;
    }
    return most > rest ? part : -1;
}

typedef struct one_part {
    const label_fields *fields;
    int part;
    double edge_mm;
} one_part;

static int label_of_part(const double p[3], void *context)
{
    const one_part *o = context;
    return label_fields_at(o->fields, p) == o->part;
}

static double size_of_part(const double p[3], int region, void *context)
{
    (void)p, (void)region;
    return ((const one_part *)context)->edge_mm;
}

/* Replaces *s by its pieces that enclose enough. */
static int32_t drop_specks(surface *s, double least_mm3)
{
    int32_t *component, count = surface_components(s, &component), dropped = 0;
    double *mm3 = NEW_ARRAY(double, count);
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        mm3[component[t]] +=
            vec_six_volume(s->xyz, s->xyz + 3 * (size_t)v[0], s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[2]) / 6;
    }
    for (int32_t k = 0; k < count; k++) dropped += fabs(mm3[k]) < least_mm3;
    for (int32_t t = 0; t < s->triangle_count; t++) keep[t] = fabs(mm3[component[t]]) >= least_mm3;
    surface kept = surface_select(s, keep);
    surface_free(s);
    *s = kept;
    free(component);
    free(mm3);
    free(keep);
    return dropped;
}

/* The mesher's surface is the boundary of tetrahedra: closed, but where two sheets come nearer than its
 * triangles measure, four of them can share an edge. */
static bool make_manifold(surface *s, int32_t *crowded_edges, err *e)
{
    int32_t open_edges;
    surface_edge_census(s, &open_edges, crowded_edges);
    if (!*crowded_edges) return true;
    repair_params p = repair_params_default();
    p.min_component_share = 0;
    surface parted;
    if (!repair_solid(s, &p, &parted, NULL, e)) return false;
    surface_free(s);
    *s = parted;
    return true;
}

bool label_surface_make(const label_fields *f, int part, const label_surface_params *p, surface *out,
                        label_surface_report *report, err *e)
{
    const part_field *field = f->part + part;
    label_mesher_params m = label_mesher_params_default();
    m.surface_only = true;
    m.facet_distance_mm = p->distance_mm;
    if (!field->value) return err_set(e, ERR_GEOMETRY, "the part is empty");
    for (int c = 0; c < 3; c++) {
        m.low[c] = HUGE_VAL;
        m.high[c] = -HUGE_VAL;
    }
    for (int corner = 0; corner < 8; corner++) {
        double x[3];
        vec_copy(f->origin, x);
        for (int a = 0; a < 3; a++)
            vec_axpy(x, field->low[a] + (corner >> a & 1 ? field->size[a] - 1 : 0), f->step[a], x);
        for (int c = 0; c < 3; c++) {
            m.low[c] = fmin(m.low[c], x[c]);
            m.high[c] = fmax(m.high[c], x[c]);
        }
    }
    tetmesh mesh;
    one_part context = {f, part, p->edge_mm};
    if (!label_mesher_run(label_of_part, size_of_part, &context, &m, &mesh, e)) return false;
    surface s = label_mesher_surface(&mesh, 1);
    tetmesh_free(&mesh);
    label_surface_report r = {0};
    bool good = make_manifold(&s, &r.crowded_edges, e);
    if (good) r.pieces_dropped = drop_specks(&s, p->least_mm3);
    if (good && !s.triangle_count)
        good = err_set(e, ERR_GEOMETRY, "no piece of the part encloses %g mm^3", p->least_mm3);
    if (!good) {
        surface_free(&s);
        return false;
    }
    *out = s;
    if (report) *report = r;
    return true;
}
