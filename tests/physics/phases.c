/* What the solver does next: along its path of loads, and within one. */
#include "tests/check.h"
#include "sim/src/solve/load.h"
#include "sim/src/solve/load_path.h"

/* Aims and answers: the targets that a path takes when loads fail where `fails` says so. Returns how many. */
static int follow(load_path *p, bool (*fails)(const load_path *p, int load), double *target)
{
    int loads = 0;
    while (p->phase != PATH_REACHED && p->phase != PATH_STOPPED) {
        target[loads] = p->target;
        bool failed = fails(p, loads++);
        load_path_go_on(p, !failed);
        assert_true(loads < 40);
    }
    return loads;
}

static bool never(const load_path *p, int load)
{
    (void)p, (void)load;
    return false;
}

static bool always(const load_path *p, int load)
{
    (void)p, (void)load;
    return true;
}

static bool at_long_steps(const load_path *p, int load) { return load < 4 && p->target - p->reached > 0.2; }

static void loads_come_in_equal_steps_and_the_last_is_whole(void **state)
{
    (void)state;
    for (int steps = 1; steps < 30; steps++) {
        double target[40];
        load_path p = load_path_begin(false, false, steps, 8);
        assert_int_equal(follow(&p, never, target), steps);
        assert_int_equal(p.phase, PATH_REACHED);
        assert_true(target[steps - 1] == 1 && p.reached == 1 && p.halvings == 0);
        for (int k = 0; k < steps; k++) assert_near(target[k], (k + 1.0) / steps, 1e-12);
    }
}

static void a_load_that_fails_is_tried_at_half_the_step_which_grows_again(void **state)
{
    (void)state;
    static const double want[] = {1, 0.5, 0.25, 0.125, 0.25, 0.5, 0.75, 1};
    double target[40];
    load_path p = load_path_begin(false, false, 1, 8);
    int loads = follow(&p, at_long_steps, target);
    assert_int_equal(p.phase, PATH_REACHED);
    assert_int_equal(p.halvings, 3);
    for (int k = 0; k < 6; k++) assert_near(target[k], want[k], 0);
    assert_true(loads < 10 && target[loads - 1] == 1);
}

static void halvings_run_out(void **state)
{
    (void)state;
    for (int most = 0; most < 5; most++) {
        double target[40];
        load_path p = load_path_begin(false, false, 2, most);
        assert_int_equal(follow(&p, always, target), most + 1);
        assert_int_equal(p.phase, PATH_STOPPED);
        assert_true(p.reached == 0 && p.halvings == most);
        assert_near(target[most], 0.5 / (1 << most), 0);
    }
}

static void held_contact_comes_last_unless_that_fails(void **state)
{
    (void)state;
    load_path p = load_path_begin(false, true, 2, 8);
    assert_int_equal(p.phase, PATH_LATE);
    assert_false(load_path_touches(&p) || load_path_first_touch(&p));
    load_path_go_on(&p, true);
    assert_true(p.target == 1 && load_path_touches(&p) && load_path_first_touch(&p));
    load_path_go_on(&p, false);
    assert_int_equal(p.phase, PATH_EVERY);
    assert_true(p.reached == 0 && p.target == 0.5 && p.halvings == 1);
    assert_true(load_path_touches(&p) && load_path_first_touch(&p));
    load_path_go_on(&p, true);
    assert_true(load_path_touches(&p) && !load_path_first_touch(&p));
    load_path_go_on(&p, true);
    assert_int_equal(p.phase, PATH_REACHED);
}

static void a_guess_that_leads_nowhere_gives_way_to_rest(void **state)
{
    (void)state;
    for (int held = 0; held < 2; held++) {
        load_path p = load_path_begin(true, held, 4, 8);
        assert_int_equal(p.phase, PATH_GUESS);
        assert_true(p.target == 1 && load_path_touches(&p) && !load_path_first_touch(&p));
        load_path_go_on(&p, false);
        assert_int_equal(p.phase, PATH_EVERY);
        assert_true(p.reached == 0 && p.target == 0.25 && load_path_first_touch(&p));
        p = load_path_begin(true, held, 4, 0);
        load_path_go_on(&p, false);
        assert_int_equal(p.phase, PATH_STOPPED);
    }
}

static void a_load_takes_its_phases_in_order(void **state)
{
    (void)state;
    load_state l = {.task = {.load = 1, .touches = true}, .phase = LOAD_START};
    static const load_phase far_off[] = {LOAD_START, LOAD_FREE, LOAD_WHOLE, LOAD_ENDED, LOAD_ENDED},
                            near[] = {LOAD_START, LOAD_NEAR, LOAD_WHOLE, LOAD_ENDED, LOAD_ENDED},
                            at_rest[] = {LOAD_START, LOAD_WHOLE, LOAD_ENDED, LOAD_ENDED, LOAD_ENDED};
    const load_phase *want[] = {far_off, near, at_rest};
    for (int way = 0; way < 3; way++) {
        l.task.near = way == 1;
        l.at_rest = way == 2;
        l.phase = LOAD_START;
        for (int k = 0; k < 5; k++, l.phase = load_phase_after(&l)) {
            assert_int_equal(l.phase, want[way][k]);
            assert_int_equal(load_touching(&l), l.phase != LOAD_FREE);
        }
    }
    l.task.touches = false;
    for (int phase = LOAD_START; phase <= LOAD_ENDED; phase++) {
        l.phase = (load_phase)phase;
        assert_false(load_touching(&l));
        l.over = true;
        assert_int_equal(load_phase_after(&l), LOAD_ENDED);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_come_in_equal_steps_and_the_last_is_whole),
        cmocka_unit_test(a_load_that_fails_is_tried_at_half_the_step_which_grows_again),
        cmocka_unit_test(halvings_run_out),
        cmocka_unit_test(held_contact_comes_last_unless_that_fails),
        cmocka_unit_test(a_guess_that_leads_nowhere_gives_way_to_rest),
        cmocka_unit_test(a_load_takes_its_phases_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
