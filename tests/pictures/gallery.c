/* What pictures of a plan hold, and what is refused; how they look is baselines.c. */
#include "tests/pictures/small_head.h"
#include "render/anatomy.h"
#include "render/png_file.h"
#include "render/standard_set.h"
#include "geometry/parallel.h"
#include <sys/stat.h>
#include <unistd.h>

static const char folder[] = "gallery_pictures";

static gallery_style small_gallery(void)
{
    gallery_style s = gallery_style_default();
    s.light_directions = 32;
    return s;
}

static image draw_one(gallery *g, panel p, int width, int height)
{
    err e = {0};
    image im = {0};
    sheet what = {NULL, &p, 1, 1, width, height};
    assert_ok(gallery_draw(g, &what, &im, &e));
    return im;
}

static panel from_left(panel_show show, panel_pose pose) { return (panel){show, pose, 90, 0, 0, NULL}; }

static void the_standard_set_is_written_and_says_what_it_shows(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    small_head_make(7, &h);
    gallery *g = open_gallery(&h, &style);
    bool written[16];
    mkdir(folder, 0777);
    assert_true(standard_set_count <= 16);
    assert_ok(standard_set_write(g, 320, 180, folder, written, &e));
    for (int i = 0; i < standard_set_count; i++) {
        char path[200], *text = NULL;
        image im = {0};
        assert_true(written[i]);
        snprintf(path, sizeof path, "%s/%s", folder, standard_set[i].file);
        assert_ok(png_file_read(path, &im, &e));
        assert_int_equal(im.width, 320);
        assert_int_equal(im.height, 180);
        image_free(&im);
        static const struct {
            const char *key, *value;
        } note[] = {{"Case", "small head"}, {"Plan", "jaw forward"}, {"Case hash", "0123abcd"}};
        for (int k = 0; k < 3; k++) {
            assert_ok(png_file_note(path, note[k].key, &text, &e));
            assert_string_equal(text, note[k].value);
            free(text);
        }
        assert_ok(png_file_note(path, "Title", &text, &e));
        assert_string_equal(text, standard_set[i].title);
        free(text);
        remove(path);
    }
    gallery_range r = gallery_map_range(g, SHOW_DISPLACEMENT);
    assert_near(r.largest, 7, 1e-9);
    assert_near(r.high, 8, 1e-12);
    rmdir(folder);
    gallery_close(&g);
    small_head_free(&h);
}

static void without_skin_or_bones_their_pictures_are_left_out(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    small_head_make(7, &h);
    h.shown.part_count = 0;
    gallery *g = open_gallery(&h, &style);
    assert_true(gallery_can_show(g, SHOW_SKIN, &e));
    assert_refused(gallery_can_show(g, SHOW_BONES, &e), ERR_USAGE);
    assert_refused(gallery_can_show(g, SHOW_CLEAR, &e), ERR_USAGE);
    gallery_close(&g);
    h.shown.part_count = SMALL_HEAD_PARTS;
    h.shown.skin_before = h.shown.skin_after = NULL;
    h.shown.signed_mm = h.shown.stretch_percent = NULL;
    g = open_gallery(&h, &style);
    assert_true(gallery_can_show(g, SHOW_BONES, &e));
    for (int show = 0; show < SHOW_COUNT; show++)
        if (show != SHOW_BONES && show != SHOW_TRACING)
            assert_refused(gallery_can_show(g, (panel_show)show, &e), ERR_USAGE);
    image im = draw_one(g, from_left(SHOW_BONES, POSE_AFTER), 160, 120);
    image_free(&im);
    gallery_close(&g);
    small_head_free(&h);
}

static void nothing_differs_when_nothing_moves(void **state)
{
    (void)state;
    small_head h;
    gallery_style style = small_gallery();
    style.labels = false;
    small_head_make(0, &h);
    gallery *g = open_gallery(&h, &style);
    static const panel_show shows[] = {SHOW_SKIN, SHOW_CLEAR, SHOW_BONES};
    for (int i = 0; i < 3; i++) {
        image before = draw_one(g, from_left(shows[i], POSE_BEFORE), 160, 120);
        for (int pose = POSE_AFTER; pose < POSE_CHECKER; pose++) {
            image after = draw_one(g, from_left(shows[i], (panel_pose)pose), 160, 120);
            if (image_difference(&before, &after, 0))
                fail_msg("%s, %s differs", panel_show_name(shows[i]), panel_pose_name((panel_pose)pose));
            image_free(&after);
        }
        image_free(&before);
    }
    assert_near(gallery_map_range(g, SHOW_DISPLACEMENT).largest, 0, 0);
    gallery_close(&g);
    small_head_free(&h);
}

/* The front border of the face at the chin's height, in pixels from the left. */
static int front_border(const image *im, const image *empty, int y)
{
    for (int x = 0; x < im->width; x++)
        if (memcmp(image_pixel(im, x, y), image_pixel(empty, x, y), 4) != 0) return x;
    return -1;
}

static void the_profile_moves_as_far_as_the_plan_says(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    style.labels = false;
    small_head_make(10, &h);
    gallery *g = open_gallery(&h, &style);
    image im[POSE_COUNT];
    for (int pose = 0; pose < POSE_COUNT; pose++)
        im[pose] = draw_one(g, from_left(SHOW_SKIN, (panel_pose)pose), 400, 300);
    studio *s = NULL;
    image empty = {0};
    assert_ok(studio_open(&s, &e));
    picture none = {.view = camera_standard(VIEW_LEFT, &h.shown.frame, (double[3]){0, 0, 0})};
    picture_style plain = picture_style_default();
    plain.width = 400;
    plain.height = 300;
    assert_ok(picture_render(s, &none, &plain, &empty, NULL, &e));
    studio_close(&s);
    /* the sphere about the face fills the height less two margins of 6 % */
    double n[3] = {0, -68, 14}, me[3] = {0, -52, -80}, scale = 300 * (1 - 2 * 0.06) / (2 * 0.86 * vec_distance(n, me));
    double pg[3];
    head_point(0, -1.0, 0, pg);
    int y = (int)(150 - scale * (pg[2] - (14 - 80) / 2.0));
    int was = front_border(&im[POSE_BEFORE], &empty, y), is = front_border(&im[POSE_AFTER], &empty, y);
    assert_near(was - is, 10 * scale, 1.5);
    /* wipe: the left half is before's, the right half after's; the profile looks to the left */
    for (int x = 0; x < 400; x++)
        assert_memory_equal(image_pixel(&im[POSE_WIPE], x, y),
                            image_pixel(&im[x < 200 ? POSE_BEFORE : POSE_AFTER], x, y), 4);
    /* checker: squares of a sixth of the height, before first */
    assert_memory_equal(image_pixel(&im[POSE_CHECKER], 10, 10), image_pixel(&im[POSE_BEFORE], 10, 10), 4);
    assert_memory_equal(image_pixel(&im[POSE_CHECKER], 210, 210), image_pixel(&im[POSE_BEFORE], 210, 210), 4);
    assert_memory_equal(image_pixel(&im[POSE_CHECKER], 160, 210), image_pixel(&im[POSE_AFTER], 160, 210), 4);
    /* overlay: the outline of before is seen through what came forward */
    assert_true(image_difference(&im[POSE_OVERLAY], &im[POSE_AFTER], 8) > 50);
    for (int pose = 0; pose < POSE_COUNT; pose++) image_free(&im[pose]);
    image_free(&empty);
    gallery_close(&g);
    small_head_free(&h);
}

static void the_same_input_gives_the_same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    small_head_make(7, &h);
    mkdir(folder, 0777);
    static const panel p[3] = {{SHOW_CLEAR, POSE_OVERLAY, 45, 0, 0, "a"},
                               {SHOW_STRETCH, POSE_AFTER, 0, 0, 0, NULL},
                               {SHOW_TRACING, POSE_AFTER, 90, 0, 0, NULL}};
    const sheet what = {"Threads", p, 3, 3, 480, 180};
    char *first = NULL;
    size_t first_size = 0;
    for (int run = 1; run <= 3; run++) {
        parallel_set_threads(run);
        gallery *g = open_gallery(&h, &style);
        assert_ok(gallery_write(g, &what, "gallery_pictures/same.png", &e));
        gallery_close(&g);
        FILE *f = fopen("gallery_pictures/same.png", "rb");
        assert_non_null(f);
        char *bytes = NEW_ARRAY(char, 1 << 20);
        size_t size = fread(bytes, 1, 1 << 20, f);
        fclose(f);
        if (run == 1) {
            first = bytes;
            first_size = size;
            continue;
        }
        assert_int_equal(size, first_size);
        assert_memory_equal(bytes, first, size);
        free(bytes);
    }
    free(first);
    parallel_set_threads(0);
    remove("gallery_pictures/same.png");
    rmdir(folder);
    small_head_free(&h);
}

static void a_range_that_is_asked_for_holds(void **state)
{
    (void)state;
    small_head h;
    gallery_style style = small_gallery();
    style.signed_mm = 5;
    small_head_make(7, &h);
    gallery *g = open_gallery(&h, &style);
    assert_near(gallery_map_range(g, SHOW_SIGNED).high, 5, 0);
    assert_near(gallery_map_range(g, SHOW_DISPLACEMENT).high, 8, 1e-12);
    gallery_close(&g);
    small_head_free(&h);
}

static void a_landmark_can_be_put_in_the_middle(void **state)
{
    (void)state;
    small_head h;
    gallery_style style = small_gallery();
    style.labels = false;
    style.centre = "Pn";
    style.zoom = 4;
    small_head_make(7, &h);
    gallery *g = open_gallery(&h, &style);
    image im = draw_one(g, from_left(SHOW_SKIN, POSE_BEFORE), 200, 200);
    /* Pn is the foremost point: background to its left, skin to its right */
    const uint8_t *in_front = image_pixel(&im, 90, 100), *behind = image_pixel(&im, 112, 100);
    assert_true(in_front[2] > in_front[0] && behind[0] > behind[2] + 20);
    image_free(&im);
    gallery_close(&g);
    small_head_free(&h);
}

static void refuses_what_cannot_be_drawn(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    gallery *g = NULL;
    image im = {0};
    small_head_make(7, &h);
    surface other = ball((double[3]){0, 0, 0}, 80, 12);
    h.shown.skin_after = &other;
    assert_refused(gallery_open(&h.shown, &style, &g, &e), ERR_GEOMETRY);
    h.shown.skin_after = NULL;
    assert_refused(gallery_open(&h.shown, &style, &g, &e), ERR_USAGE);
    h.shown.skin_after = &h.after;
    double *bad = NEW_ARRAY(double, h.after.vertex_count);
    bad[3] = -1;
    h.shown.displacement_mm = bad;
    assert_refused(gallery_open(&h.shown, &style, &g, &e), ERR_GEOMETRY);
    h.shown.displacement_mm = NULL;
    style.centre = "no such point";
    assert_refused(gallery_open(&h.shown, &style, &g, &e), ERR_USAGE);
    style.centre = NULL;
    panel p = from_left(SHOW_SKIN, POSE_AFTER);
    sheet what = {"Refused", &p, 1, 1, 300, 200};
    style.fonts.regular = "/no/such/font.ttf";
    g = open_gallery(&h, &style);
    assert_refused(gallery_write(g, &what, "refused.png", &e), ERR_RESOURCE);
    gallery_close(&g);
    style = small_gallery();
    style.skin_opacity = 2;
    p.show = SHOW_CLEAR;
    g = open_gallery(&h, &style);
    assert_refused(gallery_write(g, &what, "refused.png", &e), ERR_USAGE);
    what.width = 80;
    what.height = 40;
    assert_refused(gallery_draw(g, &what, &im, &e), ERR_USAGE);
    gallery_close(&g);
    style = small_gallery();
    style.light_directions = 3;
    what.width = 300;
    what.height = 200;
    g = open_gallery(&h, &style);
    assert_refused(gallery_draw(g, &what, &im, &e), ERR_USAGE);
    gallery_close(&g);
    assert_int_equal(access("refused.png", F_OK), -1);
    assert_null(im.rgba);
    free(bad);
    surface_free(&other);
    small_head_free(&h);
}

static void exploded_segments_and_landmarks_are_drawn(void **state)
{
    (void)state;
    err e = {0};
    small_head h;
    gallery_style style = small_gallery();
    small_head_make(0, &h);
    mkdir(folder, 0777);
    anatomy_piece piece[2] = {{.part = h.part[1]}, {.part = h.part[1]}};
    anatomy_apart(SEGMENT_CHIN, &h.shown.frame, 40, piece[1].apart_mm);
    assert_true(piece[1].apart_mm[2] < -40 && piece[1].apart_mm[1] < 0);
    assert_ok(anatomy_exploded_write(piece, 2, NULL, 0, &h.shown.frame, "Segments", &style, 366, 210,
                                     "gallery_pictures/exploded.png", &e));
    image im = {0};
    assert_ok(png_file_read("gallery_pictures/exploded.png", &im, &e));
    /* Two boxes with background between them in the left profile (the right half). */
    int changes = 0, last = 0;
    for (int x = 200; x < 340; x++) {
        changes = last = 0;
        for (int y = 25; y < im.height - 2; y++) {
            const uint8_t *p = image_pixel(&im, x, y);
            int bone = abs(p[2] - p[0]) > 40; /* the maxilla's blue against the pale background */
            changes += bone != last;
            last = bone;
        }
        if (changes >= 2) break;
    }
    assert_true(changes >= 2);
    image_free(&im);
    assert_ok(anatomy_landmarks_write(&h.before, h.part, 1, &h.points, &h.shown.frame, "Landmarks", &style, 732, 420,
                                      "gallery_pictures/landmarks.png", &e));
    assert_ok(png_file_read("gallery_pictures/landmarks.png", &im, &e));
    /* Balls of the skin's points are red at its front border in the profile. */
    bool red = false;
    for (int y = 30; y < im.height; y++)
        for (int x = 372; x < 372 + 180; x++) {
            const uint8_t *p = image_pixel(&im, x, y);
            red |= p[0] > 120 && p[1] < 90 && p[2] < 90;
        }
    assert_true(red);
    image_free(&im);
    remove("gallery_pictures/exploded.png");
    remove("gallery_pictures/landmarks.png");
    rmdir(folder);
    small_head_free(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_standard_set_is_written_and_says_what_it_shows),
        cmocka_unit_test(without_skin_or_bones_their_pictures_are_left_out),
        cmocka_unit_test(nothing_differs_when_nothing_moves),
        cmocka_unit_test(the_profile_moves_as_far_as_the_plan_says),
        cmocka_unit_test(the_same_input_gives_the_same_bytes_for_any_number_of_threads),
        cmocka_unit_test(a_range_that_is_asked_for_holds),
        cmocka_unit_test(a_landmark_can_be_put_in_the_middle),
        cmocka_unit_test(refuses_what_cannot_be_drawn),
        cmocka_unit_test(exploded_segments_and_landmarks_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
