#include "app/planner/identity/head_sound.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

/* What contact and the rounding of surfaces make of teeth that touch. */
static const double overlap_allowed_mm = 0.1;

typedef struct depths {
    const nearest *in;
    const surface *of;
    bool outside; /* ask for what lies outside, not inside */
    double *mm;   /* [of->vertex_count] */
} depths;

static void measure_depths(int64_t begin, int64_t end, void *context)
{
    const depths *d = context;
    for (int64_t i = begin; i < end; i++) {
        const double *p = d->of->xyz + 3 * i;
        d->mm[i] = nearest_inside(d->in, p) == d->outside ? 0 : nearest_point(d->in, p, NULL, NULL);
    }
}

/* The farthest of the vertices of `of` that lie outside (or inside) the surface; 0: none does. */
static double deepest(const nearest *in, const surface *of, bool outside)
{
    double most = 0, *mm = NEW_ARRAY(double, of->vertex_count);
    parallel_for(of->vertex_count, 256, measure_depths, &(depths){in, of, outside, mm});
    for (int32_t i = 0; i < of->vertex_count; i++) most = fmax(most, mm[i]);
    free(mm);
    return most;
}

/* Teeth of one row touch each other and may share a place; what lies in two of them is inside all the same, because
 * each tooth is asked alone. */
static bool measure_teeth(const surface *in, const surface *of, double *deepest_mm, err *e)
{
    int32_t *shell, shells = surface_components(in, &shell);
    uint8_t *keep = NEW_ARRAY(uint8_t, in->triangle_count);
    bool ok = true;
    for (int32_t k = 0; ok && k < shells; k++) {
        for (int32_t i = 0; i < in->triangle_count; i++) keep[i] = shell[i] == k;
        surface tooth = surface_select(in, keep);
        nearest *tree = NULL;
        ok = nearest_create(&tooth, &tree, e);
        if (ok) *deepest_mm = fmax(*deepest_mm, deepest(tree, of, false));
        nearest_destroy(&tree);
        surface_free(&tooth);
    }
    free(keep);
    free(shell);
    return ok;
}

bool head_teeth_overlap(const surface *upper, const surface *lower, double *deepest_mm, err *e)
{
    *deepest_mm = 0;
    return measure_teeth(upper, lower, deepest_mm, e) && measure_teeth(lower, upper, deepest_mm, e);
}

bool head_soundness_of(const head_template *t, const head_shape *s, head_soundness *out, err *e)
{
    head_soundness f = {0};
    f.min_j = head_min_j(t, s, &f.inverted_tets);
    if (f.inverted_tets) {
        f.bone_out_mm = f.teeth_overlap_mm = (double)NAN;
        *out = f;
        return true;
    }
    surface part[CASE_SURFACE_COUNT];
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) part[i] = head_part(t, s, (case_surface)i);
    nearest *skin = NULL;
    bool ok = nearest_create(&part[CASE_SKIN], &skin, e);
    for (int i = CASE_SKULL; ok && i < CASE_SURFACE_COUNT; i++) {
        double mm = deepest(skin, &part[i], true);
        if (mm > f.bone_out_mm) f.bone = (case_surface)i;
        f.bone_out_mm = fmax(f.bone_out_mm, mm);
    }
    nearest_destroy(&skin);
    ok = ok && head_teeth_overlap(&part[CASE_UPPER_TEETH], &part[CASE_LOWER_TEETH], &f.teeth_overlap_mm, e);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) surface_free(&part[i]);
    if (ok) *out = f;
    return ok;
}

bool head_sound(const head_soundness *f, double template_overlap_mm, err *e)
{
    if (f->inverted_tets)
        return err_set(e, ERR_GEOMETRY, "no head: %d tetrahedra of its tissue are inverted (least volume ratio %.3f)",
                       f->inverted_tets, f->min_j);
    if (f->bone_out_mm > 0)
        return err_set(e, ERR_GEOMETRY, "no head: its %s lies %.2f mm outside the skin", case_surface_name(f->bone),
                       f->bone_out_mm);
    if (f->teeth_overlap_mm > template_overlap_mm + overlap_allowed_mm)
        return err_set(e, ERR_GEOMETRY, "no head: its upper and lower teeth lie %.2f mm in each other (template %.2f)",
                       f->teeth_overlap_mm, template_overlap_mm);
    return true;
}
