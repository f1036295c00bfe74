#include "geometry/cut_face.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double on_kerf_mm = 1e-3, facing_mm = 4, sight_mm = 6, mean_mm = 3;

void cut_face_free(cut_face *f)
{
    free(f->sample);
    surface_free(&f->shell);
    *f = (cut_face){0};
}

static double normal_of(const surface *s, int32_t t, double middle[3], double n[3])
{
    const double *x[3];
    double a[3], b[3];
    for (int k = 0; k < 3; k++) x[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
    for (int c = 0; c < 3; c++) middle[c] = (x[0][c] + x[1][c] + x[2][c]) / 3;
    vec_sub(x[1], x[0], a);
    vec_sub(x[2], x[0], b);
    vec_cross(a, b, n);
    return vec_normalize(n) / 2;
}

/* The saw's bone, which lies within low and high, touches the triangle from outside, and `other` is the bone
 * behind. */
static bool is_cut(const cut_bones *b, segment_id own, segment_id other, int32_t t, const double low[3],
                   const double high[3])
{
    double middle[3], n[3], m[3], k[3];
    distance_hit hit;
    if (!(normal_of(&b->bones->part[own], t, middle, n) > 0)) return false;
    for (int c = 0; c < 3; c++)
        if (middle[c] < low[c] - on_kerf_mm || middle[c] > high[c] + on_kerf_mm) return false;
    if (distance_tree_between(b->kerf, middle, 0, 2 * on_kerf_mm, &hit) > on_kerf_mm) return false;
    normal_of(&b->bones->kerf, hit.triangle, m, k);
    if (vec_dot(n, k) > -0.9) return false;
    double mine = distance_tree_between(b->part[other], middle, 0, facing_mm, NULL);
    if (mine >= facing_mm) return false;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (s != (int)own && s != (int)other && b->part[s] && distance_tree_within(b->part[s], middle, mine))
            return false;
    return true;
}

/* ---- samples: pieces of triangles, put together by the box they lie in ---- */

typedef struct piece {
    int32_t box[4]; /* place and main direction */
    cut_sample s;
} piece;

static int by_box(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    for (int c = 0; c < 4; c++)
        if (x->box[c] != y->box[c]) return x->box[c] < y->box[c] ? -1 : 1;
    for (int c = 0; c < 3; c++)
        if (x->s.p[c] != y->s.p[c]) return x->s.p[c] < y->s.p[c] ? -1 : 1;
    return 0;
}

static void add_pieces(const surface *s, int32_t t, double spacing, piece **list, int32_t *count)
{
    const double *x[3];
    double middle[3], n[3], longest = 0, mm2 = normal_of(s, t, middle, n);
    for (int k = 0; k < 3; k++) x[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
    for (int k = 0; k < 3; k++) longest = fmax(longest, vec_distance(x[k], x[(k + 1) % 3]));
    int parts = 1 + (int)(2 * longest / spacing), main_axis = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(n[c]) > fabs(n[main_axis])) main_axis = c;
    *list = GROW_ARRAY(piece, *list, *count + parts * parts);
    for (int i = 0; i < parts; i++)
        for (int k = 0; k < 2 * (parts - i) - 1; k++) { /* rows of triangles, every second one upside down */
            double u = (i + (k % 2 ? 2 : 1) / 3.0) / parts, v = (k / 2 + (k % 2 ? 2 : 1) / 3.0) / parts;
            piece *p = &(*list)[(*count)++];
            for (int c = 0; c < 3; c++) {
                p->s.p[c] = x[0][c] + u * (x[1][c] - x[0][c]) + v * (x[2][c] - x[0][c]);
                p->s.n[c] = n[c];
                p->box[c] = (int32_t)floor(p->s.p[c] / spacing);
            }
            p->box[3] = 2 * main_axis + (n[main_axis] > 0);
            p->s.mm2 = mm2 / (parts * parts);
        }
}

static void join_pieces(piece *list, int32_t count, cut_face *f)
{
    qsort(list, (size_t)count, sizeof *list, by_box);
    f->sample = NEW_ARRAY(cut_sample, count);
    for (int32_t i = 0; i < count;) {
        cut_sample *s = &f->sample[f->count++];
        const int32_t *box = list[i].box;
        for (; i < count && !memcmp(list[i].box, box, sizeof list[i].box); i++) {
            vec_axpy(s->p, list[i].s.mm2, list[i].s.p, s->p);
            vec_axpy(s->n, list[i].s.mm2, list[i].s.n, s->n);
            s->mm2 += list[i].s.mm2;
        }
        vec_scale(s->p, 1 / s->mm2, s->p);
        vec_normalize(s->n);
        f->mm2 += s->mm2;
    }
}

cut_face cut_face_make(const cut_bones *b, segment_id own, segment_id other, double spacing_mm)
{
    cut_face f = {0};
    if (!b->part[own] || !b->part[other] || !b->kerf) return f;
    const surface *s = &b->bones->part[own];
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    piece *list = NULL;
    int32_t count = 0;
    double low[3], high[3];
    surface_bounds(&b->bones->kerf, low, high);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        keep[t] = is_cut(b, own, other, t, low, high);
        if (keep[t]) add_pieces(s, t, spacing_mm, &list, &count);
    }
    join_pieces(list, count, &f);
    f.shell = surface_select(s, keep);
    free(list);
    free(keep);
    return f;
}

cut_face cut_face_towards(const cut_face *f, const double way[3], double cosine, bool two_sided)
{
    cut_face out = {.sample = NEW_ARRAY(cut_sample, f->count)};
    for (int32_t i = 0; i < f->count; i++) {
        double lean = vec_dot(f->sample[i].n, way);
        if ((two_sided ? fabs(lean) : lean) <= cosine) continue;
        out.sample[out.count++] = f->sample[i];
        out.mm2 += f->sample[i].mm2;
    }
    return out;
}

cut_contact cut_contact_measure(const cut_face *f, const clash_body *other, const distance_tree *other_face,
                                const rigid *rel, double touch_mm)
{
    cut_contact c = {0};
    double opening = 0, facing = 0;
    const solid_grid *grid = clash_body_grid(other);
    for (int32_t i = 0; i < f->count; i++) {
        const cut_sample *s = &f->sample[i];
        double p[3], n[3];
        distance_hit hit;
        rigid_apply(rel, s->p, p);
        double clear;
        bool inside = solid_grid_look(grid, p, &clear);
        if (inside || (clear < touch_mm && distance_tree_within(clash_body_tree(other), p, touch_mm))) c.mm2 += s->mm2;
        if (inside) facing += s->mm2;
        if (inside || !other_face || clear > sight_mm) continue;
        double d = distance_tree_between(other_face, p, 0, sight_mm, &hit);
        if (d >= sight_mm) continue;
        vec_sub(hit.at, p, hit.at);
        rigid_rotate(rel, s->n, n);
        if (vec_dot(hit.at, n) < 0.7 * d) continue;
        facing += s->mm2;
        opening += d * s->mm2;
    }
    c.gap_mm = facing > 0 ? opening / facing : (double)NAN;
    return c;
}

clash_spot cut_face_trim(const cut_face *f, const clash_body *other, const distance_tree *other_face, const rigid *rel)
{
    clash_spot spot = {0};
    for (int32_t i = 0; i < f->count; i++) {
        double p[3];
        rigid_apply(rel, f->sample[i].p, p);
        if (!solid_grid_inside(clash_body_grid(other), p)) continue;
        double d = distance_tree_between(other_face, p, spot.mm, HUGE_VAL, NULL);
        if (d <= spot.mm) continue;
        spot.mm = d;
        spot.found = true;
        vec_copy(p, spot.place);
    }
    return spot;
}

bool cut_place_make(const cut_face *f, const double p[3], double kerf_mm, cut_place *out)
{
    const cut_sample *best = NULL;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < f->count; i++) {
        double d = vec_distance(f->sample[i].p, p);
        if (d < least) {
            least = d;
            best = &f->sample[i];
        }
    }
    if (!best) return false;
    *out = (cut_place){0};
    vec_copy(best->p, out->own);
    for (int32_t i = 0; i < f->count; i++)
        if (vec_distance(f->sample[i].p, best->p) < mean_mm && vec_dot(f->sample[i].n, best->n) > 0.5)
            vec_axpy(out->n, f->sample[i].mm2, f->sample[i].n, out->n);
    vec_normalize(out->n);
    vec_axpy(out->own, kerf_mm, out->n, out->other);
    return true;
}

double cut_place_gap(const cut_place *c, const rigid *rel, double *step_mm)
{
    double own[3], d[3];
    rigid_apply(rel, c->own, own);
    vec_sub(c->other, own, d);
    double gap = vec_dot(d, c->n);
    vec_axpy(d, -gap, c->n, d);
    *step_mm = vec_norm(d);
    return gap;
}
