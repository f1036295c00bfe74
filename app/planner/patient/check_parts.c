#include "app/planner/patient/check_parts.h"
#include "geometry/vec.h"
#include <string.h>

enum { SAMPLES = 1000 };

typedef struct parts {
    const surface *mesh;
    const char *const *name;
    nearest *const *tree; /* NULL: not there */
    bool closed[CASE_SURFACE_COUNT];
    double middle[CASE_SURFACE_COUNT][3], size_mm[CASE_SURFACE_COUNT]; /* of the box */
} parts;

static const char *word(int part)
{
    static const char *const words[CASE_SURFACE_COUNT] = {[CASE_SKIN] = "skin",
                                                          [CASE_SKULL] = "skull",
                                                          [CASE_MANDIBLE] = "mandible",
                                                          [CASE_UPPER_TEETH] = "upper teeth",
                                                          [CASE_LOWER_TEETH] = "lower teeth"};
    return words[part];
}

void check_trees(const surface mesh[CASE_SURFACE_COUNT], const char *const name[CASE_SURFACE_COUNT],
                 nearest *tree[CASE_SURFACE_COUNT], issue_list *issues)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        err e = {0};
        tree[i] = NULL;
        if (mesh[i].triangle_count && !nearest_create(&mesh[i], &tree[i], &e))
            issue_add_err(issues, ISSUE_ERROR, &e, name[i]);
    }
}

static void measure(parts *p)
{
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        double low[3], high[3];
        int32_t open, crowded;
        if (!p->tree[i]) continue;
        surface_edge_census(&p->mesh[i], &open, &crowded);
        p->closed[i] = !open && !crowded;
        surface_bounds(&p->mesh[i], low, high);
        p->size_mm[i] = vec_distance(low, high);
        for (int c = 0; c < 3; c++) p->middle[i][c] = (low[c] + high[c]) / 2;
    }
}

static bool is_same(const surface *a, const surface *b)
{
    size_t bytes = 3 * (size_t)a->vertex_count * sizeof *a->xyz;
    return a->triangle_count && a->triangle_count == b->triangle_count && a->vertex_count == b->vertex_count &&
           !memcmp(a->xyz, b->xyz, bytes);
}

/* One file, or two copies of it, for two parts. */
static void check_same(const parts *p, issue_list *issues)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        for (int k = 0; k < i; k++)
            if (is_same(&p->mesh[k], &p->mesh[i]))
                issue_add(issues, ISSUE_ERROR, ERR_INPUT, p->name[i], 0, NULL,
                          "is one surface for two parts, %s and %s: which is it?", word(k), word(i));
}

/* Six times the volume about the middle: its sign tells the side that most triangles show, also of open surfaces. */
static bool faces_inwards(const surface *s)
{
    double low[3], high[3], middle[3], sum = 0;
    surface_bounds(s, low, high);
    for (int c = 0; c < 3; c++) middle[c] = (low[c] + high[c]) / 2;
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        sum += vec_six_volume(middle, s->xyz + 3 * (size_t)v[0], s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[2]);
    }
    return sum < 0;
}

/* One surface that faces inwards is a slip of its maker; all of them are what a mirrored head looks like. */
static void check_facing(const parts *p, issue_list *issues)
{
    int there = 0, inward = 0;
    bool in[CASE_SURFACE_COUNT] = {0};
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        if (!p->mesh[i].triangle_count) continue;
        in[i] = faces_inwards(&p->mesh[i]);
        there++;
        inward += in[i];
    }
    if (inward > 1 && inward == there) {
        issue_add(issues, ISSUE_WARNING, ERR_NONE, p->name[CASE_SKIN], 0, NULL,
                  "all %d surfaces face inwards, as those of a mirrored head do: is its left side really the left one "
                  "(+x)? They will be turned outwards, which does not mirror them back",
                  there);
        return;
    }
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (in[i])
            issue_add(issues, ISSUE_INFO, ERR_NONE, p->name[i], 0, NULL,
                      "the triangles face inwards; they will be turned");
}

static void check_above(const parts *p, int upper, int lower, issue_list *issues)
{
    const double least_mm = 2;
    if (!p->tree[upper] || !p->tree[lower]) return;
    double above = p->middle[upper][2] - p->middle[lower][2];
    if (above < -least_mm)
        issue_add(issues, ISSUE_ERROR, ERR_GEOMETRY, p->name[lower], 0, NULL,
                  "the part called %s lies %.0f mm above the part called %s: are they exchanged, or the labels another "
                  "tool's?",
                  word(lower), -above, word(upper));
}

/* Of a part that is larger than the skull it is not the axes that are wrong. */
static bool check_frame_of_jaws(const parts *p, issue_list *issues)
{
    static const case_surface smaller[] = {CASE_MANDIBLE, CASE_UPPER_TEETH, CASE_LOWER_TEETH};
    if (!p->tree[CASE_SKULL] || !p->tree[CASE_MANDIBLE]) return true;
    for (int i = 0; i < 3; i++)
        if (p->tree[smaller[i]] && p->size_mm[smaller[i]] > p->size_mm[CASE_SKULL]) return true;
    bool above = p->middle[CASE_SKULL][2] < p->middle[CASE_MANDIBLE][2];
    return check_axes(&p->mesh[CASE_SKULL], &p->mesh[CASE_MANDIBLE], p->tree[CASE_MANDIBLE], above,
                      p->name[CASE_MANDIBLE], issues);
}

/* Share of the vertices of a that lie on or in b. */
static double share_within(const parts *p, int a, int b)
{
    const double on_mm = 0.3;
    const surface *s = &p->mesh[a];
    int count = s->vertex_count < SAMPLES ? s->vertex_count : SAMPLES, within = 0;
    for (int k = 0; k < count; k++) {
        const double *x = s->xyz + 3 * ((int64_t)k * s->vertex_count / count);
        within += nearest_point(p->tree[b], x, NULL, NULL) < on_mm || (p->closed[b] && nearest_inside(p->tree[b], x));
    }
    return (double)within / count;
}

static void check_twice(const parts *p, int bone, int in, issue_list *issues)
{
    const double most = 0.5; /* joints and teeth that touch are a few per cent */
    if (!p->tree[bone] || !p->tree[in] || is_same(&p->mesh[bone], &p->mesh[in])) return; /* told before */
    double share = share_within(p, bone, in);
    if (share > most)
        issue_add(issues, ISSUE_ERROR, ERR_GEOMETRY, p->name[in], 0, NULL,
                  "holds the %s too (%.0f %% of it lies in the %s): it would stay where it is as well as move; cut it "
                  "out of this surface",
                  word(bone), 100 * share, word(in));
}

/* A bone touches the skin nowhere but at a tooth or two. */
static void check_skin_apart(const parts *p, int bone, issue_list *issues)
{
    const double on_mm = 0.1, most = 0.5;
    const surface *s = &p->mesh[bone];
    int count = s->vertex_count < SAMPLES ? s->vertex_count : SAMPLES, on = 0;
    for (int k = 0; k < count; k++) {
        const double *x = s->xyz + 3 * ((int64_t)k * s->vertex_count / count);
        on += nearest_point(p->tree[CASE_SKIN], x, NULL, NULL) < on_mm;
    }
    if (on > most * count)
        issue_add(
            issues, ISSUE_ERROR, ERR_GEOMETRY, p->name[bone], 0, NULL,
            "%d %% of the %s is the skin's own surface: is this the skin's file, or does the skin's file hold the "
            "bone too?",
            100 * on / count, word(bone));
}

static double mean_distance(const parts *p, int a, int b)
{
    const surface *s = &p->mesh[a];
    int count = s->vertex_count < SAMPLES ? s->vertex_count : SAMPLES;
    double sum = 0;
    for (int k = 0; k < count; k++)
        sum += nearest_point(p->tree[b], s->xyz + 3 * ((int64_t)k * s->vertex_count / count), NULL, NULL);
    return sum / count;
}

static void check_teeth(const parts *p, int teeth, int own, int other, issue_list *issues)
{
    const double doubt_mm = 2;
    if (!p->tree[teeth] || !p->tree[own] || !p->tree[other]) return;
    if (p->size_mm[teeth] > p->size_mm[own])
        issue_add(issues, ISSUE_ERROR, ERR_GEOMETRY, p->name[teeth], 0, NULL,
                  "the %s measure %.0f mm corner to corner, more than the %s (%.0f mm): are the labels another tool's?",
                  word(teeth), p->size_mm[teeth], word(own), p->size_mm[own]);
    double to_own = mean_distance(p, teeth, own), to_other = mean_distance(p, teeth, other);
    if (to_own > to_other + doubt_mm)
        issue_add(
            issues, ISSUE_ERROR, ERR_GEOMETRY, p->name[teeth], 0, NULL,
            "the %s lie nearer to the %s than to the %s (%.1f and %.1f mm on average): are they the other arch's?",
            word(teeth), word(other), word(own), to_other, to_own);
}

void check_parts(const surface mesh[CASE_SURFACE_COUNT], const char *const name[CASE_SURFACE_COUNT],
                 nearest *const tree[CASE_SURFACE_COUNT], issue_list *issues)
{
    parts p = {.mesh = mesh, .name = name, .tree = tree};
    check_same(&p, issues);
    check_facing(&p, issues);
    measure(&p);
    if (check_frame_of_jaws(&p, issues)) {
        check_above(&p, CASE_SKULL, CASE_MANDIBLE, issues);
        check_above(&p, CASE_UPPER_TEETH, CASE_LOWER_TEETH, issues);
    }
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        if (!tree[i]) continue;
        check_pieces(&mesh[i], name[i], (case_surface)i, issues);
        check_slices(&mesh[i], name[i], (case_surface)i, issues);
        if (i != CASE_SKIN && tree[CASE_SKIN]) check_skin_apart(&p, i, issues);
    }
    check_twice(&p, CASE_MANDIBLE, CASE_SKULL, issues);
    check_twice(&p, CASE_SKULL, CASE_MANDIBLE, issues);
    check_teeth(&p, CASE_UPPER_TEETH, CASE_SKULL, CASE_MANDIBLE, issues);
    check_teeth(&p, CASE_LOWER_TEETH, CASE_MANDIBLE, CASE_SKULL, issues);
}
