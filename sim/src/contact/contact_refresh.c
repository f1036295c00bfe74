#include "geometry/parallel.h"
#include "sim/src/contact/contact_state.h"
#include <math.h>

enum { NODE_GRAIN = 16 };

typedef struct refresh_job {
    contact *c;
    const double *x;
} refresh_job;

static void refresh_body(int64_t begin, int64_t end, void *context)
{
    const refresh_job *job = context;
    contact *c = job->c;
    for (int64_t i = begin; i < end; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            contact_link *link = &c->link[l];
            link->delta_before = link->delta;
            if (link->left_out || link->guard) continue;
            if (is_lip(link))
                contact_refresh_lip(c, (int32_t)i, link, job->x);
            else
                contact_find_side(c, (int32_t)i, link, job->x);
        }
}

void contact_refresh(contact *c, const double *x)
{
    contact_move_lips(c, x);
    refresh_job job = {.c = c, .x = x};
    parallel_for(c->node_count, NODE_GRAIN, refresh_body, &job);
    c->report.refreshes++;
}

double contact_refresh_change(const contact *c)
{
    double worst = 0;
    for (int32_t l = 0; l < c->link_count; l++) worst = fmax(worst, fabs(c->link[l].delta - c->link[l].delta_before));
    return worst;
}
