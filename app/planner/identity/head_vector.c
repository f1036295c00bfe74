#include "app/planner/identity/head_vector.h"
#include "geometry/frame.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const case_surface surface_of[HEAD_BLOCK_COUNT] = {[HEAD_SKULL] = CASE_SKULL,
                                                          [HEAD_MANDIBLE] = CASE_MANDIBLE,
                                                          [HEAD_UPPER_TEETH] = CASE_UPPER_TEETH,
                                                          [HEAD_LOWER_TEETH] = CASE_LOWER_TEETH,
                                                          [HEAD_SKIN] = CASE_SKIN};

static bool is_tissue(head_block b) { return b == HEAD_REST || b == HEAD_NEUTRAL; }

const char *head_gap_name(int block)
{
    static const char *const name[HEAD_GAP_COUNT] = {"tissue at rest", "tissue",      "skull", "mandible",
                                                     "upper teeth",    "lower teeth", "skin",  "face"};
    assert(block >= 0 && block < HEAD_GAP_COUNT);
    return name[block];
}

const char *head_block_name(head_block b) { return head_gap_name((int)b); }

int head_block_surface(head_block b) { return is_tissue(b) ? -1 : (int)surface_of[b]; }

static int32_t vertices(const head_template *t, head_block b)
{
    return is_tissue(b) ? t->tissue.mesh.vertex_count : t->part[surface_of[b]].vertex_count;
}

static double **place_in(head_shape *s, head_block b)
{
    return b == HEAD_REST ? &s->rest : b == HEAD_NEUTRAL ? &s->neutral : &s->part[surface_of[b]];
}

head_layout head_layout_of(const head_template *t)
{
    head_layout l = {0};
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) l.start[b + 1] = l.start[b] + 3 * vertices(t, (head_block)b);
    return l;
}

static void transform(const rigid *move, double *xyz, int32_t count)
{
    for (int32_t i = 0; i < count; i++) rigid_apply(move, xyz + 3 * (size_t)i, xyz + 3 * (size_t)i);
}

bool head_shape_to_frankfort(const head_template *t, head_shape *s, rigid *move, err *e)
{
    landmarks points = head_points(t, s);
    head_frame f;
    bool ok = head_frame_from_landmarks(&points, &f, e);
    landmarks_free(&points);
    if (!ok) return false;
    rigid to = {.r = {f.left[0], f.left[1], f.left[2], f.posterior[0], f.posterior[1], f.posterior[2], f.up[0], f.up[1],
                      f.up[2]}};
    rigid_rotate(&to, f.origin, to.t);
    for (int k = 0; k < 3; k++) to.t[k] = -to.t[k];
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) transform(&to, *place_in(s, (head_block)b), vertices(t, (head_block)b));
    if (move) *move = to;
    return true;
}

void head_vector_of(const head_template *t, const head_shape *s, double *phi)
{
    head_layout l = head_layout_of(t);
    head_shape from = *s;
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++)
        memcpy(phi + l.start[b], *place_in(&from, (head_block)b), sizeof *phi * (size_t)(l.start[b + 1] - l.start[b]));
}

head_shape head_vector_shape(const head_template *t, const double *phi)
{
    head_layout l = head_layout_of(t);
    head_shape s = {0};
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++)
        *place_in(&s, (head_block)b) = COPY_ARRAY(double, phi + l.start[b], l.start[b + 1] - l.start[b]);
    return s;
}

static void add_areas(const surface *s, double *w)
{
    for (int32_t i = 0; i < s->triangle_count; i++) {
        const int32_t *v = s->tri + 3 * (size_t)i;
        const double *a = s->xyz + 3 * (size_t)v[0];
        double ab[3], ac[3], across[3];
        vec_sub(s->xyz + 3 * (size_t)v[1], a, ab);
        vec_sub(s->xyz + 3 * (size_t)v[2], a, ac);
        vec_cross(ab, ac, across);
        for (int k = 0; k < 3; k++) w[v[k]] += vec_norm(across) / 6;
    }
}

static double tet_volume(const double *xyz, const int32_t *v)
{
    double d[3][3], across[3];
    for (int k = 0; k < 3; k++) vec_sub(xyz + 3 * (size_t)v[k + 1], xyz + 3 * (size_t)v[0], d[k]);
    vec_cross(d[0], d[1], across);
    return vec_dot(across, d[2]) / 6;
}

static void add_volumes(const tetmesh *m, double *w)
{
    for (int32_t i = 0; i < m->tet_count; i++) {
        const int32_t *v = m->tet + 4 * (size_t)i;
        double volume = tet_volume(m->xyz, v);
        for (int k = 0; k < 4; k++) w[v[k]] += volume / 4;
    }
}

double *head_vector_weights(const head_template *t)
{
    head_layout l = head_layout_of(t);
    double *weight = NEW_ARRAY(double, l.start[HEAD_BLOCK_COUNT]);
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) {
        int32_t count = vertices(t, (head_block)b);
        double *w = NEW_ARRAY(double, count), all = 0, share = is_tissue((head_block)b) ? 0.5 : 1;
        if (is_tissue((head_block)b))
            add_volumes(&t->tissue.mesh, w);
        else
            add_areas(&t->part[surface_of[b]], w);
        for (int32_t i = 0; i < count; i++) all += w[i];
        for (int32_t i = 0; i < 3 * count; i++) weight[l.start[b] + i] = share * w[i / 3] / all;
        free(w);
    }
    return weight;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static head_gap summary(double *mm, int32_t count)
{
    if (!count) return (head_gap){(double)NAN, (double)NAN, (double)NAN};
    double sum = 0;
    qsort(mm, (size_t)count, sizeof *mm, by_size);
    for (int32_t i = 0; i < count; i++) sum += mm[i];
    return (head_gap){sum / count, mm[(int32_t)(0.95 * (count - 1))], mm[count - 1]};
}

void head_vector_gaps(const head_template *t, const double *a, const double *b, const double *known,
                      head_gap out[HEAD_GAP_COUNT])
{
    head_layout l = head_layout_of(t);
    for (int block = 0; block < HEAD_GAP_COUNT; block++) {
        bool face = block == HEAD_FACE;
        int from = face ? HEAD_SKIN : block;
        int32_t count = (l.start[from + 1] - l.start[from]) / 3, used = 0;
        double *mm = NEW_ARRAY(double, count);
        for (int32_t i = 0; i < count; i++) {
            size_t at = (size_t)l.start[from] + 3 * (size_t)i;
            if (known && !(known[at] > 0)) continue;
            if (!face || t->skin_on_tissue.tet[i] >= 0) mm[used++] = vec_distance(a + at, b + at);
        }
        out[block] = summary(mm, used);
        free(mm);
    }
}
