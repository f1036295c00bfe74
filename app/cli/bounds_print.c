#include "app/cli/bounds_print.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_end(const audit *a, const control *x, const audit_bound *b, const char *end)
{
    char fine[32] = "-", reach[32] = "-";
    if (!isnan(b->fine)) snprintf(fine, sizeof fine, "%.2f", b->fine);
    if (b->feasible) snprintf(reach, sizeof reach, "%.2f", b->reach);
    printf("%-24s %-4s %8s %9s  ", x ? x->name : "", end, fine, reach);
    if (!b->feasible) {
        printf("nothing is feasible here: see pieces in audit.json\n");
        return;
    }
    const finding *f = b->ended ? &b->stop : &b->caution;
    if (!b->ended) {
        printf("no limit within the box\n");
        return;
    }
    const limit *l = &limit_default[f->limit];
    const double *stop = a->patient->limits[f->limit].stop;
    double end_value = f->value < stop[0] ? stop[0] : stop[1];
    printf("%s%s%s%s: %.4g beyond %.4g %s", f->limit >= LIMIT_SOLVED ? "soft tissue, " : "", l->what,
           *f->where ? ", " : "", f->where, f->value, end_value, l->unit);
    if (b->ray && b->ray->limited) printf(" (bone and teeth allow %.2f)", b->bones);
    printf("\n");
}

static void print_throughout(const audit *a)
{
    bool any = false;
    for (int l = 0; l < LIMIT_COUNT; l++) {
        if (a->throughout[l] <= LIMIT_FINE) continue;
        printf("%s%s (%s)", any ? "; " : "\nthroughout, whatever these controls do: ", limit_default[l].what,
               limit_level_name(a->throughout[l]));
        any = true;
    }
    if (any) printf("\n");
}

static bool print_not_judged(const audit *a, err *e)
{
    audit_gap gap[AUDIT_GAPS_MAX];
    int count;
    if (!audit_not_judged(a, gap, &count, e)) return false;
    printf("\nnot judged:\n");
    for (int i = 0; i < count; i++) { /* limits with the same reason stand in one line */
        bool last = i + 1 == count || strcmp(gap[i + 1].why, gap[i].why) != 0;
        printf("%s%s", gap[i].what, last ? ": " : "; ");
        if (last) printf("%s\n", gap[i].why);
    }
    return true;
}

static void print_maps(const audit *a)
{
    for (int i = 0; i < a->settings.request_count; i++) {
        const feasible_map *m = &a->map[i];
        if (!m->node_count) continue;
        char *name = audit_map_name(a, i, "");
        double all = (double)m->node_count / 100;
        printf("%s: %.0f %% fine, %.0f %% caution, %.0f %% stop; ", name, (double)m->level_count[VERDICT_FINE] / all,
               (double)m->level_count[VERDICT_CAUTION] / all, (double)m->level_count[VERDICT_STOP] / all);
        if (m->base_stopped)
            printf("the base itself is stopped\n");
        else if (!m->behind_count)
            printf("star-shaped about the base\n");
        else
            printf("not star-shaped: %lld feasible points lie behind infeasible ones, marked in the map\n",
                   (long long)m->behind_count);
        free(name);
    }
}

bool bounds_print(const audit *a, err *e)
{
    printf("%s: how far each control may go, all others %s%s\n\n", a->patient->name,
           *a->base.path ? "as in " : "unmoved", *a->base.path ? a->base.path : "");
    printf("%-24s %-4s %8s %9s  %s\n", "control", "end", "fine to", "feasible", "stopped by");
    for (int i = 0; i < a->settings.request_count; i++) {
        if (a->map[i].node_count) continue;
        for (int end = -1; end <= 1; end += 2) {
            audit_bound b;
            if (!audit_bound_of(a, i, end, &b, e)) return false;
            print_end(a, end < 0 ? &a->settings.control[a->settings.request[i].axis[0]] : NULL, &b,
                      end < 0 ? "low" : "high");
        }
    }
    print_throughout(a);
    if (!print_not_judged(a, e)) return false;
    if (a->tissue_asked)
        printf(
            "\nsoft tissue solved at %d points on the rim of what bone and teeth allow, of %lld they allow, and without its "
            "contact with bone: predict has it\n",
            a->tissue.count, (long long)audit_points_allowed(a));
    printf("\n");
    print_maps(a);
    return true;
}
