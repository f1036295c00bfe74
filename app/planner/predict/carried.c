#include "app/planner/predict/carried.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double reach_mm = 3; /* of a landmark from the surface it lies on */

static const landmark_row *row_of(const char *label)
{
    for (int i = 0; i < landmark_row_count; i++)
        if (!strcmp(landmark_rows[i].label, label)) return &landmark_rows[i];
    return NULL;
}

static int nearest_part(nearest *const tree[SEGMENT_COUNT], const double p[3], double *gap)
{
    int best = CARRIED_BY_NONE;
    *gap = HUGE_VAL;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double d = tree[s] ? nearest_point(tree[s], p, NULL, NULL) : HUGE_VAL;
        if (d < *gap) {
            *gap = d;
            best = s;
        }
    }
    return best;
}

bool carry_landmarks(const prepared *p, const plan_moves *moves, const double *u, carried_landmarks *out, err *e)
{
    nearest *tree[SEGMENT_COUNT] = {0};
    bool ok = true;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (p->segments.part[s].triangle_count) ok = ok && nearest_create(&p->segments.part[s], &tree[s], e);
    int32_t count = p->points.count;
    carried_landmarks c = {.after = landmarks_copy(&p->points), .carrier = NEW_ARRAY(int, count)};
    for (int32_t i = 0; ok && i < count; i++) {
        const landmark *from = &p->points.point[i];
        const landmark_row *row = row_of(from->label);
        double gap, *to = c.after.point[i].xyz;
        int part = nearest_part(tree, from->xyz, &gap);
        bool inside_head = row && row->on == CASE_SURFACE_COUNT;
        if (!(row && row->on == CASE_SKIN) && (gap <= reach_mm || inside_head)) {
            c.carrier[i] = part;
            rigid_apply(&moves->move[part], from->xyz, to);
            continue;
        }
        embedding at = tissue_carry(&p->tissue, from->xyz, 1, reach_mm);
        c.carrier[i] = at.tet[0] >= 0 ? CARRIED_BY_SKIN : CARRIED_BY_NONE;
        embedding_apply(&at, &p->tissue.mesh, u, from->xyz, to);
        embedding_free(&at);
    }
    for (int s = 0; s < SEGMENT_COUNT; s++) nearest_destroy(&tree[s]);
    if (!ok) {
        carried_landmarks_free(&c);
        return false;
    }
    *out = c;
    return true;
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
        if (!move_of(p, c, r.soft, r.soft_mm) || !move_of(p, c, r.hard, r.hard_mm)) continue;
        r.ratio = fabs(r.hard_mm[0]) >= 1 ? r.soft_mm[0] / r.hard_mm[0] : (double)NAN;
        out[count++] = r;
    }
    return count;
}
