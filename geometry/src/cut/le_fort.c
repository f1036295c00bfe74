/* Le Fort I: one sheet from the piriform rims over the buttresses to the pterygomaxillary junctions, then
 * down between tuberosity and pterygoid plates. Built in the Frankfort frame as sagittal profiles stacked
 * from right to left. Each of the levels PR, ZB and PM is a straight line through its left and right
 * landmark, so that septum and lateral nasal walls are cut by the same sheet. */
#include "geometry/mem.h"
#include "geometry/src/cut/cut_plan.h"
#include "geometry/molar.h"
#include "geometry/vec.h"
#include <stdio.h>

enum { COLUMNS = 10, PROFILE = 6 }; /* profile: front, PR, ZB, PM, foot behind, foot in front */
static const double front_mm = 25;  /* the sheet starts this far before the foremost of U1 and ANS */
static const double below_teeth_mm = 15;
static const double buttress_mm = 2;     /* beyond ZB by this the sheet falls away, to leave the zygoma alone */
static const double wall_mm = 9;         /* outer wall beyond ZB or the first molar */
static const double palate_half_mm = 12; /* half the width of the choanae */
static const double spine_mm = 1.5;      /* the separation passes this far behind PNS at the midline */
static const double raise_step_mm = 0.25;

typedef struct level { /* a line through the left and right landmark, in the Frankfort frame */
    double left[3], right[3];
} level;

typedef struct setting {
    head_frame frame;
    level pr, zb, pm;
    double ans[3], pns[3], u1[3], u6_low; /* u6_low: lower of the two first molar cusps */
    double raise_mm, palate_mm;
} setting;

static void along(const level *l, double x, double *y, double *z)
{
    double t = (x - l->right[0]) / (l->left[0] - l->right[0]);
    *y = l->right[1] + t * (l->left[1] - l->right[1]);
    *z = l->right[2] + t * (l->left[2] - l->right[2]);
}

static double floor_height(const setting *s, double y)
{
    double t = (y - s->ans[1]) / (s->pns[1] - s->ans[1]);
    t = fmin(fmax(t, 0), 1);
    return s->ans[2] + t * (s->pns[2] - s->ans[2]);
}

static cutter build(const setting *s)
{
    double middle = (s->ans[0] + s->pns[0]) / 2, xyz[3 * COLUMNS * PROFILE];
    double edge_r = s->zb.right[0] - buttress_mm, edge_l = s->zb.left[0] + buttress_mm;
    double x[COLUMNS] = {fmin(s->zb.right[0], s->pm.right[0]) - wall_mm,
                         edge_r,
                         s->zb.right[0] + 2,
                         s->pm.right[0],
                         middle - palate_half_mm,
                         middle + palate_half_mm,
                         s->pm.left[0],
                         s->zb.left[0] - 2,
                         edge_l,
                         fmax(s->zb.left[0], s->pm.left[0]) + wall_mm};
    double foot = fmin(s->u1[2], s->u6_low) - below_teeth_mm, start = fmin(s->u1[1], s->ans[1]) - front_mm;
    for (int c = 0; c < COLUMNS; c++) {
        double y[3], z[3];
        const level *levels[3] = {&s->pr, &s->zb, &s->pm};
        bool palate = c == 4 || c == 5;
        /* Beyond the landmarks the levels keep the depth that they have there. */
        for (int k = 0; k < 3; k++)
            along(levels[k], fmin(fmax(x[c], levels[k]->right[0]), levels[k]->left[0]), y + k, z + k);
        if (palate) y[2] = s->pns[1] + spine_mm;
        for (int k = 0; k < 3; k++) {
            z[k] += s->raise_mm;
            if (palate) z[k] = fmax(z[k], floor_height(s, y[k]) + s->palate_mm);
            if (c == 0 || c == COLUMNS - 1) z[k] -= wall_mm - buttress_mm;
        }
        double lead = z[0] + (z[0] - z[1]) / (y[1] - y[0]) * (y[0] - start);
        double profile[PROFILE][2] = {{start, lead}, {y[0], z[0]}, {y[1], z[1]},
                                      {y[2], z[2]},  {y[2], foot}, {start, foot}};
        for (int j = 0; j < PROFILE; j++) {
            double local[3] = {x[c], profile[j][0], profile[j][1]};
            head_frame_to_world(&s->frame, local, xyz + 3 * (c * PROFILE + j));
        }
    }
    static const uint8_t moves[PROFILE] = {1, 1, 1, 1, 0, 0};
    return cutter_stack(COLUMNS, PROFILE, xyz, moves, false, false);
}

typedef struct probe { /* something that the sheet must keep away from */
    char name[64];
    double at[3];
    bool below, estimated, decides; /* decides: the sheet is raised for it */
} probe;

/* Distance to the sheet, positive on the wanted side. */
static bool measure(const cutter *c, const probe *p, double *mm, err *e)
{
    surface sheet = cutter_sheet(c);
    nearest *tree = NULL, *body = NULL;
    bool ok = nearest_create(&sheet, &tree, e) && nearest_create(&c->body, &body, e);
    if (ok) *mm = nearest_point(tree, p->at, NULL, NULL) * (nearest_inside(body, p->at) == p->below ? 1 : -1);
    nearest_destroy(&tree);
    nearest_destroy(&body);
    surface_free(&sheet);
    return ok;
}

typedef struct root_axes { /* unit, from cusp to root tip */
    double incisor[3], canine[3], molar[3];
} root_axes;

/* Molars stand along the normal of the upper occlusal plane, the canine halfway between it and the axis of the
 * incisor. */
static root_axes find_axes(const landmarks *l, const head_frame *f, cut_report *r)
{
    const landmark *apex = landmarks_find(l, "U1_apex");
    molar left, right;
    root_axes a;
    double u1[3], across[3], back[3];
    (void)(landmark_point(l, "U1", u1) && molar_find(l, true, 1, &left) &&
           molar_find(l, true, -1, &right)); /* le_fort_bodies asked for them */
    vec_sub(left.xyz, right.xyz, across);
    for (int c = 0; c < 3; c++) back[c] = (left.xyz[c] + right.xyz[c]) / 2 - u1[c];
    vec_cross(across, back, a.molar);
    vec_normalize(a.molar);
    if (apex)
        vec_sub(apex->xyz, u1, a.incisor);
    else { /* 111 degrees to the Frankfort plane */
        for (int c = 0; c < 3; c++) a.incisor[c] = 0.934 * f->up[c] + 0.358 * f->posterior[c];
        if (landmarks_find(l, "U1"))
            report_warning(r, "U1_apex is missing: the upper incisors are taken to stand at 111 degrees, %d mm long",
                           UPPER_1_MM);
    }
    vec_normalize(a.incisor);
    vec_add(a.incisor, a.molar, a.canine);
    vec_normalize(a.canine);
    return a;
}

/* Root tips of one side, from landmarks or from cusps; returns how many. */
static int root_probes(const landmarks *l, const head_frame *f, const root_axes *axes, int side, probe *out,
                       cut_report *r)
{
    const char *word = side > 0 ? "left" : "right";
    char label[LANDMARK_LABEL_SIZE];
    static const struct {
        const char *cusp, *apex, *name;
        double mm;
    } teeth[] = {{"U3", "U3_apex", "canine", UPPER_3_MM}, {"U6", "U6_apex", "first molar", UPPER_6_MM}};
    int count = 0;
    for (int k = 0; k < 2; k++) {
        const landmark *cusp = landmarks_find(l, side_label(label, teeth[k].cusp, side)),
                       *tip = landmarks_find(l, side_label(label, teeth[k].apex, side));
        if (!cusp && !tip) {
            report_warning(r, "%s is missing: the cut is not checked against that root", label);
            continue;
        }
        probe *p = out + count++;
        *p = (probe){.below = true, .estimated = !tip, .decides = true};
        snprintf(p->name, sizeof p->name, "upper %s apex %s", teeth[k].name, word);
        if (tip)
            vec_copy(tip->xyz, p->at);
        else
            vec_axpy(cusp->xyz, teeth[k].mm, k == 0 ? axes->canine : axes->molar, p->at);
    }
    const landmark *second = landmarks_find(l, side_label(label, "U7", side));
    molar first;
    (void)molar_find(l, true, side, &first);
    if (first.on_crest) return count; /* no molar on this side */
    probe *p = out + count++;         /* the second molar follows the first along the arch */
    *p = (probe){.below = true, .estimated = true};
    snprintf(p->name, sizeof p->name, "upper second molar apex %s", word);
    double step[3];
    for (int c = 0; c < 3; c++) step[c] = f->posterior[c] + 0.15 * side * f->left[c];
    vec_axpy(step, -vec_dot(step, axes->molar), axes->molar, step);
    vec_normalize(step);
    if (second)
        vec_copy(second->xyz, p->at);
    else
        vec_axpy(first.xyz, UPPER_M1_WIDTH_MM, step, p->at);
    vec_axpy(p->at, UPPER_7_MM, axes->molar, p->at);
    return count;
}

static int probes(const landmarks *l, const head_frame *f, probe out[16], cut_report *r)
{
    const landmark *apex = landmarks_find(l, "U1_apex"), *edge = landmarks_find(l, "U1");
    root_axes axes = find_axes(l, f, r);
    int count = 0;
    out[count] = (probe){.name = "upper incisor apex", .below = true, .estimated = true, .decides = true};
    if (apex)
        vec_copy(apex->xyz, out[count++].at);
    else if (edge)
        vec_axpy(edge->xyz, UPPER_1_MM, axes.incisor, out[count++].at);
    else
        report_warning(r, "U1 is missing: the cut is not checked against the roots of the incisors");
    for (int side = 1; side >= -1; side -= 2) {
        char label[LANDMARK_LABEL_SIZE];
        count += root_probes(l, f, &axes, side, out + count, r);
        const landmark *iof = landmarks_find(l, side_label(label, "IOF", side));
        if (!iof) {
            report_warning(r, "%s is missing: the cut is not checked against the infraorbital nerve", label);
            continue;
        }
        probe *p = out + count++;
        *p = (probe){.below = false};
        snprintf(p->name, sizeof p->name, "infraorbital foramen %s", side > 0 ? "left" : "right");
        vec_copy(iof->xyz, p->at);
    }
    out[count] = (probe){.name = "posterior nasal spine (palate)", .below = true};
    vec_copy(landmarks_find(l, "PNS")->xyz, out[count++].at);
    return count;
}

static void describe(const setting *s, cut_report *r)
{
    for (int side = 1; side >= -1; side -= 2) {
        const level *levels[3] = {&s->pr, &s->zb, &s->pm};
        double p[3][3], n[3], a[3], b[3];
        char label[64];
        for (int k = 0; k < 3; k++) {
            double local[3];
            vec_copy(side > 0 ? levels[k]->left : levels[k]->right, local);
            local[2] += s->raise_mm;
            head_frame_to_world(&s->frame, local, p[k]);
        }
        static const char *const name[2] = {"anterior", "posterior"};
        for (int k = 0; k < 2; k++) { /* down is the side of the piece */
            double line[3];
            vec_sub(p[k + 1], p[k], a);
            for (int c = 0; c < 3; c++)
                line[c] = (levels[k]->left[0] - levels[k]->right[0]) * s->frame.left[c] +
                          (levels[k]->left[1] - levels[k]->right[1]) * s->frame.posterior[c] +
                          (levels[k]->left[2] - levels[k]->right[2]) * s->frame.up[c];
            vec_cross(a, line, n);
            if (vec_dot(n, s->frame.up) > 0) vec_scale(n, -1, n);
            snprintf(label, sizeof label, "le fort 1 %s %s", name[k], side > 0 ? "left" : "right");
            report_plane(r, label, p[k], n);
        }
        vec_scale(s->frame.posterior, -1, b);
        snprintf(label, sizeof label, "le fort 1 pterygoid %s", side > 0 ? "left" : "right");
        report_plane(r, label, p[2], b);
    }
}

static bool locate(setting *s, const osteotomy_input *in, err *e)
{
    double u6[2];
    level *levels[3] = {&s->pr, &s->zb, &s->pm};
    static const char *const names[3] = {"PR", "ZB", "PM"};
    for (int k = 0; k < 3; k++) {
        char label[LANDMARK_LABEL_SIZE];
        landmark_local(in->points, side_label(label, names[k], 1), &s->frame, levels[k]->left);
        landmark_local(in->points, side_label(label, names[k], -1), &s->frame, levels[k]->right);
        if (!(levels[k]->left[0] - levels[k]->right[0] > 10))
            return err_set(e, ERR_INPUT, "%s_L and %s_R are not left and right of each other", names[k], names[k]);
    }
    for (int k = 0; k < 2; k++) {
        double local[3];
        landmark_local(in->points, k ? "U6_R" : "U6_L", &s->frame, local);
        u6[k] = local[2];
    }
    landmark_local(in->points, "ANS", &s->frame, s->ans);
    landmark_local(in->points, "PNS", &s->frame, s->pns);
    landmark_local(in->points, "U1", &s->frame, s->u1);
    s->u6_low = fmin(u6[0], u6[1]);
    if (!(s->pr.left[1] < s->zb.left[1] && s->zb.left[1] < s->pm.left[1] && s->pr.right[1] < s->zb.right[1] &&
          s->zb.right[1] < s->pm.right[1] && s->ans[1] < s->pns[1]))
        return err_set(e, ERR_INPUT, "Le Fort I: PR, ZB, PM (and ANS, PNS) must follow each other from front to back");
    return true;
}

/* Raises the sheet until the roots are clear, the nerve is near or the limit is reached. *c and mm[count] are those of
 * the last height. */
static bool raise_sheet(setting *s, const osteotomy_params *p, const probe *list, int count, cutter *c, double *mm,
                        err *e)
{
    for (;;) {
        cutter_free(c);
        *c = build(s);
        bool short_of = false, nerve = false;
        for (int i = 0; i < count; i++) {
            if (!measure(c, list + i, mm + i, e)) return false;
            short_of |= list[i].decides && mm[i] < p->apex_clearance_mm;
            nerve |= !list[i].below && mm[i] - raise_step_mm < p->foramen_clearance_mm;
        }
        if (!short_of || nerve || s->raise_mm + raise_step_mm > p->le_fort_raise_mm) return true;
        s->raise_mm += raise_step_mm;
    }
}

bool le_fort_bodies(const osteotomy_input *in, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e)
{
    static const char *const needed[] = {"PR_L", "PR_R", "ZB_L", "ZB_R", "PM_L", "PM_R", "ANS", "PNS",
                                         "U1",   "U6_L", "U6_R", "Po_L", "Po_R", "Or_L", NULL};
    setting s = {.palate_mm = p->palate_clearance_mm};
    if (!need_landmarks(in->points, "Le Fort I", needed, e)) return false;
    if (!head_frame_from_landmarks(in->points, &s.frame, e)) return err_prefix(e, "Le Fort I");
    if (!locate(&s, in, e)) return false;
    probe list[16];
    double mm[16];
    int count = probes(in->points, &s.frame, list, r);
    cutter c = {0};
    if (!raise_sheet(&s, p, list, count, &c, mm, e)) {
        cutter_free(&c);
        return false;
    }
    if (s.raise_mm > 0)
        report_note(r, "Le Fort I raised by %.2f mm above PR, ZB and PM to clear the estimated root tips", s.raise_mm);
    for (int i = 0; i < count; i++)
        report_clearance(r, list[i].name, mm[i],
                         !list[i].below   ? p->foramen_clearance_mm
                         : i == count - 1 ? 1
                                          : p->apex_clearance_mm,
                         list[i].estimated);
    describe(&s, r);
    *out = cut_bodies_from(&c, p->kerf_mm);
    cutter_free(&c);
    return true;
}
