#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "geometry/boolean.h"

static double volume_of(const surface *a, const surface *b, boolean_op op, boolean_report *r)
{
    err e = {0};
    surface out;
    int32_t open, crowded;
    assert_ok(boolean_apply(a, b, op, &out, r, &e));
    double v = surface_volume(&out);
    surface_edge_census(&out, &open, &crowded);
    assert_int_equal(open, 0);
    assert_int_equal(crowded, 0);
    surface_free(&out);
    return v;
}

static void volumes_of_two_boxes_are_exact(void **state)
{
    (void)state;
    surface a = body_box(0, 0, 0, 4, 4, 4), b = body_box(1, -1, 1.5, 5.25, 3, 6);
    boolean_report r;
    assert_near(volume_of(&a, &b, BOOLEAN_INTERSECTION, &r), 3 * 3 * 2.5, 1e-12);
    assert_int_equal(r.attempts, 1);
    assert_near(volume_of(&a, &b, BOOLEAN_DIFFERENCE, &r), 64 - 22.5, 1e-12);
    assert_near(volume_of(&a, &b, BOOLEAN_UNION, &r), 64 + 4.25 * 4 * 4.5 - 22.5, 1e-12);
    surface_free(&a);
    surface_free(&b);
}

static void shared_faces_cost_at_most_the_stated_shift(void **state)
{
    (void)state;
    surface a = body_box(0, 0, 0, 4, 4, 4), b = body_box(4, 0, 0, 8, 4, 4), c = body_box(1, 1, 0, 3, 3, 4);
    boolean_report r;
    double tolerance = 64 * 5e-4;
    assert_near(volume_of(&a, &b, BOOLEAN_UNION, &r), 128, tolerance);
    assert_near(volume_of(&a, &c, BOOLEAN_DIFFERENCE, &r), 48, tolerance);
    assert_true(r.shift_mm <= 5e-4 + 1e-15);
    surface_free(&a);
    surface_free(&b);
    surface_free(&c);
}

static void cavities_are_kept(void **state)
{
    (void)state;
    surface hole = body_box(2, 2, 2, 8, 8, 8);
    surface_flip(&hole);
    surface hollow = body_with(body_box(0, 0, 0, 10, 10, 10), hole), half = body_box(-1, -1, -1, 11, 11, 5);
    assert_near(volume_of(&hollow, &half, BOOLEAN_INTERSECTION, NULL), 500 - 36 * 3, 1e-9);
    surface inside = body_box(-1, -1, -1, 11, 11, 1); /* does not reach the cavity */
    assert_near(volume_of(&hollow, &inside, BOOLEAN_DIFFERENCE, NULL), 1000 - 216 - 100, 1e-9);
    surface_free(&hollow);
    surface_free(&half);
    surface_free(&inside);
}

static void a_ball_and_its_halves_add_up(void **state)
{
    (void)state;
    surface ball = body_ball(0, 0, 0, 30, 40), half = body_box(-50, -50, -50, 50, 50, 3.3);
    double whole = surface_volume(&ball), below = volume_of(&ball, &half, BOOLEAN_INTERSECTION, NULL),
           above = volume_of(&ball, &half, BOOLEAN_DIFFERENCE, NULL);
    assert_near(below + above, whole, 1e-8 * whole);
    double pi = acos(-1), height = 30 - 3.3; /* spherical cap */
    assert_near(above, pi * height * height * (90 - height) / 3, 0.01 * above);
    surface_free(&ball);
    surface_free(&half);
}

static void bodies_apart_have_nothing_in_common(void **state)
{
    (void)state;
    err e = {0};
    surface a = body_box(0, 0, 0, 1, 1, 1), b = body_box(5, 5, 5, 6, 6, 6), out;
    assert_ok(boolean_apply(&a, &b, BOOLEAN_INTERSECTION, &out, NULL, &e));
    assert_int_equal(out.vertex_count, 0);
    assert_int_equal(out.triangle_count, 0);
    surface_free(&out);
    assert_near(volume_of(&a, &b, BOOLEAN_UNION, NULL), 2, 1e-12);
    assert_near(volume_of(&a, &b, BOOLEAN_DIFFERENCE, NULL), 1, 1e-12);
    surface_free(&a);
    surface_free(&b);
}

static void union_of_many(void **state)
{
    (void)state;
    err e = {0};
    surface part[5], out;
    for (int i = 0; i < 5; i++) part[i] = body_box(3 * i, 0.1 * i, 0, 3 * i + 4, 5, 2);
    assert_ok(boolean_unite(part, 5, &out, &e));
    double want = 0;
    for (int i = 0; i < 5; i++) want += 4 * (5 - 0.1 * i) * 2;
    for (int i = 1; i < 5; i++) want -= 1 * (5 - 0.1 * i) * 2;
    assert_near(surface_volume(&out), want, 1e-9);
    int32_t *number;
    assert_int_equal(surface_components(&out, &number), 1);
    free(number);
    surface_free(&out);
    assert_refused(boolean_unite(part, 0, &out, &e), ERR_INPUT);
    surface_flip(&part[3]);
    assert_false(boolean_unite(part, 5, &out, &e));
    assert_non_null(strstr(e.text, "body 3 is inside out"));
    for (int i = 0; i < 5; i++) surface_free(&part[i]);
}

static void refuses_what_is_not_sound_and_says_which(void **state)
{
    (void)state;
    err e = {0};
    surface good = body_box(0, 0, 0, 4, 4, 4), out, open = surface_copy(&good), turned = surface_copy(&good),
            crossed = body_with(body_box(10, 0, 0, 14, 4, 4), body_box(12, 1, 1, 16, 3, 3));
    open.triangle_count--;
    surface_flip(&turned);
    const struct {
        const surface *s;
        const char *text;
    } bad[] = {{&open, "is not closed"}, {&turned, "is inside out"}, {&crossed, "intersects itself"}};
    for (int i = 0; i < 3; i++)
        for (int second = 0; second < 2; second++) {
            assert_false(
                boolean_apply(second ? &good : bad[i].s, second ? bad[i].s : &good, BOOLEAN_UNION, &out, NULL, &e));
            assert_int_equal(e.code, ERR_GEOMETRY);
            assert_non_null(strstr(e.text, second ? "second body" : "first body"));
            assert_non_null(strstr(e.text, bad[i].text));
            e = (err){0};
        }
    surface_free(&good);
    surface_free(&open);
    surface_free(&turned);
    surface_free(&crossed);
}

/* Blocks of many sizes, some of them freed: what comes next lies elsewhere, and no longer in order. */
static void stir_memory(void *block[], int count, uint32_t *seed)
{
    for (int i = 0; i < count; i++) {
        *seed = *seed * 1664525u + 1013904223u;
        if (*seed >> 31) continue;
        free(block[i]);
        block[i] = *seed >> 30 & 1 ? malloc(64 + (*seed >> 8) % 8000) : NULL;
    }
}

static void same_bits_wherever_memory_lies(void **state)
{
    (void)state;
    enum { RUNS = 40, BLOCKS = 2000 };
    void *block[BLOCKS] = {0};
    uint32_t seed = 1;
    err e = {0};
    surface ball = body_ball(0.1, 0.2, 0.3, 20, 12), box = body_box(-5, -30, -30, 7, 30, 2), first = {0};
    for (int i = 0; i < RUNS; i++) {
        surface out;
        stir_memory(block, BLOCKS, &seed);
        assert_ok(boolean_apply(&box, &ball, BOOLEAN_DIFFERENCE, &out, NULL, &e));
        if (i) {
            assert_int_equal(out.vertex_count, first.vertex_count);
            assert_int_equal(out.triangle_count, first.triangle_count);
            assert_memory_equal(out.xyz, first.xyz, 3 * (size_t)out.vertex_count * sizeof *out.xyz);
            assert_memory_equal(out.tri, first.tri, 3 * (size_t)out.triangle_count * sizeof *out.tri);
            surface_free(&out);
        } else {
            first = out;
        }
    }
    for (int i = 0; i < BLOCKS; i++) free(block[i]);
    surface_free(&ball);
    surface_free(&box);
    surface_free(&first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volumes_of_two_boxes_are_exact),
        cmocka_unit_test(shared_faces_cost_at_most_the_stated_shift),
        cmocka_unit_test(cavities_are_kept),
        cmocka_unit_test(a_ball_and_its_halves_add_up),
        cmocka_unit_test(bodies_apart_have_nothing_in_common),
        cmocka_unit_test(union_of_many),
        cmocka_unit_test(refuses_what_is_not_sound_and_says_which),
        cmocka_unit_test(same_bits_wherever_memory_lies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
