#include "app/planner/patient/case_guess.h"
#include <stdio.h>
#include <string.h>

const double case_guess_told = 0.05;

void case_guess_read(const json_file *f, case_guess *io, issue_list *issues)
{
    const json_t *list = json_object_get(json_object_get(f->root, "guessed"), "landmarks");
    char got[96], place[64];
    if (!list) return;
    if (!json_is_array(list) || json_array_size(list) > CASE_GUESSED_POINTS_MAX) {
        fields_issue(f, "/guessed/landmarks", issues, "is %s; must be a list of at most %d labels",
                     fields_value_words(list, got, sizeof got), CASE_GUESSED_POINTS_MAX);
        return;
    }
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *one = json_array_get(list, i);
        const char *label = json_string_value(one);
        if (label && *label && strlen(label) < LANDMARK_LABEL_SIZE) {
            snprintf(io->point[io->point_count++], LANDMARK_LABEL_SIZE, "%s", label);
            continue;
        }
        snprintf(place, sizeof place, "/guessed/landmarks/%zu", i);
        fields_issue(f, place, issues, "is %s; must be a label of 1 to %d bytes",
                     fields_value_words(one, got, sizeof got), LANDMARK_LABEL_SIZE - 1);
    }
}

json_t *case_guess_json(const case_guess *g)
{
    json_t *o = json_object(), *points = json_array();
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        json_object_set_new(o, case_surface_name((case_surface)p), json_real(g->share[p]));
    json_object_set_new(o, "jaw_turned_deg", json_real(g->jaw_turned_deg));
    for (int i = 0; i < g->point_count; i++) json_array_append_new(points, json_string(g->point[i]));
    json_object_set_new(o, "landmarks", points);
    return o;
}

bool case_guess_is_any(const case_guess *g)
{
    bool any = g->jaw_turned_deg > 0 || g->point_count > 0;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) any = any || g->share[p] > 0;
    return any;
}

const char *case_guess_text(const case_guess *g, char *text, size_t size)
{
    size_t n = 0;
    *text = 0;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        if (g->share[p] > case_guess_told && n < size)
            n += (size_t)snprintf(text + n, size - n, "%s%s %.0f %%", n ? ", " : "", case_surface_name((case_surface)p),
                                  100 * g->share[p]);
    if (g->point_count && n < size)
        n += (size_t)snprintf(text + n, size - n, "%s%d landmark%s", n ? ", " : "", g->point_count,
                              g->point_count > 1 ? "s" : "");
    if (g->jaw_turned_deg > 0 && n < size)
        snprintf(text + n, size - n, "%sthe bite (mandible turned up by %.1f deg)", n ? ", " : "", g->jaw_turned_deg);
    return text;
}
