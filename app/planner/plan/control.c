#include "app/planner/plan/control.h"
#include "app/planner/store/suggest.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

static const struct piece {
    const char *name;
    segment_id segment;
    limit_id first; /* forwards, upwards, to the left, turn; of a condyle shift and turn */
} pieces[] = {{"maxilla", SEGMENT_MAXILLA, LIMIT_MAXILLA_ADVANCE},
              {"mandible", SEGMENT_DISTAL, LIMIT_MANDIBLE_ADVANCE},
              {"chin", SEGMENT_CHIN, LIMIT_CHIN_ADVANCE},
              {"proximal_left", SEGMENT_PROXIMAL_LEFT, LIMIT_CONDYLE_SHIFT},
              {"proximal_right", SEGMENT_PROXIMAL_RIGHT, LIMIT_CONDYLE_SHIFT}};
enum { PIECE_COUNT = sizeof pieces / sizeof *pieces };

static const char *const part_names[CONTROL_PART_COUNT] = {"advance_mm", "lift_mm", "lateral_mm",
                                                           "pitch_deg",  "yaw_deg", "roll_deg"};

static void make(const struct piece *p, int part, const case_file *c, control *out)
{
    bool turn = part >= CONTROL_PITCH, condyle = p->first == LIMIT_CONDYLE_SHIFT,
         impaction = p->segment == SEGMENT_MAXILLA && part == CONTROL_UP;
    *out = (control){.unit = turn ? "deg" : "mm", .segment = p->segment, .part = (control_part)part};
    snprintf(out->name, sizeof out->name, "%s_%s", p->name, impaction ? "impaction_mm" : part_names[part]);
    out->limit = (limit_id)((int)p->first + (condyle ? turn : turn ? 3 : part));
    const double *stop = c->limits[out->limit].stop;
    out->low = turn || condyle ? -stop[1] : stop[0];
    out->high = stop[1];
}

bool control_find(const char *name, const case_file *c, control *out, err *e)
{
    control all[PIECE_COUNT * CONTROL_PART_COUNT];
    const char *names[PIECE_COUNT * CONTROL_PART_COUNT];
    int count = 0;
    for (int i = 0; i < PIECE_COUNT; i++)
        for (int k = 0; k < CONTROL_PART_COUNT; k++, count++) {
            make(&pieces[i], k, c, &all[count]);
            names[count] = all[count].name;
        }
    for (int i = 0; i < count; i++) {
        if (strcmp(name, names[i])) continue;
        if (!case_file_frees(c, all[i].segment))
            return err_at(e, ERR_INPUT, c->path, 0, NULL, "does not cut the %s segment, so that %s cannot be varied",
                          segment_name(all[i].segment), name);
        *out = all[i];
        return true;
    }
    int near = suggest_nearest(name, names, count);
    if (near >= 0) return err_set(e, ERR_USAGE, "unknown control \"%s\"; did you mean \"%s\"?", name, names[near]);
    return err_set(e, ERR_USAGE, "unknown control \"%s\"; gnathos audit --help names them", name);
}

/* Takes a number of the short form over. */
static void take_short(double *from, const double axis[3], double sign, plan_segment *s)
{
    vec_axpy(s->translate_mm, sign * *from, axis, s->translate_mm);
    *from = 0;
}

bool control_open_plan(const control *x, const head_frame *f, plan_file *p, err *e)
{
    plan_segment *s = &p->segment[x->segment];
    if (s->form == FORM_MATRIX)
        return err_at(e, ERR_INPUT, p->path, s->line, NULL,
                      "moves the %s segment by a matrix, so that %s cannot be varied; write it with angles",
                      segment_name(x->segment), x->name);
    if (x->segment == SEGMENT_MAXILLA) {
        take_short(&p->maxilla_advance_mm, f->posterior, -1, s);
        take_short(&p->maxilla_impaction_mm, f->up, 1, s);
    }
    if (x->segment == SEGMENT_DISTAL) take_short(&p->mandible_advance_mm, f->posterior, -1, s);
    if (x->segment == SEGMENT_CHIN) take_short(&p->chin_advance_mm, f->posterior, -1, s);
    s->form = FORM_ANGLES;
    return true;
}

/* The axis along which a shift counts, and its sign. */
static const double *axis_of(const control *x, const head_frame *f, double *sign)
{
    *sign = x->part == CONTROL_FORWARD ? -1 : 1;
    return x->part == CONTROL_FORWARD ? f->posterior : x->part == CONTROL_UP ? f->up : f->left;
}

static double *angle_of(const control *x, plan_segment *s)
{
    return x->part == CONTROL_PITCH ? &s->pitch_deg : x->part == CONTROL_YAW ? &s->yaw_deg : &s->roll_deg;
}

double control_value(const control *x, const head_frame *f, const plan_file *p)
{
    plan_segment s = p->segment[x->segment];
    double sign;
    if (x->part >= CONTROL_PITCH) return *angle_of(x, &s);
    const double *axis = axis_of(x, f, &sign);
    return sign * vec_dot(s.translate_mm, axis);
}

void control_set(const control *x, const head_frame *f, double value, plan_file *p)
{
    plan_segment *s = &p->segment[x->segment];
    assert(s->form == FORM_ANGLES);
    if (x->part >= CONTROL_PITCH) {
        *angle_of(x, s) = value;
        return;
    }
    double sign, change = value - control_value(x, f, p);
    const double *axis = axis_of(x, f, &sign);
    vec_axpy(s->translate_mm, sign * change, axis, s->translate_mm);
}
