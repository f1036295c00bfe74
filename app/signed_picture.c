#include "app/signed_picture.h"
#include "geometry/vec.h"
#include "render/label.h"
#include "render/picture.h"
#include "render/png_file.h"

const char *const signed_picture_name[SIGNED_PICTURES] = {"signed_front.png", "signed_left.png", "signed_right.png"};

static const double margin = 0.075, label_share = 0.028; /* of the height */

static bool draw(studio *s, const layer *l, const face_compare *c, camera_view view, const char *path, err *e)
{
    picture_style style = picture_style_default();
    double middle[3];
    const landmark *n = landmarks_find(&c->points, "N"), *me = landmarks_find(&c->points, "Me");
    const landmark *sn = landmarks_find(&c->points, "Sn");
    vec_add(n->xyz, me ? me->xyz : sn->xyz, middle);
    vec_scale(middle, 0.5, middle);
    vec_axpy(middle, 22, c->frame.posterior, middle);
    picture p = {.layers = l, .layer_count = 1, .view = camera_standard(view, &c->frame, middle)};
    camera_fit(&p.view, 0.86 * vec_distance(n->xyz, me ? me->xyz : sn->xyz), style.width, style.height, margin);
    p.view.depth_mm = fmax(p.view.depth_mm, 600);
    image im = {0};
    pen *ink = NULL;
    label_fonts fonts = label_fonts_default();
    if (!picture_render(s, &p, &style, &im, NULL, e)) return false;
    bool ok = pen_open(&im, &fonts, &ink, e);
    if (ok) {
        double size = label_share * im.height, scale = camera_scale(&p.view, im.height);
        label_map bar = {.map = l->map, .low = l->low, .high = l->high, .fade_end = l->low,
                         .caption = "actual in front (+), behind (-), mm"};
        label_sides(ink, 0, 0, im.width, im.height, size, &p.view, &c->frame);
        label_scale_bar(ink, 0.9 * size, im.height - size, scale, label_scale_length(scale, im.width), 0.8 * size);
        label_color_bar(ink, im.width - 2.2 * size, 3 * size, 1.1 * size, 0.36 * im.height, 0.8 * size, &bar);
        pen_close(&ink);
        ok = png_file_write(&im, NULL, 0, path, e);
    }
    image_free(&im);
    return ok;
}

bool signed_pictures_write(const face_compare *c, char *const paths[SIGNED_PICTURES], err *e)
{
    static const camera_view view[SIGNED_PICTURES] = {VIEW_FRONT, VIEW_LEFT, VIEW_RIGHT};
    const surface *skin = &c->skin[PREDICTED];
    model_params params = model_params_skin();
    studio *s = NULL;
    model *shape = NULL;
    bool ok = studio_open(&s, e) && model_create(s, skin, &params, &shape, e);
    if (ok) {
        layer l = layer_default(shape, MATERIAL_SKIN);
        l.scalar = c->signed_mm[PREDICTED];
        l.map = COLORMAP_COOLWARM;
        l.high = colormap_nice_ceiling(fmax(c->row[PREDICTED][ROW_FACE].p95, 1));
        l.low = l.fade_end = -l.high;
        ok = picture_bake(&l, 1, 64, e);
        for (int i = 0; ok && i < SIGNED_PICTURES; i++) ok = draw(s, &l, c, view[i], paths[i], e);
    }
    model_free(&shape);
    studio_close(&s);
    return ok;
}
