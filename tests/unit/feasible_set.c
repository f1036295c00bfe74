/* Sets whose bounds are known in closed form; one step is 1/32 mm, so bounds are found to 0.05 mm. */
#include "tests/check.h"
#include "app/planner/bounds/feasible_line.h"
#include "app/planner/bounds/feasible_map.h"
#include "geometry/parallel.h"
#include <string.h>

static const double unit = 1 / 32.0;
enum { SPACING = 16, COARSE = 64, HALF = 12 * 32 };

struct set {
    int (*level)(const double x[3], int *reason);
    int64_t kept;
    int stop_after; /* interrupted then; 0: never */
};

static bool judge(const int32_t *at, void *context, verdict *out, err *e)
{
    const struct set *t = context;
    double x[3] = {at[0] * unit, at[1] * unit, at[2] * unit};
    int reason = 0;
    *out = (verdict){.level = t->level(x, &reason), .value = x[0]};
    out->reason = reason;
    return x[0] < 1000 || err_set(e, ERR_INPUT, "x is %g", x[0]);
}

static bool keep(const sample *s, void *context, err *e)
{
    struct set *t = context;
    t->kept++;
    return s->at[3] == 0 || err_set(e, ERR_INTERNAL, "another axis");
}

static bool interrupted(void *context)
{
    struct set *t = context;
    return t->stop_after && t->kept >= t->stop_after;
}

static sample_set over(struct set *t)
{
    return sample_set_new(
        &(sample_params){.axis_count = 3, .judge = judge, .keep = keep, .interrupted = interrupted, .context = t});
}

static int box(const double x[3], int *reason)
{
    static const double low[3] = {-4.2, -5, -9.99}, high[3] = {7.3, 3.01, 11.7};
    for (int k = 0; k < 3; k++)
        if (x[k] < low[k] || x[k] > high[k]) {
            *reason = 2 * k + (x[k] > high[k]);
            return VERDICT_STOP;
        }
    *reason = 9;
    return x[0] > 5.1 ? VERDICT_CAUTION : VERDICT_FINE;
}

static double square(double x) { return x * x; }

static int ball(const double x[3], int *reason)
{
    *reason = 3;
    double r = sqrt(square(x[0] - 1) + square(x[1] + 2) + square(x[2]));
    return r > 6.6 ? VERDICT_STOP : VERDICT_FINE;
}

/* A ball with a wall across it: what lies past the wall is seen by no ray. */
static int walled(const double x[3], int *reason)
{
    *reason = 4;
    if (x[0] > 3 && x[0] < 6 && fabs(x[1]) < 5) return VERDICT_STOP;
    *reason = 3;
    return square(x[0]) + square(x[1]) > square(10) ? VERDICT_STOP : VERDICT_FINE;
}

/* Two bodies apart. */
static int two(const double x[3], int *reason)
{
    *reason = 5;
    return square(x[0]) + square(x[1]) < square(3.3) || square(x[0] - 8) + square(x[1]) < square(2.2) ? VERDICT_FINE
                                                                                                      : VERDICT_STOP;
}

static feasible_line line_of(sample_set *s, int axis, int sign)
{
    err e = {0};
    feasible_line l;
    int32_t d[SAMPLE_AXES_MAX] = {0};
    d[axis] = sign;
    assert_ok(feasible_line_find(s, d, -HALF, HALF, SPACING, &l, &e));
    return l;
}

static void bounds_of_a_box_are_found_with_their_reasons(void **state)
{
    (void)state;
    static const double want[3][2] = {{-4.2, 7.3}, {-5, 3.01}, {-9.99, 11.7}};
    struct set t = {.level = box};
    sample_set s = over(&t);
    for (int k = 0; k < 3; k++) {
        feasible_line l = line_of(&s, k, 1);
        int a = feasible_line_reach(&l, -1, VERDICT_STOP), b = feasible_line_reach(&l, 1, VERDICT_STOP);
        assert_near(l.piece[a].from * unit, want[k][0], 0.05);
        assert_true(l.piece[a].from * unit >= want[k][0] && l.piece[b].to * unit <= want[k][1]);
        assert_near(l.piece[b].to * unit, want[k][1], 0.05);
        assert_int_equal(l.piece[a - 1].reason, 2 * k);
        assert_int_equal(l.piece[b + 1].reason, 2 * k + 1);
        if (k == 0) assert_near(l.piece[feasible_line_reach(&l, 1, VERDICT_CAUTION)].to * unit, 5.1, 0.05);
        feasible_line_free(&l);
    }
    feasible_line back = line_of(&s, 0, -1);
    assert_near(back.piece[feasible_line_reach(&back, 1, VERDICT_STOP)].to * unit, 4.2, 0.05);
    feasible_line_free(&back);
    sample_set_free(&s);
}

static void a_line_shows_every_piece(void **state)
{
    (void)state;
    struct set t = {.level = two};
    sample_set s = over(&t);
    feasible_line l = line_of(&s, 0, 1);
    assert_int_equal(l.piece_count, 5);
    assert_int_equal(l.base, 1);
    static const double want[5][2] = {{-12, -3.3}, {-3.3, 3.3}, {3.3, 5.8}, {5.8, 10.2}, {10.2, 12}};
    for (int i = 0; i < 5; i++) {
        assert_near(l.piece[i].from * unit, want[i][0], 0.05);
        assert_near(l.piece[i].to * unit, want[i][1], 0.05);
        assert_int_equal(l.piece[i].level, i % 2 ? VERDICT_FINE : VERDICT_STOP);
        if (i) assert_int_equal(l.piece[i].from, l.piece[i - 1].to + 1);
    }
    feasible_line_free(&l);
    sample_set_free(&s);
}

static feasible_map map_of(sample_set *s, int dims)
{
    err e = {0};
    feasible_map m;
    feasible_map_params p = {.axis_count = dims,
                             .axis = {0, 1, 2},
                             .spacing = SPACING,
                             .coarse = COARSE,
                             .reasons = dims == 2,
                             .edges = dims == 2};
    for (int k = 0; k < dims; k++) {
        p.low[k] = -HALF;
        p.high[k] = HALF;
    }
    assert_ok(feasible_map_find(s, &p, &m, &e));
    return m;
}

/* Every node has the verdict of its place, judged or not. */
static void check_nodes(const feasible_map *m, const struct set *t)
{
    for (int64_t a = 0; a < m->node_count; a++) {
        int32_t at[SAMPLE_AXES_MAX];
        int reason = 0;
        feasible_map_place(m, a, at);
        double x[3] = {at[0] * unit, at[1] * unit, at[2] * unit};
        assert_int_equal(m->node[a].level, t->level(x, &reason));
    }
}

static void a_map_of_a_ball_finds_its_rim(void **state)
{
    (void)state;
    struct set t = {.level = ball};
    sample_set s = over(&t);
    feasible_map m = map_of(&s, 2);
    check_nodes(&m, &t);
    int rim = 0;
    for (int k = 0; k < 2; k++)
        for (int64_t a = 0; a < m.node_count; a++) {
            if (m.edge[k][a] < 0) continue;
            int32_t at[SAMPLE_AXES_MAX];
            feasible_map_place(&m, a, at);
            double x[2] = {at[0] * unit, at[1] * unit};
            x[k] += m.edge[k][a] * unit;
            double across = fabs(k ? x[1] + 2 : x[0] - 1) / 6.6; /* along the edge the rim lies 1/across further */
            assert_near(hypot(x[0] - 1, x[1] + 2), 6.6, 0.05 * fmax(across, 0.1));
            rim++;
        }
    assert_true(rim > 90 && rim < 120);
    assert_int_equal(m.behind_count, 0);
    int64_t all = m.node_count;
    assert_true(t.kept < all / 2); /* far from the rim little is judged */
    assert_int_equal(t.kept, s.judged);
    feasible_map_free(&m);
    feasible_map solid = map_of(&s, 3);
    check_nodes(&solid, &t);
    double step = SPACING * unit;
    assert_near((double)solid.level_count[VERDICT_FINE] * step * step * step, 4 * M_PI / 3 * pow(6.6, 3), 20);
    assert_int_equal(solid.behind_count, 0);
    feasible_map_free(&solid);
    sample_set_free(&s);
}

/* How far the ray to (x, y) runs in the wall, 3 < x < 6 and |y| < 5, before it is there. */
static double run_in_wall(double x, double y)
{
    double leaves = fmin(fmin(6, x), y == 0 ? HUGE_VAL : 5 * x / fabs(y));
    return x > 3 && leaves > 3 ? (leaves - 3) / x * hypot(x, y) : 0;
}

static void what_lies_behind_is_named(void **state)
{
    (void)state;
    struct set t = {.level = walled};
    sample_set s = over(&t);
    for (int dims = 2; dims <= 3; dims++) {
        feasible_map m = map_of(&s, dims);
        int64_t hidden = 0;
        assert_false(m.base_stopped);
        for (int64_t a = 0; a < m.node_count; a++) {
            int32_t at[SAMPLE_AXES_MAX];
            feasible_map_place(&m, a, at);
            double run = m.node[a].level == VERDICT_STOP ? 0 : run_in_wall(at[0] * unit, at[1] * unit);
            hidden += run > 0;
            if (m.behind[a]) assert_true(run > 0);
            if (run > 1.5 * SPACING * unit) assert_true(m.behind[a]);
        }
        assert_true(hidden > 200);
        assert_true(m.behind_count > 0 && m.example >= 0 && m.behind[m.example]);
        double x[3] = {m.before[0] * unit, m.before[1] * unit, m.before[2] * unit};
        int reason;
        assert_int_equal(walled(x, &reason), VERDICT_STOP);
        feasible_map_free(&m);
    }
    sample_set_free(&s);
}

static void two_bodies_are_both_found_and_the_far_one_is_behind(void **state)
{
    (void)state;
    struct set t = {.level = two};
    sample_set s = over(&t);
    feasible_map m = map_of(&s, 2);
    check_nodes(&m, &t);
    for (int64_t a = 0; a < m.node_count; a++) {
        int32_t at[SAMPLE_AXES_MAX];
        feasible_map_place(&m, a, at);
        if (m.node[a].level == VERDICT_FINE) assert_int_equal(m.behind[a], at[0] * unit > 4);
    }
    feasible_map_free(&m);
    sample_set_free(&s);
}

static int stopped_at_base(const double x[3], int *reason)
{
    *reason = 0;
    return x[0] > 1 && x[0] < 4 ? VERDICT_FINE : VERDICT_STOP;
}

static void a_stopped_base_is_said_not_hidden(void **state)
{
    (void)state;
    struct set t = {.level = stopped_at_base};
    sample_set s = over(&t);
    feasible_map m = map_of(&s, 2);
    assert_true(m.base_stopped);
    feasible_line l = line_of(&s, 0, 1);
    assert_int_equal(feasible_line_reach(&l, 1, VERDICT_STOP), -1);
    assert_int_equal(l.piece_count, 3);
    assert_near(l.piece[1].from * unit, 1, 0.05);
    feasible_line_free(&l);
    feasible_map_free(&m);
    sample_set_free(&s);
}

static int by_threads(int threads, sample_set *s, struct set *t, feasible_map *m)
{
    parallel_set_threads(threads);
    *s = over(t);
    *m = map_of(s, 2);
    sample_set_sort(s);
    parallel_set_threads(0);
    return (int)s->count;
}

static void threads_and_earlier_points_change_nothing(void **state)
{
    (void)state;
    struct set t = {.level = walled}, u = {.level = walled}, v = {.level = walled};
    sample_set a, b, c = over(&v);
    feasible_map ma, mb, mc;
    assert_int_equal(by_threads(1, &a, &t, &ma), by_threads(3, &b, &u, &mb));
    for (int64_t i = a.count; i-- > 0;)
        if (i % 3) assert_true(sample_set_put(&c, &a.item[i]));
    assert_false(sample_set_put(&c, &a.item[1]));
    mc = map_of(&c, 2);
    assert_int_equal(v.kept, (a.count + 2) / 3); /* none twice */
    sample_set_sort(&c);
    const sample_set *other[2] = {&b, &c};
    const feasible_map *map[2] = {&mb, &mc};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(other[k]->count, a.count);
        assert_memory_equal(other[k]->item, a.item, (size_t)a.count * sizeof *a.item);
        assert_memory_equal(map[k]->node, ma.node, (size_t)ma.node_count * sizeof *ma.node);
        assert_memory_equal(map[k]->edge[0], ma.edge[0], (size_t)ma.node_count * sizeof *ma.edge[0]);
        assert_memory_equal(map[k]->behind, ma.behind, (size_t)ma.node_count);
    }
    feasible_map_free(&ma);
    feasible_map_free(&mb);
    feasible_map_free(&mc);
    sample_set_free(&a);
    sample_set_free(&b);
    sample_set_free(&c);
}

static void an_interruption_keeps_what_was_judged(void **state)
{
    (void)state;
    err e = {0};
    struct set t = {.level = ball, .stop_after = 700};
    sample_set s = over(&t);
    int32_t d[SAMPLE_AXES_MAX] = {1};
    feasible_line l;
    assert_refused(feasible_line_find(&s, d, -HALF, HALF, 1, &l, &e), ERR_INTERRUPTED);
    assert_int_equal(s.count, t.kept);
    assert_in_range(t.kept, 700, 700 + 64);
    t.stop_after = 0;
    assert_ok(feasible_line_find(&s, d, -HALF, HALF, 1, &l, &e));
    assert_int_equal(t.kept, 2 * HALF + 1);
    feasible_line_free(&l);
    sample_set_free(&s);
}

static void the_first_refusal_of_the_judge_is_told(void **state)
{
    (void)state;
    err e = {0};
    struct set t = {.level = ball};
    sample_set s = over(&t);
    int32_t at[4 * SAMPLE_AXES_MAX] = {0};
    at[SAMPLE_AXES_MAX] = 32 * 2000;
    at[2 * SAMPLE_AXES_MAX] = 32 * 3000;
    assert_refused(sample_set_ask(&s, at, 4, &e), ERR_INPUT);
    assert_int_equal(s.count, 1);
    assert_false(sample_set_ask(&s, at, 4, &e));
    assert_string_equal(e.text, "x is 2000");
    sample_set_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_of_a_box_are_found_with_their_reasons),
        cmocka_unit_test(a_line_shows_every_piece),
        cmocka_unit_test(a_map_of_a_ball_finds_its_rim),
        cmocka_unit_test(what_lies_behind_is_named),
        cmocka_unit_test(two_bodies_are_both_found_and_the_far_one_is_behind),
        cmocka_unit_test(a_stopped_base_is_said_not_hidden),
        cmocka_unit_test(threads_and_earlier_points_change_nothing),
        cmocka_unit_test(an_interruption_keeps_what_was_judged),
        cmocka_unit_test(the_first_refusal_of_the_judge_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
