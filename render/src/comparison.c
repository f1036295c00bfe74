#include "render/comparison.h"
#include "render/compose.h"
#include "render/png_file.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double fit_margin = 0.075; /* room for captions and the scale bar */
static const double heat_fade = 0.2;    /* in this part of the range the skin colour passes into the map */

comparison_params comparison_params_default(void)
{
    return (comparison_params){.tile_width = 900,
                               .tile_height = 1000,
                               .light_directions = 64,
                               .skin_opacity = 0.25,
                               .fonts = label_fonts_default()};
}

void comparison_segment_color(segment_id id, double rgb[3])
{
    static const double color[SEGMENT_COUNT][3] = {
        [SEGMENT_CRANIUM] = {0.905, 0.865, 0.765},     [SEGMENT_MAXILLA] = {0.38, 0.62, 0.82},
        [SEGMENT_DISTAL] = {0.93, 0.69, 0.36},         [SEGMENT_PROXIMAL_LEFT] = {0.48, 0.74, 0.52},
        [SEGMENT_PROXIMAL_RIGHT] = {0.24, 0.60, 0.56}, [SEGMENT_CHIN] = {0.72, 0.52, 0.77},
    };
    vec_copy(color[id], rgb);
}

typedef struct sheet { /* a finished picture that waits to be written */
    char name[COMPARISON_NAME_SIZE];
    image im;
} sheet;

typedef struct work {
    const comparison *c;
    const comparison_params *params;
    studio *s;
    model *skin[2], **bone;
    double *displacement;
    double low, high, largest, median;
    sheet sheets[COMPARISON_PICTURES_MAX];
    int sheet_count;
    image overview[8]; /* 0..3 before, 4..7 after */
} work;

static const struct {
    camera_view view;
    const char *file, *title;
} views[] = {
    {VIEW_FRONT, "front", "Front"},
    {VIEW_LEFT, "left", "Left profile"},
    {VIEW_THREE_QUARTER_LEFT, "three_quarter", "Three-quarter, left"},
    {VIEW_RIGHT, "right", "Right profile"},
};
enum { VIEWS = 4, BONE_VIEWS = 3 }; /* heat and bones use the first three */

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool check(const comparison *c, err *e)
{
    if (!c->skin_before != !c->skin_after)
        return err_set(e, ERR_USAGE, "a comparison needs the skin before and after, or neither");
    if (!c->skin_before && !c->part_count) return err_set(e, ERR_USAGE, "a comparison of nothing");
    if (c->part_count < 0 || !(c->region_radius_mm >= 0))
        return err_set(e, ERR_USAGE, "a comparison of nothing");
    if (!c->skin_before) return true;
    const surface *a = c->skin_before, *b = c->skin_after;
    if (a->vertex_count != b->vertex_count || a->triangle_count != b->triangle_count ||
        memcmp(a->tri, b->tri, 3 * (size_t)a->triangle_count * sizeof *a->tri) != 0)
        return err_set(e, ERR_GEOMETRY,
                       "the skin before (%d vertices) and after (%d) do not have the same triangles",
                       a->vertex_count, b->vertex_count);
    for (int32_t v = 0; c->displacement_mm && v < b->vertex_count; v++)
        if (c->displacement_mm[v] < 0)
            return err_set(e, ERR_GEOMETRY, "the displacement of skin vertex %d is negative (%g mm)", v,
                           c->displacement_mm[v]);
    return true;
}

static void measure(work *w)
{
    const comparison *c = w->c;
    int32_t n = c->skin_after->vertex_count, known = 0;
    w->displacement = NEW_ARRAY(double, n);
    double *sorted = NEW_ARRAY(double, n);
    for (int32_t v = 0; v < n; v++) {
        size_t i = 3 * (size_t)v;
        w->displacement[v] = c->displacement_mm
                                 ? c->displacement_mm[v]
                                 : vec_distance(c->skin_after->xyz + i, c->skin_before->xyz + i);
        if (!isnan(w->displacement[v])) sorted[known++] = w->displacement[v];
    }
    qsort(sorted, (size_t)known, sizeof *sorted, compare_doubles);
    w->largest = known ? sorted[known - 1] : 0;
    w->median = known ? sorted[known / 2] : 0;
    free(sorted);
    /* Noise of a fraction of a micrometre is not worth a colour range. */
    w->high = w->params->heat_high_mm > 0 ? w->params->heat_high_mm
                                          : colormap_nice_ceiling(w->largest > 1e-3 ? w->largest : 1);
}

/* ---- layers ---- */

static int bone_layers(const work *w, bool after, layer *out)
{
    for (int i = 0; i < w->c->part_count; i++) {
        const comparison_part *p = w->c->parts + i;
        out[i] = layer_default(w->bone[i], p->kind);
        vec_copy(p->rgb, out[i].rgb);
        out[i].move = after ? p->after : p->before;
    }
    return w->c->part_count;
}

static bool load(work *w, err *e)
{
    const comparison *c = w->c;
    model_params skin = model_params_skin(), bone = model_params_bone();
    if (!studio_open(&w->s, e)) return false;
    for (int k = 0; c->skin_before && k < 2; k++)
        if (!model_create(w->s, k ? c->skin_after : c->skin_before, &skin, &w->skin[k], e))
            return err_prefix(e, "skin %s", k ? "after" : "before");
    for (int i = 0; i < c->part_count; i++)
        if (!model_create(w->s, c->parts[i].bone, &bone, &w->bone[i], e))
            return err_prefix(e, "%s", c->parts[i].name ? c->parts[i].name : "bone");
    for (int k = 0; c->skin_before && k < 2; k++) {
        layer l = layer_default(w->skin[k], MATERIAL_SKIN);
        if (!picture_bake(&l, 1, w->params->light_directions, e)) return false;
    }
    return true;
}

static camera camera_for(const work *w, int view, int width, int height)
{
    const comparison *c = w->c;
    camera out = camera_standard(views[view].view, &c->frame, c->region_centre);
    if (c->region_radius_mm > 0) {
        camera_fit(&out, c->region_radius_mm, width, height, fit_margin);
        out.depth_mm =
            fmax(out.depth_mm, 600); /* what lies outside the region is cut by the border, not by depth */
        return out;
    }
    const surface **all = NEW_ARRAY(const surface *, 2 + c->part_count);
    int count = 0;
    if (c->skin_before) {
        all[count++] = c->skin_before;
        all[count++] = c->skin_after;
    } else
        for (int i = 0; i < c->part_count; i++) all[count++] = c->parts[i].bone;
    camera_fit_surfaces(&out, all, count, width, height, fit_margin);
    free(all);
    return out;
}

/* ---- one tile ---- */

typedef enum tile_kind { TILE_SKIN, TILE_BONES, TILE_HEAT } tile_kind;

static void write_marks(const work *w, pen *p, const image *im, const camera *cam, double size)
{
    double scale = camera_scale(cam, im->height);
    label_sides(p, 0, 0, im->width, im->height, size, cam, &w->c->frame);
    label_scale_bar(p, 0.9 * size, im->height - 1.0 * size, scale, label_scale_length(scale, im->width),
                    0.8 * size);
}

static void write_heat(const work *w, pen *p, const image *im, double size)
{
    label_map m = {.map = COLORMAP_VIRIDIS,
                   .low = w->low,
                   .high = w->high,
                   .fade_end = heat_fade * w->high,
                   .caption = "skin displacement, mm"};
    material_color(MATERIAL_SKIN, m.fade_rgb);
    double height = 0.36 * im->height;
    label_color_bar(p, im->width - 2.2 * size, 3.0 * size, 1.1 * size, height, 0.8 * size, &m);
    char text[80];
    static const double ink[3] = {0.16, 0.19, 0.23};
    snprintf(text, sizeof text, "largest %.1f mm, median %.1f mm", w->largest, w->median);
    pen_text(p, im->width - 0.9 * size, im->height - 1.0 * size, LABEL_RIGHT, 0.8 * size, false, ink, text);
}

static void write_legend(const work *w, pen *p, const image *im, double size)
{
    label_entry *entry = NEW_ARRAY(label_entry, w->c->part_count);
    int count = 0;
    double widest = 0;
    for (int i = 0; i < w->c->part_count; i++) {
        const comparison_part *part = w->c->parts + i;
        if (!part->name) continue;
        entry[count].text = part->name;
        vec_copy(part->rgb, entry[count++].rgb);
        widest = fmax(widest, pen_text_width(p, 0.75 * size, false, part->name));
    }
    double height = count * 1.55 * 0.75 * size;
    label_legend(p, im->width - widest - 2.3 * size, im->height - height - 0.6 * size, 0.75 * size, entry,
                 count);
    free(entry);
}

/* half (may be NULL) gets the picture at half size, without labels. */
static bool draw_tile(work *w, tile_kind kind, int view, bool after, image *half, image *out, err *e)
{
    const comparison *c = w->c;
    int width = w->params->tile_width, height = w->params->tile_height;
    layer *layers = NEW_ARRAY(layer, c->part_count + 1);
    int count = kind == TILE_BONES ? bone_layers(w, after, layers) : 0;
    if (c->skin_before) {
        layer l = layer_default(w->skin[after], MATERIAL_SKIN);
        if (kind == TILE_BONES) l.opacity = w->params->skin_opacity;
        if (kind != TILE_HEAT) l.vertex_rgb = (after ? c->skin_after : c->skin_before)->rgb;
        if (kind == TILE_HEAT) {
            l.scalar = w->displacement;
            l.low = w->low;
            l.high = w->high;
            l.fade_end = heat_fade * w->high;
        }
        layers[count++] = l;
    }
    picture p = {.layers = layers, .layer_count = count, .view = camera_for(w, view, width, height)};
    picture_style style = picture_style_default();
    style.width = width;
    style.height = height;
    image im = {0};
    pen *marker = NULL;
    bool ok = picture_render(w->s, &p, &style, &im, NULL, e);
    free(layers);
    if (ok && half) *half = image_half(&im);
    if (ok) {
        double size = fmax(9, im.height / 45.0);
        ok = pen_open(&im, &w->params->fonts, &marker, e);
        if (ok) {
            write_marks(w, marker, &im, &p.view, size);
            if (kind == TILE_HEAT) write_heat(w, marker, &im, size);
            if (kind == TILE_BONES && after) write_legend(w, marker, &im, size);
            pen_close(&marker);
        }
    }
    if (ok)
        *out = im;
    else
        image_free(&im);
    return ok;
}

/* ---- sheets ---- */

static compose_params sheet_params(const work *w, int columns, int tile_height, const char *title)
{
    compose_params p = compose_params_default();
    p.columns = columns;
    p.font_size = fmax(10, tile_height / (columns > 2 ? 26.0 : 42.0));
    p.title = title;
    p.subtitle = w->c->plan_text;
    p.fonts = w->params->fonts;
    return p;
}

static bool add_sheet(work *w, const char *name, const char *title, const compose_tile *tiles, int count,
                      int columns, err *e)
{
    assert(w->sheet_count < COMPARISON_PICTURES_MAX);
    sheet *s = w->sheets + w->sheet_count;
    char text[300];
    snprintf(s->name, sizeof s->name, "%s", name);
    snprintf(text, sizeof text, "%s   %s", w->c->case_name, title);
    compose_params p = sheet_params(w, columns, tiles[0].picture->height, text);
    if (!compose_sheet(tiles, count, &p, &s->im, e)) return false;
    w->sheet_count++;
    return true;
}

/* All tiles of one pose; the after tiles are put beside the waiting before tiles. */
typedef struct waiting {
    image skin[VIEWS], bones[BONE_VIEWS];
} waiting;

static bool draw_pose(work *w, bool after, waiting *t, err *e)
{
    const comparison *c = w->c;
    image *small = w->overview + 4 * after;
    /* The light of the bones depends on where they are. */
    if (c->part_count) {
        layer *layers = NEW_ARRAY(layer, c->part_count);
        bool ok = picture_bake(layers, bone_layers(w, after, layers), w->params->light_directions, e);
        free(layers);
        if (!ok) return false;
    }
    for (int v = 0; c->skin_before && v < VIEWS; v++)
        if (!draw_tile(w, TILE_SKIN, v, after, v < 3 ? &small[v] : NULL, &t->skin[v], e)) return false;
    for (int v = 0; c->part_count && v < BONE_VIEWS; v++)
        if (!draw_tile(w, TILE_BONES, v, after, v == 1 ? &small[3] : NULL, &t->bones[v], e)) return false;
    return true;
}

static bool pair(work *w, const char *name, const char *title, const char *second, const image *before,
                 const image *after, err *e)
{
    compose_tile tiles[2] = {{before, "Before"}, {after, second}};
    return add_sheet(w, name, title, tiles, 2, 2, e);
}

static bool draw_all(work *w, waiting t[2], err *e)
{
    const comparison *c = w->c;
    char name[COMPARISON_NAME_SIZE], title[120];
    for (int k = 0; k < 2; k++)
        if (!draw_pose(w, k, &t[k], e)) return false;
    for (int v = 0; c->skin_before && v < VIEWS; v++) {
        snprintf(name, sizeof name, "before_after_%s.png", views[v].file);
        if (!pair(w, name, views[v].title, "Predicted", &t[0].skin[v], &t[1].skin[v], e)) return false;
    }
    for (int v = 0; c->skin_before && v < BONE_VIEWS; v++) {
        image im = {0};
        snprintf(name, sizeof name, "heat_%s.png", views[v].file);
        bool ok = draw_tile(w, TILE_HEAT, v, true, NULL, &im, e) &&
                  add_sheet(w, name, views[v].title, &(compose_tile){&im, "Predicted"}, 1, 1, e);
        image_free(&im);
        if (!ok) return false;
    }
    for (int v = 0; c->part_count && v < BONE_VIEWS; v++) {
        snprintf(name, sizeof name, "bones_%s.png", views[v].file);
        snprintf(title, sizeof title, "%s, bones", views[v].title);
        if (!pair(w, name, title, "Planned", &t[0].bones[v], &t[1].bones[v], e)) return false;
    }
    compose_tile tiles[8];
    int columns = 0;
    for (int i = 0; i < 4; i++) columns += w->overview[i].rgba != NULL;
    for (int i = 0, n = 0; i < 8; i++)
        if (w->overview[i].rgba) {
            tiles[n] = (compose_tile){&w->overview[i], n == 0 ? "Before" : n == columns ? "Predicted" : NULL};
            n++;
        }
    return add_sheet(w, "overview.png", "Overview", tiles, 2 * columns, columns, e);
}

static bool write_all(const work *w, const char *folder, err *e)
{
    png_note notes[5] = {{"Software", "gnathos " GNATHOS_VERSION},
                         {"Renderer", studio_description(w->s)},
                         {"Case", w->c->case_name}};
    int count = 3;
    if (w->c->plan_text) notes[count++] = (png_note){"Plan", w->c->plan_text};
    if (w->c->case_hash) notes[count++] = (png_note){"Case hash", w->c->case_hash};
    for (int i = 0; i < w->sheet_count; i++) {
        size_t size = strlen(folder) + COMPARISON_NAME_SIZE + 2;
        char *path = mem_alloc(size, 1);
        snprintf(path, size, "%s/%s", folder, w->sheets[i].name);
        bool ok = png_file_write(&w->sheets[i].im, notes, count, path, e);
        free(path);
        if (!ok) return false;
    }
    return true;
}

bool comparison_write(const comparison *c, const comparison_params *params, const char *folder,
                      comparison_result *result, err *e)
{
    if (!check(c, e)) return false;
    work w = {.c = c, .params = params, .bone = NEW_ARRAY(model *, c->part_count)};
    waiting t[2] = {{{{0}}, {{0}}}, {{{0}}, {{0}}}};
    if (c->skin_before) measure(&w);
    bool ok = load(&w, e) && draw_all(&w, t, e) && write_all(&w, folder, e);
    if (ok && result) {
        *result = (comparison_result){.count = w.sheet_count,
                                      .heat_low_mm = w.low,
                                      .heat_high_mm = w.high,
                                      .largest_mm = w.largest,
                                      .median_mm = w.median};
        for (int i = 0; i < w.sheet_count; i++)
            memcpy(result->name[i], w.sheets[i].name, COMPARISON_NAME_SIZE);
    }
    for (int k = 0; k < 2; k++) {
        for (int v = 0; v < VIEWS; v++) image_free(&t[k].skin[v]);
        for (int v = 0; v < BONE_VIEWS; v++) image_free(&t[k].bones[v]);
        model_free(&w.skin[k]);
    }
    for (int i = 0; i < 8; i++) image_free(&w.overview[i]);
    for (int i = 0; i < w.sheet_count; i++) image_free(&w.sheets[i].im);
    for (int i = 0; i < c->part_count; i++) model_free(&w.bone[i]);
    free(w.bone);
    free(w.displacement);
    studio_close(&w.s);
    return ok;
}
