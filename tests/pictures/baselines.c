/* Every kind of picture against a baseline that a person has looked at: at most 0.1 % of the pixels may
 * differ by more than 8 of 255 in a channel. On failure what was drawn and where it differs are left in the
 * folder of the test. GNATHOS_ACCEPT_PICTURES=1 writes the baselines anew: look at each before it is
 * committed. */
#include "tests/pictures/small_head.h"
#include "render/png_file.h"

enum { WIDTH = 320, HEIGHT = 180, TOLERANCE = 8 };
static const double share_allowed = 0.001;

static small_head head;
static gallery *shown;
static gallery_style style;

static int open_all(void **state)
{
    (void)state;
    style = gallery_style_default();
    style.light_directions = 48;
    style.sex = 'f';
    small_head_make(8, &head);
    shown = open_gallery(&head, &style);
    return 0;
}

static int close_all(void **state)
{
    (void)state;
    gallery_close(&shown);
    small_head_free(&head);
    return 0;
}

/* White where the two differ beyond the tolerance. */
static image difference(const image *a, const image *b)
{
    image out = image_new(a->width, a->height);
    image_fill(&out, (const double[3]){0, 0, 0});
    for (int y = 0; y < a->height && y < b->height; y++)
        for (int x = 0; x < a->width && x < b->width; x++)
            for (int k = 0; k < 4; k++)
                if (abs(image_pixel(a, x, y)[k] - image_pixel(b, x, y)[k]) > TOLERANCE)
                    memset(image_pixel(&out, x, y), 255, 4);
    return out;
}

static void compare(const char *name, const image *drawn)
{
    char path[1024];
    err e = {0};
    image want = {0};
    const char *accept = getenv("GNATHOS_ACCEPT_PICTURES");
    snprintf(path, sizeof path, "%s/%s.png", PICTURE_BASELINES, name);
    if (accept && !strcmp(accept, "1")) {
        assert_ok(png_file_write(drawn, NULL, 0, path, &e));
        return;
    }
    assert_ok(png_file_read(path, &want, &e));
    int64_t differing = image_difference(drawn, &want, TOLERANCE);
    bool same = differing >= 0 && (double)differing <= share_allowed * drawn->width * drawn->height;
    if (!same) {
        image where = difference(drawn, &want);
        snprintf(path, sizeof path, "%s.actual.png", name);
        assert_ok(png_file_write(drawn, NULL, 0, path, &e));
        snprintf(path, sizeof path, "%s.difference.png", name);
        assert_ok(png_file_write(&where, NULL, 0, path, &e));
        fail_msg("%s: %lld of %d pixels differ by more than %d; see %s beside this test", name, (long long)differing,
                 drawn->width * drawn->height, TOLERANCE, path);
    }
    image_free(&want);
}

static void check_sheet(const char *name, const panel *panels, int count, int width, int height)
{
    err e = {0};
    sheet what = {name, panels, count, count, width, height};
    image im = {0};
    assert_ok(gallery_draw(shown, &what, &im, &e));
    assert_int_equal(im.width, width);
    assert_int_equal(im.height, height);
    compare(name, &im);
    image_free(&im);
}

static void check_panel(const char *name, panel_show show, panel_pose pose, double azimuth, double elevation)
{
    check_sheet(name, &(panel){show, pose, azimuth, elevation, 0, "Caption"}, 1, WIDTH, HEIGHT);
}

static void skin(void **state)
{
    (void)state;
    check_panel("skin_before_front", SHOW_SKIN, POSE_BEFORE, 0, 0);
    check_panel("skin_after_left", SHOW_SKIN, POSE_AFTER, 90, 0);
    check_panel("skin_after_submental", SHOW_SKIN, POSE_AFTER, 0, -60);
    check_panel("skin_overlay_left", SHOW_SKIN, POSE_OVERLAY, 90, 0);
    check_panel("skin_wipe_front", SHOW_SKIN, POSE_WIPE, 0, 0);
    check_panel("skin_checker_three_quarter", SHOW_SKIN, POSE_CHECKER, 45, 0);
}

static void bones(void **state)
{
    (void)state;
    check_panel("clear_after_left", SHOW_CLEAR, POSE_AFTER, 90, 0);
    check_panel("bones_after_right", SHOW_BONES, POSE_AFTER, -90, 0);
    check_panel("bones_overlay_three_quarter", SHOW_BONES, POSE_OVERLAY, 45, 10);
}

static void maps(void **state)
{
    (void)state;
    check_panel("displacement_front", SHOW_DISPLACEMENT, POSE_AFTER, 0, 0);
    check_panel("signed_left", SHOW_SIGNED, POSE_AFTER, 90, 0);
    check_panel("stretch_three_quarter", SHOW_STRETCH, POSE_AFTER, 45, 0);
}

static void profiles(void **state)
{
    (void)state;
    check_sheet("contour", &(panel){SHOW_CONTOUR, POSE_AFTER, 0, 0, 0, NULL}, 1, 720, 420);
    check_sheet("tracing", &(panel){SHOW_TRACING, POSE_AFTER, 0, 0, 0, NULL}, 1, 720, 420);
}

static void before_and_after(void **state)
{
    (void)state;
    static const panel p[2] = {{SHOW_SKIN, POSE_BEFORE, 90, 0, 0, "Before"},
                               {SHOW_SKIN, POSE_AFTER, 90, 0, 0, "Predicted"}};
    check_sheet("before_after_left", p, 2, WIDTH, HEIGHT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skin),
        cmocka_unit_test(bones),
        cmocka_unit_test(maps),
        cmocka_unit_test(profiles),
        cmocka_unit_test(before_and_after),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
