#include "render/src/panel_draw.h"
#include "render/src/profile.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ink[3] = {0.16, 0.19, 0.23}, paper[3] = {1, 1, 1};
static const double ghost_rgb[3] = {0.10, 0.34, 0.72}, rim_rgb[3] = {0.62, 0.10, 0.10};
static const double ghost_opacity = 0.18, rim_width_mm = 0.55;
enum { CHECKER_SQUARES = 6 }; /* along the shorter side */

/* ---- what is in the picture ---- */

static int bone_layers(const gallery *g, bool after, layer *out)
{
    for (int i = 0; i < g->s->part_count; i++) {
        const subject_part *p = g->s->parts + i;
        out[i] = layer_default(g->bone[after][i], p->kind);
        vec_copy(p->rgb, out[i].rgb);
        out[i].move = after ? p->after : p->before;
    }
    return g->s->part_count;
}

static layer skin_layer(const gallery *g, panel_show show, bool after)
{
    layer l = layer_default(g->skin[after], MATERIAL_SKIN);
    l.vertex_rgb = (after ? g->s->skin_after : g->s->skin_before)->rgb;
    if (show == SHOW_CLEAR) l.opacity = g->style->skin_opacity;
    if (panel_has_pose(show)) return l;
    label_map bar;
    l.vertex_rgb = NULL;
    l.scalar = gallery_map(g, show, &bar);
    l.map = bar.map;
    l.low = bar.low;
    l.high = bar.high;
    l.fade_end = bar.fade_end;
    return l;
}

/* Turns layers into what shows the other pose through them. Returns how many are left: what does not move has
 * none. */
static int make_ghost(const gallery *g, layer *l, int count)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        bool skin = l[i].kind == MATERIAL_SKIN;
        if (!skin && !part_moves(&g->s->parts[i])) continue;
        l[kept] = l[i];
        l[kept].vertex_rgb = NULL;
        l[kept].weight = skin ? g->moved : NULL;
        vec_copy(ghost_rgb, l[kept].rgb);
        l[kept].opacity = ghost_opacity;
        l[kept++].over = true;
    }
    return kept;
}

static bool load(gallery *g, panel_show show, bool after, err *e)
{
    return (show == SHOW_BONES || gallery_skin(g, after, e)) &&
           ((show != SHOW_BONES && show != SHOW_CLEAR) || gallery_bones(g, after, e));
}

static int layers_of(const gallery *g, panel_show show, bool after, layer *out)
{
    int count = show == SHOW_BONES || show == SHOW_CLEAR ? bone_layers(g, after, out) : 0;
    if (show != SHOW_BONES) out[count++] = skin_layer(g, show, after);
    return count;
}

/* The lines of the cuts, where the plan puts them; one stroke of two points each. */
static stroke *rims(const gallery *g, bool after, double **points, int *count)
{
    *count = 0;
    for (int i = 0; i < g->s->part_count; i++) *count += g->s->parts[i].rim_count;
    stroke *out = NEW_ARRAY(stroke, *count);
    *points = NEW_ARRAY(double, 6 * (size_t)*count);
    double *at = *points;
    stroke *k = out;
    for (int i = 0; i < g->s->part_count; i++) {
        const subject_part *p = g->s->parts + i;
        for (int r = 0; r < p->rim_count; r++, k++, at += 6) {
            for (int end = 0; end < 2; end++)
                rigid_apply(after ? &p->after : &p->before, p->rim + 6 * r + 3 * end, at + 3 * end);
            *k = (stroke){.xyz = at, .count = 2, .width_mm = rim_width_mm};
            vec_copy(rim_rgb, k->rgb);
        }
    }
    return out;
}

static bool draw_pose(gallery *g, const panel *p, bool after, const camera *view, image *out, int width, int height,
                      err *e)
{
    bool ghost = p->pose == POSE_OVERLAY && panel_has_pose(p->show);
    if (!load(g, p->show, after, e) || (ghost && !load(g, p->show, !after, e))) return false;
    layer *layers = NEW_ARRAY(layer, 2 * g->s->part_count + 2);
    int count = layers_of(g, p->show, after, layers), rim_count = 0;
    if (ghost) {
        panel_show other = p->show == SHOW_CLEAR ? SHOW_SKIN : p->show;
        int more = layers_of(g, other, !after, layers + count);
        count += make_ghost(g, layers + count, more);
    }
    double *rim_points = NULL;
    stroke *lines = p->show == SHOW_BONES ? rims(g, after, &rim_points, &rim_count) : NULL;
    picture pic = {.layers = layers, .layer_count = count, .strokes = lines, .stroke_count = rim_count, .view = *view};
    picture_style style = picture_style_default();
    style.width = width;
    style.height = height;
    bool ok = picture_render(g->room, &pic, &style, out, NULL, e);
    free(layers);
    free(lines);
    free(rim_points);
    return ok;
}

/* ---- two poses in one picture ---- */

static int checker_side(const image *im)
{
    int side = (im->width < im->height ? im->width : im->height) / CHECKER_SQUARES;
    return side > 0 ? side : 1;
}

/* Puts the pixels of `before` that belong to it into `out`, which shows after. */
static void mix(const image *before, panel_pose pose, image *out)
{
    int side = checker_side(out);
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            bool first = pose == POSE_WIPE ? x < out->width / 2 : (x / side + y / side) % 2 == 0;
            if (first) memcpy(image_pixel(out, x, y), image_pixel(before, x, y), 4);
        }
}

/* ---- labels ---- */

static void write_bar(const gallery *g, panel_show show, pen *p, const image *im, double size)
{
    label_map bar;
    gallery_map(g, show, &bar);
    gallery_range r = gallery_map_range(g, show);
    double width = fmin(0.42 * im->width, 16 * size);
    label_color_bar(p, im->width - width - 1.2 * size, im->height - 2.0 * size, width, 0.8 * size, 0.75 * size, &bar);
    char text[96];
    snprintf(text, sizeof text, "%s (largest %.1f)", bar.caption, r.largest);
    double room = im->width - 2.4 * size, wide = pen_text_width(p, 0.8 * size, true, text);
    pen_text(p, im->width - 1.2 * size, im->height - 3.9 * size, LABEL_RIGHT, 0.8 * size * fmin(1, room / wide), true,
             ink, text);
}

static void write_legend(const gallery *g, pen *p, const image *im, double size)
{
    label_entry *entry = NEW_ARRAY(label_entry, g->s->part_count);
    int count = 0;
    double widest = 0;
    for (int i = 0; i < g->s->part_count; i++) {
        const subject_part *part = g->s->parts + i;
        if (!part->name) continue;
        entry[count].text = part->name;
        vec_copy(part->rgb, entry[count++].rgb);
    }
    /* at most a third of a small picture */
    double font = fmin(0.75 * size, 0.33 * im->height / (1.55 * (count ? count : 1)));
    for (int i = 0; i < count; i++) widest = fmax(widest, pen_text_width(p, font, false, entry[i].text));
    label_legend(p, im->width - widest - 2.4 * font - 0.5 * size, im->height - count * 1.55 * font - 0.6 * size, font,
                 entry, count);
    free(entry);
}

static void write_pose(panel_show show, panel_pose pose, pen *p, const image *im, double size)
{
    bool bones = show == SHOW_BONES;
    double middle = im->width / 2, y = im->height - 1.0 * size;
    if (pose == POSE_WIPE) {
        pen_line(p, middle, 0, middle, im->height, fmax(1, size / 9), paper);
        pen_text(p, middle - 0.6 * size, y, LABEL_RIGHT, size, true, ink, "before");
        pen_text(p, middle + 0.6 * size, y, LABEL_LEFT, size, true, ink, bones ? "planned" : "predicted");
    }
    if (pose == POSE_CHECKER) {
        int side = checker_side(im);
        for (int x = side; x < im->width; x += side) pen_line(p, x, 0, x, im->height, fmax(1, size / 18), paper);
        for (int y0 = side; y0 < im->height; y0 += side) pen_line(p, 0, y0, im->width, y0, fmax(1, size / 18), paper);
        for (int k = 0; k < 2; k++)
            pen_text(p, (k + 0.5) * side, side - 0.5 * size, LABEL_CENTRE, 0.75 * size, true, ink,
                     k ? (bones ? "planned" : "predicted") : "before");
    }
    if (pose == POSE_OVERLAY) {
        label_entry entry[2] = {{"outline: before", {0}}, {bones ? "solid: planned" : "solid: predicted", {0}}};
        vec_copy(ghost_rgb, entry[0].rgb);
        material_color(bones ? MATERIAL_BONE : MATERIAL_SKIN, entry[1].rgb);
        double wide = pen_text_width(p, 0.75 * size, false, entry[1].text);
        label_legend(p, im->width - wide - 2.6 * size, 0.8 * size, 0.75 * size, entry, 2);
    }
}

static bool write_labels(const gallery *g, const panel *p, const camera *view, image *im, err *e)
{
    pen *marker = NULL;
    double size = fmax(9, im->height / 45.0), scale = camera_scale(view, im->height);
    if (!g->style->labels) return true;
    if (!pen_open(im, &g->style->fonts, &marker, e)) return false;
    if (panel_has_pose(p->show)) write_pose(p->show, p->pose, marker, im, size);
    label_sides(marker, 0, 0, im->width, im->height, size, view, &g->s->frame);
    if (!(view->eye_mm > 0))
        label_scale_bar(marker, 0.9 * size, im->height - 1.0 * size, scale, label_scale_length(scale, im->width),
                        0.8 * size);
    if (!panel_has_pose(p->show)) write_bar(g, p->show, marker, im, size);
    if (p->show == SHOW_BONES || (p->show == SHOW_CLEAR && p->pose != POSE_BEFORE)) write_legend(g, marker, im, size);
    pen_close(&marker);
    return true;
}

bool panel_draw(gallery *g, const panel *p, int width, int height, image *out, err *e)
{
    if (!gallery_can_show(g, p->show, e)) return false;
    if (p->show == SHOW_CONTOUR) return contour_draw(g, width, height, out, e);
    if (p->show == SHOW_TRACING) return tracing_draw(g, width, height, out, e);
    camera view = gallery_camera(g, p, width, height);
    bool both = panel_has_pose(p->show) && (p->pose == POSE_WIPE || p->pose == POSE_CHECKER);
    bool after = !panel_has_pose(p->show) || p->pose != POSE_BEFORE;
    image im = {0}, before = {0};
    bool ok = draw_pose(g, p, after, &view, &im, width, height, e);
    if (ok && both) {
        ok = draw_pose(g, p, false, &view, &before, width, height, e);
        if (ok) mix(&before, p->pose, &im);
        image_free(&before);
    }
    ok = ok && write_labels(g, p, &view, &im, e);
    if (ok)
        *out = im;
    else
        image_free(&im);
    return ok;
}
