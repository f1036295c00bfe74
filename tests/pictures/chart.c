#include "tests/check.h"
#include "render/chart.h"
#include <string.h>

enum { N = 9 };

/* A disc of kind 1 (rank 2) in kind 0 about the middle, radius 2.6 nodes; crossings where the circle cuts the edges. */
static const double middle = (N - 1) / 2.0, radius = 2.6;

struct plane {
    int32_t kind[N * N];
    double crossing[2][N * N];
    uint8_t veiled[N * N];
};

static void fill(struct plane *p)
{
    memset(p, 0, sizeof *p);
    for (int k = 0; k < N; k++)
        for (int i = 0; i < N; i++) {
            double x = i - middle, y = k - middle;
            p->kind[k * N + i] = hypot(x, y) < radius;
            for (int axis = 0; axis < 2; axis++) {
                double along = axis ? y : x, across = axis ? x : y, reach = radius * radius - across * across;
                double cut = reach > 0 ? sqrt(reach) : 0;
                p->crossing[axis][k * N + i] = along < 0 ? -cut - along : cut - along;
            }
        }
}

static chart chart_of(const struct plane *p, const chart_kind *kinds)
{
    return (chart){.title = "Title",
                   .x = {.title = "across, mm", .low = -middle, .step = 1, .count = N},
                   .y = {.title = "up, mm", .low = -middle, .step = 1, .count = N},
                   .kind = p->kind,
                   .crossing = {p->crossing[0], p->crossing[1]},
                   .kinds = kinds,
                   .kind_count = 2};
}

static image draw(const chart *c)
{
    err e = {0};
    image im = {0};
    assert_ok(chart_draw(c, 1200, true, &im, &e));
    assert_int_equal(im.width, 1200);
    return im;
}

static bool is(const image *im, int x, int y, const double rgb[3])
{
    const uint8_t *p = image_pixel(im, x, y);
    for (int k = 0; k < 3; k++)
        if (abs(p[k] - (int)lround(255 * rgb[k])) > 1) return false;
    return true;
}

static const chart_kind plain[2] = {{.rgb = {0.9, 1, 0.9}, .text = "outside"},
                                    {.rgb = {0.8, 0.2, 0}, .rank = 2, .text = "inside"}};

static void the_line_between_kinds_goes_through_the_crossings(void **state)
{
    (void)state;
    struct plane p;
    fill(&p);
    chart c = chart_of(&p, plain);
    image im = draw(&c);
    int left = im.width, right = 0, pixels = 0;
    for (int y = 0; y < im.height; y++)
        for (int x = 0; x < im.width * 6 / 10; x++) /* the legend is to the right */
            if (is(&im, x, y, plain[1].rgb)) {
                left = x < left ? x : left;
                right = x > right ? x : right;
                pixels++;
            }
    int wide = right - left + 1;
    int plane_left = im.width, plane_right = 0;
    for (int x = 0; x < im.width * 6 / 10; x++)
        for (int y = 0; y < im.height; y++)
            if (is(&im, x, y, plain[0].rgb)) {
                plane_left = x < plane_left ? x : plane_left;
                plane_right = x > plane_right ? x : plane_right;
            }
    double per_node = (plane_right - plane_left + 1) / (double)(N - 1);
    assert_near(wide, 2 * radius * per_node, 3);
    assert_near((left + right) / 2.0, (plane_left + plane_right) / 2.0, 2);
    /* a polygon through its crossings, less the lines of the axes: between 94 % and all of the disc */
    double disc = M_PI * radius * radius * per_node * per_node;
    assert_true(pixels < disc && pixels > 0.90 * disc);
    image_free(&im);
}

static void same_chart_same_picture_and_a_veil_is_seen(void **state)
{
    (void)state;
    struct plane p;
    fill(&p);
    chart c = chart_of(&p, plain);
    image a = draw(&c), b = draw(&c);
    assert_int_equal(image_difference(&a, &b, 0), 0);
    image_free(&b);
    p.veiled[4 * N + 4] = 1;
    c.veiled = p.veiled;
    b = draw(&c);
    assert_true(image_difference(&a, &b, 8) > 100);
    image_free(&a);
    image_free(&b);
}

/* Two kinds of one colour differ by pattern and letter. */
static void kinds_are_told_apart_without_colour(void **state)
{
    (void)state;
    struct plane p;
    fill(&p);
    chart_kind grey[2] = {{.rgb = {0.5, 0.5, 0.5}, .text = "a"}, {.rgb = {0.5, 0.5, 0.5}, .text = "b"}};
    chart c = chart_of(&p, grey);
    image same = draw(&c);
    grey[1].pattern = CHART_DOTS;
    image dots = draw(&c);
    strcpy(grey[1].letter, "B");
    image letter = draw(&c);
    assert_true(image_difference(&same, &dots, 8) > 1000);
    assert_true(image_difference(&dots, &letter, 8) > 100);
    image_free(&same);
    image_free(&dots);
    image_free(&letter);
}

static void a_mark_lies_where_it_says(void **state)
{
    (void)state;
    struct plane p;
    fill(&p);
    memset(p.kind, 0, sizeof p.kind);
    chart c = chart_of(&p, plain);
    image without = draw(&c);
    chart_mark mark = {1.5, -2, CHART_DOT, NULL};
    c.marks = &mark;
    c.mark_count = 1;
    image with = draw(&c);
    double x = 0, y = 0, plane_low_x = 1e9, plane_high_x = 0, plane_low_y = 1e9, plane_high_y = 0;
    int n = 0;
    for (int k = 0; k < with.height; k++)
        for (int i = 0; i < with.width; i++) {
            if (i < with.width * 6 / 10 && is(&without, i, k, plain[0].rgb)) {
                plane_low_x = fmin(plane_low_x, i);
                plane_high_x = fmax(plane_high_x, i);
                plane_low_y = fmin(plane_low_y, k);
                plane_high_y = fmax(plane_high_y, k);
            }
            if (!memcmp(image_pixel(&with, i, k), image_pixel(&without, i, k), 4)) continue;
            x += i;
            y += k;
            n++;
        }
    assert_true(n > 20);
    assert_near(x / n, plane_low_x + (1.5 + middle) / (N - 1) * (plane_high_x - plane_low_x), 2);
    assert_near(y / n, plane_high_y - (-2 + middle) / (N - 1) * (plane_high_y - plane_low_y), 2);
    image_free(&with);
    image_free(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_line_between_kinds_goes_through_the_crossings),
        cmocka_unit_test(same_chart_same_picture_and_a_veil_is_seen),
        cmocka_unit_test(kinds_are_told_apart_without_colour),
        cmocka_unit_test(a_mark_lies_where_it_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
