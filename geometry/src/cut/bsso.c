/* BSSO of one side. The proximal piece is a box around ramus and angle without a block that carries teeth,
 * canal, lingula and lingual plate. The top of the block is the medial horizontal cut; its sides are, from
 * the outside inwards, the vertical buccal cut, the sagittal cut and the lingual cut behind the lingula: in
 * an axial section a Z. */
#include "geometry/boolean.h"
#include "geometry/src/cut/jaw_side.h"
#include "geometry/vec.h"
#include <stdio.h>

enum { STATIONS = 6, HEIGHTS = 7, NODES = STATIONS + 4, LEVELS = HEIGHTS + 1 };
static const double midline_mm = 6, margin_mm = 12;

/* *moved_mm: farthest that a corner of the sagittal cut lies inside its first place. */
static cutter block(const jaw_side *j, const osteotomy_params *p, double *moved_mm)
{
    double xyz[3 * NODES * LEVELS], front = jaw_side_buccal_y(j, j->low[2]);
    front = fmin(front, jaw_side_buccal_y(j, j->top)) - 2 * margin_mm;
    double bottom = fmin(jaw_side_border(j, j->m2[1]), j->low[2]) - 2 * margin_mm;
    double lowest = fmin(j->border_at_v, j->lingual[1][1]) - 2;
    jaw_side as_fitted = *j;
    as_fitted.plate.least_mm = 0;
    *moved_mm = 0;
    for (int l = 0; l < LEVELS; l++) {
        double z = l < HEIGHTS ? j->top + l / (HEIGHTS - 1.0) * (lowest - j->top) : bottom, zs = fmax(z, lowest);
        double node[NODES][3], y0 = jaw_side_buccal_y(j, zs), y1 = jaw_side_lingual_y(j, zs);
        for (int s = 0; s < STATIONS; s++) {
            double y = y0 + s / (STATIONS - 1.0) * (y1 - y0);
            node[s + 1][0] = jaw_side_sagittal_x(j, p, y, zs);
            *moved_mm = fmax(*moved_mm, jaw_side_sagittal_x(&as_fitted, p, y, zs) - node[s + 1][0]);
            node[s + 1][1] = y;
        }
        node[0][0] = j->high[0] + 2 * margin_mm;
        node[0][1] = y0;
        node[STATIONS + 1][0] = node[STATIONS + 2][0] = -midline_mm;
        node[STATIONS + 1][1] = y1;
        node[STATIONS + 2][1] = node[STATIONS + 3][1] = front;
        node[STATIONS + 3][0] = node[0][0];
        for (int k = 0; k < NODES; k++) {
            node[k][2] = z;
            jaw_side_world(j, node[k], xyz + 3 * (l * NODES + k));
        }
    }
    uint8_t moves[NODES] = {0};
    for (int k = 0; k <= STATIONS; k++) moves[k] = 1;
    return cutter_stack(LEVELS, NODES, xyz, moves, true, false);
}

/* box without the block shifted by mm */
static bool carve(const surface *box, const cutter *block_, double mm, surface *out, err *e)
{
    surface b = cutter_offset(block_, mm, 0);
    bool ok = boolean_apply(box, &b, BOOLEAN_DIFFERENCE, out, NULL, e);
    surface_free(&b);
    return ok;
}

static void report_lingula(const jaw_side *j, const osteotomy_params *p, cut_report *r)
{
    char name[64];
    snprintf(name, sizeof name, "lingula below the medial cut %s", jaw_side_word(j));
    report_clearance(r, name, j->top - j->li[2], fmin(2, p->above_lingula_mm), j->lingula_estimated);
    snprintf(name, sizeof name, "lingula before the lingual cut %s", jaw_side_word(j));
    report_clearance(r, name, jaw_side_lingual_y(j, j->li[2]) - j->li[1], 2, j->lingula_estimated);
    snprintf(name, sizeof name, "medial cut below the sigmoid notch %s", jaw_side_word(j));
    report_clearance(r, name, j->sn[2] - j->top, NOTCH_MM, false);
}

static bool report_canal(const jaw_side *j, const osteotomy_params *p, const surface *sheet, cut_report *r, err *e)
{
    char name[64];
    nearest *tree = NULL;
    double world[3], least = HUGE_VAL;
    if (!nearest_create(sheet, &tree, e)) return false;
    for (int i = 0; i + 1 < j->canal_count; i++)
        for (int k = 0; k < 10; k++) {
            double q[3];
            for (int c = 0; c < 3; c++) q[c] = j->canal[i][c] + k / 10.0 * (j->canal[i + 1][c] - j->canal[i][c]);
            if (q[1] < jaw_side_buccal_y(j, q[2])) continue; /* in front of the split the canal is left alone */
            jaw_side_world(j, q, world);
            least = fmin(least, nearest_point(tree, world, NULL, NULL));
        }
    snprintf(name, sizeof name, "mandibular canal %s", jaw_side_word(j));
    if (isfinite(least)) report_clearance(r, name, least, p->canal_clearance_mm, j->canal_estimated);
    nearest_destroy(&tree);
    return true;
}

/* For display: the horizontal cut, the buccal cut, a plane near the sagittal one. */
static void report_planes(const jaw_side *j, const osteotomy_params *p, cut_report *r)
{
    char name[64];
    double local[3] = {j->li[0], j->li[1], j->top}, world[3], normal[3], a[3], b[3], c[3];
    jaw_side_world(j, local, world);
    snprintf(name, sizeof name, "bsso medial %s", jaw_side_word(j));
    report_plane(r, name, world, j->frame.up);
    double v[3] = {j->m2[0], jaw_side_buccal_y(j, j->m2[2]), j->m2[2]};
    jaw_side_world(j, v, world);
    for (int k = 0; k < 3; k++) normal[k] = j->frame.posterior[k] - j->v_slope * j->frame.up[k];
    snprintf(name, sizeof name, "bsso buccal %s", jaw_side_word(j));
    report_plane(r, name, world, normal);
    double mid = (j->top + j->border_at_v) / 2, y0 = jaw_side_buccal_y(j, j->top), y1 = jaw_side_lingual_y(j, j->top);
    double pa[3] = {jaw_side_sagittal_x(j, p, y0, j->top - 1), y0, j->top - 1},
           pb[3] = {jaw_side_sagittal_x(j, p, y1, j->top - 1), y1, j->top - 1},
           pc[3] = {jaw_side_sagittal_x(j, p, (y0 + y1) / 2, mid), (y0 + y1) / 2, mid};
    jaw_side_world(j, pa, a);
    jaw_side_world(j, pb, b);
    jaw_side_world(j, pc, c);
    vec_sub(b, a, b);
    vec_sub(c, a, c);
    vec_cross(b, c, normal);
    if (vec_dot(normal, j->frame.left) * j->side < 0) vec_scale(normal, -1, normal);
    snprintf(name, sizeof name, "bsso sagittal %s", jaw_side_word(j));
    report_plane(r, name, a, normal);
}

static bool report_side(const jaw_side *j, const osteotomy_params *p, const surface *sheet, cut_report *r, err *e)
{
    report_lingula(j, p, r);
    if (!report_canal(j, p, sheet, r, e)) return false;
    report_planes(j, p, r);
    return true;
}

static bool bodies_of(jaw_side *j, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e)
{
    if (!jaw_side_locate(j, p, r, e) || !jaw_side_take_canal(j, r, e)) return false;
    if (!jaw_side_fit_sagittal(j, p))
        return err_set(e, ERR_GEOMETRY, "BSSO %s: no bone between the vertical cut and the lingula", jaw_side_word(j));
    double low[3] = {midline_mm, fmin(jaw_side_buccal_y(j, j->top), jaw_side_buccal_y(j, j->low[2])) - margin_mm,
                     j->low[2] - margin_mm},
           high[3] = {j->high[0] + margin_mm, j->high[1] + margin_mm, j->high[2] + margin_mm};
    if (j->side < 0) {
        double keep = low[0];
        low[0] = -high[0];
        high[0] = -keep;
    }
    double moved;
    cutter box = cutter_box(&j->frame, low, high), distal = block(j, p, &moved);
    cut_bodies b = {.sheet = cutter_sheet(&distal), .moved_mm = moved};
    surface wide = cutter_offset(&box, 0, HOLLOW_MM);
    bool ok = carve(&box.body, &distal, p->kerf_mm / 2, &b.inner, e) &&
              carve(&wide, &distal, p->kerf_mm / 2, &b.hollow, e) &&
              carve(&box.body, &distal, -p->kerf_mm / 2, &b.outer, e) && report_side(j, p, &b.sheet, r, e);
    surface_free(&wide);
    cutter_free(&box);
    cutter_free(&distal);
    if (!ok) {
        cut_bodies_free(&b);
        return err_prefix(e, "BSSO %s", jaw_side_word(j));
    }
    *out = b;
    return true;
}

bool bsso_bodies(const osteotomy_input *in, const osteotomy_params *p, const nearest *mandible, int side,
                 lateral_plate plate, cut_bodies *out, cut_report *r, err *e)
{
    char label[6][LANDMARK_LABEL_SIZE];
    const char *needed[7];
    jaw_side j;
    jaw_side_needs(side, label, needed);
    if (!need_landmarks(in->points, "BSSO", needed, e) || !jaw_side_open(in, mandible, side, &j, e)) return false;
    j.plate = plate;
    bool ok = bodies_of(&j, p, out, r, e);
    jaw_side_close(&j);
    return ok;
}
