#include "geometry/frame.h"
#include "geometry/vec.h"
#include <stddef.h>

static const double *need(const landmarks *l, const char *label, err *e)
{
    const landmark *p = landmarks_find(l, label);
    if (!p)
        err_set(e, ERR_INPUT, "landmark %s is missing: the Frankfort frame needs Po_L, Po_R and Or_L or Or_R", label);
    return p ? p->xyz : NULL;
}

bool head_frame_from_landmarks(const landmarks *l, head_frame *out, err *e)
{
    const double *po_l = need(l, "Po_L", e), *po_r = need(l, "Po_R", e);
    if (!po_l || !po_r) return false;
    const landmark *or_l = landmarks_find(l, "Or_L"), *or_r = landmarks_find(l, "Or_R");
    if (!or_l && !or_r) return need(l, "Or_L", e) != NULL;
    head_frame f = {0};
    double front[3];
    if (or_l && or_r)
        for (int c = 0; c < 3; c++) front[c] = (or_l->xyz[c] + or_r->xyz[c]) / 2;
    else
        vec_copy(or_l ? or_l->xyz : or_r->xyz, front);
    for (int c = 0; c < 3; c++) f.origin[c] = (po_l[c] + po_r[c]) / 2;
    /* With four points the least-squares plane of a near-rectangle passes through both midpoints and averages the
     * two left-right lines; with three it is exact. */
    double po[3], orb[3] = {0}, back[3];
    vec_sub(po_l, po_r, po);
    if (or_l && or_r) vec_sub(or_l->xyz, or_r->xyz, orb);
    vec_add(po, orb, f.left);
    vec_sub(f.origin, front, back);
    if (!(vec_norm(po) > 20) || !(vec_norm(back) > 20))
        return err_set(e, ERR_INPUT, "porion and orbitale are %.3g and %.3g mm apart: not the points of a head in mm",
                       vec_norm(po), vec_norm(back));
    vec_normalize(f.left);
    vec_cross(f.left, back, f.up);
    if (!(vec_normalize(f.up) > 1))
        return err_set(e, ERR_INPUT, "porion and orbitale lie on one line: no Frankfort plane");
    /* left x posterior = up, with up = left x back */
    vec_cross(f.up, f.left, f.posterior);
    const double *points[4] = {po_l, po_r, or_l ? or_l->xyz : NULL, or_r ? or_r->xyz : NULL};
    for (int i = 0; i < 4; i++) {
        double local[3];
        if (!points[i]) continue;
        head_frame_to_local(&f, points[i], local);
        f.residual_mm = fmax(f.residual_mm, fabs(local[2]));
    }
    if (f.left[0] < 0.5 || f.posterior[1] < 0.5 || f.up[2] < 0.5)
        return err_set(e, ERR_INPUT,
                       "the face looks the wrong way: left (%.2f %.2f %.2f), posterior (%.2f %.2f %.2f), up (%.2f "
                       "%.2f %.2f) must be near +x, +y, +z (LPS); is the file in RAS, mirrored or turned?",
                       f.left[0], f.left[1], f.left[2], f.posterior[0], f.posterior[1], f.posterior[2], f.up[0],
                       f.up[1], f.up[2]);
    *out = f;
    return true;
}

void head_frame_to_local(const head_frame *f, const double p[3], double local[3])
{
    double d[3];
    vec_sub(p, f->origin, d);
    local[0] = vec_dot(d, f->left);
    local[1] = vec_dot(d, f->posterior);
    local[2] = vec_dot(d, f->up);
}

void head_frame_to_world(const head_frame *f, const double local[3], double p[3])
{
    for (int c = 0; c < 3; c++)
        p[c] = f->origin[c] + local[0] * f->left[c] + local[1] * f->posterior[c] + local[2] * f->up[c];
}
