/* How the actual face comes to lie where the predicted one does. */
#include "app/planner/predict/face_compare.h"
#include "geometry/face_fit.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double cranium_rms_mm = 2, above_mm = 60;

/* The middle of the chin, and the arm to it from the middle of the stable skin. */
static void find_chin(const face_compare *c, double chin[3], double arm[3])
{
    const surface *s = &c->skin[PREDICTED];
    double middle[2][3] = {{0}}, count[2] = {0};
    for (int32_t v = 0; v < s->vertex_count; v++) {
        bool own = c->map.region[v] == FACE_CHIN;
        if (!own && !c->map.stable[v]) continue;
        vec_add(middle[own], s->xyz + 3 * (size_t)v, middle[own]);
        count[own]++;
    }
    for (int k = 0; k < 2; k++) vec_scale(middle[k], 1 / count[k], middle[k]);
    vec_copy(middle[1], chin);
    vec_sub(middle[1], middle[0], arm);
}

static face_alignment alignment_of(const face_compare *c, const surface_fit *fit)
{
    face_alignment a = {.known = true, .fit = *fit};
    double chin[3], arm[3], turned[3], moved[3];
    find_chin(c, chin, arm);
    rigid_rotate(&fit->move, arm, turned);
    a.turn_at_chin_mm = vec_distance(arm, turned);
    rigid_apply(&fit->move, chin, moved);
    a.chin_mm = vec_distance(chin, moved);
    return a;
}

/* The crania, before the ears and from the orbits up: what every scan of a face has of them. */
static bool fit_crania(const face_compare *c, surface_fit *out, err *e)
{
    const surface *s = &c->cranium;
    const landmark *nasion = landmarks_find(&c->points, "N");
    double n[3], p[3];
    if (c->one_case) {
        *out = (surface_fit){.move = rigid_identity()};
        return true;
    }
    uint8_t *front = NEW_ARRAY(uint8_t, s->vertex_count);
    head_frame_to_local(&c->frame, nasion->xyz, n); /* face_map_make asked for it */
    for (int32_t v = 0; v < s->vertex_count; v++) {
        head_frame_to_local(&c->frame, s->xyz + 3 * (size_t)v, p);
        front[v] = p[1] < 0 && p[2] > 0 && p[2] < n[2] + above_mm;
    }
    bool ok = surface_fit_rigid(&c->actual_cranium, s, front, out, e) || err_prefix(e, "the crania");
    free(front);
    if (ok && out->rms_after_mm > cranium_rms_mm)
        return err_set(e, ERR_GEOMETRY, "the crania do not fit after alignment: %.1f mm RMS; is it another head?",
                       out->rms_after_mm);
    return ok;
}

static void move_actual(face_compare *c, surface *actual, const rigid *move)
{
    surface_transform(actual, move);
    if (c->actual_cranium.vertex_count) surface_transform(&c->actual_cranium, move);
    for (int32_t i = 0; i < c->actual_points.count; i++) {
        double *p = c->actual_points.point[i].xyz;
        rigid_apply(move, p, p);
    }
}

bool face_compare_align(compare_align how, face_compare *c, surface *actual, err *e)
{
    bool bones = c->one_case || (c->cranium.vertex_count && c->actual_cranium.vertex_count);
    surface_fit fit;
    c->on = how != ALIGN_USUAL ? how : bones ? ALIGN_BONE : ALIGN_SKIN;
    if (c->on == ALIGN_BONE && !bones)
        return err_set(e, ERR_GEOMETRY, "the faces cannot be aligned on bone: an outcome holds no cranium");
    if (c->on == ALIGN_BONE) {
        if (!fit_crania(c, &fit, e)) return false;
        c->aligned = alignment_of(c, &fit);
        move_actual(c, actual, &fit.move);
    }
    if (c->on == ALIGN_NONE) {
        err ignored = {0}; /* without a forehead it is not known what skin would do */
        if (face_fit(actual, &c->skin[PREDICTED], &c->map, &fit, &ignored)) c->by_skin = alignment_of(c, &fit);
        return true;
    }
    if (!face_fit(actual, &c->skin[PREDICTED], &c->map, &fit, e)) return false;
    if (c->on == ALIGN_BONE) {
        c->by_skin = alignment_of(c, &fit);
        return true;
    }
    c->aligned = alignment_of(c, &fit);
    move_actual(c, actual, &fit.move);
    return true;
}
