/* From the words of a plan to rigid moves; each refusal with its message is under tests/cli. */
#include "tests/check.h"
#include "app/planner/plan/plan_moves.h"
#include "geometry/frame.h"
#include "geometry/transform_file.h"
#include "geometry/vec.h"
#include <string.h>
#include <unistd.h>

static char path[64];
static landmarks head;
static case_file patient;

static int make_head(void **state)
{
    (void)state;
    snprintf(path, sizeof path, "plan-%ld.json", (long)getpid());
    const struct {
        const char *label;
        double x[3];
    } points[] = {{"Po_L", {60, 10, 0}},   {"Po_R", {-60, 10, 0}}, {"Or_L", {30, -70, 0}},
                  {"Or_R", {-30, -70, 0}}, {"U1", {0, -80, -40}},  {"L1", {0, -78, -42}},
                  {"Pog", {0, -75, -80}},  {"Co_L", {50, 0, -5}},  {"Co_R", {-50, 0, -5}}};
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) landmarks_set(&head, points[i].label, points[i].x);
    patient = case_file_default();
    return 0;
}

static int drop_head(void **state)
{
    (void)state;
    landmarks_free(&head);
    unlink(path);
    return 0;
}

static void put(const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static plan_moves moves_of(const char *text)
{
    err e = {0};
    plan_file p;
    plan_moves m;
    put(text);
    assert_ok(plan_moves_load(path, &patient, &head, &p, &m, &e));
    return m;
}

static void moved(const plan_moves *m, segment_id s, const char *label, double out[3])
{
    const double *x = landmarks_find(&head, label)->xyz;
    rigid_apply(&m->move[s], x, out);
    vec_sub(out, x, out);
}

static void the_short_form_moves_along_the_head(void **state)
{
    (void)state;
    double d[3];
    plan_moves m = moves_of("{\"gnathos\": 1, \"maxilla_advance_mm\": 5, \"maxilla_impaction_mm\": 2, "
                            "\"mandible_advance_mm\": -4}");
    moved(&m, SEGMENT_MAXILLA, "U1", d);
    assert_near(d[0], 0, 1e-12);
    assert_near(d[1], -5, 1e-12); /* forwards is -y */
    assert_near(d[2], 2, 1e-12);
    moved(&m, SEGMENT_DISTAL, "L1", d);
    assert_near(d[1], 4, 1e-12);
    assert_true(rigid_is_identity(&m.move[SEGMENT_CRANIUM]));
    assert_true(rigid_is_identity(&m.move[SEGMENT_PROXIMAL_LEFT]));
    assert_near(m.measure[LIMIT_MAXILLA_ADVANCE], 5, 1e-9);
    assert_near(m.measure[LIMIT_MAXILLA_IMPACTION], 2, 1e-9);
    assert_near(m.measure[LIMIT_MANDIBLE_ADVANCE], -4, 1e-9);
}

static void the_short_form_follows_a_tilted_head(void **state)
{
    (void)state;
    landmarks upright = head;
    head = landmarks_copy(&upright);
    const double origin[3] = {0}, axis[3] = {1, 0, 0};
    rigid tilt = rigid_rotation(origin, axis, 0.3);
    for (int i = 0; i < head.count; i++) rigid_apply(&tilt, head.point[i].xyz, head.point[i].xyz);
    plan_moves m = moves_of("{\"gnathos\": 1, \"maxilla_advance_mm\": 5}");
    double d[3], want[3], forwards[3] = {0, -5, 0};
    moved(&m, SEGMENT_MAXILLA, "U1", d);
    rigid_rotate(&tilt, forwards, want);
    for (int c = 0; c < 3; c++) assert_near(d[c], want[c], 1e-12);
    landmarks_free(&head);
    head = upright;
}

static void the_chin_rides_on_the_distal_segment(void **state)
{
    (void)state;
    double d[3];
    plan_moves m = moves_of("{\"gnathos\": 1, \"mandible_advance_mm\": 3, \"chin_advance_mm\": 4}");
    moved(&m, SEGMENT_CHIN, "Pog", d);
    assert_near(d[1], -7, 1e-12);
    assert_near(m.measure[LIMIT_CHIN_ADVANCE], 4, 1e-9);
    m = moves_of("{\"gnathos\": 1, \"mandible_advance_mm\": 3}");
    moved(&m, SEGMENT_CHIN, "Pog", d);
    assert_near(d[1], -3, 1e-12);
}

static void angles_turn_as_the_help_says(void **state)
{
    (void)state;
    /* About the point between the porions, 10 mm ahead of which lies a test point of the maxilla. */
    const struct {
        const char *angle;
        double from[3];
        int axis;
        double sign; /* of the displacement along the axis */
    } turn[] = {{"pitch_deg", {0, -90, 0}, 2, -1}, {"yaw_deg", {0, -90, 0}, 0, 1}, {"roll_deg", {50, 0, 0}, 2, -1}};
    for (int i = 0; i < 3; i++) {
        char text[256];
        double to[3];
        snprintf(text, sizeof text,
                 "{\"gnathos\": 1, \"override\": \"test\", \"segments\": {\"maxilla\": {\"%s\": 1, "
                 "\"pivot\": [0, 0, 0]}}}",
                 turn[i].angle);
        plan_moves m = moves_of(text);
        rigid_apply(&m.move[SEGMENT_MAXILLA], turn[i].from, to);
        double arm = vec_norm(turn[i].from);
        assert_near(to[turn[i].axis] - turn[i].from[turn[i].axis], turn[i].sign * arm * sin(M_PI / 180), 1e-9);
        assert_near(m.measure[LIMIT_MAXILLA_TURN], 1, 1e-9);
    }
}

static void a_pivot_stays_but_for_the_translation(void **state)
{
    (void)state;
    double d[3];
    plan_moves m =
        moves_of("{\"gnathos\": 1, \"segments\": {\"maxilla\": {\"translate_mm\": [1, -2, 3], \"pitch_deg\": 3, "
                 "\"yaw_deg\": -2, \"roll_deg\": 1, \"pivot\": \"U1\"}}}");
    moved(&m, SEGMENT_MAXILLA, "U1", d);
    assert_near(d[0], 1, 1e-9);
    assert_near(d[1], -2, 1e-9);
    assert_near(d[2], 3, 1e-9);
    plan_moves same =
        moves_of("{\"gnathos\": 1, \"segments\": {\"maxilla\": {\"translate_mm\": [1, -2, 3], \"pitch_deg\": 3, "
                 "\"yaw_deg\": -2, \"roll_deg\": 1}}}");
    assert_memory_equal(&m, &same, sizeof m); /* U1 is the maxilla's own pivot */
}

static void matrix_and_transform_file_say_the_same(void **state)
{
    (void)state;
    err e = {0};
    double m16[16], pivot[3] = {10, -20, -30}, axis[3] = {0.6, 0, 0.8};
    char text[1024], tfm[96];
    rigid a = rigid_rotation(pivot, axis, 0.05);
    snprintf(tfm, sizeof tfm, "plan-%ld.tfm", (long)getpid());
    assert_ok(transform_write(&a, tfm, &e));
    rigid_to_matrix(&a, m16);
    int n = snprintf(text, sizeof text, "{\"gnathos\": 1, \"segments\": {\"distal\": {\"matrix\": [");
    for (int i = 0; i < 16; i++) n += snprintf(text + n, sizeof text - (size_t)n, "%s%.17g", i ? ", " : "", m16[i]);
    snprintf(text + n, sizeof text - (size_t)n, "]}}}");
    plan_moves by_matrix = moves_of(text);
    snprintf(text, sizeof text, "{\"gnathos\": 1, \"segments\": {\"distal\": {\"file\": \"%s\"}}}", tfm);
    plan_moves by_file = moves_of(text);
    unlink(tfm);
    for (int i = 0; i < 9; i++) {
        assert_near(by_matrix.move[SEGMENT_DISTAL].r[i], a.r[i], 1e-12);
        assert_near(by_file.move[SEGMENT_DISTAL].r[i], a.r[i], 1e-12);
    }
    for (int i = 0; i < 3; i++) assert_near(by_file.move[SEGMENT_DISTAL].t[i], a.t[i], 1e-9);
}

/* The moves of a plan, written as .tfm files as an outcome has them, read again by a plan of files. */
static void check_round_trip(const char *text)
{
    err e = {0};
    static const segment_id segment[] = {SEGMENT_MAXILLA, SEGMENT_DISTAL, SEGMENT_PROXIMAL_LEFT, SEGMENT_PROXIMAL_RIGHT,
                                         SEGMENT_CHIN};
    plan_moves m = moves_of(text);
    char files[2048], name[80];
    int n = snprintf(files, sizeof files, "{\"gnathos\": 1, \"override\": \"test\", \"segments\": {");
    for (int i = 0; i < 5; i++) {
        snprintf(name, sizeof name, "plan-%ld-%d.tfm", (long)getpid(), i);
        assert_ok(transform_write(&m.move[segment[i]], name, &e));
        n += snprintf(files + n, sizeof files - (size_t)n, "%s\"%s\": {\"file\": \"%s\"}", i ? ", " : "",
                      segment_name(segment[i]), name);
    }
    snprintf(files + n, sizeof files - (size_t)n, "}}");
    plan_moves again = moves_of(files);
    for (int i = 0; i < 5; i++) {
        const rigid *a = &m.move[segment[i]], *b = &again.move[segment[i]];
        for (int k = 0; k < 9; k++) assert_near(b->r[k], a->r[k], 1e-12);
        for (int k = 0; k < 3; k++) assert_near(b->t[k], a->t[k], 1e-9);
        snprintf(name, sizeof name, "plan-%ld-%d.tfm", (long)getpid(), i);
        unlink(name);
    }
    for (int l = LIMIT_CHIN_ADVANCE; l < LIMIT_CHIN_ADVANCE + 4; l++) /* still measured against the distal segment */
        assert_near(again.measure[l], m.measure[l], 1e-6);
}

static void moves_fed_back_as_files_are_the_same_moves(void **state)
{
    (void)state;
    check_round_trip("{\"gnathos\": 1, \"mandible_advance_mm\": 5.73, \"chin_advance_mm\": 0}");
    check_round_trip("{\"gnathos\": 1, \"maxilla_advance_mm\": 3, \"mandible_advance_mm\": -4, "
                     "\"chin_advance_mm\": 5}");
    check_round_trip("{\"gnathos\": 1, \"segments\": {\"distal\": {\"translate_mm\": [1, -3, 0], \"yaw_deg\": 2, "
                     "\"pitch_deg\": -3}, \"chin\": {\"translate_mm\": [0, -4, 1], \"pitch_deg\": 3}, "
                     "\"proximal_left\": {\"yaw_deg\": 1}}}");
    check_round_trip("{\"gnathos\": 1, \"chin_advance_mm\": 4}");
}

static void a_matrix_is_the_chins_whole_move(void **state)
{
    (void)state;
    double d[3];
    const char *matrix = "\"chin\": {\"matrix\": [1, 0, 0, 0, 0, 1, 0, -5, 0, 0, 1, 0, 0, 0, 0, 1]}";
    const char *const distal[] = {"", "\"distal\": {\"translate_mm\": [0, -3, 0]}, ",
                                  "\"distal\": {\"yaw_deg\": 2, \"pitch_deg\": -1}, "};
    for (int i = 0; i < 3; i++) {
        char text[512];
        snprintf(text, sizeof text, "{\"gnathos\": 1, \"override\": \"test\", \"segments\": {%s%s}}", distal[i],
                 matrix);
        plan_moves m = moves_of(text);
        moved(&m, SEGMENT_CHIN, "Pog", d);
        assert_near(d[0], 0, 1e-12);
        assert_near(d[1], -5, 1e-12);
        assert_near(d[2], 0, 1e-12);
        if (i == 1) assert_near(m.measure[LIMIT_CHIN_ADVANCE], 2, 1e-9); /* relative to the distal segment */
    }
    plan_moves m = moves_of("{\"gnathos\": 1, \"segments\": {\"distal\": {\"translate_mm\": [0, -3, 0]}, \"chin\": "
                            "{\"translate_mm\": [0, -2, 0]}}}"); /* a move in parts rides */
    moved(&m, SEGMENT_CHIN, "Pog", d);
    assert_near(d[1], -5, 1e-12);
}

/* A matrix is what a registration found; angles are what is asked for. */
static void a_ramus_turned_by_a_registration_does_not_stop(void **state)
{
    (void)state;
    const char *label[] = {"Co_L", "Co_R"}, *name[] = {"proximal_left", "proximal_right"};
    for (int side = 0; side < 2; side++)
        for (int deg = -9; deg <= 9; deg += 18) {
            char text[1024];
            double m16[16];
            err e = {0};
            plan_file p;
            plan_moves m;
            rigid a =
                rigid_rotation(landmarks_find(&head, label[side])->xyz, (const double[3]){0, 0, 1}, deg * M_PI / 180);
            rigid_to_matrix(&a, m16);
            int n = snprintf(text, sizeof text, "{\"gnathos\": 1, \"segments\": {\"%s\": {\"matrix\": [", name[side]);
            for (int i = 0; i < 16; i++)
                n += snprintf(text + n, sizeof text - (size_t)n, "%s%.17g", i ? ", " : "", m16[i]);
            snprintf(text + n, sizeof text - (size_t)n, "]}, \"%s\": {\"yaw_deg\": 3}}}", name[1 - side]);
            m = moves_of(text);
            assert_near(m.measure[LIMIT_CONDYLE_TURN], 9, 1e-9);
            assert_near(m.commanded_turn_deg, 3, 1e-9);
            snprintf(text + n, sizeof text - (size_t)n, "]}, \"%s\": {\"yaw_deg\": 6}}}", name[1 - side]);
            put(text);
            assert_false(plan_moves_load(path, &patient, &head, &p, &m, &e));
            assert_int_equal(e.code, ERR_INFEASIBLE);
            assert_non_null(strstr(e.text, "condyle_turn_deg is 6"));
        }
}

/* Reads a plan that has to be refused; *text holds why. */
static void refused(const char *plan, char *text, size_t size)
{
    err e = {0};
    plan_file p;
    plan_moves m;
    put(plan);
    assert_false(plan_moves_load(path, &patient, &head, &p, &m, &e));
    assert_int_equal(e.code, ERR_INPUT);
    snprintf(text, size, "%s", e.text);
}

static void every_word_of_an_audit_is_read_or_told_its_place(void **state)
{
    (void)state;
    char plan[256], text[2048], want[128];
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control x;
        control_of_piece(i, &x);
        snprintf(plan, sizeof plan, "{\"gnathos\": 1, \"%s\": 3}", x.name);
        bool short_form = false;
        for (int k = 0; k < CONTROL_COUNT; k++) short_form |= !strcmp(controls[k].name, x.name);
        if (short_form) {
            (void)moves_of(plan);
            continue;
        }
        refused(plan, text, sizeof text);
        snprintf(want, sizeof want, "its place is \"segments\": {\"%s\": {\"%s", segment_name(x.segment),
                 x.axis >= RIG_PITCH ? strstr(x.name, x.axis == RIG_YAW    ? "yaw"
                                                      : x.axis == RIG_ROLL ? "roll"
                                                                           : "pitch")
                                     : "translate_mm");
        if (!strstr(text, want)) print_message("%s: %s; not %s\n", plan, text, want);
        assert_non_null(strstr(text, want));
    }
    static const char *const told[][2] = {
        {"\"maxilla_roll_deg\": 3", "its place is \"segments\": {\"maxilla\": {\"roll_deg\": 3}}"},
        {"\"mandible_lateral_mm\": -2", "its place is \"segments\": {\"distal\": {\"translate_mm\": [-2, 0, 0]}}"},
        {"\"distal_advance_mm\": 2", "did you mean \"mandible_advance_mm\"?"},
        {"\"maxilla_lift_mm\": 2", "did you mean \"maxilla_impaction_mm\"?"},
        {"\"mandible_yaw_dg\": 1", "did you mean \"mandible_yaw_deg\"? Its place is \"segments\""},
        {"\"maxila_advance_mm\": 1", "did you mean \"maxilla_advance_mm\"?"},
        {"\"segments\": {\"chin\": {\"lift_mm\": 2}}", "its place is \"translate_mm\": [0, 0, 2]"},
        {"\"segments\": {\"chin\": {\"chin_roll_deg\": 2}}",
         "its place is \"segments\": {\"chin\": {\"roll_deg\": 2}}"},
        {"\"segments\": {\"mandible\": {\"roll_deg\": 2}}", "unknown segment; did you mean \"distal\"?"}};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++) {
        snprintf(plan, sizeof plan, "{\"gnathos\": 1, %s}", told[i][0]);
        refused(plan, text, sizeof text);
        if (!strstr(text, told[i][1])) print_message("%s: %s\n", plan, text);
        assert_non_null(strstr(text, told[i][1]));
    }
}

static void a_limit_holds_exactly_at_its_end(void **state)
{
    (void)state;
    err e = {0};
    plan_file p;
    plan_moves m;
    (void)moves_of("{\"gnathos\": 1, \"maxilla_advance_mm\": 8, \"maxilla_impaction_mm\": -5}");
    put("{\"gnathos\": 1, \"maxilla_advance_mm\": 8.001}");
    assert_refused(plan_moves_load(path, &patient, &head, &p, &m, &e), ERR_INFEASIBLE);
}

static void an_override_turns_a_breach_into_a_warning(void **state)
{
    (void)state;
    issue_list issues = {0};
    plan_file p;
    plan_moves m;
    put("{\"gnathos\": 1, \"maxilla_advance_mm\": 12, \"override\": \"cleft, done in two stages\"}");
    assert_true(plan_file_read(path, &patient, &p, &issues));
    assert_true(plan_moves_make(&p, &patient, &head, &m, &issues));
    assert_int_equal(issue_count(&issues, ISSUE_WARNING), 1);
    assert_non_null(strstr(issues.item[0].text, "cleft, done in two stages"));
    issue_list_free(&issues);
}

static void a_long_breach_is_measured_at_the_segments_point(void **state)
{
    (void)state;
    err e = {0};
    plan_file p;
    plan_moves m;
    /* Turned about the porions, the incisors swing: 4 degrees over 90 mm is 6 mm down, the limit is 5. */
    put("{\"gnathos\": 1, \"segments\": {\"maxilla\": {\"pitch_deg\": 4, \"pivot\": [0, 10, 0]}}}");
    assert_false(plan_moves_load(path, &patient, &head, &p, &m, &e));
    assert_int_equal(e.code, ERR_INFEASIBLE);
    assert_non_null(strstr(e.text, "maxilla_impaction_mm is -"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_short_form_moves_along_the_head),
        cmocka_unit_test(the_short_form_follows_a_tilted_head),
        cmocka_unit_test(the_chin_rides_on_the_distal_segment),
        cmocka_unit_test(angles_turn_as_the_help_says),
        cmocka_unit_test(a_pivot_stays_but_for_the_translation),
        cmocka_unit_test(matrix_and_transform_file_say_the_same),
        cmocka_unit_test(moves_fed_back_as_files_are_the_same_moves),
        cmocka_unit_test(a_matrix_is_the_chins_whole_move),
        cmocka_unit_test(a_ramus_turned_by_a_registration_does_not_stop),
        cmocka_unit_test(every_word_of_an_audit_is_read_or_told_its_place),
        cmocka_unit_test(a_limit_holds_exactly_at_its_end),
        cmocka_unit_test(an_override_turns_a_breach_into_a_warning),
        cmocka_unit_test(a_long_breach_is_measured_at_the_segments_point),
    };
    return cmocka_run_group_tests(tests, make_head, drop_head);
}
