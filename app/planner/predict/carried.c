#include "app/planner/predict/carried.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double reach_mm = 3; /* of a landmark from the surface it lies on */

static int nearest_part(const segment_trees *trees, const double p[3], double *gap)
{
    int best = CARRIED_BY_NONE;
    *gap = HUGE_VAL;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double d = trees->part[s] ? nearest_point(trees->part[s], p, NULL, NULL) : HUGE_VAL;
        if (d < *gap) {
            *gap = d;
            best = s;
        }
    }
    return best;
}

landmark_carriers landmark_carriers_find(const prepared *p, const segment_trees *trees)
{
    int32_t count = p->points.count;
    double *xyz = NEW_ARRAY(double, 3 * (size_t)count);
    landmark_carriers c = {.carrier = NEW_ARRAY(int, count)};
    for (int32_t i = 0; i < count; i++) vec_copy(p->points.point[i].xyz, xyz + 3 * (size_t)i);
    c.in_tissue = tissue_carry(&p->tissue, xyz, count, reach_mm);
    for (int32_t i = 0; i < count; i++) {
        const landmark_row *row = landmark_row_find(p->points.point[i].label);
        double gap;
        int part = nearest_part(trees, p->points.point[i].xyz, &gap);
        bool inside_head = row && row->on == CASE_SURFACE_COUNT;
        bool on_bone = !(row && row->on == CASE_SKIN) && (gap <= reach_mm || inside_head);
        c.carrier[i] = on_bone ? part : c.in_tissue.tet[i] >= 0 ? CARRIED_BY_SKIN : CARRIED_BY_NONE;
    }
    free(xyz);
    return c;
}

void landmark_carriers_free(landmark_carriers *c)
{
    free(c->carrier);
    embedding_free(&c->in_tissue);
    *c = (landmark_carriers){0};
}

carried_landmarks carry_landmarks(const prepared *p, const landmark_carriers *by, const plan_moves *moves,
                                  const double *u)
{
    int32_t count = p->points.count;
    carried_landmarks c = {.after = landmarks_copy(&p->points), .carrier = COPY_ARRAY(int, by->carrier, count)};
    double *from = NEW_ARRAY(double, 3 * (size_t)count), *to = NEW_ARRAY(double, 3 * (size_t)count);
    for (int32_t i = 0; i < count; i++) vec_copy(p->points.point[i].xyz, from + 3 * (size_t)i);
    embedding_apply(&by->in_tissue, &p->tissue.mesh, u, from, to);
    for (int32_t i = 0; i < count; i++) {
        if (by->carrier[i] >= 0)
            rigid_apply(&moves->move[by->carrier[i]], from + 3 * (size_t)i, c.after.point[i].xyz);
        else
            vec_copy(to + 3 * (size_t)i, c.after.point[i].xyz);
    }
    free(from);
    free(to);
    return c;
}

void carried_landmarks_free(carried_landmarks *c)
{
    landmarks_free(&c->after);
    free(c->carrier);
    *c = (carried_landmarks){0};
}

static bool move_of(const prepared *p, const carried_landmarks *c, const char *label, double mm[3])
{
    const landmark *from = landmarks_find(&p->points, label), *to = landmarks_find(&c->after, label);
    if (!from || !to) return false;
    double d[3];
    vec_sub(to->xyz, from->xyz, d);
    mm[0] = -vec_dot(d, p->frame.posterior);
    mm[1] = vec_dot(d, p->frame.up);
    mm[2] = vec_dot(d, p->frame.left);
    return true;
}

int soft_ratios(const prepared *p, const carried_landmarks *c, soft_ratio out[SOFT_RATIOS_MAX])
{
    static const char *const pair[SOFT_RATIOS_MAX][2] = {{"Pn", "U1"},      {"Sn", "A"}, {"A'", "A"},    {"Ls", "U1"},
                                                         {"Li_soft", "L1"}, {"B'", "B"}, {"Pg'", "Pog"}, {"Me'", "Me"}};
    int count = 0;
    for (int i = 0; i < SOFT_RATIOS_MAX; i++) {
        soft_ratio r = {.soft = pair[i][0], .hard = pair[i][1]};
        if (!strcmp(r.hard, "U1") && !landmarks_find(&p->points, "U1")) r.hard = "Pr"; /* the jaw has lost it */
        if (!strcmp(r.hard, "L1") && !landmarks_find(&p->points, "L1")) r.hard = "Id";
        if (!move_of(p, c, r.soft, r.soft_mm) || !move_of(p, c, r.hard, r.hard_mm)) continue;
        r.ratio = fabs(r.hard_mm[0]) >= 1 ? r.soft_mm[0] / r.hard_mm[0] : (double)NAN;
        out[count++] = r;
    }
    return count;
}
