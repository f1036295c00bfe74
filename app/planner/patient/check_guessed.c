#include "app/planner/patient/case_guess.h"
#include "app/planner/patient/check.h"
#include <stdio.h>
#include <string.h>

static bool is_guessed(const case_guess *g, const char *label)
{
    for (int i = 0; i < g->point_count; i++)
        if (!strcmp(g->point[i], label)) return true;
    return false;
}

void check_guessed(const case_file *c, const check_found *found, issue_list *issues)
{
    const case_guess *g = &c->guessed;
    char names[600] = "";
    int32_t count = 0;
    size_t n = 0;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        if (g->share[p] > case_guess_told)
            issue_add(issues, ISSUE_WARNING, ERR_NONE, *c->surface[p] ? c->surface[p] : c->path, 0, NULL,
                      "%.0f %% of it is guessed, not from the scan", 100 * g->share[p]);
    if (g->jaw_turned_deg > 0)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, c->path, 0, "guessed.jaw_turned_deg",
                  "the mandible was turned up by %.1f deg to close an open mouth: the bite is guessed",
                  g->jaw_turned_deg);
    for (int32_t i = 0; i < found->points.count; i++) {
        const char *label = found->points.point[i].label;
        if (!is_guessed(g, label)) continue;
        if (n < sizeof names) n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", count ? ", " : "", label);
        count++;
    }
    if (count)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, c->landmarks, 0, NULL, "%d of %d are guessed, not from the scan: %s",
                  count, found->points.count, names);
}
