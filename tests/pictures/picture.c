#include "tests/pictures/stage.h"
#include "geometry/parallel.h"
#include "render/src/studio.h"

static studio *the_studio;

static int open_studio(void **state)
{
    (void)state;
    err e = {0};
    if (studio_open(&the_studio, &e)) return 0;
    print_error("%s\n", e.text);
    return -1;
}

static int close_studio(void **state)
{
    (void)state;
    studio_close(&the_studio);
    return 0;
}

static camera front(double half_height_mm)
{
    head_frame f = straight_frame();
    camera c = camera_standard(VIEW_FRONT, &f, (double[3]){0, 0, 0});
    c.half_height_mm = half_height_mm;
    c.depth_mm = 300;
    return c;
}

static image draw(const layer *layers, int count, const camera *c)
{
    err e = {0};
    image im = {0};
    picture p = {.layers = layers, .layer_count = count, .view = *c};
    picture_style style = small_style();
    assert_ok(picture_render(the_studio, &p, &style, &im, NULL, &e));
    return im;
}

static bool reddish(const uint8_t *p) { return p[0] > 100 && p[0] > 2 * p[1] && p[0] > 2 * p[2]; }

static void paint(layer *l, double r, double g, double b)
{
    l->rgb[0] = r;
    l->rgb[1] = g;
    l->rgb[2] = b;
}

static void a_red_box_is_where_it_should_be(void **state)
{
    (void)state;
    /* 20 mm wide around x = +30 (the patient's left), 40 mm high around z = +20; 1 mm is 1 pixel. */
    surface s = box(20, -10, 0, 40, 10, 40);
    model *m = make_model(the_studio, &s, 30);
    layer l = layer_default(m, MATERIAL_PLAIN);
    paint(&l, 0.9, 0.05, 0.05);
    camera c = front(100);
    image im = draw(&l, 1, &c);
    for (int y = 0; y < im.height; y++)
        for (int x = 0; x < im.width; x++) {
            bool inside = x >= 80 + 20 && x < 80 + 40 && y >= 100 - 40 && y < 100;
            if (reddish(image_pixel(&im, x, y)) != inside) fail_msg("pixel %d %d is %s red", x, y, inside ? "not" : "");
        }
    image_free(&im);
    model_free(&m);
    surface_free(&s);
}

static void a_fitted_ball_is_centred_and_fills_the_picture(void **state)
{
    (void)state;
    surface s = ball((double[3]){12, -340, 95}, 50, 24);
    model *m = make_model(the_studio, &s, 180);
    layer l = layer_default(m, MATERIAL_SKIN);
    head_frame f = straight_frame();
    camera c = camera_standard(VIEW_THREE_QUARTER_LEFT, &f, (double[3]){0, 0, 0});
    camera_fit_surfaces(&c, (const surface *[]){&s}, 1, 160, 200, 0.05);
    image im = draw(&l, 1, &c), empty = draw(NULL, 0, &c);
    double sx = 0, sy = 0, n = 0;
    int low = 160, high = 0;
    for (int y = 0; y < im.height; y++)
        for (int x = 0; x < im.width; x++)
            if (memcmp(image_pixel(&im, x, y), image_pixel(&empty, x, y), 4) != 0) {
                sx += x + 0.5;
                sy += y + 0.5;
                n++;
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
    assert_near(sx / n, 80, 0.5);
    assert_near(sy / n, 100, 0.5);
    assert_near(low, 8, 1.5); /* 5 % of 160 */
    assert_near(high, 151, 1.5);
    image_free(&im);
    image_free(&empty);
    model_free(&m);
    surface_free(&s);
}

static void the_same_input_gives_the_same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    surface s = ball((double[3]){0, 0, 0}, 50, 40), o = box(-80, -90, 20, 80, -70, 30);
    image first = {0};
    for (int run = 0; run < 3; run++) {
        err e = {0};
        studio *mine = NULL;
        parallel_set_threads(run + 1);
        assert_ok(studio_open(&mine, &e));
        model *m[2] = {make_model(mine, &s, 180), make_model(mine, &o, 30)};
        layer l[2] = {layer_default(m[0], MATERIAL_SKIN), layer_default(m[1], MATERIAL_BONE)};
        assert_ok(picture_bake(l, 2, 48, &e));
        picture p = {.layers = l, .layer_count = 2, .view = front(100)};
        picture_style style = small_style();
        image im = {0};
        assert_ok(picture_render(mine, &p, &style, &im, NULL, &e));
        model_free(&m[0]);
        model_free(&m[1]);
        studio_close(&mine);
        if (run) {
            assert_int_equal(image_difference(&im, &first, 0), 0);
            image_free(&im);
        } else
            first = im;
    }
    parallel_set_threads(0);
    image_free(&first);
    surface_free(&s);
    surface_free(&o);
}

static void the_nearer_of_two_boxes_is_seen_whatever_the_order(void **state)
{
    (void)state;
    surface near = box(-20, -60, -20, 20, -40, 20), far = box(-40, 40, -40, 40, 60, 40);
    model *m[2] = {make_model(the_studio, &near, 30), make_model(the_studio, &far, 30)};
    layer l[2] = {layer_default(m[0], MATERIAL_PLAIN), layer_default(m[1], MATERIAL_PLAIN)};
    paint(&l[0], 0.9, 0.05, 0.05);
    paint(&l[1], 0.05, 0.05, 0.9);
    camera c = front(100);
    for (int order = 0; order < 2; order++) {
        layer two[2] = {l[order], l[!order]};
        image im = draw(two, 2, &c);
        assert_true(reddish(image_pixel(&im, 80, 100)));
        const uint8_t *side = image_pixel(&im, 80 + 30, 100);
        assert_true(side[2] > 2 * side[0]);
        image_free(&im);
    }
    for (int k = 0; k < 2; k++) model_free(&m[k]);
    surface_free(&near);
    surface_free(&far);
}

static void clear_skin_shows_the_bone_and_only_its_own_front(void **state)
{
    (void)state;
    surface bone = box(-20, -10, -20, 20, 10, 20), skin = box(-50, -40, -50, 50, 40, 50);
    surface one = box(-50, -40, -50, 50, -39.9, 50); /* its front alone */
    model *m[3] = {make_model(the_studio, &bone, 30), make_model(the_studio, &skin, 30),
                   make_model(the_studio, &one, 30)};
    layer l[2] = {layer_default(m[0], MATERIAL_PLAIN), layer_default(m[1], MATERIAL_PLAIN)};
    camera c = front(100);
    paint(&l[0], 0.9, 0.05, 0.05);
    paint(&l[1], 0.05, 0.9, 0.05);
    l[1].opacity = 0.4;
    image both = draw(l, 2, &c), bone_alone = draw(l, 1, &c);
    const uint8_t *mixed = image_pixel(&both, 80, 100), *red = image_pixel(&bone_alone, 80, 100);
    assert_true(mixed[0] < red[0] && mixed[0] > 60); /* the bone shines through */
    assert_true(mixed[1] > red[1] + 40);             /* and the skin is there */
    /* A closed shell looks like its front sheet: the back does not add a second veil. */
    layer sheet = l[1];
    sheet.shape = m[2];
    layer two[2] = {l[0], sheet};
    image front_only = draw(two, 2, &c);
    for (int y = 60; y < 140; y++)
        for (int x = 40; x < 120; x++)
            for (int k = 0; k < 3; k++) assert_near(image_pixel(&both, x, y)[k], image_pixel(&front_only, x, y)[k], 1);
    image_free(&both);
    image_free(&bone_alone);
    image_free(&front_only);
    for (int k = 0; k < 3; k++) model_free(&m[k]);
    surface_free(&bone);
    surface_free(&skin);
    surface_free(&one);
}

static void every_clear_layer_is_drawn_over_the_ones_before(void **state)
{
    (void)state;
    surface front_box = box(-30, -60, -30, 30, -50, 30), back_box = box(-60, 10, -60, 60, 20, 60);
    model *m[2] = {make_model(the_studio, &front_box, 30), make_model(the_studio, &back_box, 30)};
    layer l[2] = {layer_default(m[0], MATERIAL_PLAIN), layer_default(m[1], MATERIAL_PLAIN)};
    paint(&l[0], 0.9, 0.05, 0.05);
    paint(&l[1], 0.05, 0.05, 0.9);
    l[0].opacity = l[1].opacity = 0.5;
    camera c = front(100);
    image both = draw(l, 2, &c), first = draw(l, 1, &c);
    /* The second lies behind the first and is not lost. */
    assert_true(image_pixel(&both, 80, 100)[0] + 30 < image_pixel(&first, 80, 100)[0]);
    image_free(&both);
    image_free(&first);
    for (int k = 0; k < 2; k++) model_free(&m[k]);
    surface_free(&front_box);
    surface_free(&back_box);
}

static void hollows_are_darker_after_baking(void **state)
{
    (void)state;
    surface floor = ball((double[3]){0, 0, 0}, 40, 40), roof = box(-60, -60, 41, 60, 60, 45);
    model *m[2] = {make_model(the_studio, &floor, 180), make_model(the_studio, &roof, 30)};
    layer l[2] = {layer_default(m[0], MATERIAL_BONE), layer_default(m[1], MATERIAL_BONE)};
    camera c = front(100);
    image before = draw(l, 1, &c), after;
    err e = {0};
    assert_ok(picture_bake(l, 2, 96, &e));
    after = draw(l, 1, &c);
    int under_roof = image_pixel(&before, 80, 66)[1] - image_pixel(&after, 80, 66)[1];
    int open_side = image_pixel(&before, 80, 136)[1] - image_pixel(&after, 80, 136)[1];
    assert_true(under_roof > 20);
    assert_true(abs(open_side) < 12);
    image_free(&before);
    image_free(&after);
    for (int k = 0; k < 2; k++) model_free(&m[k]);
    surface_free(&floor);
    surface_free(&roof);
}

static void the_map_shows_its_ends_and_no_data_is_grey(void **state)
{
    (void)state;
    surface s = box(-40, -10, -40, 40, 10, 40);
    model *m = make_model(the_studio, &s, 30);
    layer l = layer_default(m, MATERIAL_PLAIN);
    camera c = front(100);
    double value[8];
    l.scalar = value;
    l.low = 0;
    l.high = 5;
    uint8_t seen[3][3];
    for (int k = 0; k < 3; k++) {
        for (int v = 0; v < 8; v++) value[v] = k == 0 ? -1 : k == 1 ? 7 : (double)NAN; /* beyond the ends: the ends */
        image im = draw(&l, 1, &c);
        memcpy(seen[k], image_pixel(&im, 80, 100), 3);
        image_free(&im);
    }
    assert_true(seen[0][2] > seen[0][1] + 20 && seen[0][0] > seen[0][1] + 10); /* violet */
    assert_true(seen[1][0] > seen[1][2] + 80 && seen[1][1] > seen[1][2] + 80); /* yellow */
    assert_near(seen[2][0], seen[2][1], 12);
    assert_near(seen[2][1], seen[2][2], 12);
    /* At the low end the fade gives the layer's own colour. */
    for (int v = 0; v < 8; v++) value[v] = 0;
    l.fade_end = 1;
    paint(&l, 0.9, 0.05, 0.05);
    image im = draw(&l, 1, &c);
    assert_true(reddish(image_pixel(&im, 80, 100)));
    image_free(&im);
    model_free(&m);
    surface_free(&s);
}

static void marks_are_hidden_by_what_lies_in_front(void **state)
{
    (void)state;
    surface s = box(-40, -10, -40, 40, 10, 40);
    model *m = make_model(the_studio, &s, 30);
    layer l = layer_default(m, MATERIAL_PLAIN);
    mark marks[3] = {{.xyz = {0, -10, 0}, .radius_mm = 4, .rgb = {0.9, 0, 0}},
                     {.xyz = {20, 10, 0}, .radius_mm = 4, .rgb = {0.9, 0, 0}},
                     {.xyz = {-20, 10, 0}, .radius_mm = 4, .rgb = {0.9, 0, 0}, .on_top = true}};
    double line[6] = {-30, -10, 30, 30, -10, 30};
    stroke k = {.xyz = line, .count = 2, .width_mm = 4, .rgb = {0.9, 0, 0}};
    picture p = {.layers = &l,
                 .layer_count = 1,
                 .marks = marks,
                 .mark_count = 3,
                 .strokes = &k,
                 .stroke_count = 1,
                 .view = front(100)};
    picture_style style = small_style();
    image im;
    uint8_t seen[3];
    err e = {0};
    assert_ok(picture_render(the_studio, &p, &style, &im, seen, &e));
    assert_true(seen[0] && !seen[1] && seen[2]);
    assert_true(reddish(image_pixel(&im, 80, 100)));
    assert_false(reddish(image_pixel(&im, 100, 100)));
    assert_true(reddish(image_pixel(&im, 60, 100)));
    for (int x = 52; x < 108; x++) assert_true(reddish(image_pixel(&im, x, 70)));
    assert_false(reddish(image_pixel(&im, 80, 66)));
    image_free(&im);
    model_free(&m);
    surface_free(&s);
}

static void perspective_keeps_the_scale_at_the_target_and_shrinks_behind(void **state)
{
    (void)state;
    camera c = front(100);
    double x, y, n, x0;
    camera_set_perspective(&c, 0.5);
    camera_project(&c, 160, 200, (double[3]){30, 0, 0}, &x0, &y, &n);
    assert_near(x0, 110, 1e-9);
    camera_project(&c, 160, 200, (double[3]){30, 100, 0}, &x, &y, &n);
    assert_true(x < x0 - 3 && n < 0);
    /* The picture agrees with the projection. */
    surface s = box(20, 95, 20, 40, 105, 40);
    model *m = make_model(the_studio, &s, 30);
    layer l = layer_default(m, MATERIAL_PLAIN);
    paint(&l, 0.9, 0.05, 0.05);
    image im = draw(&l, 1, &c);
    double corner[2][2];
    camera_project(&c, 160, 200, (double[3]){20, 95, 40}, &corner[0][0], &corner[0][1], &n);
    camera_project(&c, 160, 200, (double[3]){40, 95, 20}, &corner[1][0], &corner[1][1], &n);
    for (int py = 0; py < 200; py++)
        for (int px = 0; px < 160; px++)
            if (px > corner[0][0] && px + 1 < corner[1][0] && py > corner[0][1] && py + 1 < corner[1][1])
                assert_true(reddish(image_pixel(&im, px, py)));
    assert_false(reddish(image_pixel(&im, (int)corner[1][0] + 2, (int)corner[0][1] + 4)));
    image_free(&im);
    model_free(&m);
    surface_free(&s);
}

static void a_moved_layer_is_drawn_where_it_moved(void **state)
{
    (void)state;
    surface s = box(-10, -10, -10, 10, 10, 10);
    model *m = make_model(the_studio, &s, 30);
    layer l = layer_default(m, MATERIAL_PLAIN);
    paint(&l, 0.9, 0.05, 0.05);
    l.move = rigid_translation((double[3]){40, 0, 50});
    camera c = front(100);
    image im = draw(&l, 1, &c);
    assert_true(reddish(image_pixel(&im, 120, 50)));
    assert_false(reddish(image_pixel(&im, 80, 100)));
    image_free(&im);
    model_free(&m);
    surface_free(&s);
}

static void a_crease_splits_the_normals_of_a_box(void **state)
{
    (void)state;
    surface s = box(0, 0, 0, 1, 1, 1);
    model *sharp = make_model(the_studio, &s, 30), *smooth = make_model(the_studio, &s, 180);
    assert_int_equal(sharp->vertex_count, 24);
    assert_int_equal(smooth->vertex_count, 8);
    for (int32_t v = 0; v < sharp->vertex_count; v++) {
        const float *n = sharp->normal + 3 * v;
        assert_near(fabs((double)n[0]) + fabs((double)n[1]) + fabs((double)n[2]), 1, 1e-6);
    }
    /* Angle weights: a corner of a cube points along its diagonal however its faces are divided. */
    for (int k = 0; k < 3; k++) assert_near(fabs((double)smooth->normal[k]), sqrt(1 / 3.0), 1e-6);
    model_free(&sharp);
    model_free(&smooth);
    surface_free(&s);
}

static void refuses_what_cannot_be_drawn(void **state)
{
    (void)state;
    err e = {0};
    surface s = box(-10, -10, -10, 10, 10, 10);
    model *m = make_model(the_studio, &s, 30), *none = NULL;
    layer l = layer_default(m, MATERIAL_PLAIN);
    picture p = {.layers = &l, .layer_count = 1, .view = front(100)};
    picture_style style = small_style();
    image im = {0};
    style.width = 8;
    assert_refused(picture_render(the_studio, &p, &style, &im, NULL, &e), ERR_USAGE);
    style = small_style();
    l.opacity = 0;
    assert_refused(picture_render(the_studio, &p, &style, &im, NULL, &e), ERR_USAGE);
    l.opacity = 1;
    double value[8] = {0};
    l.scalar = value;
    l.low = l.high = 1;
    assert_refused(picture_render(the_studio, &p, &style, &im, NULL, &e), ERR_USAGE);
    assert_null(im.rgba);
    assert_refused(picture_bake(&l, 1, 3, &e), ERR_USAGE);
    s.tri[5] = 99;
    model_params params = model_params_bone();
    assert_refused(model_create(the_studio, &s, &params, &none, &e), ERR_GEOMETRY);
    camera c;
    assert_refused(camera_custom((double[3]){0, 0, 1}, (double[3]){0, 0, 2}, (double[3]){0, 0, 0}, &c, &e), ERR_INPUT);
    model_free(&m);
    surface_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_red_box_is_where_it_should_be),
        cmocka_unit_test(a_fitted_ball_is_centred_and_fills_the_picture),
        cmocka_unit_test(the_same_input_gives_the_same_bytes_for_any_number_of_threads),
        cmocka_unit_test(the_nearer_of_two_boxes_is_seen_whatever_the_order),
        cmocka_unit_test(clear_skin_shows_the_bone_and_only_its_own_front),
        cmocka_unit_test(every_clear_layer_is_drawn_over_the_ones_before),
        cmocka_unit_test(hollows_are_darker_after_baking),
        cmocka_unit_test(the_map_shows_its_ends_and_no_data_is_grey),
        cmocka_unit_test(marks_are_hidden_by_what_lies_in_front),
        cmocka_unit_test(perspective_keeps_the_scale_at_the_target_and_shrinks_behind),
        cmocka_unit_test(a_moved_layer_is_drawn_where_it_moved),
        cmocka_unit_test(a_crease_splits_the_normals_of_a_box),
        cmocka_unit_test(refuses_what_cannot_be_drawn),
    };
    return cmocka_run_group_tests(tests, open_studio, close_studio);
}
