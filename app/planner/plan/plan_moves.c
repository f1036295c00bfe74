#include "app/planner/plan/plan_moves.h"
#include "app/planner/plan/plan_words.h"
#include "geometry/frame.h"
#include "geometry/rig.h"
#include "geometry/vec.h"
#include <string.h>

/* Where a segment's move is measured, and about what it turns where the plan names no pivot: the first that
 * is there. */
static const char *const reference_labels[SEGMENT_COUNT][4] = {
    [SEGMENT_MAXILLA] = {"U1", "Pr", "ANS", "A"}, [SEGMENT_DISTAL] = {"L1", "Id", "B", "Pog"},
    [SEGMENT_PROXIMAL_LEFT] = {"Co_L"},           [SEGMENT_PROXIMAL_RIGHT] = {"Co_R"},
    [SEGMENT_CHIN] = {"Pog", "Me", "Gn"},
};

const landmark *plan_moves_reference(const landmarks *l, segment_id s)
{
    for (int i = 0; i < 4 && reference_labels[s][i]; i++) {
        const landmark *p = landmarks_find(l, reference_labels[s][i]);
        if (p) return p;
    }
    return NULL;
}

bool plan_moves_condyles(const landmarks *l, double condyle[2][3])
{
    const landmark *left = landmarks_find(l, "Co_L"), *right = landmarks_find(l, "Co_R");
    if (!left || !right) return false;
    vec_copy(left->xyz, condyle[0]);
    vec_copy(right->xyz, condyle[1]);
    return true;
}

static bool is_named(const plan_segment *s) { return s->short_form || s->move.kind != MOVE_NONE; }

/* The segment's own move, in its long form; false after an issue. */
static bool own_move(const plan_file *p, segment_id id, const landmarks *l, segment_move *out, issue_list *issues)
{
    const plan_segment *s = &p->segment[id];
    const landmark *named = *s->pivot ? landmarks_find(l, s->pivot) : NULL;
    char where[64];
    snprintf(where, sizeof where, "segments.%s", segment_name(id));
    *out = s->move;
    if (!is_named(s)) return true;
    const landmark *usual = plan_moves_reference(l, id);
    if (!usual) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, p->path, s->line, where,
                  "moving the %s segment needs the landmark %s", segment_name(id), reference_labels[id][0]);
        return false;
    }
    if (*s->pivot && !named) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, p->path, s->line, where,
                  "pivot \"%s\" is not a landmark of this case", s->pivot);
        return false;
    }
    if (!s->has_pivot_point) vec_copy(named ? named->xyz : usual->xyz, out->pivot_mm);
    return true;
}

/* A turn of a ramus that was measured, not asked for: it is told, and does not stop. */
static bool is_registered_turn(const plan_segment *s, limit_id l)
{
    return l == LIMIT_CONDYLE_TURN && s->move.kind == MOVE_RIGID;
}

/* An issue where a measure lies beyond its stop range. */
static void check_limit(const plan_file *p, const case_file *c, segment_id id, limit_id l, double value,
                        issue_list *issues)
{
    const limit_range *r = &c->limits[l];
    if (limit_judge(r, value) != LIMIT_STOP) return;
    bool excused = *p->override, short_form = p->segment[id].short_form;
    const char *name = limit_default[l].name,
               *source = c->limit_from_case[l] ? "set by the case" : limit_default[l].source;
    char where[64], range[LIMIT_WORDS_SIZE];
    bool both_ends = isfinite(r->stop[0]) && isfinite(r->stop[1]);
    if (is_registered_turn(&p->segment[id], l)) {
        snprintf(where, sizeof where, "segments.%s", segment_name(id));
        issue_add(
            issues, ISSUE_WARNING, ERR_INFEASIBLE, p->path, p->segment[id].line, where,
            "%s is %.4g, outside %s: %s. It is the move of a matrix, which is taken for a registration's, so that "
            "it cautions only",
            name, value, limit_range_words(r->stop, range), source);
        return;
    }
    snprintf(where, sizeof where, "%s%s", short_form ? "" : "segments.", short_form ? name : segment_name(id));
    issue_add(issues, excused ? ISSUE_WARNING : ISSUE_ERROR, ERR_INFEASIBLE, p->path, p->segment[id].line, where,
              "%s%sis %.4g, %s %s: %s. %s%s", short_form ? "" : name, short_form ? "" : " ", value,
              both_ends ? "outside" : "must be", limit_range_words(r->stop, range), source,
              excused ? "Accepted because: " : "Move less, or say why in \"override\"", excused ? p->override : "");
}

/* The measures of one segment's own move, from limit *first on; returns how many. */
static int measure(const plan_file *p, segment_id id, const landmarks *l, const head_frame *f,
                   const rigid motion[SEGMENT_COUNT], limit_id *first, double out[4])
{
    const landmark *at = plan_moves_reference(l, id);
    double d[3];
    rigid own = motion[id], distal_back = rigid_inverse(&motion[SEGMENT_DISTAL]);
    if (!is_named(&p->segment[id]) || !at) return 0;
    if (id == SEGMENT_CHIN) own = rigid_compose(&distal_back, &own);
    rigid_apply(&own, at->xyz, d);
    vec_sub(d, at->xyz, d);
    double turn_deg = rigid_angle(&own) * 180 / M_PI;
    *first = control_limit(id, RIG_FORWARD);
    if (id == SEGMENT_PROXIMAL_LEFT || id == SEGMENT_PROXIMAL_RIGHT) {
        out[0] = vec_norm(d);
        out[1] = turn_deg;
        return 2;
    }
    out[0] = -vec_dot(d, f->posterior);
    out[1] = vec_dot(d, f->up);
    out[2] = vec_dot(d, f->left);
    out[3] = turn_deg;
    return 4;
}

bool plan_moves_set(const plan_file *p, const case_file *c, const landmarks *l, plan_moves *out, issue_list *issues)
{
    plan_moves m = {0};
    rig_controls q = rig_controls_default();
    head_frame f;
    err e = {0};
    int errors = issue_count(issues, ISSUE_ERROR);
    if (!head_frame_from_landmarks(l, &f, &e)) {
        issue_add(issues, ISSUE_ERROR, e.code, c->landmarks, 0, NULL, "%s", e.text);
        return false;
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) (void)own_move(p, (segment_id)i, l, &q.move[i], issues);
    if (issue_count(issues, ISSUE_ERROR) > errors) return false;
    for (int i = 0; i < CONTROL_COUNT; i++)
        if (p->value[i] != 0) control_apply(&controls[i], p->value[i], &f, &q);
    double condyle[2][3];
    bool hinged = plan_moves_condyles(l, condyle);
    if (!rig_motion(&q, &f, hinged ? (const double(*)[3])condyle : NULL, m.move, &e)) {
        issue_add(issues, ISSUE_ERROR, e.code, p->path, 0, NULL, "%s", e.text);
        return false;
    }
    for (int id = SEGMENT_MAXILLA; id < SEGMENT_COUNT; id++) {
        limit_id first;
        double value[4];
        int count = measure(p, (segment_id)id, l, &f, m.move, &first, value);
        for (int i = 0; i < count; i++)
            if (fabs(value[i]) >= fabs(m.measure[(int)first + i])) m.measure[(int)first + i] = value[i];
        if (count == 2 && !is_registered_turn(&p->segment[id], LIMIT_CONDYLE_TURN))
            m.commanded_turn_deg = fmax(m.commanded_turn_deg, value[1]);
    }
    *out = m;
    return true;
}

bool plan_moves_make(const plan_file *p, const case_file *c, const landmarks *l, plan_moves *out, issue_list *issues)
{
    plan_moves m;
    head_frame f;
    err e = {0};
    int errors = issue_count(issues, ISSUE_ERROR);
    if (!plan_moves_set(p, c, l, &m, issues) || !head_frame_from_landmarks(l, &f, &e)) return false;
    for (int id = SEGMENT_MAXILLA; id < SEGMENT_COUNT; id++) {
        limit_id first;
        double value[4];
        int count = measure(p, (segment_id)id, l, &f, m.move, &first, value);
        for (int i = 0; i < count; i++) check_limit(p, c, (segment_id)id, (limit_id)((int)first + i), value[i], issues);
    }
    if (issue_count(issues, ISSUE_ERROR) > errors) return false;
    plan_words_check(p, m.move, l, &f, issues);
    *out = m;
    return true;
}

bool plan_moves_load(const char *plan_path, const case_file *c, const landmarks *l, plan_file *plan, plan_moves *out,
                     err *e)
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
