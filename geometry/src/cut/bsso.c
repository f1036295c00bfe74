/* BSSO of one side. The proximal piece is a box around ramus and angle without a block that carries teeth,
 * canal, lingula and lingual plate. The top of the block is the medial horizontal cut; its sides are, from
 * the outside inwards, the vertical buccal cut, the sagittal cut and the lingual cut behind the lingula: in
 * an axial section a Z.
 *
 * Coordinates are those of jaw_frame, with x counted from the midline outwards on either side. */
#include "geometry/boolean.h"
#include "geometry/mem.h"
#include "geometry/src/cut/cut_plan.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <string.h>

enum {
    CANAL_POINTS = CANAL_POINTS_MAX,
    STATIONS = 6,
    HEIGHTS = 7,
    TERMS = 5,
    NODES = STATIONS + 4,
    LEVELS = HEIGHTS + 1
};
static const double third_molar_mm = 23; /* L6 to L7 beyond this: L7 is the third molar */
static const double behind_m2_mm = 1;
static const double posterior_strip_mm = 4; /* bone kept behind the lingual cut at the top */
static const double foramen_reach_mm = 8;
static const double foramen_drop_mm = 3;    /* mandibular foramen below the tip of the lingula */
static const double angle_mm = 12;          /* the lingual cut meets the lower border this far before gonion */
static const double least_lingual_mm = 4;   /* least distance from the buccal to the lingual cut */
static const double cusp_to_contact_mm = 2; /* mesiobuccal cusp to mesial contact of the lower first molar */
static const double crown_mm = 1.5;         /* sagittal cut outside the molar landmarks */
static const double least_plate_mm = 1.5;   /* least bone on either side of the sagittal cut */
static const double notch_mm = 3;           /* horizontal cut below the sigmoid notch */
static const double midline_mm = 6, margin_mm = 12;

typedef struct jaw_side {
    const osteotomy_input *in;
    const nearest *tree;
    head_frame frame;
    int side;
    double low[3], high[3]; /* of the mandible on this side */
    double li[3], l6[3], l7[3], go[3], sn[3], ra[3], rp[3], m2[3];
    double top;           /* height of the horizontal cut */
    double v_slope;       /* dy/dz of the buccal cut */
    double lingual[2][2]; /* y, z of the lingual cut: above and below */
    double border_at_v;   /* height of the lower border there */
    double fit[TERMS];    /* sagittal cut: x = 1, y, z, y^2, yz */
    double canal[CANAL_POINTS][3];
    int canal_count;
    outline lower, posterior; /* lower border over y, posterior border over z */
    bool lingula_estimated, canal_estimated;
} jaw_side;

static void to_local(const jaw_side *j, const double world[3], double local[3])
{
    head_frame_to_local(&j->frame, world, local);
    local[0] *= j->side;
}

static void to_world(const jaw_side *j, const double local[3], double world[3])
{
    double p[3] = {local[0] * j->side, local[1], local[2]};
    head_frame_to_world(&j->frame, p, world);
}

/* Outermost and innermost bone on the horizontal line across the jaw at (y, z). */
static bool cross_jaw(const jaw_side *j, double y, double z, double *outside, double *inside)
{
    double from[3] = {j->high[0] + 20, y, z}, start[3], way[3], hit[3], local[3];
    to_world(j, from, start);
    vec_scale(j->frame.left, -j->side, way);
    if (!nearest_ray(j->tree, start, way, hit, NULL)) return false;
    to_local(j, hit, local);
    *outside = local[0];
    from[0] = 0;
    to_world(j, from, start);
    vec_scale(way, -1, way);
    if (!nearest_ray(j->tree, start, way, hit, NULL)) return false;
    to_local(j, hit, local);
    *inside = local[0];
    return *outside > 0 && *inside > 0;
}

static double border_height(const jaw_side *j, double y) { return outline_at(&j->lower, y); }

static double buccal_y(const jaw_side *j, double z) { return j->m2[1] + j->v_slope * (z - j->m2[2]); }

static double lingual_y(const jaw_side *j, double z)
{
    double t = (z - j->lingual[1][1]) / (j->lingual[0][1] - j->lingual[1][1]);
    return fmax(j->lingual[1][0] + t * (j->lingual[0][0] - j->lingual[1][0]), buccal_y(j, z) + least_lingual_mm);
}

static void terms(double y, double z, double t[TERMS])
{
    t[0] = 1;
    t[1] = y;
    t[2] = z;
    t[3] = y * y;
    t[4] = y * z;
}

/* Gauss with pivoting; false if singular. */
static bool solve(double a[TERMS][TERMS + 1])
{
    for (int c = 0; c < TERMS; c++) {
        int pivot = c;
        for (int r = c + 1; r < TERMS; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        if (!(fabs(a[pivot][c]) > 1e-9)) return false;
        for (int k = 0; k <= TERMS; k++) {
            double keep = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = keep;
        }
        for (int r = 0; r < TERMS; r++) {
            if (r == c) continue;
            double f = a[r][c] / a[c][c];
            for (int k = c; k <= TERMS; k++) a[r][k] -= f * a[c][k];
        }
    }
    return true;
}

/* The sagittal cut follows the outer cortex at the depth of the lateral plate. Above the external oblique
 * ridge (the outermost bone at this y) it stays just inside the ridge instead of following the alveolus
 * inwards. */
static bool fit_sagittal(jaw_side *j, const osteotomy_params *p)
{
    double a[TERMS][TERMS + 1] = {{0}};
    int used = 0;
    for (int s = 0; s <= 24; s++) {
        double y = buccal_y(j, j->top) + s / 24.0 * (lingual_y(j, j->top) - buccal_y(j, j->top)), ridge = -HUGE_VAL,
               low = border_height(j, y);
        for (int h = 0; h <= 24; h++) { /* upwards */
            double z = low + 1 + h / 24.0 * (j->top - low - 1), out, in, t[TERMS];
            if (y < buccal_y(j, z) - 2 || y > lingual_y(j, z) + 2 || !cross_jaw(j, y, z, &out, &in)) continue;
            bool above_ridge = out < ridge - 1;
            ridge = fmax(ridge, out);
            double depth = fmin(p->buccal_depth_mm, p->ramus_depth_share * (out - in));
            if (above_ridge) continue;
            terms(y, z, t);
            for (int r = 0; r < TERMS; r++) {
                for (int c = 0; c < TERMS; c++) a[r][c] += t[r] * t[c];
                a[r][TERMS] += t[r] * (out - depth);
            }
            used++;
        }
    }
    if (used < 4 * TERMS) return false;
    double scale = 1e-9 * a[0][0];
    for (int r = 0; r < TERMS; r++) a[r][r] += scale;
    if (!solve(a)) return false;
    for (int r = 0; r < TERMS; r++) j->fit[r] = a[r][TERMS] / a[r][r];
    return true;
}

/* x and z of the canal at y, by its polyline, and how much longer than across the jaw its distance to a sheet
 * beside it must be, because it runs aslant. */
static bool canal_at(const jaw_side *j, double y, double out[3])
{
    for (int i = 0; i + 1 < j->canal_count; i++) {
        const double *a = j->canal[i], *b = j->canal[i + 1];
        if ((y - a[1]) * (y - b[1]) > 0 || a[1] == b[1]) continue;
        double t = (y - a[1]) / (b[1] - a[1]);
        out[0] = a[0] + t * (b[0] - a[0]);
        out[1] = a[2] + t * (b[2] - a[2]);
        out[2] = hypot(1, (b[0] - a[0]) / (b[1] - a[1]));
        return true;
    }
    const double *end = j->canal[0]; /* a cut just behind the foramen must not slant towards it */
    if (!j->canal_count || y < end[1] || y > end[1] + foramen_reach_mm) return false;
    out[0] = end[0];
    out[1] = end[2];
    out[2] = 1;
    return true;
}

static double sagittal_x(const jaw_side *j, const osteotomy_params *p, double y, double z)
{
    double t[TERMS], x = 0, out, in, canal[3];
    double low = border_height(j, y), inside_bone = fmax(z, low + 0.5);
    terms(y, inside_bone, t);
    for (int k = 0; k < TERMS; k++) x += t[k] * j->fit[k];
    for (int k = -3; k <= 3; k++) /* up to halfway to the next stations, because the sheet is straight between them */
        if (canal_at(j, y + k, canal) && fabs(z - canal[1]) < 6)
            x = fmax(x, canal[0] + canal[2] * p->canal_clearance_mm);
    double u = fmin(fmax((y - j->l6[1]) / (j->l7[1] - j->l6[1]), 0),
                    1), /* beside the molars, fading behind and below */
        away = fmax(y - j->l7[1], 0) + fmax(j->l7[2] - 10 - z, 0);
    x = fmax(x, j->l6[0] + u * (j->l7[0] - j->l6[0]) + crown_mm - away / 2);
    if (cross_jaw(j, y, inside_bone, &out, &in) && out - in > 2 * least_plate_mm) x = fmax(x, in + least_plate_mm);
    return x;
}

static bool locate(jaw_side *j, const osteotomy_params *p, cut_report *r, err *e)
{
    const landmarks *l = j->in->points;
    char label[LANDMARK_LABEL_SIZE];
    const char *word = j->side > 0 ? "left" : "right";
    static const char *const base[] = {"L6", "L7", "Go", "SN", "RA", "RP"};
    double *const place[] = {j->l6, j->l7, j->go, j->sn, j->ra, j->rp};
    for (int k = 0; k < 6; k++) to_local(j, landmarks_find(l, side_label(label, base[k], j->side))->xyz, place[k]);
    for (int c = 0; c < 3; c++) {
        j->low[c] = HUGE_VAL;
        j->high[c] = -HUGE_VAL;
    }
    for (int32_t v = 0; v < j->in->mandible->vertex_count; v++) {
        double q[3];
        to_local(j, j->in->mandible->xyz + 3 * (size_t)v, q);
        if (q[0] < 0) continue;
        for (int c = 0; c < 3; c++) {
            j->low[c] = fmin(j->low[c], q[c]);
            j->high[c] = fmax(j->high[c], q[c]);
        }
    }
    if (!(j->l6[0] > 0 && j->go[0] > 0 && j->ra[1] < j->rp[1] && j->l6[1] < j->ra[1]))
        return err_set(e, ERR_INPUT, "BSSO %s: L6, RA, RP, Go are not where a mandible has them", word);
    /* Second molar: molars of a set scale together. */
    double reach = vec_distance(j->l6, j->l7), to_m2 = LOWER_M1_WIDTH_MM - cusp_to_contact_mm + LOWER_M2_WIDTH_MM,
           share = 1;
    if (reach > third_molar_mm) {
        share = to_m2 / (to_m2 + 10); /* the third molar is 10 mm wide */
        report_warning(r,
                       "BSSO %s: L7 lies %.1f mm behind L6, so it marks the third molar; the vertical cut is placed "
                       "%.1f mm in front of it, behind the second molar",
                       word, reach, (1 - share) * reach);
    }
    for (int c = 0; c < 3; c++) j->m2[c] = j->l6[c] + share * (j->l7[c] - j->l6[c]);
    j->m2[1] += behind_m2_mm;
    /* Buccal cut: at right angles to the lower border below it. */
    double ahead = border_height(j, j->m2[1] - 8), behind = border_height(j, j->m2[1] + 8);
    if (!isfinite(ahead) || !isfinite(behind)) return err_set(e, ERR_GEOMETRY, "BSSO %s: no bone below L7", word);
    double slope = fmin(fmax((behind - ahead) / 16, -1), 1);
    j->v_slope = -slope;
    j->border_at_v = border_height(j, buccal_y(j, ahead));
    const landmark *li = landmarks_find(l, side_label(label, "Li", j->side));
    if (li) {
        to_local(j, li->xyz, j->li);
    } else { /* mean of 150 rami */
        double z, out, in;
        j->lingula_estimated = true;
        j->li[1] = j->rp[1] - p->lingula_width_share * (j->rp[1] - j->ra[1]);
        double low = border_height(j, j->li[1]);
        z = low + p->lingula_height_share * (j->sn[2] - low);
        if (!cross_jaw(j, j->li[1], z, &out, &in))
            return err_set(e, ERR_GEOMETRY, "BSSO %s: no ramus where the lingula is expected", word);
        j->li[0] = in;
        j->li[2] = z;
        report_warning(r,
                       "BSSO %s: %s is missing; estimated at %.0f %% of the ramus width from behind and %.0f %% of "
                       "its height",
                       word, label, 100 * p->lingula_width_share, 100 * p->lingula_height_share);
    }
    j->top = j->li[2] + p->above_lingula_mm;
    double teeth = fmax(j->l6[2], j->l7[2]) + 1;
    if (j->top < teeth) {
        report_warning(r, "BSSO %s: the medial cut is raised by %.1f mm to stay above the molars", word,
                       teeth - j->top);
        j->top = teeth;
    }
    if (j->top > j->sn[2] - notch_mm)
        return err_set(e, ERR_GEOMETRY,
                       "BSSO %s: the medial cut would lie %.1f mm below the sigmoid notch; %g mm are "
                       "needed",
                       word, j->sn[2] - j->top, notch_mm);
    double last = outline_at(&j->posterior, j->top), room = last - posterior_strip_mm;
    /* The foramen lies below and behind the tip of the lingula: the margin holds at its height. */
    j->lingual[0][0] = j->li[1] + p->behind_lingula_mm;
    j->lingual[0][1] = j->li[2] - foramen_drop_mm;
    if (room < j->li[1] + 1)
        return err_set(e, ERR_GEOMETRY, "BSSO %s: only %.1f mm of ramus lie behind the lingula", word, last - j->li[1]);
    double y = fmax(buccal_y(j, j->border_at_v) + least_lingual_mm, j->go[1] - angle_mm);
    j->lingual[1][0] = fmin(y, j->lingual[0][0]);
    j->lingual[1][1] = border_height(j, j->lingual[1][0]);
    if (!(j->lingual[0][1] > j->lingual[1][1] + 1))
        return err_set(e, ERR_INPUT, "BSSO %s: the lingula lies at the lower border", word);
    if (lingual_y(j, j->top) > room) { /* turn it about its lower end */
        double rise = (j->lingual[0][1] - j->lingual[1][1]) / (j->top - j->lingual[1][1]);
        j->lingual[0][0] = j->lingual[1][0] + (room - j->lingual[1][0]) * rise;
    }
    return true;
}

/* Behind the lingula, then along the body at 9 mm above the lower border and a third of the bone from inside,
 * to the mental foramen: only an estimate. */
static void find_canal(jaw_side *j, cut_report *r)
{
    const char *word = j->side > 0 ? "left" : "right";
    char label[LANDMARK_LABEL_SIZE];
    const landmark *mf = landmarks_find(j->in->points, side_label(label, "MF", j->side));
    double out, in;
    j->canal_estimated = true;
    vec_copy(j->li, j->canal[0]);
    j->canal[0][1] += 2;
    j->canal[0][2] -= foramen_drop_mm;
    if (cross_jaw(j, j->canal[0][1], j->canal[0][2], &out, &in)) j->canal[0][0] = in + 1;
    j->canal_count = 1;
    for (int k = 1; k <= 4; k++) {
        double y = j->canal[0][1] + k / 5.0 * (j->l6[1] - j->canal[0][1]), low = border_height(j, y), bowed = low + 9,
               z = k < 3 ? fmax(bowed, j->canal[0][2] - 6.0 * k) : bowed;
        if (!cross_jaw(j, y, z, &out, &in)) continue;
        double *q = j->canal[j->canal_count++];
        q[0] = in + fmin((out - in) / 3, 4);
        q[1] = y;
        q[2] = z;
    }
    if (mf)
        to_local(j, mf->xyz, j->canal[j->canal_count++]);
    else
        report_warning(r, "%s is missing: the %s canal is estimated up to the first molar only", label, word);
}

static cutter block(const jaw_side *j, const osteotomy_params *p)
{
    double xyz[3 * NODES * LEVELS], front = buccal_y(j, j->low[2]);
    front = fmin(front, buccal_y(j, j->top)) - 2 * margin_mm;
    double bottom = fmin(border_height(j, j->m2[1]), j->low[2]) - 2 * margin_mm;
    double lowest = fmin(j->border_at_v, j->lingual[1][1]) - 2;
    for (int l = 0; l < LEVELS; l++) {
        double z = l < HEIGHTS ? j->top + l / (HEIGHTS - 1.0) * (lowest - j->top) : bottom, zs = fmax(z, lowest);
        double node[NODES][3], y0 = buccal_y(j, zs), y1 = lingual_y(j, zs);
        for (int s = 0; s < STATIONS; s++) {
            double y = y0 + s / (STATIONS - 1.0) * (y1 - y0);
            node[s + 1][0] = sagittal_x(j, p, y, zs);
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
            to_world(j, node[k], xyz + 3 * (l * NODES + k));
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

static bool report_side(const jaw_side *j, const osteotomy_params *p, const surface *sheet, cut_report *r, err *e)
{
    const char *word = j->side > 0 ? "left" : "right";
    char name[64];
    nearest *tree = NULL;
    double world[3];
    if (!nearest_create(sheet, &tree, e)) return false;
    snprintf(name, sizeof name, "lingula below the medial cut %s", word);
    report_clearance(r, name, j->top - j->li[2], fmin(2, p->above_lingula_mm), j->lingula_estimated);
    snprintf(name, sizeof name, "lingula before the lingual cut %s", word);
    report_clearance(r, name, lingual_y(j, j->li[2]) - j->li[1], 2, j->lingula_estimated);
    snprintf(name, sizeof name, "medial cut below the sigmoid notch %s", word);
    report_clearance(r, name, j->sn[2] - j->top, notch_mm, false);
    double least = HUGE_VAL;
    for (int i = 0; i + 1 < j->canal_count; i++)
        for (int k = 0; k < 10; k++) {
            double q[3];
            for (int c = 0; c < 3; c++) q[c] = j->canal[i][c] + k / 10.0 * (j->canal[i + 1][c] - j->canal[i][c]);
            if (q[1] < buccal_y(j, q[2])) continue; /* in front of the split the canal is left alone */
            to_world(j, q, world);
            least = fmin(least, nearest_point(tree, world, NULL, NULL));
        }
    snprintf(name, sizeof name, "mandibular canal %s", word);
    if (isfinite(least)) report_clearance(r, name, least, p->canal_clearance_mm, j->canal_estimated);
    nearest_destroy(&tree);
    /* For display: the horizontal cut, the buccal cut, a plane near the sagittal one. */
    double local[3] = {j->li[0], j->li[1], j->top}, normal[3], a[3], b[3], c[3];
    to_world(j, local, world);
    snprintf(name, sizeof name, "bsso medial %s", word);
    report_plane(r, name, world, j->frame.up);
    double v[3] = {j->m2[0], buccal_y(j, j->m2[2]), j->m2[2]};
    to_world(j, v, world);
    for (int k = 0; k < 3; k++) normal[k] = j->frame.posterior[k] - j->v_slope * j->frame.up[k];
    snprintf(name, sizeof name, "bsso buccal %s", word);
    report_plane(r, name, world, normal);
    double mid = (j->top + j->border_at_v) / 2, y0 = buccal_y(j, j->top), y1 = lingual_y(j, j->top);
    double pa[3] = {sagittal_x(j, p, y0, j->top - 1), y0, j->top - 1},
           pb[3] = {sagittal_x(j, p, y1, j->top - 1), y1, j->top - 1},
           pc[3] = {sagittal_x(j, p, (y0 + y1) / 2, mid), (y0 + y1) / 2, mid};
    to_world(j, pa, a);
    to_world(j, pb, b);
    to_world(j, pc, c);
    vec_sub(b, a, b);
    vec_sub(c, a, c);
    vec_cross(b, c, normal);
    if (vec_dot(normal, j->frame.left) * j->side < 0) vec_scale(normal, -1, normal);
    snprintf(name, sizeof name, "bsso sagittal %s", word);
    report_plane(r, name, a, normal);
    return true;
}

static bool bodies_of(jaw_side *j, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e)
{
    if (!locate(j, p, r, e)) return false;
    int which = j->side > 0 ? 0 : 1;
    const osteotomy_input *in = j->in;
    const char *word = j->side > 0 ? "left" : "right";
    if (in->canal[which]) {
        if (in->canal_count[which] < 2 || in->canal_count[which] > CANAL_POINTS)
            return err_set(e, ERR_INPUT, "a canal needs 2 to %d points, got %d", CANAL_POINTS, in->canal_count[which]);
        j->canal_count = in->canal_count[which];
        for (int i = 0; i < j->canal_count; i++) to_local(j, in->canal[which] + 3 * (size_t)i, j->canal[i]);
    } else {
        find_canal(j, r);
    }
    if (!fit_sagittal(j, p))
        return err_set(e, ERR_GEOMETRY, "BSSO %s: no bone between the vertical cut and the lingula", word);
    double low[3] = {midline_mm, fmin(buccal_y(j, j->top), buccal_y(j, j->low[2])) - margin_mm, j->low[2] - margin_mm},
           high[3] = {j->high[0] + margin_mm, j->high[1] + margin_mm, j->high[2] + margin_mm};
    if (j->side < 0) {
        double keep = low[0];
        low[0] = -high[0];
        high[0] = -keep;
    }
    cutter box = cutter_box(&j->frame, low, high), distal = block(j, p);
    cut_bodies b = {.sheet = cutter_sheet(&distal)};
    surface wide = cutter_offset(&box, 0, HOLLOW_MM);
    bool ok = carve(&box.body, &distal, p->kerf_mm / 2, &b.inner, e) &&
              carve(&wide, &distal, p->kerf_mm / 2, &b.hollow, e) &&
              carve(&box.body, &distal, -p->kerf_mm / 2, &b.outer, e) && report_side(j, p, &b.sheet, r, e);
    surface_free(&wide);
    cutter_free(&box);
    cutter_free(&distal);
    if (!ok) {
        cut_bodies_free(&b);
        return err_prefix(e, "BSSO %s", word);
    }
    *out = b;
    return true;
}

int osteotomy_canal(const surface *mandible, const landmarks *points, const osteotomy_params *p, int side, double *xyz)
{
    const osteotomy_input in = {.mandible = mandible, .points = points};
    jaw_side j = {.in = &in, .side = side};
    cut_report ignored = {0};
    err e = {0};
    nearest *tree = NULL;
    char label[LANDMARK_LABEL_SIZE];
    static const char *const base[] = {"L6", "L7", "Go", "SN", "RA", "RP"};
    for (int k = 0; k < 6; k++)
        if (!landmarks_find(points, side_label(label, base[k], side))) return 0;
    if (!nearest_create(mandible, &tree, &e)) return 0;
    j.tree = tree;
    if (jaw_frame(points, &j.frame, &e)) {
        j.lower = outline_make(mandible, &j.frame, side, 1, 2, -1);
        j.posterior = outline_make(mandible, &j.frame, side, 2, 1, 1);
        if (locate(&j, p, &ignored, &e)) find_canal(&j, &ignored);
        outline_free(&j.lower);
        outline_free(&j.posterior);
    }
    for (int i = 0; i < j.canal_count; i++) to_world(&j, j.canal[i], xyz + 3 * (size_t)i);
    cut_report_free(&ignored);
    nearest_destroy(&tree);
    return j.canal_count;
}

bool bsso_bodies(const osteotomy_input *in, const osteotomy_params *p, const nearest *mandible, int side,
                 cut_bodies *out, cut_report *r, err *e)
{
    static const char *const base[] = {"L6", "L7", "Go", "SN", "RA", "RP"};
    char names[6][LANDMARK_LABEL_SIZE];
    const char *needed[7] = {0};
    for (int k = 0; k < 6; k++) needed[k] = side_label(names[k], base[k], side);
    if (!need_landmarks(in->points, "BSSO", needed, e)) return false;
    jaw_side j = {.in = in, .tree = mandible, .side = side};
    if (!jaw_frame(in->points, &j.frame, e)) return false;
    j.lower = outline_make(in->mandible, &j.frame, side, 1, 2, -1);
    j.posterior = outline_make(in->mandible, &j.frame, side, 2, 1, 1);
    bool ok = bodies_of(&j, p, out, r, e);
    outline_free(&j.lower);
    outline_free(&j.posterior);
    return ok;
}
