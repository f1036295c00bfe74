#include "app/planner/plan/controls.h"
#include "geometry/suggest.h"
#include <stdio.h>
#include <string.h>

const control controls[CONTROL_COUNT] = {
#define X(id, name_, unit_, kind_, segment_, axis_, low_, high_, default_, built_, audit_, title_, help_)              \
    [CONTROL_##id] = {.name = name_,                                                                                   \
                      .unit = unit_,                                                                                   \
                      .kind = CONTROL_OF_##kind_,                                                                      \
                      .segment = segment_,                                                                             \
                      .axis = axis_,                                                                                   \
                      .low = low_,                                                                                     \
                      .high = high_,                                                                                   \
                      .usual = default_,                                                                               \
                      .built = built_,                                                                                 \
                      .audit = CONTROL_AUDIT_##audit_,                                                                 \
                      .title = title_},
    CONTROLS(X)
#undef X
};

#define X(id, name_, unit_, kind_, segment_, axis_, low_, high_, default_, built_, audit_, ...)                        \
    +(CONTROL_AUDIT_##audit_ == CONTROL_AUDIT_BOX)
_Static_assert(0 CONTROLS(X) <= 3, "a box has three sides");
#undef X

static const struct piece {
    const char *name;
    segment_id segment;
    limit_id first; /* forwards, upwards, to the left, turn; of a condyle shift and turn */
} pieces[CONTROL_PIECES] = {{"maxilla", SEGMENT_MAXILLA, LIMIT_MAXILLA_ADVANCE},
                            {"mandible", SEGMENT_DISTAL, LIMIT_MANDIBLE_ADVANCE},
                            {"chin", SEGMENT_CHIN, LIMIT_CHIN_ADVANCE},
                            {"proximal_left", SEGMENT_PROXIMAL_LEFT, LIMIT_CONDYLE_SHIFT},
                            {"proximal_right", SEGMENT_PROXIMAL_RIGHT, LIMIT_CONDYLE_SHIFT}};

static const char *const axis_names[RIG_AXES] = {"advance_mm", "lift_mm", "lateral_mm",
                                                 "pitch_deg",  "yaw_deg", "roll_deg"};

void control_of_piece(int number, control *out)
{
    const struct piece *p = &pieces[number / RIG_AXES];
    rig_axis axis = (rig_axis)(number % RIG_AXES);
    for (int i = 0; i < CONTROL_COUNT; i++)
        if (controls[i].kind == CONTROL_OF_SEGMENT && controls[i].segment == p->segment && controls[i].axis == axis) {
            *out = controls[i];
            return;
        }
    *out = (control){.unit = axis >= RIG_PITCH ? "deg" : "mm",
                     .kind = CONTROL_OF_SEGMENT,
                     .segment = p->segment,
                     .axis = axis,
                     .low = -HUGE_VAL,
                     .high = HUGE_VAL};
    snprintf(out->name, sizeof out->name, "%s_%s", p->name, axis_names[axis]);
}

bool control_axis(const char *name, rig_axis *axis)
{
    for (int i = 0; i < RIG_AXES; i++) {
        if (strcmp(name, axis_names[i]) != 0) continue;
        *axis = (rig_axis)i;
        return true;
    }
    return false;
}

bool control_words(const char *name, segment_id *s, rig_axis *axis)
{
    for (int i = 0; i < 2 * CONTROL_PIECES; i++) {
        const struct piece *p = &pieces[i / 2];
        const char *word = i % 2 ? segment_name(p->segment) : p->name;
        size_t n = strlen(word);
        if (strncmp(name, word, n) != 0 || name[n] != '_' || !control_axis(name + n + 1, axis)) continue;
        *s = p->segment;
        return true;
    }
    return false;
}

const char *control_piece_name(segment_id s)
{
    for (int i = 0; i < CONTROL_PIECES; i++)
        if (pieces[i].segment == s) return pieces[i].name;
    return segment_name(s);
}

int control_piece_named(const char *name)
{
    for (int i = 0; i < CONTROL_PIECES; i++)
        if (!strcmp(name, pieces[i].name)) return (int)pieces[i].segment;
    return -1;
}

bool control_named(const char *name, control *out)
{
    for (int i = 0; i < CONTROL_COUNT; i++) {
        *out = controls[i];
        if (!strcmp(name, out->name)) return true;
    }
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control_of_piece(i, out);
        if (!strcmp(name, out->name)) return true;
    }
    return false;
}

bool control_find(const char *name, const case_file *c, control *out, err *e)
{
    control all[CONTROL_PIECE_MAX];
    const char *names[CONTROL_PIECE_MAX];
    int found = -1;
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control_of_piece(i, &all[i]);
        names[i] = all[i].name;
        if (!strcmp(name, names[i])) found = i;
    }
    if (found < 0) {
        int near = suggest_nearest(name, names, CONTROL_PIECE_MAX);
        if (near >= 0) return err_set(e, ERR_USAGE, "unknown control \"%s\"; did you mean \"%s\"?", name, names[near]);
        return err_set(e, ERR_USAGE, "unknown control \"%s\"; gnathos audit --help names them", name);
    }
    control x = all[found];
    if (!case_file_frees(c, x.segment))
        return err_at(e, ERR_INPUT, c->path, 0, NULL, "does not cut the %s segment, so that %s cannot be varied",
                      segment_name(x.segment), name);
    limit_id l = control_limit(x.segment, x.axis);
    bool either_way = x.axis >= RIG_PITCH || l == LIMIT_CONDYLE_SHIFT; /* its limit is of an amount */
    x.low = either_way ? -c->limits[l].stop[1] : c->limits[l].stop[0];
    x.high = c->limits[l].stop[1];
    *out = x;
    return true;
}

limit_id control_limit(segment_id s, rig_axis axis)
{
    int i = 0;
    while (pieces[i].segment != s) i++;
    int turn = axis >= RIG_PITCH, condyle = pieces[i].first == LIMIT_CONDYLE_SHIFT;
    return (limit_id)((int)pieces[i].first + (condyle ? turn : turn ? 3 : (int)axis));
}

void control_apply(const control *x, double value, const head_frame *f, rig_controls *to)
{
    switch (x->kind) {
    case CONTROL_OF_SEGMENT: rig_move(&to->move[x->segment], x->axis, value, f); return;
    case CONTROL_OF_JAW: *rig_jaw_part(&to->jaw, x->axis) += value; return;
    case CONTROL_OF_EXPRESSION:
    case CONTROL_OF_REST: return;
    }
}
