/* Crowns against crowns. In most cases the teeth are one surface with their jaw, so that the crowns are what lies
 * within a crown's height of the plane through the cusps, in front of the last molar. */
#include "app/planner/judge/parts.h"
#include "geometry/incisor.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double crown_mm = 7, beyond_mm = 5;         /* of the cusps' plane, towards the gum and away from it */
static const double behind_u6_mm = 18, behind_l7_mm = 3; /* mesiobuccal cusp of the first molar to the arch's end */
static const double touch_mm = 0.3, sight_mm = 10, bite_spacing_mm = 0.8, apart_mm = 5;

/* The plane of the cusps (up: towards the upper teeth) and how far back the arch goes. False without any tooth. */
static bool cusp_plane(const prepared *p, bool upper, double at[3], double up[3], double *end)
{
    const landmarks *l = &p->points;
    incisor front;
    molar first[2];
    if (!incisor_find(l, upper, &front) || !molar_find(l, upper, 1, &first[0]) || !molar_find(l, upper, -1, &first[1]))
        return false;
    if (front.stands_in && first[0].on_crest && first[1].on_crest) return false;
    double back[3], across[3], local[3];
    for (int c = 0; c < 3; c++) back[c] = (first[0].xyz[c] + first[1].xyz[c]) / 2 - front.xyz[c];
    vec_sub(first[0].xyz, first[1].xyz, across);
    vec_cross(across, back, up);
    if (!(vec_normalize(up) > 0)) return false;
    vec_copy(front.xyz, at);
    *end = -HUGE_VAL;
    for (int k = 0; k < 2; k++) {
        const landmark *last = upper ? NULL : landmarks_find(l, k ? "L7_R" : "L7_L");
        const double reach = upper ? behind_u6_mm : last ? behind_l7_mm : behind_u6_mm + 2;
        head_frame_to_local(&p->frame, last ? last->xyz : first[k].xyz, local);
        *end = fmax(*end, local[1] + reach);
    }
    return true;
}

uint8_t *judge_crowns(const prepared *p, segment_id bone, const char **why)
{
    bool upper = bone == SEGMENT_MAXILLA;
    const surface *s = &p->segments.part[bone];
    double at[3], up[3], end;
    if (!cusp_plane(p, upper, at, up, &end)) {
        *why =
            upper
                ? "the upper crowns are not known, or there are none: needs U1 and, on both sides, U6 or the next tooth"
                : "the lower crowns are not known, or there are none: needs L1 and, on both sides, L6 or the next tooth";
        return NULL;
    }
    uint8_t *kind = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        kind[t] = KIND_BONE;
        for (int k = 0; k < 3; k++) {
            const double *x = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
            double d[3], local[3];
            vec_sub(x, at, d);
            head_frame_to_local(&p->frame, x, local);
            double height = vec_dot(d, up) * (upper ? 1 : -1); /* towards the gum */
            if (height < crown_mm && height > -beyond_mm && local[1] < end) kind[t] = KIND_CROWN;
        }
    }
    return kind;
}

/* Points of the lower crowns that look up, thinned. */
static void find_bite_points(judge *j)
{
    const prepared *p = j->prepared;
    const surface *s = &p->segments.part[SEGMENT_DISTAL];
    const char *why;
    uint8_t *kind = judge_crowns(p, SEGMENT_DISTAL, &why);
    if (!kind) return;
    j->bite = NEW_ARRAY(double, 3 * (size_t)s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const double *x[3];
        double a[3], b[3], n[3], middle[3] = {0};
        if (kind[t] != KIND_CROWN) continue;
        for (int k = 0; k < 3; k++) {
            x[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
            vec_axpy(middle, 1 / 3.0, x[k], middle);
        }
        vec_sub(x[1], x[0], a);
        vec_sub(x[2], x[0], b);
        vec_cross(a, b, n);
        if (vec_dot(n, p->frame.up) < 0.2 * vec_norm(n)) continue;
        bool near = false;
        for (int32_t i = 0; i < j->bite_count && !near; i++)
            near = vec_distance(j->bite + 3 * (size_t)i, middle) < bite_spacing_mm;
        if (!near) vec_copy(middle, j->bite + 3 * (size_t)j->bite_count++);
    }
    free(kind);
}

/* Places, at least apart_mm from each other, where a lower crown is at an upper one. */
static int count_contacts(const judge *j, const rigid *rel)
{
    enum { MOST = 64 };
    double found[MOST][3];
    int count = 0;
    const solid_grid *grid = clash_body_grid(j->body[SEGMENT_MAXILLA]);
    const distance_tree *tree = clash_body_tree(j->body[SEGMENT_MAXILLA]);
    for (int32_t i = 0; i < j->bite_count && count < MOST; i++) {
        double p[3];
        bool known = false;
        rigid_apply(rel, j->bite + 3 * (size_t)i, p);
        for (int k = 0; k < count && !known; k++) known = vec_distance(found[k], p) < apart_mm;
        if (known) continue;
        double clear;
        if (!solid_grid_look(grid, p, &clear) && !(clear < touch_mm && distance_tree_within(tree, p, touch_mm)))
            continue;
        vec_copy(p, found[count++]);
    }
    return count;
}

void judge_teeth_make(judge *j)
{
    if (!j->body[SEGMENT_MAXILLA] || !j->body[SEGMENT_DISTAL])
        j->no_crowns = "the case cuts no Le Fort I, so that the upper teeth are not apart from the skull";
    if (j->no_crowns || j->jaws_apart) return;
    rigid rest = rigid_identity();
    find_bite_points(j);
    j->tooth_rest_mm = clash_depth(j->body[SEGMENT_MAXILLA], j->body[SEGMENT_DISTAL], &rest, KIND_CROWN).mm;
    j->tooth_rest_places = count_contacts(j, &rest);
}

void judge_teeth(const judge *j, const plan_moves *m, judgement *out)
{
    static const char *const apart = "the scan shows the jaws apart, so that the plan's bite is not known";
    const char *why = j->no_crowns ? j->no_crowns : j->jaws_apart ? apart : NULL;
    if (why) {
        judgement_add(out, j->patient, LIMIT_TOOTH_OVERLAP, "", (double)NAN, false, why);
        judgement_add(out, j->patient, LIMIT_BITE_CONTACTS, "", (double)NAN, false, why);
        return;
    }
    rigid rel;
    clash_spot spot = {0};
    if (judge_relative(m, SEGMENT_MAXILLA, SEGMENT_DISTAL, &rel))
        spot = clash_depth(j->body[SEGMENT_MAXILLA], j->body[SEGMENT_DISTAL], &rel, KIND_CROWN);
    double value = fmax(spot.mm - j->tooth_rest_mm, 0);
    if (!spot.found) {
        spot = clash_distance(j->body[SEGMENT_MAXILLA], j->body[SEGMENT_DISTAL], &rel, KIND_CROWN, sight_mm);
        value = spot.mm > 0 ? -spot.mm : 0;
    }
    finding *f = judgement_add(out, j->patient, LIMIT_TOOTH_OVERLAP, "", value, false,
                               j->tooth_rest_mm > 0.1 ? "beyond the overlap that the scan itself shows" : NULL);
    f->segment_a = SEGMENT_MAXILLA;
    f->segment_b = SEGMENT_DISTAL;
    f->has_place = spot.found;
    if (spot.found) rigid_apply(&m->move[SEGMENT_MAXILLA], spot.place, f->place);
    int places = count_contacts(j, &rel);
    bool lost = !places && j->tooth_rest_places;
    f = judgement_add(out, j->patient, LIMIT_BITE_CONTACTS, "", places, false,
                      lost ? "no tooth meets another, as they do in the scan: the bite does not fit" : NULL);
    if (lost) judgement_lead(out);
    f->segment_a = SEGMENT_MAXILLA;
    f->segment_b = SEGMENT_DISTAL;
}
