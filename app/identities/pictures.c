#include "app/identities/pictures.h"
#include "geometry/mem.h"
#include "render/colormap.h"
#include "render/gallery.h"
#include "render/compose.h"
#include "render/png_file.h"
#include <stdio.h>
#include <stdlib.h>

enum { MODES_DRAWN = 6, VIEWS = 3, LIGHT = 32, WIDE = 1920, HIGH = 1080 };

typedef struct drawn { /* not to be moved in memory */
    head_shape shape;
    surface part[CASE_SURFACE_COUNT];
    landmarks points;
    subject shown;
    subject_part bone[CASE_SURFACE_COUNT];
} drawn;

static bool drawn_open(const head_template *t, const double *phi, const char *name, drawn *out, err *e)
{
    *out = (drawn){.shape = head_vector_shape(t, phi)};
    out->points = head_points(t, &out->shape);
    subject *s = &out->shown;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) out->part[i] = head_part(t, &out->shape, (case_surface)i);
    *s = (subject){.case_name = name,
                   .skin_before = &out->part[CASE_SKIN],
                   .skin_after = &out->part[CASE_SKIN],
                   .parts = out->bone,
                   .before = &out->points,
                   .after = &out->points};
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        subject_part *p = &out->bone[s->part_count++];
        *p = (subject_part){.bone = &out->part[i],
                            .before = rigid_identity(),
                            .after = rigid_identity(),
                            .kind = i >= CASE_UPPER_TEETH ? MATERIAL_TOOTH : MATERIAL_BONE};
        material_color(p->kind, p->rgb);
    }
    return head_frame_from_landmarks(&out->points, &s->frame, e);
}

static void drawn_free(drawn *d)
{
    head_shape_free(&d->shape);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) surface_free(&d->part[i]);
    landmarks_free(&d->points);
}

/* From the front, from the left, and the bones within. */
static bool draw_row(const head_template *t, const double *phi, int high, image *out, err *e)
{
    static const panel panels[VIEWS] = {{SHOW_SKIN, POSE_BEFORE, 0, 0, 0, NULL},
                                        {SHOW_SKIN, POSE_BEFORE, 90, 0, 0, NULL},
                                        {SHOW_CLEAR, POSE_BEFORE, 90, 0, 0, NULL}};
    const sheet what = {NULL, panels, VIEWS, VIEWS, WIDE, high};
    drawn d;
    gallery_style style = gallery_style_default();
    style.light_directions = LIGHT;
    style.labels = false;
    style.zoom = 0.75; /* the whole head */
    gallery *g = NULL;
    bool ok = drawn_open(t, phi, "", &d, e) && gallery_open(&d.shown, &style, &g, e) && gallery_draw(g, &what, out, e);
    gallery_close(&g);
    drawn_free(&d);
    return ok;
}

static bool draw_mode(const head_template *t, const head_model *m, int32_t mode, const char *folder, double *phi,
                      err *e)
{
    image row[2] = {{0}};
    char caption[2][64], title[96], path[FIELD_PATH_SIZE];
    bool ok = true;
    for (int side = 0; ok && side < 2; side++) {
        double p[HEAD_MODES_MOST] = {0};
        p[mode] = side ? 2 : -2;
        snprintf(caption[side], sizeof caption[side], "%+.0f standard deviations", p[mode]);
        principal_make(&m->modes, p, mode + 1, phi);
        ok = draw_row(t, phi, HIGH / 2, &row[side], e);
    }
    const compose_tile tiles[2] = {{&row[0], caption[0]}, {&row[1], caption[1]}};
    compose_params how = compose_params_default();
    image all = {0};
    how.columns = 1;
    how.title = title;
    snprintf(title, sizeof title, "Mode %d: %.1f %% of the variance of %d heads", mode + 1,
             100 * principal_share(&m->modes, mode), m->modes.sample_count);
    snprintf(path, sizeof path, "%s/mode_%02d.png", folder, mode + 1);
    ok = ok && compose_sheet(tiles, 2, &how, &all, e) && png_file_write(&all, NULL, 0, path, e);
    image_free(&all);
    for (int side = 0; side < 2; side++) image_free(&row[side]);
    return ok;
}

bool identities_draw(const head_template *t, const head_model *m, const char *folder, err *e)
{
    char path[FIELD_PATH_SIZE];
    image mean = {0};
    snprintf(path, sizeof path, "%s/mean.png", folder);
    bool ok = draw_row(t, m->modes.mean, HIGH * 2 / 3, &mean, e) && png_file_write(&mean, NULL, 0, path, e);
    image_free(&mean);
    double *phi = NEW_ARRAY(double, m->modes.length);
    for (int32_t k = 0; ok && k < m->modes.mode_count && k < MODES_DRAWN; k++) ok = draw_mode(t, m, k, folder, phi, e);
    free(phi);
    return ok;
}

bool identity_draw(const head_template *t, const identities_projection *p, const double *error_mm, const char *folder,
                   err *e)
{
    static const panel panels[VIEWS] = {{SHOW_DISPLACEMENT, POSE_AFTER, 0, 0, 0, "Front"},
                                        {SHOW_DISPLACEMENT, POSE_AFTER, 90, 0, 0, "Left profile"},
                                        {SHOW_DISPLACEMENT, POSE_AFTER, -90, 0, 0, "Right profile"}};
    const sheet what = {"Head made by the model: distance from the fitted head, mm", panels, VIEWS, VIEWS, WIDE, HIGH};
    char path[FIELD_PATH_SIZE];
    drawn d;
    gallery_style style = gallery_style_default();
    gallery *g = NULL;
    bool ok = drawn_open(t, p->made, p->name, &d, e);
    d.shown.displacement_mm = error_mm;
    snprintf(path, sizeof path, "%s/error.png", folder);
    ok = ok && gallery_open(&d.shown, &style, &g, e) && gallery_write(g, &what, path, e);
    if (ok) {
        double high = gallery_map_range(g, SHOW_DISPLACEMENT).high;
        surface *skin = &d.part[CASE_SKIN];
        skin->rgb = skin->rgb ? skin->rgb : NEW_ARRAY(uint8_t, 3 * (size_t)skin->vertex_count);
        for (int32_t i = 0; i < skin->vertex_count; i++) {
            double rgb[3];
            colormap_color(COLORMAP_VIRIDIS, error_mm[i], 0, high, rgb);
            for (int c = 0; c < 3; c++) skin->rgb[3 * i + c] = (uint8_t)(255 * rgb[c] + 0.5);
        }
        snprintf(path, sizeof path, "%s/error.ply", folder);
        ok = mesh_write_surface(skin, path, e);
    }
    gallery_close(&g);
    drawn_free(&d);
    return ok;
}
