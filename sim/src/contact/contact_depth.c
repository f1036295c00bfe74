/* What touches, how deep and with what force. */
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <math.h>
#include <string.h>

static const double covered = 0.5; /* of C: contacts that count for the depth */
static const double stiffening_step = 4;
static const double asked_mm = 1; /* gap by the smooth distance of what may be deep by the exact one */

bool contact_is_pinched(const contact *c, int32_t i)
{
    for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
        for (int32_t k = c->link_start[i]; k < l; k++)
            if (c->link[l].delta > 0 && c->link[k].delta > 0 && c->link[l].collider != c->link[k].collider &&
                vec_dot(c->link[l].force, c->link[k].force) < 0)
                return true;
    return false;
}

static double depth_of(const contact_link *link)
{
    if (!(link->delta > 0) || link->cover < covered || link->guard) return 0;
    return fmax(0, link->depth_from_mm - link->gap);
}

bool contact_stiffen(contact *c)
{
    bool any = false;
    contact_mark(c);
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            if (depth_of(&c->link[l]) > c->setup.params.depth_limit_mm && !contact_is_pinched(c, i)) {
                c->link[l].stiffening *= stiffening_step;
                c->link[l].delta_here = c->link[l].delta / sqrt(stiffening_step); /* where the force is what it was */
                c->link[l].delta_factored = 0;
                any = true;
            }
    c->report.stiffenings += any;
    return any;
}

/* By how much the smooth distance has to be less for the node, at x, to be as deep as it is; 0: it is not too deep. */
static double find_off(const contact *c, int32_t i, const contact_link *link, const double *x)
{
    const bone_shape *shape = is_lip(link) ? NULL : c->setup.shape[link->collider];
    double limit = c->setup.params.exact_limit_mm, at[3];
    if (!shape || !shape->exact || !link->near || link->guard || link->flat) return 0;
    if (!(link->gap < asked_mm) || contact_is_pinched(c, i)) return 0;
    rigid_apply(&c->back[link->collider], x + 3 * (size_t)c->node[i], at);
    double exact = shape->exact(shape->context, at);
    if (!(exact < -limit)) return 0;
    double rest = shape->exact(shape->context, c->rest_xyz + 3 * (size_t)c->node[i]);
    return exact < fmin(0, rest) - limit ? fmax(0, link->gap - exact) : 0;
}

bool contact_correct(contact *c, const double *x)
{
    bool any = false;
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            double off = find_off(c, i, &c->link[l], x);
            if (!(off > 0)) continue;
            c->link[l].off_mm += off;
            any = true;
        }
    c->report.corrections += any;
    return any;
}

double contact_force(const contact *c)
{
    double square = 0;
    for (int32_t l = 0; l < c->link_count; l++) square += vec_dot(c->link[l].force, c->link[l].force);
    return sqrt(square);
}

contact_report contact_measure(const contact *c)
{
    contact_report r = c->report;
    r.on = true;
    r.held = c->setup.held;
    r.nodes = c->node_count;
    r.links = c->link_count;
    r.active_nodes = r.lost = r.pinched = r.guards = 0;
    r.depth_mm = r.bone_area_mm2 = r.lip_area_mm2 = r.pressure_kpa = r.energy_uj = 0;
    memset(r.bone_force_mn, 0, sizeof r.bone_force_mn);
    for (int32_t i = 0; i < c->node_count; i++) {
        bool bone = false, lip = false, pinched = contact_is_pinched(c, i);
        r.pinched += pinched;
        r.energy_uj += c->energy[i];
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            const contact_link *link = &c->link[l];
            if (!pinched) r.depth_mm = fmax(r.depth_mm, depth_of(link));
            r.lost += link->lost;
            r.guards += link->near && link->guard;
            if (!is_lip(link)) vec_sub(r.bone_force_mn[link->collider], link->force, r.bone_force_mn[link->collider]);
            double pressure = vec_norm(link->force) / c->area[i] * (is_lip(link) ? 2 : 1);
            r.pressure_kpa = fmax(r.pressure_kpa, pressure);
            /* touching begins where the force is worth a name */
            if (!(pressure > 1e-6 * c->k * c->setup.params.depth_mm * c->setup.params.depth_mm)) continue;
            bone |= !is_lip(link);
            lip |= is_lip(link);
        }
        r.active_nodes += bone || lip;
        if (bone) r.bone_area_mm2 += c->area[i];
        if (lip) r.lip_area_mm2 += c->area[i] / 2; /* both sides */
    }
    return r;
}
