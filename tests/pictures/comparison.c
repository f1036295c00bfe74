#include "tests/pictures/stage.h"
#include "render/anatomy.h"
#include "render/comparison.h"
#include "render/png_file.h"
#include "geometry/vec.h"
#include <sys/stat.h>
#include <unistd.h>

static const char folder[] = "comparison_pictures";

typedef struct scene {
    surface before, after, bone;
    comparison_part part;
    comparison c;
    comparison_params params;
} scene;

/* A ball of skin whose front comes forward by move_mm, and a box of bone in it that moves as much. */
static scene make_scene(double move_mm)
{
    scene s = {.before = ball((double[3]){0, 0, 0}, 80, 30), .bone = box(-20, -50, -20, 20, -10, 20)};
    s.after = surface_copy(&s.before);
    for (int32_t v = 0; v < s.after.vertex_count; v++) {
        double *x = s.after.xyz + 3 * v;
        if (x[1] < -60) x[1] -= move_mm;
    }
    s.part = (comparison_part){.before = rigid_identity(),
                               .after = rigid_translation((double[3]){0, -move_mm, 0}),
                               .kind = MATERIAL_BONE,
                               .name = "box"};
    comparison_segment_color(SEGMENT_MAXILLA, s.part.rgb);
    s.params = comparison_params_default();
    s.params.tile_width = 180;
    s.params.tile_height = 200;
    s.params.light_directions = 32;
    s.c = (comparison){.case_name = "ball", .plan_text = "forward", .case_hash = "0123abcd", .part_count = 1};
    s.c.frame = straight_frame();
    mkdir(folder, 0777);
    return s;
}

static comparison *linked(scene *s)
{
    s->part.bone = &s->bone;
    s->c.skin_before = &s->before;
    s->c.skin_after = &s->after;
    s->c.parts = &s->part;
    return &s->c;
}

static void free_scene(scene *s)
{
    surface_free(&s->before);
    surface_free(&s->after);
    surface_free(&s->bone);
}

static image load(const char *name)
{
    err e = {0};
    char path[200];
    image im = {0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_ok(png_file_read(path, &im, &e));
    return im;
}

static int remove_all(const comparison_result *r)
{
    int removed = 0;
    for (int i = 0; i < r->count; i++) {
        char path[200];
        snprintf(path, sizeof path, "%s/%s", folder, r->name[i]);
        removed += remove(path) == 0;
    }
    return removed;
}

/* Pixels that differ between the two halves of a before | after picture, captions and legend left out. */
static int64_t halves_differ(const image *im)
{
    int width = 180, gap = im->width - 2 * width, top = im->height - 200;
    int64_t count = 0;
    for (int y = top + 30; y < im->height - 40; y++)
        for (int x = 0; x < width; x++)
            count += memcmp(image_pixel(im, x, y), image_pixel(im, x + width + gap, y), 4) != 0;
    return count;
}

static void the_whole_set_is_written_and_says_what_it_shows(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(7);
    comparison_result r = {0};
    assert_ok(comparison_write(linked(&s), &s.params, folder, &r, &e));
    assert_int_equal(r.count, 11);
    assert_near(r.largest_mm, 7, 1e-12);
    assert_near(r.median_mm, 0, 0);
    assert_near(r.heat_high_mm, 8, 1e-12);
    image im = load("before_after_left.png"), heat = load("heat_front.png"), overview = load("overview.png");
    assert_true(halves_differ(&im) > 100);
    assert_int_equal(heat.width, 180);
    assert_int_equal(overview.width, 4 * 90 + 3 * 6);
    char *text = NULL;
    assert_ok(png_file_note("comparison_pictures/overview.png", "Case hash", &text, &e));
    assert_string_equal(text, "0123abcd");
    free(text);
    image_free(&im);
    image_free(&heat);
    image_free(&overview);
    assert_int_equal(remove_all(&r), 11);
    free_scene(&s);
}

static void nothing_differs_when_nothing_moves(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(0);
    comparison_result r = {0};
    assert_ok(comparison_write(linked(&s), &s.params, folder, &r, &e));
    for (int i = 0; i < r.count; i++) {
        if (strncmp(r.name[i], "before_after", 12) != 0 && strncmp(r.name[i], "bones", 5) != 0) continue;
        image im = load(r.name[i]);
        assert_int_equal(halves_differ(&im), 0);
        image_free(&im);
    }
    assert_near(r.largest_mm, 0, 0);
    remove_all(&r);
    free_scene(&s);
}

static void bones_move_under_skin_that_stays(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(0);
    s.part.after = rigid_translation((double[3]){0, -9, 0});
    comparison_result r = {0};
    assert_ok(comparison_write(linked(&s), &s.params, folder, &r, &e));
    image skin = load("before_after_left.png"), bones = load("bones_left.png");
    assert_int_equal(halves_differ(&skin), 0);
    assert_true(halves_differ(&bones) > 200);
    image_free(&skin);
    image_free(&bones);
    remove_all(&r);
    free_scene(&s);
}

static void two_runs_write_the_same_bytes(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(7);
    comparison_result r = {0};
    image first[COMPARISON_PICTURES_MAX];
    for (int run = 0; run < 2; run++) {
        assert_ok(comparison_write(linked(&s), &s.params, folder, &r, &e));
        for (int i = 0; i < r.count; i++) {
            image im = load(r.name[i]);
            if (run) {
                assert_int_equal(image_difference(&im, &first[i], 0), 0);
                image_free(&im);
                image_free(&first[i]);
            } else
                first[i] = im;
        }
    }
    remove_all(&r);
    free_scene(&s);
}

static void refusals_write_no_picture(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(7);
    comparison *c = linked(&s);
    comparison_result r = {0};
    surface other = ball((double[3]){0, 0, 0}, 80, 12);
    c->skin_after = &other;
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_GEOMETRY);
    c->skin_after = NULL;
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_USAGE);
    c->skin_after = &s.after;
    double *bad = NEW_ARRAY(double, s.after.vertex_count);
    bad[3] = -1;
    c->displacement_mm = bad;
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_GEOMETRY);
    c->displacement_mm = NULL;
    s.params.fonts.regular = "/no/such/font.ttf";
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_RESOURCE);
    s.params.fonts = label_fonts_default();
    s.params.skin_opacity = 2;
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_USAGE);
    assert_int_equal(r.count, 0);
    assert_int_equal(rmdir(folder), 0); /* succeeds only if it is empty */
    s.params.skin_opacity = 0.25;
    assert_refused(comparison_write(c, &s.params, folder, &r, &e), ERR_RESOURCE);
    free(bad);
    surface_free(&other);
    free_scene(&s);
}

static void bones_alone_and_skin_alone_give_their_own_pictures(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(7);
    comparison *c = linked(&s);
    comparison_result r = {0};
    c->skin_before = c->skin_after = NULL;
    assert_ok(comparison_write(c, &s.params, folder, &r, &e));
    assert_int_equal(r.count, 4); /* three bone pictures, overview */
    remove_all(&r);
    linked(&s);
    c->parts = NULL;
    c->part_count = 0;
    assert_ok(comparison_write(c, &s.params, folder, &r, &e));
    assert_int_equal(r.count, 8); /* four before | after, three heat, overview */
    remove_all(&r);
    free_scene(&s);
}

static void exploded_segments_and_landmarks_are_drawn(void **state)
{
    (void)state;
    err e = {0};
    scene s = make_scene(0);
    linked(&s);
    anatomy_piece piece[2] = {{.part = s.part}, {.part = s.part}};
    anatomy_apart(SEGMENT_CHIN, &s.c.frame, 40, piece[1].apart_mm);
    assert_true(piece[1].apart_mm[2] < -40 && piece[1].apart_mm[1] < 0);
    assert_ok(anatomy_exploded_write(piece, 2, NULL, 0, &s.c.frame, "Segments", &s.params,
                                     "comparison_pictures/exploded.png", &e));
    image im = load("exploded.png");
    /* Two boxes with background between them in the left profile (the right half). */
    int changes = 0, x = 180 + 6 + 90, top = im.height - 200, last = 0;
    for (int y = top + 2; y < im.height - 2; y++) {
        const uint8_t *p = image_pixel(&im, x, y);
        int bone = abs(p[2] - p[0]) > 40; /* the maxilla's blue against the pale background */
        changes += bone != last;
        last = bone;
    }
    assert_true(changes >= 2);
    image_free(&im);
    landmarks l = {0};
    landmarks_set(&l, "Pog", (double[3]){0, -50, -10});
    landmarks_set(&l, "Pn", (double[3]){0, -80, 0});
    assert_ok(anatomy_landmarks_write(&s.before, &s.part, 1, &l, &s.c.frame, "Landmarks", &s.params,
                                      "comparison_pictures/landmarks.png", &e));
    im = load("landmarks.png");
    /* The ball of Pn is red in the profile, at the front border of the skin. */
    bool red = false;
    for (int y = top; y < im.height; y++)
        for (int px = 186; px < 186 + 60; px++) {
            const uint8_t *p = image_pixel(&im, px, y);
            red |= p[0] > 120 && p[1] < 90 && p[2] < 90;
        }
    assert_true(red);
    image_free(&im);
    remove("comparison_pictures/exploded.png");
    remove("comparison_pictures/landmarks.png");
    rmdir(folder);
    landmarks_free(&l);
    free_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_whole_set_is_written_and_says_what_it_shows),
        cmocka_unit_test(nothing_differs_when_nothing_moves),
        cmocka_unit_test(bones_move_under_skin_that_stays),
        cmocka_unit_test(two_runs_write_the_same_bytes),
        cmocka_unit_test(refusals_write_no_picture),
        cmocka_unit_test(bones_alone_and_skin_alone_give_their_own_pictures),
        cmocka_unit_test(exploded_segments_and_landmarks_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
