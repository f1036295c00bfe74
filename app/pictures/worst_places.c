#include "app/pictures/worst_places.h"
#include "app/planner/judge/parts.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include "render/compose.h"
#include "render/picture.h"
#include "render/png_file.h"
#include <stdio.h>
#include <stdlib.h>

enum { LAYERS = SEGMENT_COUNT + 2, TILES = 6, CLOSE_UPS = 3, TILE_WIDTH = 760, TILE_HEIGHT = 720 };
static const double red[3] = {0.84, 0.07, 0.10}, blue[3] = {0.10, 0.32, 0.88}, pale[3] = {0.74, 0.84, 0.97},
                    yellow[3] = {0.95, 0.80, 0.05}, orange[3] = {0.78, 0.38, 0.02};
static const double parted_mm = 0.5, dark_blue_mm = 5, close_mm = 24, bone_opacity = 0.32;
static const double coarse_mm = 2, fine_mm = 0.4; /* triangles that are painted: of one kind, at its border */

typedef struct patchwork { /* loose triangles, each with its colour */
    surface s;
    int32_t room;
} patchwork;

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

static void add_triangle(patchwork *w, double x[3][3], const rigid *move, const double rgb[3])
{
    if (w->s.triangle_count == w->room) {
        w->room = 2 * w->room + 64;
        w->s.xyz = GROW_ARRAY(double, w->s.xyz, 9 * (size_t)w->room);
        w->s.tri = GROW_ARRAY(int32_t, w->s.tri, 3 * (size_t)w->room);
        w->s.rgb = GROW_ARRAY(uint8_t, w->s.rgb, 9 * (size_t)w->room);
    }
    for (int k = 0; k < 3; k++) {
        size_t v = (size_t)w->s.vertex_count++;
        rigid_apply(move, x[k], w->s.xyz + 3 * v);
        w->s.tri[v] = (int32_t)v;
        for (int c = 0; c < 3; c++) w->s.rgb[3 * v + (size_t)c] = (uint8_t)lround(255 * rgb[c]);
    }
    w->s.triangle_count++;
}

typedef struct brush { /* what is painted of the triangles of one bone that is moved against another */
    patchwork *to;
    const clash_body *other;
    const nearest *sight; /* of gaps: to look for the other bone */
    rigid rel, move;
    double saw_mm; /* of gaps */
} brush;

static double longest_edge(double x[3][3])
{
    return fmax(vec_distance(x[0], x[1]), fmax(vec_distance(x[1], x[2]), vec_distance(x[2], x[0])));
}

/* Calls paint for each of four parts. */
static void quarter(const brush *b, double x[3][3], void (*paint)(const brush *, double[3][3]))
{
    double m[3][3], y[3][3];
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) m[k][c] = (x[k][c] + x[(k + 1) % 3][c]) / 2;
    paint(b, m);
    for (int k = 0; k < 3; k++) {
        vec_copy(x[k], y[0]);
        vec_copy(m[k], y[1]);
        vec_copy(m[(k + 2) % 3], y[2]);
        paint(b, y);
    }
}

/* The part of a triangle that lies within the other bone. */
static void paint_overlap(const brush *b, double x[3][3])
{
    const solid_grid *grid = clash_body_grid(b->other);
    double middle[3] = {0}, p[3], edge = longest_edge(x);
    int in = 0;
    for (int k = 0; k < 3; k++) {
        vec_axpy(middle, 1 / 3.0, x[k], middle);
        rigid_apply(&b->rel, x[k], p);
        in += solid_grid_inside(grid, p);
    }
    rigid_apply(&b->rel, middle, p);
    if (!in && solid_grid_clear(grid, p) > edge) return;
    if (edge > ((in == 0 || in == 3) ? coarse_mm : fine_mm))
        quarter(b, x, paint_overlap);
    else if (in >= 2)
        add_triangle(b->to, x, &b->move, red);
}

/* The part of a cut's face that has no bone opposite within the saw's width and a little. */
static void paint_gap(const brush *b, double x[3][3])
{
    double middle[3] = {0}, p[3], e1[3], e2[3], n[3], hit[3], rgb[3];
    if (longest_edge(x) > coarse_mm) {
        quarter(b, x, paint_gap);
        return;
    }
    for (int k = 0; k < 3; k++) vec_axpy(middle, 1 / 3.0, x[k], middle);
    vec_sub(x[1], x[0], e1);
    vec_sub(x[2], x[0], e2);
    vec_cross(e1, e2, n);
    rigid_apply(&b->rel, middle, p);
    rigid_rotate(&b->rel, n, n);
    if (solid_grid_inside(clash_body_grid(b->other), p)) return;
    bool faces = nearest_ray(b->sight, p, n, hit, NULL);
    double gap = (faces ? vec_distance(p, hit) : 2 * dark_blue_mm) - b->saw_mm, share = fmin(gap / dark_blue_mm, 1);
    if (gap < parted_mm) return;
    for (int c = 0; c < 3; c++) rgb[c] = pale[c] + share * (blue[c] - pale[c]);
    add_triangle(b->to, x, &b->move, rgb);
    double back[3][3]; /* to be seen from behind too */
    vec_sub(x[1], x[0], e1);
    vec_sub(x[2], x[0], e2);
    vec_cross(e1, e2, n);
    vec_normalize(n);
    for (int k = 0; k < 3; k++) vec_axpy(x[2 - k], -0.05, n, back[k]);
    add_triangle(b->to, back, &b->move, rgb);
}

static void paint(const surface *s, const brush *b, void (*with)(const brush *, double[3][3]))
{
    for (int32_t t = 0; t < s->triangle_count; t++) {
        double x[3][3];
        for (int k = 0; k < 3; k++) vec_copy(s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k], x[k]);
        with(b, x);
    }
}

static void add_overlap(scene *s, segment_id own, segment_id other)
{
    brush b = {.to = &s->overlap, .other = s->j->body[other], .move = s->m->move[own]};
    if (b.other && judge_relative(s->m, other, own, &b.rel))
        paint(&s->j->prepared->segments.part[own], &b, paint_overlap);
}

static bool add_gap(scene *s, const surface *shell, segment_id own, segment_id other, err *e)
{
    nearest *sight;
    if (!nearest_create(&s->j->prepared->segments.part[other], &sight, e)) return false;
    brush b = {.to = &s->gap,
               .other = s->j->body[other],
               .sight = sight,
               .move = s->m->move[own],
               .saw_mm = s->j->patient->cuts.kerf_mm};
    if (judge_relative(s->m, other, own, &b.rel)) paint(shell, &b, paint_gap);
    nearest_destroy(&sight);
    return true;
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
            vec_copy(level == LIMIT_STOP ? red : orange, s->marks[k].rgb);
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
    label_entry entry[4] = {{"overlap", {red[0], red[1], red[2]}},
                            {"cut face parted (darker: up to 5 mm)", {blue[0], blue[1], blue[2]}},
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
