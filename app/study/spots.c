#include "app/study/spots.h"
#include <stdio.h>

/* -1: not in the pictures. */
static int series_of(const study_table *t, int i)
{
    const study_rung *r = t->run[i].rung;
    if (!(t->error[i].mean_mm > 0) || r->contact) return -1;
    switch (r->group) {
    case GROUP_MESH: return PLAIN;
    case GROUP_ELEMENT: return AVERAGED;
    case GROUP_TOLERANCE: return TOLERANCES;
    case GROUP_SCENE: return SCENES;
    default: return -1;
    }
}

static void name_spot(const study_rung *r, spot *s)
{
    if (s->series == TOLERANCES)
        snprintf(s->label, sizeof s->label, "%.0e", r->rel_tol);
    else if (s->series == SCENES)
        s->label[0] = 0;
    else
        snprintf(s->label, sizeof s->label, r->refined ? "x%g /%d" : "x%g", r->coarsening, 1 << r->refined);
}

/* Errors to the reference. Over size: meshes made anew alone. */
static int collect(const study_table *t, bool over_time, spot s[SPOTS_MAX])
{
    int count = 0;
    for (int i = 0; i < t->count && count < SPOTS_MAX; i++) {
        int which = series_of(t, i);
        const study_result *r = &t->run[i].result;
        if (which < 0 || (!over_time && (which > AVERAGED || t->run[i].rung->refined))) continue;
        s[count] = (spot){over_time ? r->wall_s : r->size_mm, t->error[i].mean_mm, i, which, ""};
        name_spot(t->run[i].rung, &s[count++]);
    }
    return count;
}

/* A mesh and its halves against the finest of them: the discretisation alone. */
static int collect_halved(const study_table *t, spot s[SPOTS_MAX], int count)
{
    for (int i = 0; i < t->count && count < SPOTS_MAX; i++) {
        const study_rung *r = t->run[i].rung;
        int finest = i;
        for (int k = 0; k < t->count; k++) {
            const study_rung *o = t->run[k].rung;
            if (o->group == GROUP_MESH && t->run[k].result.solved && o->coarsening == r->coarsening &&
                o->refined > t->run[finest].rung->refined)
                finest = k;
        }
        if (r->group != GROUP_MESH || finest == i || finest == study_reference) continue;
        s[count] = (spot){t->run[i].result.size_mm, study_compare(&t->run[i], &t->run[finest]).mean_mm, i, HALVED, ""};
        name_spot(r, &s[count]);
        if (s[count].y > 0) count++;
    }
    return count;
}

int spots_collect(const study_table *t, bool over_time, spot s[SPOTS_MAX])
{
    int count = collect(t, over_time, s);
    return over_time ? count : collect_halved(t, s, count);
}
