#include "app/planner/identity/head_landmarks.h"
#include "app/planner/identity/point_refine.h"
#include "app/planner/identity/template_get.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double around_mm = 12, open_mm = 3;
/* How far off points were on two scans with placed landmarks and on norm heads, for each sign of it. */
static const double least_doubt_mm = 0.7, without_definition_mm = 2.5, nothing_there_mm = 4, not_on_it_mm = 6,
                    share_of_move = 0.3;

void head_landmarks_free(head_landmarks *l)
{
    free(l->item);
    *l = (head_landmarks){0};
}

landmarks head_landmarks_points(const head_landmarks *l)
{
    landmarks out = {0};
    for (int32_t i = 0; i < l->count; i++) {
        landmarks_set(&out, l->item[i].label, l->item[i].at);
        out.point[out.count - 1].doubt_mm = l->item[i].doubt_mm;
    }
    return out;
}

/* Mean gap of the part's vertices around x; NAN where most of them have no target. */
static double gap_around(const head_template *t, const head_fit *f, int32_t part, const double x[3])
{
    const double *at = f->shape.part[part];
    double sum = 0;
    int32_t near = 0, with = 0;
    for (int32_t v = 0; v < t->part[part].vertex_count; v++) {
        if (vec_distance(at + 3 * (size_t)v, x) > around_mm) continue;
        near++;
        if (f->guessed[part][v]) continue;
        with++;
        sum += f->gap_mm[part][v];
    }
    return with > 0 && 2 * with >= near ? sum / with : (double)NAN;
}

/* Teeth that the scan has as part of the bone have no target of their own. */
static int32_t part_asked(const head_scan *s, int32_t part)
{
    if (part == CASE_UPPER_TEETH && !s->part[part].triangle_count) return CASE_SKULL;
    if (part == CASE_LOWER_TEETH && !s->part[part].triangle_count) return CASE_MANDIBLE;
    return part;
}

static double doubt_of(const head_landmark *l, const point_place *p)
{
    double sum = least_doubt_mm * least_doubt_mm + l->spread_mm * l->spread_mm;
    sum += share_of_move * l->moved_mm * share_of_move * l->moved_mm;
    sum += isnan(l->gap_mm) ? nothing_there_mm * nothing_there_mm : l->gap_mm * l->gap_mm;
    if (!l->by_definition) sum += without_definition_mm * without_definition_mm;
    if (l->on != CASE_SURFACE_COUNT && !p->found) sum += not_on_it_mm * not_on_it_mm;
    return sqrt(sum + p->doubt_mm * p->doubt_mm);
}

static case_surface surface_of(const char *label)
{
    const landmark_row *row = landmark_row_find(label);
    return row ? row->on : CASE_SURFACE_COUNT;
}

/* An open mouth has two points between the lips, a closed one has one. */
static void settle_mouth(head_landmarks *l)
{
    const head_landmark *upper = NULL, *lower = NULL;
    for (int32_t i = 0; i < l->count; i++) {
        if (!strcmp(l->item[i].label, "Stms")) upper = l->item + i;
        if (!strcmp(l->item[i].label, "Stmi")) lower = l->item + i;
    }
    l->mouth_open =
        upper && lower && upper->by_definition && lower->by_definition && upper->at[2] - lower->at[2] > open_mm;
    int32_t kept = 0;
    for (int32_t i = 0; i < l->count; i++) {
        bool single = !strcmp(l->item[i].label, "Stm"), pair = !single && !strncmp(l->item[i].label, "Stm", 3);
        if (!(l->mouth_open ? single : pair)) l->item[kept++] = l->item[i];
    }
    l->count = kept;
}

bool head_landmarks_find(const head_template *t, const head_scan *s, const head_fit *f, head_landmarks *out, err *e)
{
    landmarks carried = head_points(t, &f->shape);
    const landmark *lips = landmarks_find(&carried, "Stm");
    int32_t known = carried.count; /* the template's, in its order */
    if (lips) {
        double at[3];
        vec_copy(lips->xyz, at);
        landmarks_set(&carried, "Stms", at);
        landmarks_set(&carried, "Stmi", at);
    }
    point_place *place = NEW_ARRAY(point_place, carried.count);
    bool ok = point_refine(s, &carried, place, e);
    if (ok) {
        *out = (head_landmarks){.count = carried.count, .item = NEW_ARRAY(head_landmark, carried.count)};
        for (int32_t i = 0; i < carried.count; i++) {
            head_landmark *l = out->item + i;
            memcpy(l->label, carried.point[i].label, sizeof l->label);
            l->on = surface_of(l->label);
            vec_copy(place[i].at, l->at);
            l->moved_mm = place[i].moved_mm;
            l->spread_mm = place[i].spread_mm;
            l->by_definition = place[i].by_rule && place[i].found;
            l->gap_mm = gap_around(t, f, part_asked(s, i < known ? t->point[i].part : CASE_SKIN), carried.point[i].xyz);
            l->doubt_mm = doubt_of(l, place + i);
        }
        settle_mouth(out);
    }
    free(place);
    landmarks_free(&carried);
    return ok;
}

bool head_landmarks_place(const head_scan *s, const task *watch, head_landmarks *out, err *e)
{
    head_template t = {0};
    head_scan bare = *s;
    head_place place;
    head_fit fit = {0};
    head_fit_params p = head_fit_params_default();
    char told[256] = "";
    bare.points = (landmarks){0};
    if (!head_template_get(watch, &t, NULL, e)) return false;
    task_progress(watch, "place of the head", 0);
    bool ok = head_place_find(&t, &bare, watch, &place, told, e);
    if (ok && *told) ok = err_set(e, ERR_GEOMETRY, "%s", told);
    ok = ok && head_fit_from(&t, &bare, &p, &place, watch, &fit, e);
    if (ok) task_progress(watch, "landmarks", -1);
    ok = ok && head_landmarks_find(&t, &bare, &fit, out, e);
    head_fit_free(&fit);
    head_template_free(&t);
    return ok;
}
