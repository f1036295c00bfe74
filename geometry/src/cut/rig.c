#include "geometry/rig.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stddef.h>

static double radians(double degrees) { return degrees * (M_PI / 180); }

rig_controls rig_controls_default(void)
{
    rig_controls c = {0};
    for (int s = 0; s < SEGMENT_COUNT; s++) c.move[s].motion = rigid_identity();
    return c;
}

static rigid turn_about(const head_frame *f, const double pivot[3], const double pitch_axis[3], double pitch_deg,
                        double yaw_deg, double roll_deg)
{
    /* no rotation stays the exact identity: pure translations keep their digits */
    rigid all = rigid_identity();
    const double *axis[3] = {pitch_axis, f->posterior, f->up};
    const double angle[3] = {pitch_deg, roll_deg, yaw_deg};
    for (int k = 0; k < 3; k++) {
        if (angle[k] == 0) continue;
        rigid one = rigid_rotation(pivot, axis[k], radians(angle[k]));
        all = rigid_compose(&one, &all);
    }
    return all;
}

rigid rig_segment_motion(const segment_move *m, const head_frame *f)
{
    if (m->kind == MOVE_NONE) return rigid_identity();
    if (m->kind == MOVE_RIGID) return m->motion;
    rigid turn = turn_about(f, m->pivot_mm, f->left, m->pitch_deg, m->yaw_deg, m->roll_deg);
    vec_add(turn.t, m->translate_mm, turn.t);
    return turn;
}

double *rig_angle(segment_move *m, rig_axis axis)
{
    assert(axis >= RIG_PITCH);
    return axis == RIG_PITCH ? &m->pitch_deg : axis == RIG_YAW ? &m->yaw_deg : &m->roll_deg;
}

double *rig_jaw_part(jaw_motion *j, rig_axis axis)
{
    assert(axis >= RIG_PITCH || axis == RIG_FORWARD);
    return axis == RIG_PITCH  ? &j->open_deg
           : axis == RIG_YAW  ? &j->yaw_deg
           : axis == RIG_ROLL ? &j->roll_deg
                              : &j->protrude_mm;
}

/* The axis along which a shift counts, and its sign. */
static const double *axis_of(rig_axis axis, const head_frame *f, double *sign)
{
    *sign = axis == RIG_FORWARD ? -1 : 1;
    return axis == RIG_FORWARD ? f->posterior : axis == RIG_UP ? f->up : f->left;
}

void rig_move(segment_move *m, rig_axis axis, double by, const head_frame *f)
{
    if (m->kind == MOVE_NONE) m->kind = MOVE_ANGLES;
    if (axis >= RIG_PITCH) {
        assert(m->kind == MOVE_ANGLES);
        *rig_angle(m, axis) += by;
        return;
    }
    double sign, *t = m->kind == MOVE_RIGID ? m->motion.t : m->translate_mm;
    const double *along = axis_of(axis, f, &sign);
    vec_axpy(t, sign * by, along, t);
}

double rig_moved(const segment_move *m, rig_axis axis, const head_frame *f)
{
    segment_move copy = *m;
    if (axis >= RIG_PITCH) return *rig_angle(&copy, axis);
    double sign;
    const double *along = axis_of(axis, f, &sign);
    return sign * vec_dot(m->translate_mm, along);
}

/* In the head's axes (left, posterior, up) the rotation is Z(yaw) Y(roll) X(pitch). */
void rig_angles(const rigid *motion, const head_frame *f, double *pitch_deg, double *yaw_deg, double *roll_deg)
{
    const double *axis[3] = {f->left, f->posterior, f->up}, degrees = 180 / M_PI;
    double r[3][3];
    for (int k = 0; k < 3; k++) {
        double turned[3];
        rigid_rotate(motion, axis[k], turned);
        for (int i = 0; i < 3; i++) r[i][k] = vec_dot(axis[i], turned);
    }
    *yaw_deg = degrees * atan2(r[1][0], r[0][0]);
    *roll_deg = degrees * atan2(-r[2][0], hypot(r[0][0], r[1][0]));
    *pitch_deg = degrees * atan2(r[2][1], r[2][2]);
}

rigid rig_jaw_motion(const jaw_motion *j, const head_frame *f, const double condyle[2][3])
{
    double centre[3], hinge[3];
    for (int c = 0; c < 3; c++) centre[c] = (condyle[0][c] + condyle[1][c]) / 2;
    vec_sub(condyle[0], condyle[1], hinge); /* right to left */
    rigid turn = turn_about(f, centre, hinge, j->open_deg, j->yaw_deg, j->roll_deg);
    if (j->protrude_mm == 0) return turn;
    vec_axpy(turn.t, -j->protrude_mm * cos(radians(j->path_slope_deg)), f->posterior, turn.t);
    vec_axpy(turn.t, -j->protrude_mm * sin(radians(j->path_slope_deg)), f->up, turn.t);
    return turn;
}

static bool check_number(double x, const char *segment, const char *name, err *e)
{
    if (isfinite(x)) return true;
    return err_set(e, ERR_INPUT, "%s.%s is not a finite number", segment, name);
}

static bool check_controls(const rig_controls *c, err *e)
{
    const jaw_motion *j = &c->jaw;
    if (!check_number(j->open_deg, "jaw", "open_deg", e) || !check_number(j->yaw_deg, "jaw", "yaw_deg", e) ||
        !check_number(j->roll_deg, "jaw", "roll_deg", e) || !check_number(j->protrude_mm, "jaw", "protrude_mm", e) ||
        !check_number(j->path_slope_deg, "jaw", "path_slope_deg", e))
        return false;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        const segment_move *m = &c->move[s];
        const char *name = segment_name((segment_id)s);
        if (m->kind == MOVE_RIGID) {
            double matrix[16];
            rigid checked;
            rigid_to_matrix(&m->motion, matrix);
            if (!rigid_from_matrix(matrix, &checked, e)) return err_prefix(e, "%s", name);
        }
        if (m->kind != MOVE_ANGLES) continue;
        for (int k = 0; k < 3; k++)
            if (!check_number(m->translate_mm[k], name, "translate_mm", e) ||
                !check_number(m->pivot_mm[k], name, "pivot_mm", e))
                return false;
        if (!check_number(m->pitch_deg, name, "pitch_deg", e) || !check_number(m->yaw_deg, name, "yaw_deg", e) ||
            !check_number(m->roll_deg, name, "roll_deg", e))
            return false;
    }
    if (c->move[SEGMENT_CRANIUM].kind != MOVE_NONE)
        return err_set(e, ERR_INPUT, "the cranium holds the head: it cannot be moved");
    return true;
}

static bool check_condyles(const double (*condyle)[3], const head_frame *f, err *e)
{
    if (!condyle) return err_set(e, ERR_INPUT, "a jaw motion needs both condyles");
    for (int k = 0; k < 6; k++)
        if (!isfinite(condyle[k / 3][k % 3])) return err_set(e, ERR_INPUT, "a condyle is not at a finite position");
    double hinge[3];
    vec_sub(condyle[0], condyle[1], hinge);
    if (!(vec_dot(hinge, f->left) > 40)) /* adults: 90 to 110 mm */
        return err_set(e, ERR_INPUT, "the left condyle is %.3g mm to the left of the right one, must be over 40",
                       vec_dot(hinge, f->left));
    return true;
}

bool rig_motion(const rig_controls *c, const head_frame *f, const double (*condyle)[3], rigid motion[SEGMENT_COUNT],
                err *e)
{
    const jaw_motion *j = &c->jaw;
    bool jaw_moves = j->open_deg != 0 || j->yaw_deg != 0 || j->roll_deg != 0 || j->protrude_mm != 0;
    if (!check_controls(c, e) || (jaw_moves && !check_condyles(condyle, f, e))) return false;
    rigid out[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) out[s] = rig_segment_motion(&c->move[s], f);
    if (c->move[SEGMENT_CHIN].kind != MOVE_RIGID)
        out[SEGMENT_CHIN] = rigid_compose(&out[SEGMENT_DISTAL], &out[SEGMENT_CHIN]);
    if (jaw_moves) {
        rigid jaw = rig_jaw_motion(j, f, condyle);
        static const segment_id mandible[] = {SEGMENT_DISTAL, SEGMENT_CHIN, SEGMENT_PROXIMAL_LEFT,
                                              SEGMENT_PROXIMAL_RIGHT};
        for (int k = 0; k < 4; k++) out[mandible[k]] = rigid_compose(&jaw, &out[mandible[k]]);
    }
    for (int s = 0; s < SEGMENT_COUNT; s++) motion[s] = out[s];
    return true;
}
