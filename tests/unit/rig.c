#include "tests/check.h"
#include "geometry/vec.h"
#include "geometry/rig.h"
#include <string.h>

/* A head whose own axes are the file's. */
static const head_frame straight = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};
static const double condyles[2][3] = {{50, 10, 0}, {-50, 10, 0}};

static head_frame tilted(void)
{
    rigid turn = rigid_rotation((double[]){0, 0, 0}, (double[]){1, 0.3, -0.2}, 0.4);
    head_frame f = straight;
    rigid_rotate(&turn, f.left, f.left);
    rigid_rotate(&turn, f.posterior, f.posterior);
    rigid_rotate(&turn, f.up, f.up);
    return f;
}

static void moved_by(const rigid *t, const double p[3], double d[3])
{
    rigid_apply(t, p, d);
    vec_sub(d, p, d);
}

static void no_controls_move_nothing(void **state)
{
    (void)state;
    err e = {0};
    rigid t[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    head_frame f = tilted();
    assert_ok(rig_motion(&c, &f, NULL, t, &e));
    for (int s = 0; s < SEGMENT_COUNT; s++) assert_true(rigid_is_identity(&t[s]));
}

static void shifts_go_along_the_heads_axes(void **state)
{
    (void)state;
    err e = {0};
    rigid t[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    head_frame f = tilted();
    rig_move(&c.move[SEGMENT_MAXILLA], RIG_FORWARD, 5, &f);
    rig_move(&c.move[SEGMENT_MAXILLA], RIG_UP, 2, &f);
    rig_move(&c.move[SEGMENT_DISTAL], RIG_FORWARD, -4, &f);
    rig_move(&c.move[SEGMENT_CHIN], RIG_FORWARD, 3, &f);
    assert_ok(rig_motion(&c, &f, NULL, t, &e));
    double d[3], p[3] = {3, -80, -20};
    moved_by(&t[SEGMENT_MAXILLA], p, d);
    assert_near(vec_dot(d, f.posterior), -5, 1e-12);
    assert_near(vec_dot(d, f.up), 2, 1e-12);
    assert_near(vec_dot(d, f.left), 0, 1e-12);
    moved_by(&t[SEGMENT_DISTAL], p, d);
    assert_near(vec_dot(d, f.posterior), 4, 1e-12);
    moved_by(&t[SEGMENT_CHIN], p, d);
    assert_near(vec_dot(d, f.posterior), 1, 1e-12); /* rides on the distal segment */
    assert_near(vec_norm(d), 1, 1e-12);
    assert_true(rigid_is_identity(&t[SEGMENT_CRANIUM]));
    assert_true(rigid_is_identity(&t[SEGMENT_PROXIMAL_LEFT]));
    assert_true(rigid_is_identity(&t[SEGMENT_PROXIMAL_RIGHT]));
}

static void positive_angles_turn_front_down_front_left_and_left_side_down(void **state)
{
    (void)state;
    double front[3] = {0, -100, 0}, left_side[3] = {60, 0, 0}, d[3];
    segment_move m = {.kind = MOVE_ANGLES, .pitch_deg = 10};
    rigid t = rig_segment_motion(&m, &straight);
    moved_by(&t, front, d);
    assert_near(d[2], -100 * sin(M_PI / 18), 1e-12);
    moved_by(&t, left_side, d);
    assert_near(vec_norm(d), 0, 1e-12);
    m = (segment_move){.kind = MOVE_ANGLES, .yaw_deg = 10};
    t = rig_segment_motion(&m, &straight);
    moved_by(&t, front, d);
    assert_near(d[0], 100 * sin(M_PI / 18), 1e-12);
    assert_near(d[2], 0, 1e-12);
    m = (segment_move){.kind = MOVE_ANGLES, .roll_deg = 10};
    t = rig_segment_motion(&m, &straight);
    moved_by(&t, left_side, d);
    assert_near(d[2], -60 * sin(M_PI / 18), 1e-12);
    moved_by(&t, front, d);
    assert_near(vec_norm(d), 0, 1e-12);
}

static void a_full_move_turns_about_its_pivot_and_then_shifts(void **state)
{
    (void)state;
    segment_move m = {.kind = MOVE_ANGLES,
                      .translate_mm = {1, -5, 2},
                      .pitch_deg = 3,
                      .yaw_deg = -2,
                      .roll_deg = 4,
                      .pivot_mm = {2, -70, -30}};
    head_frame f = tilted();
    rigid t = rig_segment_motion(&m, &f);
    double d[3];
    moved_by(&t, m.pivot_mm, d);
    for (int c = 0; c < 3; c++) assert_near(d[c], m.translate_mm[c], 1e-12);
    /* pitch first, then roll, then yaw */
    rigid pitch = rigid_rotation(m.pivot_mm, f.left, 3 * M_PI / 180);
    rigid roll = rigid_rotation(m.pivot_mm, f.posterior, 4 * M_PI / 180);
    rigid yaw = rigid_rotation(m.pivot_mm, f.up, -2 * M_PI / 180);
    rigid want = rigid_compose(&roll, &pitch);
    want = rigid_compose(&yaw, &want);
    for (int i = 0; i < 9; i++) assert_near(t.r[i], want.r[i], 1e-14);
}

static void the_chin_makes_its_own_move_and_then_the_distal_one(void **state)
{
    (void)state;
    err e = {0};
    rigid t[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    c.move[SEGMENT_DISTAL] = (segment_move){.kind = MOVE_ANGLES, .yaw_deg = 5, .pivot_mm = {0, -60, -40}};
    c.move[SEGMENT_CHIN] = (segment_move){.kind = MOVE_ANGLES, .pitch_deg = 6, .pivot_mm = {0, -90, -50}};
    assert_ok(rig_motion(&c, &straight, NULL, t, &e));
    rigid own = rig_segment_motion(&c.move[SEGMENT_CHIN], &straight), want = rigid_compose(&t[SEGMENT_DISTAL], &own);
    assert_memory_equal(&t[SEGMENT_CHIN], &want, sizeof want);
    c.move[SEGMENT_CHIN] = (segment_move){.kind = MOVE_RIGID, .motion = want}; /* whole: the distal one is not added */
    assert_ok(rig_motion(&c, &straight, NULL, t, &e));
    assert_memory_equal(&t[SEGMENT_CHIN], &want, sizeof want);
}

static void opening_turns_the_whole_mandible_about_the_condyles(void **state)
{
    (void)state;
    err e = {0};
    rigid t[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    c.jaw.open_deg = 20;
    assert_ok(rig_motion(&c, &straight, condyles, t, &e));
    double d[3], incisor[3] = {0, -80, -30};
    for (int k = 0; k < 2; k++) {
        moved_by(&t[SEGMENT_DISTAL], condyles[k], d);
        assert_near(vec_norm(d), 0, 1e-12);
    }
    moved_by(&t[SEGMENT_DISTAL], incisor, d);
    assert_true(d[2] < -25 && d[1] > 0); /* down and back */
    assert_near(d[0], 0, 1e-12);
    assert_memory_equal(&t[SEGMENT_CHIN], &t[SEGMENT_DISTAL], sizeof *t);
    assert_memory_equal(&t[SEGMENT_PROXIMAL_LEFT], &t[SEGMENT_DISTAL], sizeof *t);
    assert_memory_equal(&t[SEGMENT_PROXIMAL_RIGHT], &t[SEGMENT_DISTAL], sizeof *t);
    assert_true(rigid_is_identity(&t[SEGMENT_MAXILLA]));
    c.jaw = (jaw_motion){.protrude_mm = 6, .path_slope_deg = 30};
    assert_ok(rig_motion(&c, &straight, condyles, t, &e));
    moved_by(&t[SEGMENT_DISTAL], incisor, d);
    assert_near(d[1], -6 * cos(M_PI / 6), 1e-12);
    assert_near(d[2], -3, 1e-12);
    c.jaw = (jaw_motion){.yaw_deg = 4};
    assert_ok(rig_motion(&c, &straight, condyles, t, &e));
    moved_by(&t[SEGMENT_DISTAL], incisor, d);
    assert_true(d[0] > 5);
    moved_by(&t[SEGMENT_DISTAL], (double[]){0, 10, 0}, d);
    assert_near(vec_norm(d), 0, 1e-12); /* midway between the condyles */
    c.jaw = (jaw_motion){.roll_deg = 4};
    assert_ok(rig_motion(&c, &straight, condyles, t, &e));
    moved_by(&t[SEGMENT_PROXIMAL_LEFT], condyles[0], d);
    assert_true(d[2] < -3);
}

static void surgery_comes_before_opening(void **state)
{
    (void)state;
    err e = {0};
    rigid planned[SEGMENT_COUNT], opened[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    rig_move(&c.move[SEGMENT_DISTAL], RIG_FORWARD, 6, &straight);
    assert_ok(rig_motion(&c, &straight, condyles, planned, &e));
    c.jaw.open_deg = 15;
    assert_ok(rig_motion(&c, &straight, condyles, opened, &e));
    rigid jaw = rig_jaw_motion(&c.jaw, &straight, condyles);
    rigid want = rigid_compose(&jaw, &planned[SEGMENT_DISTAL]);
    assert_memory_equal(&opened[SEGMENT_DISTAL], &want, sizeof want);
}

static void controls_that_contradict_each_other_are_refused(void **state)
{
    (void)state;
    err e = {0};
    rigid t[SEGMENT_COUNT];
    rig_controls c = rig_controls_default();
    c.move[SEGMENT_CRANIUM].kind = MOVE_RIGID;
    assert_refused(rig_motion(&c, &straight, NULL, t, &e), ERR_INPUT);
    c = rig_controls_default();
    c.move[SEGMENT_DISTAL].kind = MOVE_RIGID;
    c.move[SEGMENT_DISTAL].motion.r[4] = 1.1;
    assert_refused(rig_motion(&c, &straight, NULL, t, &e), ERR_INPUT);
    c = rig_controls_default();
    c.move[SEGMENT_DISTAL].kind = MOVE_ANGLES;
    c.move[SEGMENT_DISTAL].roll_deg = nan("");
    assert_refused(rig_motion(&c, &straight, NULL, t, &e), ERR_INPUT);
    c = rig_controls_default();
    c.jaw.open_deg = 10;
    assert_refused(rig_motion(&c, &straight, NULL, t, &e), ERR_INPUT);
    const double swapped[2][3] = {{-50, 10, 0}, {50, 10, 0}};
    assert_refused(rig_motion(&c, &straight, swapped, t, &e), ERR_INPUT);
}

static void the_angles_of_a_motion_are_those_it_was_made_of(void **state)
{
    (void)state;
    head_frame f = tilted();
    const double angle[][3] = {{0, 0, 0}, {7, 0, 0}, {0, -4, 0}, {0, 0, 3}, {12, -8, 5}, {-75, 160, -80}};
    for (size_t i = 0; i < sizeof angle / sizeof *angle; i++) {
        segment_move m = {.kind = MOVE_ANGLES, .translate_mm = {1, 2, 3}, .pivot_mm = {9, -60, 4}};
        m.pitch_deg = angle[i][0];
        m.yaw_deg = angle[i][1];
        m.roll_deg = angle[i][2];
        rigid t = rig_segment_motion(&m, &f);
        double pitch, yaw, roll;
        rig_angles(&t, &f, &pitch, &yaw, &roll);
        assert_near(pitch, angle[i][0], 1e-10);
        assert_near(yaw, angle[i][1], 1e-10);
        assert_near(roll, angle[i][2], 1e-10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_controls_move_nothing),
        cmocka_unit_test(shifts_go_along_the_heads_axes),
        cmocka_unit_test(positive_angles_turn_front_down_front_left_and_left_side_down),
        cmocka_unit_test(a_full_move_turns_about_its_pivot_and_then_shifts),
        cmocka_unit_test(the_chin_makes_its_own_move_and_then_the_distal_one),
        cmocka_unit_test(opening_turns_the_whole_mandible_about_the_condyles),
        cmocka_unit_test(surgery_comes_before_opening),
        cmocka_unit_test(the_angles_of_a_motion_are_those_it_was_made_of),
        cmocka_unit_test(controls_that_contradict_each_other_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
