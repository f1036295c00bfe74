#include "app/pictures/fit.h"
#include "geometry/mem.h"
#include "render/compose.h"
#include "render/gallery.h"
#include "render/picture.h"
#include "render/png_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1920, HEIGHT = 1080 };

/* Skin, or bones and teeth in one; gap the same way. */
static surface fitted(const fit_pictures *p, bool bones, double **gap)
{
    surface all = {0};
    double *distance = NULL;
    for (int i = bones ? CASE_SKULL : CASE_SKIN; i < (bones ? CASE_SURFACE_COUNT : CASE_SKULL); i++) {
        surface one = head_part(p->head, &p->fit->shape, (case_surface)i), sum = surface_joined(&all, &one);
        distance = GROW_ARRAY(double, distance, sum.vertex_count);
        for (size_t v = 0; v < (size_t)one.vertex_count; v++)
            distance[(size_t)all.vertex_count + v] = fit_shown_mm(p->fit, (case_surface)i, v);
        surface_free(&one);
        surface_free(&all);
        all = sum;
    }
    *gap = distance;
    return all;
}

static surface scanned(const fit_pictures *p, bool bones)
{
    surface all = {0};
    for (int i = bones ? CASE_SKULL : CASE_SKIN; i < (bones ? CASE_SURFACE_COUNT : CASE_SKULL); i++) {
        surface sum = surface_joined(&all, &p->scan->part[i]);
        surface_free(&all);
        all = sum;
    }
    return all;
}

static bool frame_of(const fit_pictures *p, landmarks *points, head_frame *f, err *e)
{
    *points = head_points(p->head, &p->fit->shape);
    bool ok = head_frame_from_landmarks(points, f, e);
    if (!ok) landmarks_free(points);
    return ok;
}

/* gap_mm of the shape's vertices in colours; front and both sides. */
static bool draw_gaps(const fit_pictures *p, const surface *shape, const double *gap_mm, double range_mm,
                      const char *title, const char *caption, const char *path, err *e)
{
    static const panel panels[] = {{SHOW_SIGNED, POSE_AFTER, 0, 0, 0, "Front"},
                                   {SHOW_SIGNED, POSE_AFTER, 90, 0, 0, "Left profile"},
                                   {SHOW_SIGNED, POSE_AFTER, -90, 0, 0, "Right profile"}};
    const sheet what = {title, panels, 3, 3, WIDTH, HEIGHT};
    landmarks points;
    subject s = {.case_name = "",
                 .plan_text = p->title,
                 .signed_caption = caption,
                 .skin_before = shape,
                 .skin_after = shape,
                 .signed_mm = gap_mm};
    if (!frame_of(p, &points, &s.frame, e)) return false;
    s.before = s.after = &points;
    gallery_style style = gallery_style_default();
    style.signed_mm = range_mm;
    style.labels = true;
    gallery *g = NULL;
    bool ok = gallery_open(&s, &style, &g, e) && gallery_write(g, &what, path, e);
    gallery_close(&g);
    landmarks_free(&points);
    return ok;
}

bool fit_residual_write(const fit_pictures *p, bool bones, double range_mm, const char *path, err *e)
{
    double *gap;
    surface shape = fitted(p, bones, &gap);
    bool ok = draw_gaps(p, &shape, gap, range_mm,
                        bones ? "Fitted bones and teeth against the scan" : "Fitted skin against the scan",
                        "distance to the scan, mm; dark grey: guessed", path, e);
    surface_free(&shape);
    free(gap);
    return ok;
}

bool fit_scan_write(const fit_pictures *p, double range_mm, const char *path, err *e)
{
    return draw_gaps(p, &p->scan->part[CASE_SKIN], p->fit->back_mm[CASE_SKIN], range_mm,
                     "The scan's skin against the fitted one",
                     "distance to the fitted skin, mm; dark grey: not on the outside or not covered", path, e);
}

/* Front and left profile of one surface. */
static bool draw_pair(const surface *shape, const landmarks *points, const head_frame *frame, const char *caption,
                      image out[2], err *e)
{
    subject s = {
        .case_name = "", .skin_before = shape, .skin_after = shape, .before = points, .after = points, .frame = *frame};
    gallery_style style = gallery_style_default();
    gallery *g = NULL;
    bool ok = gallery_open(&s, &style, &g, e);
    for (int i = 0; ok && i < 2; i++) {
        const panel one = {SHOW_SKIN, POSE_AFTER, i ? 90 : 0, 0, 0, caption};
        const sheet what = {NULL, &one, 1, 1, WIDTH / 4, (HEIGHT - 60) / 2};
        ok = gallery_draw(g, &what, &out[i], e);
    }
    gallery_close(&g);
    return ok;
}

/* The usual colour, grey where gap_mm[vertex_count] is NAN: the scan has nothing there. */
static uint8_t *colours(const surface *shape, const double *gap_mm)
{
    double usual[3];
    uint8_t *rgb = NEW_ARRAY(uint8_t, 3 * (size_t)shape->vertex_count);
    material_color(MATERIAL_SKIN, usual);
    for (size_t i = 0; i < 3 * (size_t)shape->vertex_count; i++)
        rgb[i] = isnan(gap_mm[i / 3]) ? 120 : (uint8_t)lround(255 * usual[i % 3]);
    return rgb;
}

bool fit_beside_write(const fit_pictures *p, const char *path, err *e)
{
    landmarks points;
    head_frame frame;
    image tile[8] = {{0}};
    if (!frame_of(p, &points, &frame, e)) return false;
    bool ok = true;
    for (int i = 0; ok && i < 4; i++) { /* scan: skin, bones; fitted: skin, bones */
        double *gap = NULL;
        surface shape = i < 2 ? scanned(p, i % 2) : fitted(p, i % 2, &gap);
        if (gap) shape.rgb = colours(&shape, gap);
        free(gap);
        if (shape.triangle_count)
            ok = draw_pair(&shape, &points, &frame, i < 2 ? "scan" : "fitted template; grey: guessed", tile + 2 * i, e);
        else
            for (int k = 2 * i; k < 2 * i + 2; k++) tile[k] = image_new(WIDTH / 4, (HEIGHT - 60) / 2);
        surface_free(&shape);
    }
    compose_params params = compose_params_default();
    params.columns = 4;
    params.title = "The template on the patient";
    params.subtitle = p->title;
    compose_tile tiles[8];
    for (int i = 0; i < 8; i++) tiles[i] = (compose_tile){&tile[i], NULL};
    image whole = {0};
    ok = ok && compose_sheet(tiles, 8, &params, &whole, e) && png_file_write(&whole, NULL, 0, path, e);
    for (int i = 0; i < 8; i++) image_free(&tile[i]);
    image_free(&whole);
    landmarks_free(&points);
    return ok;
}
