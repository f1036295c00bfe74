#include "app/plan_moves.h"
#include "geometry/frame.h"
#include "geometry/vec.h"
#include <string.h>

/* Where a segment's move is measured, and about what it turns where the plan names no pivot: the first that
 * is there. */
static const char *const reference_labels[SEGMENT_COUNT][3] = {
    [SEGMENT_MAXILLA] = {"U1", "ANS", "A"}, [SEGMENT_DISTAL] = {"L1", "B", "Pog"},
    [SEGMENT_PROXIMAL_LEFT] = {"Co_L"},     [SEGMENT_PROXIMAL_RIGHT] = {"Co_R"},
    [SEGMENT_CHIN] = {"Pog", "Me", "Gn"},
};

static const double *reference(const landmarks *l, segment_id s)
{
    for (int i = 0; i < 3 && reference_labels[s][i]; i++) {
        const landmark *p = landmarks_find(l, reference_labels[s][i]);
        if (p) return p->xyz;
    }
    return NULL;
}

static rigid turned(const plan_segment *s, const head_frame *f, const double pivot[3])
{
    const double radian = M_PI / 180;
    rigid roll = rigid_rotation(pivot, f->posterior, s->roll_deg * radian);
    rigid pitch = rigid_rotation(pivot, f->left, s->pitch_deg * radian);
    rigid yaw = rigid_rotation(pivot, f->up, s->yaw_deg * radian);
    rigid both = rigid_compose(&pitch, &roll), all = rigid_compose(&yaw, &both);
    rigid shift = rigid_translation(s->translate_mm);
    return rigid_compose(&shift, &all);
}

static rigid along_head(const head_frame *f, double advance_mm, double lift_mm)
{
    double t[3];
    for (int c = 0; c < 3; c++) t[c] = -advance_mm * f->posterior[c] + lift_mm * f->up[c];
    return rigid_translation(t);
}

/* The segment's own move; false after an issue. */
static bool own_move(const plan_file *p, segment_id id, const head_frame *f, const landmarks *l, rigid *out,
                     issue_list *issues)
{
    const plan_segment *s = &p->segment[id];
    const landmark *named = *s->pivot ? landmarks_find(l, s->pivot) : NULL;
    char where[64];
    snprintf(where, sizeof where, "segments.%s", segment_name(id));
    *out = rigid_identity();
    if (s->form == FORM_NONE) return true;
    if (!reference(l, id)) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, p->path, s->line, where,
                  "moving the %s segment needs the landmark %s", segment_name(id), reference_labels[id][0]);
        return false;
    }
    if (*s->pivot && !named) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, p->path, s->line, where,
                  "pivot \"%s\" is not a landmark of this case", s->pivot);
        return false;
    }
    const double *pivot = s->has_pivot_point ? s->pivot_mm : named ? named->xyz : reference(l, id);
    if (s->form == FORM_ANGLES)
        *out = turned(s, f, pivot);
    else if (s->form == FORM_MATRIX)
        *out = s->motion;
    else if (id == SEGMENT_MAXILLA)
        *out = along_head(f, p->maxilla_advance_mm, p->maxilla_impaction_mm);
    else if (id == SEGMENT_DISTAL)
        *out = along_head(f, p->mandible_advance_mm, 0);
    else
        *out = along_head(f, p->chin_advance_mm, 0);
    return true;
}

/* Compares one measure with its bound; rounding of rotations and frames is not a breach. */
static void check_bound(const plan_file *p, const case_file *c, segment_id id, bound_id b, double value,
                        issue_list *issues)
{
    const double rounding = 1e-6;
    double low = c->bounds[b][0], high = c->bounds[b][1];
    if (value >= low - rounding && value <= high + rounding) return;
    bool excused = *p->override, short_form = p->segment[id].form == FORM_SHORT;
    const char *name = bound_default[b].name,
               *source = c->bound_from_case[b] ? "set by the case" : bound_default[b].source;
    char where[64];
    snprintf(where, sizeof where, "%s%s", short_form ? "" : "segments.",
             short_form ? name : segment_name(id));
    issue_add(issues, excused ? ISSUE_WARNING : ISSUE_ERROR, ERR_INFEASIBLE, p->path, p->segment[id].line,
              where, "%s%sis %.4g, outside %g to %g: %s. %s%s", short_form ? "" : name, short_form ? "" : " ",
              value, low, high, source,
              excused ? "Accepted because: " : "Move less, or say why in \"override\"",
              excused ? p->override : "");
}

static void measure(const plan_file *p, const case_file *c, const landmarks *l, const head_frame *f,
                    const rigid own[SEGMENT_COUNT], double out[BOUND_COUNT], issue_list *issues)
{
    static const bound_id first[SEGMENT_COUNT] = {[SEGMENT_MAXILLA] = BOUND_MAXILLA_ADVANCE,
                                                  [SEGMENT_DISTAL] = BOUND_MANDIBLE_ADVANCE,
                                                  [SEGMENT_CHIN] = BOUND_CHIN_ADVANCE};
    for (int id = SEGMENT_MAXILLA; id < SEGMENT_COUNT; id++) {
        const double *x = reference(l, (segment_id)id);
        double d[3], turn_deg = rigid_angle(&own[id]) * 180 / M_PI;
        if (p->segment[id].form == FORM_NONE || !x) continue;
        rigid_apply(&own[id], x, d);
        vec_sub(d, x, d);
        if (id == SEGMENT_PROXIMAL_LEFT || id == SEGMENT_PROXIMAL_RIGHT) {
            const double value[2] = {vec_norm(d), turn_deg};
            for (int i = 0; i < 2; i++) {
                bound_id b = (bound_id)(BOUND_CONDYLE_SHIFT + i);
                out[b] = fmax(out[b], value[i]);
                check_bound(p, c, (segment_id)id, b, value[i], issues);
            }
            continue;
        }
        const double value[4] = {-vec_dot(d, f->posterior), vec_dot(d, f->up), vec_dot(d, f->left), turn_deg};
        for (int i = 0; i < 4; i++) {
            bound_id b = (bound_id)((int)first[id] + i);
            out[b] = value[i];
            check_bound(p, c, (segment_id)id, b, value[i], issues);
        }
    }
}

bool plan_moves_make(const plan_file *p, const case_file *c, const landmarks *l, plan_moves *out,
                     issue_list *issues)
{
    plan_moves m = {0};
    rigid own[SEGMENT_COUNT];
    head_frame f;
    err e = {0};
    int errors = issue_count(issues, ISSUE_ERROR);
    if (!head_frame_from_landmarks(l, &f, &e)) {
        issue_add(issues, ISSUE_ERROR, e.code, c->landmarks, 0, NULL, "%s", e.text);
        return false;
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) (void)own_move(p, (segment_id)i, &f, l, &own[i], issues);
    if (issue_count(issues, ISSUE_ERROR) > errors) return false;
    measure(p, c, l, &f, own, m.measure, issues);
    if (issue_count(issues, ISSUE_ERROR) > errors) return false;
    memcpy(m.move, own, sizeof own);
    m.move[SEGMENT_CHIN] = rigid_compose(&own[SEGMENT_DISTAL], &own[SEGMENT_CHIN]);
    *out = m;
    return true;
}

bool plan_moves_load(const char *plan_path, const case_file *c, const landmarks *l, plan_file *plan,
                     plan_moves *out, err *e)
{
    issue_list issues = {0};
    plan_file p;
    plan_moves m;
    bool made = plan_file_read(plan_path, c, &p, &issues) && plan_moves_make(&p, c, l, &m, &issues);
    bool ok = issue_none_is_error(&issues, e) && made;
    if (ok) {
        *plan = p;
        *out = m;
    }
    issue_list_free(&issues);
    return ok;
}
