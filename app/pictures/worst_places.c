#include "app/pictures/worst_places.h"
#include "app/pictures/patchwork.h"
#include "app/planner/judge/parts.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "render/compose.h"
#include "render/picture.h"
#include "render/png_file.h"
#include <stdio.h>
#include <stdlib.h>

enum { LAYERS = SEGMENT_COUNT + 2, TILES = 6, CLOSE_UPS = 3, TILE_WIDTH = 760, TILE_HEIGHT = 720 };
static const double yellow[3] = {0.95, 0.80, 0.05}, orange[3] = {0.78, 0.38, 0.02};
static const double close_mm = 24, bone_opacity = 0.32;

typedef struct scene {
    const judge *j;
    const plan_moves *m;
    patchwork overlap, gap; /* as planned */
    model *shape[LAYERS];
    layer layers[LAYERS];
    int layer_count;
    mark marks[FINDINGS_MAX];
    char text[FINDINGS_MAX][96];
    int mark_count;
    int worst[CLOSE_UPS], worst_count; /* numbers of findings, the gravest first, at different places */
    stroke canal[2];
    double canal_xyz[2][3 * CANAL_POINTS_MAX];
} scene;

static void add_overlap(scene *s, segment_id own, segment_id other)
{
    rigid rel;
    if (s->j->body[other] && judge_relative(s->m, other, own, &rel))
        patchwork_overlap(&s->overlap, &s->j->prepared->segments.part[own], s->j->body[other], &rel, &s->m->move[own]);
}

static bool add_gap(scene *s, const surface *shell, segment_id own, segment_id other, err *e)
{
    rigid rel;
    return !judge_relative(s->m, other, own, &rel) ||
           patchwork_gap(&s->gap, shell, s->j->body[other], &s->j->prepared->segments.part[other], &rel,
                         &s->m->move[own], s->j->patient->cuts.kerf_mm, e);
}

static bool find_surfaces(scene *s, err *e)
{
    for (int i = 0; i < JUDGE_CUTS; i++) {
        const judge_cut *c = &s->j->cut[i];
        if (!c->there) continue;
        add_overlap(s, c->moved, c->still);
        add_overlap(s, c->still, c->moved);
        if (!add_gap(s, &c->face.shell, c->moved, c->still, e)) return false;
    }
    for (int i = 0; i < JUDGE_PAIRS; i++) {
        add_overlap(s, s->j->pair[i].moved, s->j->pair[i].still);
        add_overlap(s, s->j->pair[i].still, s->j->pair[i].moved);
    }
    return true;
}

static void find_marks(scene *s, const judgement *now)
{
    for (int level = LIMIT_STOP; level >= LIMIT_CAUTION; level--)
        for (int i = 0; i < now->count; i++) {
            const finding *f = &now->finding[i];
            if ((int)f->level != level || !f->has_place) continue;
            int k = s->mark_count++;
            snprintf(s->text[k], sizeof s->text[k], "%s%s%s %.1f", limit_default[f->limit].name, *f->where ? ", " : "",
                     f->where, f->value);
            s->marks[k] = (mark){.radius_mm = 1.1, .on_top = true};
            vec_copy(f->place, s->marks[k].xyz);
            vec_copy(level == LIMIT_STOP ? patchwork_red : orange, s->marks[k].rgb);
            bool new_place = s->worst_count < CLOSE_UPS;
            for (int w = 0; w < s->worst_count; w++)
                new_place = new_place && vec_distance(now->finding[s->worst[w]].place, f->place) > close_mm / 2;
            if (new_place) s->worst[s->worst_count++] = i;
        }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < s->j->canal_count[k]; i++)
            rigid_apply(&s->m->move[SEGMENT_DISTAL], s->j->canal[k] + 3 * i, s->canal_xyz[k] + 3 * i);
        s->canal[k] = (stroke){.xyz = s->canal_xyz[k], .count = s->j->canal_count[k], .width_mm = 1.6, .on_top = true};
        vec_copy(yellow, s->canal[k].rgb);
    }
}

static bool add_layer(scene *s, studio *st, const surface *shape, const rigid *move, double opacity, err *e)
{
    model_params p = model_params_bone();
    if (!shape->triangle_count) return true;
    if (!model_create(st, shape, &p, &s->shape[s->layer_count], e)) return false;
    layer *l = &s->layers[s->layer_count];
    *l = layer_default(s->shape[s->layer_count], opacity < 1 ? MATERIAL_BONE : MATERIAL_PLAIN);
    if (opacity == 1) l->vertex_rgb = shape->rgb; /* bones keep the usual colour */
    l->opacity = opacity;
    l->move = *move;
    s->layer_count++;
    return true;
}

static bool make_layers(scene *s, studio *st, err *e)
{
    rigid rest = rigid_identity();
    bool ok = add_layer(s, st, &s->overlap.s, &rest, 1, e) && add_layer(s, st, &s->gap.s, &rest, 1, e);
    for (int i = 0; ok && i < SEGMENT_COUNT; i++)
        ok = add_layer(s, st, &s->j->prepared->segments.part[i], &s->m->move[i], bone_opacity, e);
    return ok;
}

static bool draw(const scene *s, studio *st, camera *view, bool names, image *out, err *e)
{
    picture_style style = picture_style_default();
    style.width = TILE_WIDTH;
    style.height = TILE_HEIGHT;
    view->depth_mm = 600;
    picture p = {.layers = s->layers,
                 .layer_count = s->layer_count,
                 .marks = s->marks,
                 .mark_count = s->mark_count,
                 .strokes = s->canal,
                 .stroke_count = s->canal[0].count && s->canal[1].count ? 2 : 0,
                 .view = *view};
    pen *ink = NULL;
    label_fonts fonts = label_fonts_default();
    if (!picture_render(st, &p, &style, out, NULL, e) || !pen_open(out, &fonts, &ink, e)) return false;
    double scale = camera_scale(view, TILE_HEIGHT);
    for (int i = 0; names && i < s->mark_count && i < 12; i++)
        pen_text(ink, 14, 66 + 18 * i, LABEL_LEFT, 14, false, s->marks[i].rgb, s->text[i]);
    label_sides(ink, 0, 0, TILE_WIDTH, TILE_HEIGHT, 20, view, &s->j->prepared->frame);
    label_scale_bar(ink, 18, TILE_HEIGHT - 20, scale, label_scale_length(scale, TILE_WIDTH), 16);
    pen_close(&ink);
    return true;
}

static void standard_view(const scene *s, camera_view which, camera *out)
{
    const prepared *p = s->j->prepared;
    const surface *part[SEGMENT_COUNT];
    int count = 0;
    for (int i = SEGMENT_MAXILLA; i < SEGMENT_COUNT; i++)
        if (p->segments.part[i].triangle_count) part[count++] = &p->segments.part[i];
    *out = camera_standard(which, &p->frame, p->frame.origin);
    camera_fit_surfaces(out, part, count, TILE_WIDTH, TILE_HEIGHT, 0.10);
}

/* From outside, level: away from the middle of the jaws. */
static bool close_view(const scene *s, const double place[3], camera *out, err *e)
{
    const head_frame *f = &s->j->prepared->frame;
    double middle[3], away[3];
    vec_axpy(f->origin, -35, f->posterior, middle);
    vec_sub(place, middle, away);
    vec_axpy(away, -vec_dot(away, f->up), f->up, away);
    if (!(vec_normalize(away) > 0)) vec_scale(f->posterior, -1, away);
    if (!camera_custom(away, f->up, place, out, e)) return false;
    camera_fit(out, close_mm, TILE_WIDTH, TILE_HEIGHT, 0.05);
    return true;
}

static bool add_legend(image *im, err *e)
{
    pen *ink;
    label_fonts fonts = label_fonts_default();
    label_entry entry[4] = {
        {"overlap", {patchwork_red[0], patchwork_red[1], patchwork_red[2]}},
        {"cut face parted (darker: up to 5 mm)", {patchwork_blue[0], patchwork_blue[1], patchwork_blue[2]}},
        {"mandibular canal (estimated)", {yellow[0], yellow[1], yellow[2]}},
        {"ball: caution; red ball: stop", {orange[0], orange[1], orange[2]}}};
    if (!pen_open(im, &fonts, &ink, e)) return false;
    label_legend(ink, 14, 48, 16, entry, 4);
    pen_close(&ink);
    return true;
}

static bool draw_sheet(const scene *s, studio *st, const judgement *now, const char *title, image *sheet, err *e)
{
    static const camera_view view[] = {VIEW_FRONT, VIEW_LEFT, VIEW_RIGHT};
    image tile[TILES] = {0};
    compose_tile on[TILES];
    char caption[TILES][96];
    bool ok = true;
    int count = 0;
    for (int i = 0; ok && i < 3 + s->worst_count; i++, count++) {
        camera c;
        const finding *f = i < 3 ? NULL : &now->finding[s->worst[i - 3]];
        if (f)
            ok = close_view(s, f->place, &c, e);
        else
            standard_view(s, view[i], &c);
        snprintf(caption[i], sizeof caption[i], "%s%s%s", f ? limit_default[f->limit].name : camera_view_name(view[i]),
                 f && *f->where ? ", " : "", f ? f->where : "");
        ok = ok && draw(s, st, &c, i == 0, &tile[i], e) && (i != 1 || add_legend(&tile[i], e));
        on[i] = (compose_tile){&tile[i], caption[i]};
    }
    compose_params p = compose_params_default();
    p.columns = 3;
    p.title = title;
    p.subtitle = limit_level_name(now->worst);
    ok = ok && compose_sheet(on, count, &p, sheet, e);
    for (int i = 0; i < TILES; i++) image_free(&tile[i]);
    return ok;
}

bool judge_picture_write(const judge *j, const plan_moves *m, const judgement *now, const char *title, const char *path,
                         err *e)
{
    scene *s = NEW_ARRAY(scene, 1);
    studio *st = NULL;
    image sheet = {0};
    s->j = j;
    s->m = m;
    find_marks(s, now);
    bool ok = find_surfaces(s, e) && studio_open(&st, e) && make_layers(s, st, e) &&
              draw_sheet(s, st, now, title, &sheet, e) && png_file_write(&sheet, NULL, 0, path, e);
    for (int i = 0; i < LAYERS; i++) model_free(&s->shape[i]);
    studio_close(&st);
    image_free(&sheet);
    surface_free(&s->overlap.s);
    surface_free(&s->gap.s);
    free(s);
    return ok;
}
