#include "geometry/face_fit.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double stable_rms_mm = 2, nose_mean_mm = 8;

bool face_outward(surface *skin, const face_map *m, const double posterior[3])
{
    double *normal = surface_vertex_normals(skin), sum = 0;
    for (int32_t v = 0; v < skin->vertex_count; v++)
        if (m->stable[v] || m->region[v] != FACE_OUTSIDE) sum += vec_dot(normal + 3 * (size_t)v, posterior);
    free(normal);
    if (sum > 0) surface_flip(skin);
    return sum > 0;
}

/* Mean distance at the nose, mm; 0 where the actual face does not cover it. */
static bool nose_apart(const surface *actual, const surface *predicted, const face_map *m, const rigid *move,
                       double *mm, err *e)
{
    surface moved = surface_copy(actual);
    double *d = NEW_ARRAY(double, predicted->vertex_count);
    surface_transform(&moved, move);
    bool ok = surface_signed_distance(predicted, &moved, d, e);
    if (ok) {
        distance_stats s = distance_summary(d, m->region, FACE_NOSE, predicted->vertex_count);
        *mm = s.count ? s.mean_abs : 0;
    }
    free(d);
    surface_free(&moved);
    return ok;
}

typedef struct axes { /* new[c] = sign[c] * old[from[c]] */
    int from[3], sign[3];
} axes;

/* The k-th of the 48 ways to name and point three axes; 0: as they are. */
static axes axes_at(int k)
{
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    axes a;
    for (int c = 0; c < 3; c++) {
        a.from[c] = order[k / 8][c];
        a.sign[c] = k >> c & 1 ? -1 : 1;
    }
    return a;
}

static surface with_axes(const surface *s, const axes *a)
{
    surface out = surface_copy(s);
    for (int32_t v = 0; v < s->vertex_count; v++)
        for (int c = 0; c < 3; c++)
            out.xyz[3 * (size_t)v + (size_t)c] = a->sign[c] * s->xyz[3 * (size_t)v + (size_t)a->from[c]];
    return out;
}

/* Which axes would make the faces fit best; false: none. */
static bool mend(const surface *actual, const surface *predicted, const face_map *m, axes *best)
{
    double least = stable_rms_mm;
    bool found = false;
    for (int k = 1; k < 48; k++) {
        axes a = axes_at(k);
        surface turned = with_axes(actual, &a);
        surface_fit fit;
        err ignored = {0};
        double nose = 0;
        if (surface_fit_rigid(&turned, predicted, m->stable, &fit, &ignored) && fit.rms_after_mm < least &&
            nose_apart(&turned, predicted, m, &fit.move, &nose, &ignored) && nose <= nose_mean_mm) {
            least = fit.rms_after_mm;
            *best = a;
            found = true;
        }
        surface_free(&turned);
    }
    return found;
}

static void say(const axes *a, char text[64])
{
    int side = 0;
    for (int c = 0; c < 3; c++)
        for (int b = 0; b < c; b++) side += a->from[b] > a->from[c];
    for (int c = 0; c < 3; c++) side += a->sign[c] < 0;
    snprintf(text, 64, "(%s%c, %s%c, %s%c)%s", a->sign[0] < 0 ? "-" : "", "xyz"[a->from[0]],
             a -> sign[1] < 0 ? "-" : "", "xyz"[a->from[1]], a -> sign[2] < 0 ? "-" : "", "xyz"[a->from[2]],
             side % 2 ? ", mirrored," : "");
}

bool face_fit(const surface *actual, const surface *predicted, const face_map *m, surface_fit *out, err *e)
{
    err why = {0};
    double nose = 0;
    bool fitted = surface_fit_rigid(actual, predicted, m->stable, out, &why) &&
                  nose_apart(actual, predicted, m, &out->move, &nose, &why);
    if (fitted && out->rms_after_mm <= stable_rms_mm && nose <= nose_mean_mm) return true;
    axes a;
    char text[64];
    bool mended = surface_check(actual, &(err){0}) && mend(actual, predicted, m, &a);
    if (mended) say(&a, text);
    if (!fitted && !mended) return err_set(e, why.code, "%s", why.text);
    if (!fitted)
        return err_set(
            e, ERR_GEOMETRY,
            "the faces cannot be aligned as they lie, and would be with the axes of the actual face taken as "
            "%s: is it in another system (RAS, y up)?",
            text);
    return err_set(
        e, ERR_GEOMETRY,
        "the faces do not fit after alignment on the forehead: %.1f mm RMS there, %.1f mm apart at the nose; "
        "%s%s%s",
        out->rms_after_mm, nose, mended ? "they would with the axes of the actual face taken as " : "",
        mended ? text : "",
        mended ? ": is it in another system (RAS, y up)?" : "are the axes others, or is it another head?");
}
