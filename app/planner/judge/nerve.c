/* The mandibular canal, as the sagittal split assumes it, against the proximal segments: bone that closes in on it. */
#include "app/planner/judge/parts.h"
#include "geometry/vec.h"
#include <string.h>

static const double mouth_mm = 5; /* of the canal behind: there the nerve comes from outside the bone */
static const segment_id plate[2] = {SEGMENT_PROXIMAL_LEFT, SEGMENT_PROXIMAL_RIGHT};

/* Points along the canal, evenly, from its corners, without its mouth. */
static int spread(const double *corner, int count, double out[3 * CANAL_POINTS_MAX])
{
    double length = 0;
    int n = 0;
    for (int i = 0; i + 1 < count; i++) length += vec_distance(corner + 3 * i, corner + 3 * (i + 1));
    const double step = (length - mouth_mm) / (CANAL_POINTS_MAX - 1);
    double next = mouth_mm, passed = 0;
    if (!(step > 0)) return 0;
    for (int i = 0; i + 1 < count; i++) {
        const double *a = corner + 3 * i, *b = a + 3;
        double part = vec_distance(a, b);
        for (; next <= passed + part && n < CANAL_POINTS_MAX; next += step, n++)
            for (int c = 0; c < 3; c++) out[3 * n + c] = a[c] + (next - passed) / part * (b[c] - a[c]);
        passed += part;
    }
    return n;
}

void judge_nerve_make(judge *j)
{
    static const segment_id piece[] = {SEGMENT_DISTAL, SEGMENT_PROXIMAL_LEFT, SEGMENT_PROXIMAL_RIGHT, SEGMENT_CHIN};
    if (!j->cut[1].there || !j->cut[2].there) return;
    surface jaw = {0};
    for (int i = 0; i < 4; i++) {
        surface both = surface_joined(&jaw, &j->prepared->segments.part[piece[i]]);
        surface_free(&jaw);
        jaw = both;
    }
    for (int k = 0; k < 2; k++) {
        double corner[3 * CANAL_POINTS_MAX];
        int count = osteotomy_canal(&jaw, &j->prepared->points, &j->patient->cuts, k ? -1 : 1, corner);
        j->canal_count[k] = count > 1 ? spread(corner, count, j->canal[k]) : 0;
    }
    surface_free(&jaw);
}

void judge_nerve(const judge *j, const plan_moves *m, judgement *out)
{
    static const char *const side[2] = {"left", "right"};
    for (int k = 0; k < 2; k++) {
        if (!j->canal_count[k]) {
            judgement_add(out, j->patient, LIMIT_NERVE_ROOM, side[k], (double)NAN, false,
                          "no sagittal split, or its landmarks are missing");
            continue;
        }
        const clash_body *bone = j->body[plate[k]];
        double least = HUGE_VAL, place[3] = {0};
        rigid rel;
        (void)judge_relative(m, plate[k], SEGMENT_DISTAL, &rel);
        for (int i = 0; i < j->canal_count[k]; i++) {
            double p[3];
            rigid_apply(&rel, j->canal[k] + 3 * i, p);
            double d = solid_grid_inside(clash_body_grid(bone), p)
                           ? 0
                           : distance_tree_between(clash_body_tree(bone), p, 0, least, NULL);
            if (d >= least) continue;
            least = d;
            vec_copy(p, place);
        }
        finding *f = judgement_add(out, j->patient, LIMIT_NERVE_ROOM, side[k], least, true, NULL);
        f->segment_a = SEGMENT_DISTAL;
        f->segment_b = plate[k];
        f->has_place = true;
        rigid_apply(&m->move[plate[k]], place, f->place);
    }
}
