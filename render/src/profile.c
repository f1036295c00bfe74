#include "render/src/profile.h"
#include "render/src/section.h"
#include "geometry/cephalometry.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

const double profile_rgb[2][3] = {{0.16, 0.40, 0.72}, {0.80, 0.20, 0.16}}, profile_same_rgb[3] = {0.30, 0.33, 0.38};
static const double same_share = 0.1; /* of a clear move: less is no move */

double profile_text_size(int height) { return fmax(9, height / 52.0); }

bool profile_has_table(const gallery *g, int width, int height)
{
    return g->style->labels && height >= 360 && width > 1.25 * height;
}

bool profile_point(const profile *f, bool after, const char *label, double xyz[3])
{
    const char *missing;
    return ceph_point(after ? f->g->s->after : f->g->s->before, label, xyz, &missing);
}

/* The midline runs through the mean of its points: the midpoint of the porions is off it in many heads. */
static void find_midline(profile *f)
{
    static const char *const midline[] = {"G'", "N'", "Pn", "Sn", "Pg'"};
    const head_frame *frame = &f->g->s->frame;
    double left = 0, p[3], local[3];
    int n = 0;
    for (size_t i = 0; i < sizeof midline / sizeof *midline; i++) {
        if (!profile_point(f, false, midline[i], p)) continue;
        head_frame_to_local(frame, p, local);
        left += local[0];
        n++;
    }
    vec_axpy(frame->origin, n ? left / n : 0, frame->left, f->middle);
}

bool profile_open(gallery *g, const char *const *labels, double margin_mm, int width, int height, profile *out, err *e)
{
    profile f = {.g = g, .width = width, .height = height, .size = profile_text_size(height)};
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL}, p[3], local[3];
    find_midline(&f);
    for (; *labels; labels++)
        for (int after = 0; after < 2; after++) {
            if (!profile_point(&f, after, *labels, p)) continue;
            head_frame_to_local(&g->s->frame, p, local);
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], local[1 + k] - margin_mm);
                high[k] = fmax(high[k], local[1 + k] + margin_mm);
            }
        }
    if (!(low[0] < high[0])) return err_set(e, ERR_USAGE, "a drawing of the profile needs landmarks of the profile");
    head_frame_to_world(&g->s->frame, (double[3]){0, (low[0] + high[0]) / 2, (low[1] + high[1]) / 2}, p);
    f.view = camera_standard(VIEW_LEFT, &g->s->frame, p);
    f.view.half_height_mm = fmax((high[1] - low[1]) / 2, (high[0] - low[0]) / 2 * height / width);
    f.view.depth_mm = 600;
    *out = f;
    return true;
}

static void to_pixels(const profile *f, const double a[3], double *x, double *y)
{
    double near_mm;
    camera_project(&f->view, f->width, f->height, a, x, y, &near_mm);
}

void profile_line(const profile *f, const double a[3], const double b[3], double width, const double rgb[3])
{
    double x0, y0, x1, y1;
    to_pixels(f, a, &x0, &y0);
    to_pixels(f, b, &x1, &y1);
    pen_line(f->p, x0, y0, x1, y1, width, rgb);
}

void profile_dot(const profile *f, const double at[3], double radius, const double rgb[3])
{
    double x, y;
    to_pixels(f, at, &x, &y);
    pen_dot(f->p, x, y, radius, rgb);
}

static void draw_section(const profile *f, const surface *s, const rigid *move, const double *moved, double width,
                         const double rgb[3])
{
    int count;
    int32_t *triangle;
    double *piece = section_of(s, move, f->middle, f->g->s->frame.left, &triangle, &count);
    for (int pass = 0; pass < 2; pass++) /* what moves lies on top */
        for (int i = 0; i < count; i++) {
            const int32_t *v = s->tri + 3 * (size_t)triangle[i];
            bool moves = !moved || fmax(moved[v[0]], fmax(moved[v[1]], moved[v[2]])) > same_share;
            if (moves == pass) profile_line(f, piece + 6 * i, piece + 6 * i + 3, width, moves ? rgb : profile_same_rgb);
        }
    free(piece);
    free(triangle);
}

void profile_skin(const profile *f, bool after, double width)
{
    const subject *s = f->g->s;
    rigid stay = rigid_identity();
    if (s->skin_before)
        draw_section(f, after ? s->skin_after : s->skin_before, &stay, f->g->moved, width, profile_rgb[after]);
}

void profile_bones(const profile *f, bool after, double width)
{
    for (int i = 0; i < f->g->s->part_count; i++) {
        const subject_part *p = f->g->s->parts + i;
        bool moves = part_moves(p);
        draw_section(f, p->bone, after ? &p->after : &p->before, NULL, width,
                     moves ? profile_rgb[after] : profile_same_rgb);
    }
}
