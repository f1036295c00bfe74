#include "render/src/gallery.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double fit_margin = 0.06;   /* room for captions and the scale bar */
static const double clear_move_mm = 1.0; /* what moves less fades out of an overlay */

gallery_style gallery_style_default(void)
{
    return (gallery_style){
        .light_directions = 64, .skin_opacity = 0.25, .zoom = 1, .labels = true, .fonts = label_fonts_default()};
}

/* ---- opening ---- */

static bool check(const subject *s, err *e)
{
    if (!s->skin_before != !s->skin_after)
        return err_set(e, ERR_USAGE, "pictures need the skin before and after, or neither");
    if (!s->skin_before && s->part_count < 1) return err_set(e, ERR_USAGE, "pictures of nothing");
    if (!s->skin_before) return true;
    const surface *a = s->skin_before, *b = s->skin_after;
    if (a->vertex_count != b->vertex_count || a->triangle_count != b->triangle_count ||
        memcmp(a->tri, b->tri, 3 * (size_t)a->triangle_count * sizeof *a->tri) != 0)
        return err_set(e, ERR_GEOMETRY, "the skin before (%d vertices) and after (%d) do not have the same triangles",
                       a->vertex_count, b->vertex_count);
    for (int32_t v = 0; s->displacement_mm && v < b->vertex_count; v++)
        if (s->displacement_mm[v] < 0)
            return err_set(e, ERR_GEOMETRY, "the displacement of skin vertex %d is negative (%g mm)", v,
                           s->displacement_mm[v]);
    return true;
}

/* The sphere to show: the face, from brow to neck and back to the ears; or about a landmark. */
static bool find_centre(gallery *g, err *e)
{
    const landmarks *l = g->s->before;
    const landmark *n = l ? landmarks_find(l, "N") : NULL, *me = l ? landmarks_find(l, "Me") : NULL;
    if (n && me) {
        for (int k = 0; k < 3; k++) g->centre[k] = (n->xyz[k] + me->xyz[k]) / 2;
        vec_axpy(g->centre, 22, g->s->frame.posterior, g->centre);
        g->radius_mm = 0.86 * vec_distance(n->xyz, me->xyz);
    }
    if (!g->style->centre) return true;
    const landmark *c = l ? landmarks_find(l, g->style->centre) : NULL;
    if (!c) return err_set(e, ERR_USAGE, "there is no landmark \"%s\" to put in the middle", g->style->centre);
    if (!(g->radius_mm > 0))
        return err_set(e, ERR_USAGE, "a picture about a landmark needs N and Me, which give the size of the face");
    vec_copy(c->xyz, g->centre);
    return true;
}

bool gallery_open(const subject *s, const gallery_style *style, gallery **out, err *e)
{
    gallery *g = mem_alloc(1, sizeof *g);
    g->s = s;
    g->style = style;
    if (!check(s, e) || !find_centre(g, e) || !studio_open(&g->room, e)) {
        free(g);
        return false;
    }
    size_t n = s->skin_before ? (size_t)s->skin_after->vertex_count : 0;
    g->displacement = NEW_ARRAY(double, n);
    g->moved = NEW_ARRAY(double, n);
    for (size_t v = 0; v < n; v++) {
        g->displacement[v] = s->displacement_mm ? s->displacement_mm[v]
                                                : vec_distance(s->skin_after->xyz + 3 * v, s->skin_before->xyz + 3 * v);
        g->moved[v] = fmin(1, g->displacement[v] / clear_move_mm);
    }
    *out = g;
    return true;
}

void gallery_close(gallery **g)
{
    if (!*g) return;
    for (int k = 0; k < 2; k++) {
        model_free(&(*g)->skin[k]);
        for (int i = 0; (*g)->bone[k] && i < (*g)->s->part_count; i++) model_free(&(*g)->bone[k][i]);
        free((*g)->bone[k]);
    }
    studio_close(&(*g)->room);
    free((*g)->displacement);
    free((*g)->moved);
    free(*g);
    *g = NULL;
}

/* ---- models ---- */

bool gallery_skin(gallery *g, bool after, err *e)
{
    if (g->skin[after]) return true;
    model_params params = model_params_skin();
    model *m = NULL;
    if (!model_create(g->room, after ? g->s->skin_after : g->s->skin_before, &params, &m, e))
        return err_prefix(e, "skin %s", after ? "after" : "before");
    layer l = layer_default(m, MATERIAL_SKIN);
    if (!picture_bake(&l, 1, g->style->light_directions, e)) {
        model_free(&m);
        return false;
    }
    g->skin[after] = m;
    return true;
}

/* The light of the bones depends on where they are: each pose has its own models. */
bool gallery_bones(gallery *g, bool after, err *e)
{
    const subject *s = g->s;
    if (g->bone[after]) return true;
    model_params params = model_params_bone();
    model **m = NEW_ARRAY(model *, s->part_count);
    layer *l = NEW_ARRAY(layer, s->part_count);
    bool ok = true;
    for (int i = 0; ok && i < s->part_count; i++) {
        const subject_part *p = s->parts + i;
        ok = model_create(g->room, p->bone, &params, &m[i], e) || err_prefix(e, "%s", p->name ? p->name : "bone");
        l[i] = layer_default(m[i], p->kind);
        l[i].move = after ? p->after : p->before;
    }
    ok = ok && picture_bake(l, s->part_count, g->style->light_directions, e);
    free(l);
    if (ok) {
        g->bone[after] = m;
        return true;
    }
    for (int i = 0; i < s->part_count; i++) model_free(&m[i]);
    free(m);
    return false;
}

bool part_moves(const subject_part *p)
{
    bool same = true;
    for (int i = 0; i < 9; i++) same &= p->before.r[i] >= p->after.r[i] && p->before.r[i] <= p->after.r[i];
    for (int i = 0; i < 3; i++) same &= p->before.t[i] >= p->after.t[i] && p->before.t[i] <= p->after.t[i];
    return !same;
}

bool gallery_can_show(const gallery *g, panel_show show, err *e)
{
    const subject *s = g->s;
    const char *what = panel_show_name(show);
    bool skin = show != SHOW_BONES && show != SHOW_TRACING, bones = show == SHOW_CLEAR || show == SHOW_BONES;
    if (skin && !s->skin_before) return err_set(e, ERR_USAGE, "a picture of \"%s\" needs the skin", what);
    if (bones && s->part_count < 1) return err_set(e, ERR_USAGE, "a picture of \"%s\" needs the segments", what);
    if (show == SHOW_SIGNED && !s->signed_mm)
        return err_set(e, ERR_USAGE, "a picture of \"%s\" needs the signed distance of the skins", what);
    if (show == SHOW_STRETCH && !s->stretch_percent)
        return err_set(e, ERR_USAGE, "a picture of \"%s\" needs the stretch of the skin", what);
    if ((show == SHOW_TRACING || show == SHOW_CONTOUR) && (!s->before || !s->after))
        return err_set(e, ERR_USAGE, "a picture of \"%s\" needs the landmarks", what);
    return true;
}

/* ---- the view ---- */

camera gallery_camera(const gallery *g, const panel *p, int width, int height)
{
    const subject *s = g->s;
    camera c = camera_orbit(p->azimuth_deg, p->elevation_deg, p->roll_deg, &s->frame, g->centre);
    if (g->radius_mm > 0) {
        camera_fit(&c, g->radius_mm, width, height, fit_margin);
        c.depth_mm = fmax(c.depth_mm, 600); /* what lies outside is cut by the border, not by depth */
    } else {
        const surface **all = NEW_ARRAY(const surface *, 2 + s->part_count);
        int count = 0;
        if (s->skin_before) {
            all[count++] = s->skin_before;
            all[count++] = s->skin_after;
        } else
            for (int i = 0; i < s->part_count; i++) all[count++] = s->parts[i].bone;
        camera_fit_surfaces(&c, all, count, width, height, fit_margin);
        free(all);
    }
    c.half_height_mm /= g->style->zoom;
    if (g->style->perspective_deg > 0) camera_set_perspective(&c, g->style->perspective_deg * (M_PI / 180));
    return c;
}
