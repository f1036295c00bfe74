#include "tests/check.h"
#include "render/compose.h"
#include "render/label.h"
#include "render/png_file.h"
#include <string.h>
#include <unistd.h>

static const double white[3] = {1, 1, 1};

static image blank(int width, int height)
{
    image im = image_new(width, height);
    image_fill(&im, white);
    return im;
}

static pen *pen_on(image *im)
{
    err e = {0};
    pen *p = NULL;
    label_fonts fonts = label_fonts_default();
    assert_ok(pen_open(im, &fonts, &p, &e));
    return p;
}

static bool dark(const image *im, int x, int y) { return image_pixel(im, x, y)[1] < 128; }

static head_frame straight(void) { return (head_frame){.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}}; }

static void a_scale_bar_is_as_long_as_it_says(void **state)
{
    (void)state;
    head_frame f = straight();
    camera c = camera_standard(VIEW_LEFT, &f, (double[3]){0, 0, 0});
    camera_fit(&c, 123, 400, 300, 0.05);
    double scale = camera_scale(&c, 300), x0, x1, y, n;
    /* In a profile the posterior axis runs across; 50 mm of it are as long as the bar. */
    camera_project(&c, 400, 300, (double[3]){0, 0, 0}, &x0, &y, &n);
    camera_project(&c, 400, 300, (double[3]){0, 50, 0}, &x1, &y, &n);
    assert_near(x1 - x0, 50 * scale, 1e-9);
    image im = blank(400, 300);
    pen *p = pen_on(&im);
    label_scale_bar(p, 40, 250, scale, 50, 14);
    pen_close(&p);
    int first = -1, last = -1;
    for (int x = 0; x < 400; x++)
        if (dark(&im, x, 250)) {
            first = first < 0 ? x : first;
            last = x;
        }
    assert_int_equal(first, 40);
    assert_near(last + 1 - first, 50 * scale, 0.51);
    image_free(&im);
    assert_near(label_scale_length(2, 900), 100, 0);
    assert_near(label_scale_length(4, 900), 50, 0);
    assert_near(label_scale_length(50, 900), 10, 0);
}

/* Mean of red minus blue in the left and the right third. */
static void colour_balance(const image *im, double *left, double *right)
{
    double sum[2] = {0, 0};
    for (int y = 0; y < im->height; y++)
        for (int x = 0; x < im->width; x++) {
            const uint8_t *p = image_pixel(im, x, y);
            if (3 * x < im->width) sum[0] += p[0] - p[2];
            if (3 * x >= 2 * im->width) sum[1] += p[0] - p[2];
        }
    *left = sum[0];
    *right = sum[1];
}

static void the_patients_left_is_marked_on_the_viewers_right_in_front_views(void **state)
{
    (void)state;
    head_frame f = straight();
    const struct {
        camera_view view;
        int left, right; /* +1 the red R, -1 the blue L, 0 nothing */
    } want[] = {{VIEW_FRONT, 1, -1}, {VIEW_POSTERIOR, -1, 1},          {VIEW_LEFT, -1, 0},
                {VIEW_RIGHT, 1, 0},  {VIEW_THREE_QUARTER_LEFT, 1, -1}, {VIEW_SUBMENTAL, 1, -1}};
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        camera c = camera_standard(want[i].view, &f, (double[3]){0, 0, 0});
        image im = blank(300, 200);
        pen *p = pen_on(&im);
        label_sides(p, 0, 0, 300, 200, 20, &c, &f);
        pen_close(&p);
        double left, right;
        colour_balance(&im, &left, &right);
        assert_int_equal((left > 1000) - (left < -1000), want[i].left);
        assert_int_equal((right > 1000) - (right < -1000), want[i].right);
        image_free(&im);
    }
    /* And the geometry agrees: a point on the patient's left is drawn on the right in the front view. */
    camera c = camera_standard(VIEW_FRONT, &f, (double[3]){0, 0, 0});
    double x, y, n;
    camera_project(&c, 300, 200, (double[3]){20, -50, 10}, &x, &y, &n);
    assert_true(x > 150 && y < 100 && n > 0);
}

static void the_colour_bar_runs_from_low_to_high_rightwards(void **state)
{
    (void)state;
    image im = blank(300, 200);
    pen *p = pen_on(&im);
    label_map m = {COLORMAP_COOLWARM, -3, 3, -3, {0, 0, 0}, "mm"};
    label_color_bar(p, 50, 150, 200, 20, 12, &m);
    pen_close(&p);
    const uint8_t *high = image_pixel(&im, 248, 160), *low = image_pixel(&im, 51, 160),
                  *middle = image_pixel(&im, 150, 160);
    assert_near(high[0], 180, 3);
    assert_near(high[2], 38, 6);
    assert_near(low[0], 59, 6);
    assert_near(low[2], 192, 3);
    assert_near(middle[0], 221, 3);
    assert_near(middle[1], 221, 3);
    image_free(&im);
}

static void the_maps_are_the_published_ones(void **state)
{
    (void)state;
    /* matplotlib's viridis at 0, 1/4, 1/2, 3/4, 1 */
    static const double want[5][3] = {{0.267004, 0.004874, 0.329415},
                                      {0.229739, 0.322361, 0.545706},
                                      {0.127568, 0.566949, 0.550556},
                                      {0.369214, 0.788888, 0.382914},
                                      {0.993248, 0.906157, 0.143936}};
    double rgb[3];
    for (int i = 0; i < 5; i++) {
        colormap_color(COLORMAP_VIRIDIS, i, 0, 4, rgb);
        for (int k = 0; k < 3; k++) assert_near(rgb[k], want[i][k], 0.025);
    }
    /* Moreland's table of the cool-warm map: 0, 1/4, 1/2, 3/4, 1 of 33 steps */
    static const int cool[5][3] = {{59, 76, 192}, {141, 176, 254}, {221, 221, 221}, {244, 154, 123}, {180, 4, 38}};
    for (int i = 0; i < 5; i++) {
        colormap_color(COLORMAP_COOLWARM, i, 0, 4, rgb);
        for (int k = 0; k < 3; k++) assert_near(255 * rgb[k], cool[i][k], 3);
    }
    colormap_color(COLORMAP_VIRIDIS, (double)NAN, 0, 1, rgb);
    assert_near(rgb[0], colormap_no_data[0], 0);
    assert_near(colormap_nice_ceiling(6.57), 8, 1e-12);
    assert_near(colormap_nice_ceiling(0.031), 0.04, 1e-12);
    assert_near(colormap_nice_ceiling(10), 10, 1e-12);
    assert_near(colormap_nice_ceiling(0), 1, 0);
}

static void a_png_comes_back_as_it_went_with_its_texts(void **state)
{
    (void)state;
    err e = {0};
    image im = image_new(37, 19), back = {0};
    for (int i = 0; i < 4 * 37 * 19; i++) im.rgba[i] = (uint8_t)(i * 7 + i / 5);
    const png_note notes[3] = {
        {"Software", "gnathos"}, {"Plan", "maxilla +5 mm"}, {"Case", "M\u00fcller \u2013 3\u00b0"}};
    assert_ok(png_file_write(&im, notes, 3, "round_trip.png", &e));
    assert_ok(png_file_read("round_trip.png", &back, &e));
    assert_int_equal(image_difference(&im, &back, 0), 0);
    image_free(&back);
    char *text = NULL;
    assert_ok(png_file_note("round_trip.png", "Plan", &text, &e));
    assert_string_equal(text, "maxilla +5 mm");
    free(text);
    assert_ok(png_file_note("round_trip.png", "Case", &text, &e));
    assert_string_equal(text, notes[2].value);
    free(text);
    assert_ok(png_file_note("round_trip.png", "tIME", &text, &e));
    assert_null(text);
    /* Opaque images go as RGB and come back opaque. */
    for (int i = 3; i < 4 * 37 * 19; i += 4) im.rgba[i] = 255;
    assert_ok(png_file_write(&im, notes, 3, "round_trip.png", &e));
    assert_ok(png_file_read("round_trip.png", &back, &e));
    assert_int_equal(image_difference(&im, &back, 0), 0);
    image_free(&back);
    assert_int_equal(truncate("round_trip.png", 200), 0);
    assert_refused(png_file_read("round_trip.png", &back, &e), ERR_INPUT);
    assert_refused(png_file_read("not_there.png", &back, &e), ERR_INPUT);
    assert_refused(png_file_write(&im, notes, 3, "no/such/folder/x.png", &e), ERR_RESOURCE);
    assert_refused(png_file_write(&im, &(png_note){"", "x"}, 1, "bad_note.png", &e), ERR_USAGE);
    assert_int_equal(access("bad_note.png", F_OK), -1);
    remove("round_trip.png");
    image_free(&im);
}

static void a_missing_font_is_refused_by_name(void **state)
{
    (void)state;
    err e = {0};
    image im = blank(20, 20);
    pen *p = NULL;
    label_fonts fonts = label_fonts_default();
    fonts.bold = "/no/such/font.ttf";
    assert_false(pen_open(&im, &fonts, &p, &e));
    assert_int_equal(e.code, ERR_RESOURCE);
    assert_non_null(strstr(e.text, "/no/such/font.ttf"));
    image_free(&im);
}

static void a_sheet_puts_its_tiles_side_by_side(void **state)
{
    (void)state;
    err e = {0};
    image a = image_new(60, 40), b = image_new(60, 40), odd = image_new(61, 40), sheet = {0};
    image_fill(&a, (double[3]){1, 0, 0});
    image_fill(&b, (double[3]){0, 0, 1});
    compose_params p = compose_params_default();
    p.title = "T";
    p.gap = 4;
    p.font_size = 10;
    assert_ok(compose_sheet((compose_tile[3]){{&a, NULL}, {&b, NULL}, {&b, NULL}}, 3, &p, &sheet, &e));
    int title = compose_title_height(&p);
    assert_int_equal(sheet.width, 124);
    assert_int_equal(sheet.height, title + 84);
    assert_int_equal(image_pixel(&sheet, 30, title + 20)[0], 255);
    assert_int_equal(image_pixel(&sheet, 30, title + 20)[2], 0);
    assert_int_equal(image_pixel(&sheet, 94, title + 20)[2], 255);
    assert_int_equal(image_pixel(&sheet, 30, title + 64)[2], 255);
    image_free(&sheet);
    assert_refused(compose_sheet((compose_tile[2]){{&a, NULL}, {&odd, NULL}}, 2, &p, &sheet, &e), ERR_USAGE);
    image_free(&a);
    image_free(&b);
    image_free(&odd);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scale_bar_is_as_long_as_it_says),
        cmocka_unit_test(the_patients_left_is_marked_on_the_viewers_right_in_front_views),
        cmocka_unit_test(the_colour_bar_runs_from_low_to_high_rightwards),
        cmocka_unit_test(the_maps_are_the_published_ones),
        cmocka_unit_test(a_png_comes_back_as_it_went_with_its_texts),
        cmocka_unit_test(a_missing_font_is_refused_by_name),
        cmocka_unit_test(a_sheet_puts_its_tiles_side_by_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
