#include "app/planner/plan/plan_words.h"
#include "app/planner/plan/movements.h"
#include <string.h>
#include <strings.h>

enum { WORDS = 7 };
/* Names of planners, by stems; of each axis the words for more and for less. */
static const char *const segment_words[SEGMENT_COUNT][WORDS] = {
    [SEGMENT_MAXILLA] = {"maxill", "lefort", "le_fort", "le fort", "upper_jaw", "upper jaw"},
    [SEGMENT_DISTAL] = {"distal", "mandib", "bsso", "lower_jaw", "lower jaw"},
    [SEGMENT_PROXIMAL_LEFT] = {"proximal_left", "proximal_l", "left_ramus", "ramus_left", "left ramus",
                               "left_proximal"},
    [SEGMENT_PROXIMAL_RIGHT] = {"proximal_right", "proximal_r", "right_ramus", "ramus_right", "right ramus",
                                "right_proximal"},
    [SEGMENT_CHIN] = {"chin", "genio"},
};
static const char *const way_words[2][2][WORDS] = {
    {{"advance", "forward", "protru"}, {"setback", "set-back", "set_back", "set back", "backward"}},
    {{"impact", "intru", "upward"}, {"downgraft", "down-graft", "extru", "downward"}},
};
static const char *const way_does[2][2] = {{"forwards", "backwards"}, {"up", "down"}};

static const char *find(const char *text, const char *const words[WORDS])
{
    for (int i = 0; i < WORDS && words[i]; i++)
        if (strcasestr(text, words[i])) return words[i];
    return NULL;
}

/* The text names one way of an axis, and every segment it speaks of goes the other. */
static void check_way(const plan_file *p, const char *text, const char *file, const movement *m, int count, int axis,
                      issue_list *issues)
{
    const double least_mm = 0.5;
    const char *more = find(text, way_words[axis][0]), *less = find(text, way_words[axis][1]),
               *word = more ? more : less;
    const movement *worst = NULL;
    bool names_one = false;
    if (!word || (more && less)) return;
    for (int s = 0; s < SEGMENT_COUNT; s++) names_one |= !file && find(text, segment_words[s]);
    for (int i = 0; i < count; i++) {
        if (names_one && !find(text, segment_words[m[i].segment])) continue;
        double by = (axis ? m[i].up_mm : m[i].anterior_mm) * (more ? 1 : -1);
        if (!(by < -least_mm)) return;
        worst = &m[i];
    }
    if (!worst) return;
    issue_add(issues, ISSUE_WARNING, ERR_NONE, p->path, p->segment[worst->segment].line, file ? "file" : "name",
              "\"%.80s\" says %s, but it moves the %s %.2f mm %s (at %s): is %s?", text, word,
              segment_name(worst->segment), fabs(axis ? worst->up_mm : worst->anterior_mm),
              way_does[axis][more != NULL], worst->at,
              file ? "the transform in RAS, or the inverse one" : "the sign right");
}

static void check_file(const plan_file *p, const movement *m, issue_list *issues)
{
    const char *path = p->segment[m->segment].file, *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    if (!*path) return;
    for (int axis = 0; axis < 2; axis++) check_way(p, base, path, m, 1, axis, issues);
    if (find(base, segment_words[m->segment])) return;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (find(base, segment_words[s])) {
            issue_add(issues, ISSUE_WARNING, ERR_NONE, p->path, p->segment[m->segment].line, "file",
                      "\"%.80s\" bears the name of the %s, but it moves the %s", base, segment_name((segment_id)s),
                      segment_name(m->segment));
            return;
        }
}

void plan_words_check(const plan_file *p, const rigid move[SEGMENT_COUNT], const landmarks *l, const head_frame *f,
                      issue_list *issues)
{
    const double least_mm = 0.1, least_deg = 0.1;
    movement m[SEGMENT_COUNT];
    int count = movements_make(move, l, f, m);
    if (!count) {
        issue_add(issues, ISSUE_WARNING, ERR_NONE, p->path, 0, NULL, "moves nothing: the face stays as it is");
        return;
    }
    for (int axis = 0; axis < 2; axis++) check_way(p, p->name, NULL, m, count, axis, issues);
    for (int i = 0; i < count; i++) {
        double turn_deg = rigid_angle(&move[m[i].segment]) * 180 / M_PI;
        double mm = fmax(fabs(m[i].left_mm), fmax(fabs(m[i].anterior_mm), fabs(m[i].up_mm)));
        check_file(p, &m[i], issues);
        if (m[i].segment == SEGMENT_CHIN && !memcmp(&move[SEGMENT_CHIN], &move[SEGMENT_DISTAL], sizeof *move)) continue;
        if (mm < least_mm && turn_deg < least_deg)
            issue_add(
                issues, ISSUE_WARNING, ERR_NONE, p->path, p->segment[m[i].segment].line, NULL,
                "moves the %s segment by no more than %.3g mm and %.3g degrees: are lengths in mm and angles in degrees?",
                segment_name(m[i].segment), mm, turn_deg);
    }
}
