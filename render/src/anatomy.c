#include "render/anatomy.h"
#include "render/compose.h"
#include "render/png_file.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

void anatomy_apart(segment_id id, const head_frame *frame, double distance_mm, double out[3])
{
    static const double way[SEGMENT_COUNT][3] = {
        /* left, posterior, up */
        [SEGMENT_CRANIUM] = {0, 0, 0},
        [SEGMENT_MAXILLA] = {0, -0.5, -0.7},
        [SEGMENT_DISTAL] = {0, -0.75, -1.5},
        [SEGMENT_PROXIMAL_LEFT] = {1.2, 0.2, -0.5},
        [SEGMENT_PROXIMAL_RIGHT] = {-1.2, 0.2, -0.5},
        [SEGMENT_CHIN] = {0, -1.0, -2.2},
    };
    const double *axis[3] = {frame->left, frame->posterior, frame->up};
    for (int k = 0; k < 3; k++) out[k] = 0;
    for (int a = 0; a < 3; a++) vec_axpy(out, distance_mm * way[id][a], axis[a], out);
}

typedef struct stage { /* what is drawn, in place */
    studio *s;
    model **models;
    layer *layers;
    surface *placed; /* copies in place: the cameras are fitted to them */
    const surface **fitted;
    int count;
} stage;

static bool stage_open(stage *g, int capacity, err *e)
{
    *g = (stage){.models = NEW_ARRAY(model *, capacity),
                 .layers = NEW_ARRAY(layer, capacity),
                 .placed = NEW_ARRAY(surface, capacity),
                 .fitted = NEW_ARRAY(const surface *, capacity)};
    return studio_open(&g->s, e);
}

static bool stage_add(stage *g, const surface *from, material kind, const double rgb[3], const rigid *move, err *e)
{
    model_params p = kind == MATERIAL_SKIN ? model_params_skin() : model_params_bone();
    if (!model_create(g->s, from, &p, &g->models[g->count], e)) return false;
    layer *l = g->layers + g->count;
    *l = layer_default(g->models[g->count], kind);
    vec_copy(rgb, l->rgb);
    l->move = *move;
    g->placed[g->count] = surface_copy(from);
    surface_transform(&g->placed[g->count], move);
    g->fitted[g->count] = &g->placed[g->count];
    g->count++;
    return true;
}

static void stage_close(stage *g)
{
    for (int i = 0; i < g->count; i++) {
        model_free(&g->models[i]);
        surface_free(&g->placed[i]);
    }
    studio_close(&g->s);
    free(g->models);
    free(g->layers);
    free(g->placed);
    free(g->fitted);
}

/* Two views side by side. legend or points may be empty. */
typedef struct plate {
    camera_view view[2];
    const char *caption[2];
    const head_frame *frame;
    const char *text;
    const gallery_style *style;
    int width, height; /* of the sheet */
    const stroke *cuts;
    const mark *marks;
    const label_point *points;
    const label_entry *entries;
    int cut_count, point_count, entry_count;
} plate;

static compose_params sheet_params(const plate *p)
{
    compose_params c = compose_params_default();
    c.font_size = fmax(9, p->height / 52.0);
    c.title = p->text;
    c.fonts = p->style->fonts;
    c.sheet_width = p->width;
    c.sheet_height = p->height;
    return c;
}

static bool plate_tile(const stage *g, const plate *p, int side, image *out, err *e)
{
    picture_style style = picture_style_default();
    compose_params whole = sheet_params(p);
    compose_tile_size(2, &whole, &style.width, &style.height);
    camera c = camera_standard(p->view[side], p->frame, p->frame->origin);
    camera_fit_surfaces(&c, g->fitted, g->count, style.width, style.height, p->point_count ? 0.13 : 0.09);
    uint8_t *seen = NEW_ARRAY(uint8_t, p->point_count);
    mark *shown = NEW_ARRAY(mark, p->point_count);
    int shown_count = 0;
    for (int i = 0; i < p->point_count; i++) {
        const char *label = p->points[i].text;
        size_t length = strlen(label);
        seen[i] = p->view[side] != VIEW_LEFT || length < 2 || strcmp(label + length - 2, "_R") != 0;
        if (seen[i]) shown[shown_count++] = p->marks[i];
    }
    picture pic = {.layers = g->layers,
                   .layer_count = g->count,
                   .marks = shown,
                   .mark_count = shown_count,
                   .strokes = p->cuts,
                   .stroke_count = p->cut_count,
                   .view = c};
    image im = {0};
    pen *marker = NULL;
    bool ok = picture_render(g->s, &pic, &style, &im, NULL, e) && pen_open(&im, &p->style->fonts, &marker, e);
    if (ok) {
        double size = fmax(9, im.height / 45.0), scale = camera_scale(&c, im.height), widest = 0;
        label_sides(marker, 0, 0, im.width, im.height, size, &c, p->frame);
        label_scale_bar(marker, 0.9 * size, im.height - size, scale, label_scale_length(scale, im.width), 0.8 * size);
        label_points(marker, &im, 0.62 * size, &c, p->points, p->point_count, seen);
        for (int i = 0; side && i < p->entry_count; i++)
            widest = fmax(widest, pen_text_width(marker, 0.75 * size, false, p->entries[i].text));
        if (side)
            label_legend(marker, im.width - widest - 2.3 * size,
                         im.height - p->entry_count * 1.55 * 0.75 * size - 0.6 * size, 0.75 * size, p->entries,
                         p->entry_count);
        pen_close(&marker);
        *out = im;
    } else
        image_free(&im);
    free(seen);
    free(shown);
    return ok;
}

static bool plate_write(const stage *g, const plate *p, const char *path, err *e)
{
    image tile[2] = {{0}, {0}}, whole = {0};
    compose_params params = sheet_params(p);
    bool ok =
        plate_tile(g, p, 0, &tile[0], e) && plate_tile(g, p, 1, &tile[1], e) &&
        compose_sheet((compose_tile[2]){{&tile[0], p->caption[0]}, {&tile[1], p->caption[1]}}, 2, &params, &whole, e);
    png_note notes[2] = {{"Software", "gnathos " GNATHOS_VERSION}, {"Renderer", studio_description(g->s)}};
    ok = ok && png_file_write(&whole, notes, 2, path, e);
    image_free(&tile[0]);
    image_free(&tile[1]);
    image_free(&whole);
    return ok;
}

bool anatomy_exploded_write(const anatomy_piece *pieces, int count, const stroke *cuts, int cut_count,
                            const head_frame *frame, const char *text, const gallery_style *style, int width,
                            int height, const char *path, err *e)
{
    if (count < 1) return err_set(e, ERR_USAGE, "%s: a picture of no segments", path);
    stage g;
    bool ok = stage_open(&g, count, e);
    label_entry *entry = NEW_ARRAY(label_entry, count);
    int entries = 0;
    for (int i = 0; ok && i < count; i++) {
        const subject_part *part = &pieces[i].part;
        rigid move = part->before;
        vec_add(move.t, pieces[i].apart_mm, move.t);
        ok = stage_add(&g, part->bone, part->kind, part->rgb, &move, e);
        if (!part->name) continue;
        entry[entries].text = part->name;
        vec_copy(part->rgb, entry[entries++].rgb);
    }
    plate p = {.view = {VIEW_THREE_QUARTER_LEFT, VIEW_LEFT},
               .caption = {"Three-quarter, left", "Left profile"},
               .frame = frame,
               .text = text,
               .style = style,
               .width = width,
               .height = height,
               .cuts = cuts,
               .cut_count = cut_count,
               .entries = entry,
               .entry_count = entries};
    ok = ok && picture_bake(g.layers, g.count, style->light_directions, e) && plate_write(&g, &p, path, e);
    free(entry);
    stage_close(&g);
    return ok;
}

static bool soft_tissue(const char *label)
{
    static const char *const names[] = {"Pn",   "Sn",   "Ls",   "Stm",  "Stms", "Stmi", "Li_soft", "C",   "Al_L",
                                        "Al_R", "Ch_L", "Ch_R", "En_L", "En_R", "Ex_L", "Ex_R",    "T_L", "T_R"};
    if (strchr(label, '\'')) return true;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(label, names[i])) return true;
    return false;
}

bool anatomy_landmarks_write(const surface *skin, const subject_part *parts, int part_count, const landmarks *points,
                             const head_frame *frame, const char *text, const gallery_style *style, int width,
                             int height, const char *path, err *e)
{
    static const double red[3] = {0.80, 0.22, 0.20}, blue[3] = {0.13, 0.38, 0.70};
    if (!skin && part_count < 1) return err_set(e, ERR_USAGE, "%s: landmarks on nothing", path);
    stage g;
    bool ok = stage_open(&g, part_count + 1, e);
    for (int i = 0; ok && i < part_count; i++)
        ok = stage_add(&g, parts[i].bone, parts[i].kind, parts[i].rgb, &parts[i].before, e);
    ok = ok && picture_bake(g.layers, g.count, style->light_directions, e);
    if (ok && skin) {
        double rgb[3];
        rigid stay = rigid_identity();
        material_color(MATERIAL_SKIN, rgb);
        ok = stage_add(&g, skin, MATERIAL_SKIN, rgb, &stay, e) &&
             picture_bake(g.layers + g.count - 1, 1, style->light_directions, e);
        if (ok && part_count) g.layers[g.count - 1].opacity = style->skin_opacity;
    }
    mark *marks = NEW_ARRAY(mark, points->count);
    label_point *names = NEW_ARRAY(label_point, points->count);
    for (int32_t i = 0; i < points->count; i++) {
        const landmark *l = points->point + i;
        marks[i] = (mark){.radius_mm = 1.3, .on_top = true};
        vec_copy(l->xyz, marks[i].xyz);
        vec_copy(soft_tissue(l->label) ? red : blue, marks[i].rgb);
        names[i].text = l->label;
        vec_copy(l->xyz, names[i].xyz);
    }
    label_entry entry[2] = {{"soft tissue", {0}}, {"bone", {0}}};
    vec_copy(red, entry[0].rgb);
    vec_copy(blue, entry[1].rgb);
    plate p = {.view = {VIEW_FRONT, VIEW_LEFT},
               .caption = {"Front", "Left profile"},
               .frame = frame,
               .text = text,
               .style = style,
               .width = width,
               .height = height,
               .marks = marks,
               .points = names,
               .point_count = points->count,
               .entries = entry,
               .entry_count = 2};
    ok = ok && plate_write(&g, &p, path, e);
    free(marks);
    free(names);
    stage_close(&g);
    return ok;
}
