/* Genioplasty: a plane below mental foramina and root tips that leaves the lower border near the molars, in
 * the mandible's own frame. Parallel to the lower occlusal plane, and tilted only as far as it must be to
 * leave the border between the first molar and the second. */
#include "geometry/mem.h"
#include "geometry/src/cut/cut_plan.h"
#include "geometry/vec.h"
#include <stdio.h>

static const double margin_mm = 15, clear_mm = 0.5;
static const double least_height_mm = 6, least_apex_mm = 1, step_mm = 0.5; /* below this no plate can be screwed on */
static const double behind_l6_mm = 17;                                     /* the second molar ends about here */

typedef struct chin {
    const surface *mandible;
    head_frame frame;
    outline lower[2];     /* lower border, left and right */
    double apex_mm;       /* clearance to root tips; reduced where the chin would be too thin for a plate */
    double y0, z0, slope; /* the plane: z = z0 + slope (y - y0) */
    double me[3], l6[2][3];
    double from, to; /* y between which the plane may leave the border */
} chin;

static double plane_z(const chin *c, double y) { return c->z0 + c->slope * (y - c->y0); }

static double border_height(const chin *c, int side, double y) { return outline_at(c->lower + (side < 0), y); }

/* Where, going backwards from `from`, the lower border rises above the plane; HUGE_VAL if not before `to`. */
static double exit_y(const chin *c, int side, double from, double to)
{
    for (double y = from; y <= to; y += 0.5)
        if (border_height(c, side, y) > plane_z(c, y) + clear_mm) return y;
    return HUGE_VAL;
}

typedef struct guard_point { /* the plane passes at least `below` under it */
    char name[64];
    double local[3], below;
    bool estimated, root;
} guard_point;

static int guards(const osteotomy_input *in, const osteotomy_params *p, const head_frame *f, guard_point out[8],
                  cut_report *r)
{
    int count = 0;
    for (int side = 1; side >= -1; side -= 2) {
        char label[LANDMARK_LABEL_SIZE];
        const char *word = side > 0 ? "left" : "right";
        guard_point *g = out + count;
        *g = (guard_point){.below = p->below_mental_foramen_mm};
        snprintf(g->name, sizeof g->name, "mental foramen %s", word);
        landmark_local(in->points, side_label(label, "MF", side), f, g->local);
        count++;
        g = out + count;
        *g = (guard_point){.below = p->apex_clearance_mm, .root = true};
        snprintf(g->name, sizeof g->name, "lower canine apex %s", word);
        if (landmark_local(in->points, side_label(label, "L3_apex", side), f, g->local)) {
            count++;
        } else if (landmark_local(in->points, side_label(label, "L3", side), f, g->local)) {
            g->local[2] -= LOWER_3_MM;
            g->estimated = true;
            count++;
        } else {
            report_warning(r, "%s is missing: the chin cut is not checked against the %s canine", label, word);
        }
    }
    guard_point *g = out + count;
    *g = (guard_point){.name = "lower incisor apex", .below = p->apex_clearance_mm, .root = true};
    if (landmark_local(in->points, "L1_apex", f, g->local)) return count + 1;
    if (!landmarks_find(in->points, "L1")) {
        report_warning(r, "L1 is missing: the chin cut is not checked against the roots of the incisors");
        return count;
    }
    landmark_local(in->points, "L1", f, g->local);
    g->local[2] -= LOWER_1_MM;
    g->estimated = true;
    return count + 1;
}

/* Highest plane of this slope that respects every guard, roots by apex_mm. */
static void settle(chin *c, const guard_point *g, int count)
{
    double z = HUGE_VAL;
    for (int i = 0; i < count; i++) {
        double below = g[i].root ? c->apex_mm : g[i].below;
        z = fmin(z, g[i].local[2] - below * sqrt(1 + c->slope * c->slope) - c->slope * (g[i].local[1] - c->y0));
    }
    c->z0 = z;
}

/* The plane leaves the border between the molars on both sides; else the slope that just does, by bisection:
 * a steeper rise backwards leaves later. */
static double mean_exit(chin *c, const guard_point *g, int count, double from, double to)
{
    settle(c, g, count);
    double left = exit_y(c, 1, from, to), right = exit_y(c, -1, from, to);
    return (left + right) / 2;
}

static void place(chin *c, const guard_point *g, int count, double first, double last, double from, double to)
{
    c->slope = 0;
    double leave = mean_exit(c, g, count, from, to);
    if (leave >= first && leave <= last) return;
    double want = leave < first ? first : last, low = -0.6, high = 0.6;
    for (int i = 0; i < 24; i++) {
        c->slope = (low + high) / 2;
        if (mean_exit(c, g, count, from, to) < want)
            low = c->slope;
        else
            high = c->slope;
    }
    c->slope = low;
    mean_exit(c, g, count, from, to);
}

static void locate(chin *c, const osteotomy_input *in)
{
    double go[2][3], mf[3];
    landmark_local(in->points, "Me", &c->frame, c->me);
    landmark_local(in->points, "L6_L", &c->frame, c->l6[0]);
    landmark_local(in->points, "L6_R", &c->frame, c->l6[1]);
    landmark_local(in->points, "Go_L", &c->frame, go[0]);
    landmark_local(in->points, "Go_R", &c->frame, go[1]);
    landmark_local(in->points, "MF_L", &c->frame, mf);
    c->y0 = mf[1];
    c->from = c->y0 + 2;
    c->to = fmin(go[0][1], go[1][1]) - 5;
}

/* The plane, as far from the root tips as leaves a chin that can hold a plate. */
static void choose_plane(chin *c, const osteotomy_params *p, const guard_point *list, int count, cut_report *r)
{
    double first = (c->l6[0][1] + c->l6[1][1]) / 2, last = first + behind_l6_mm;
    for (c->apex_mm = p->apex_clearance_mm;; c->apex_mm = fmax(c->apex_mm - step_mm, least_apex_mm)) {
        place(c, list, count, first, last, c->from, c->to);
        if (plane_z(c, c->me[1]) - c->me[2] >= least_height_mm || c->apex_mm <= least_apex_mm) break;
    }
    if (c->apex_mm < p->apex_clearance_mm)
        report_warning(r,
                       "the chin is low: the cut comes within %.1f mm of the root tips, so that %.1f mm of "
                       "chin are left to "
                       "hold a plate",
                       c->apex_mm, plane_z(c, c->me[1]) - c->me[2]);
    if (fabs(c->slope) > 1e-6)
        report_note(r,
                    "the chin cut is tilted by %.1f degrees against the lower occlusal plane, to leave the lower "
                    "border beside the molars",
                    atan(c->slope) * 180 / acos(-1));
}

/* Where the plane, behind its exit at `end`, is furthest below the bone, the body can end without cutting. */
static double rear_wall(const chin *c, double end)
{
    double wall = end, best = -HUGE_VAL;
    for (double y = end; y <= end + margin_mm && y <= c->to; y += 0.5) {
        double gap = fmin(border_height(c, 1, y), border_height(c, -1, y)) - plane_z(c, y);
        if (gap < 0) break;
        if (gap > best) {
            best = gap;
            wall = y;
        }
    }
    return wall;
}

static cutter body_below(const chin *c, double wall)
{
    double low[3], high[3], xyz[3 * 2 * 4];
    for (int k = 0; k < 3; k++) {
        low[k] = HUGE_VAL;
        high[k] = -HUGE_VAL;
    }
    for (int32_t v = 0; v < c->mandible->vertex_count; v++) {
        double q[3];
        head_frame_to_local(&c->frame, c->mandible->xyz + 3 * (size_t)v, q);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], q[k]);
            high[k] = fmax(high[k], q[k]);
        }
    }
    double front = low[1] - margin_mm, bottom = fmin(low[2], plane_z(c, front)) - margin_mm;
    for (int side = 0; side < 2; side++) {
        double x = side ? high[0] + margin_mm : low[0] - margin_mm;
        double corner[4][3] = {
            {x, front, plane_z(c, front)}, {x, wall, plane_z(c, wall)}, {x, wall, bottom}, {x, front, bottom}};
        for (int k = 0; k < 4; k++) head_frame_to_world(&c->frame, corner[k], xyz + 3 * (4 * side + k));
    }
    return cutter_stack(2, 4, xyz, (const uint8_t[4]){1, 0, 0, 0}, false, false);
}

static void report_chin(const chin *c, const osteotomy_params *p, const guard_point *list, int count, double left,
                        double right, cut_report *r)
{
    double tilt = sqrt(1 + c->slope * c->slope), point[3], normal[3], at[3] = {0, c->me[1], plane_z(c, c->me[1])};
    for (int i = 0; i < count; i++)
        report_clearance(r, list[i].name, (list[i].local[2] - plane_z(c, list[i].local[1])) / tilt, list[i].below,
                         list[i].estimated);
    report_clearance(r, "chin height at the midline", (plane_z(c, c->me[1]) - c->me[2]) / tilt, p->chin_height_mm,
                     false);
    report_clearance(r, "chin cut leaves the border behind L6 left", left - c->l6[0][1], 0, false);
    report_clearance(r, "chin cut leaves the border behind L6 right", right - c->l6[1][1], 0, false);
    head_frame_to_world(&c->frame, at, point);
    for (int k = 0; k < 3; k++) normal[k] = c->slope * c->frame.posterior[k] - c->frame.up[k];
    report_plane(r, "genioplasty", point, normal);
}

static bool bodies_of(const osteotomy_input *in, const osteotomy_params *p, chin *c, cut_bodies *out, cut_report *r,
                      err *e)
{
    guard_point list[8];
    locate(c, in);
    int count = guards(in, p, &c->frame, list, r);
    choose_plane(c, p, list, count, r);
    double left = exit_y(c, 1, c->from, c->to), right = exit_y(c, -1, c->from, c->to), end = fmax(left, right);
    if (!(end < c->to))
        return err_set(e, ERR_GEOMETRY, "the chin cut does not leave the lower border in front of the angles");
    cutter body = body_below(c, rear_wall(c, end));
    report_chin(c, p, list, count, left, right, r);
    *out = cut_bodies_from(&body, p->kerf_mm);
    cutter_free(&body);
    return true;
}

bool genioplasty_bodies(const osteotomy_input *in, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e)
{
    static const char *const needed[] = {"L1", "L6_L", "L6_R", "Me", "MF_L", "MF_R", "Go_L", "Go_R", NULL};
    if (!need_landmarks(in->points, "genioplasty", needed, e)) return false;
    chin c = {.mandible = in->mandible};
    if (!jaw_frame(in->points, &c.frame, e)) return err_prefix(e, "genioplasty");
    for (int k = 0; k < 2; k++) c.lower[k] = outline_make(in->mandible, &c.frame, k ? -1 : 1, 1, 2, -1);
    bool ok = bodies_of(in, p, &c, out, r, e);
    for (int k = 0; k < 2; k++) outline_free(c.lower + k);
    return ok;
}
