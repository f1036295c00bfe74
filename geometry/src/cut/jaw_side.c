#include "geometry/src/cut/jaw_side.h"
#include "geometry/vec.h"
#include <math.h>
#include <stddef.h>

static const double third_molar_mm = 23; /* L6 to L7 beyond this: L7 is the third molar */
static const double behind_m2_mm = 1;
static const double posterior_strip_mm = 4; /* bone kept behind the lingual cut at the top */
static const double angle_mm = 12;          /* the lingual cut meets the lower border this far before gonion */
static const double least_lingual_mm = 4;   /* least distance from the buccal to the lingual cut */
static const double cusp_to_contact_mm = 2; /* mesiobuccal cusp to mesial contact of the lower first molar */

static const char *const labels[6] = {"L6", "L7", "Go", "SN", "RA", "RP"};

void jaw_side_needs(int side, char label[6][LANDMARK_LABEL_SIZE], const char *needed[7])
{
    for (int k = 0; k < 6; k++) needed[k] = side_label(label[k], labels[k], side);
    needed[6] = NULL;
}

bool jaw_side_open(const osteotomy_input *in, const nearest *mandible, int side, jaw_side *out, err *e)
{
    jaw_side j = {.in = in, .tree = mandible, .side = side};
    if (!jaw_frame(in->points, &j.frame, e)) return false;
    j.lower = outline_make(in->mandible, &j.frame, side, 1, 2, -1);
    j.posterior = outline_make(in->mandible, &j.frame, side, 2, 1, 1);
    *out = j;
    return true;
}

void jaw_side_close(jaw_side *j)
{
    outline_free(&j->lower);
    outline_free(&j->posterior);
}

const char *jaw_side_word(const jaw_side *j) { return j->side > 0 ? "left" : "right"; }

void jaw_side_local(const jaw_side *j, const double world[3], double local[3])
{
    head_frame_to_local(&j->frame, world, local);
    local[0] *= j->side;
}

void jaw_side_world(const jaw_side *j, const double local[3], double world[3])
{
    double p[3] = {local[0] * j->side, local[1], local[2]};
    head_frame_to_world(&j->frame, p, world);
}

bool jaw_side_cross(const jaw_side *j, double y, double z, double *outside, double *inside)
{
    double from[3] = {j->high[0] + 20, y, z}, start[3], way[3], hit[3], local[3];
    jaw_side_world(j, from, start);
    vec_scale(j->frame.left, -j->side, way);
    if (!nearest_ray(j->tree, start, way, hit, NULL)) return false;
    jaw_side_local(j, hit, local);
    *outside = local[0];
    from[0] = 0;
    jaw_side_world(j, from, start);
    vec_scale(way, -1, way);
    if (!nearest_ray(j->tree, start, way, hit, NULL)) return false;
    jaw_side_local(j, hit, local);
    *inside = local[0];
    return *outside > 0 && *inside > 0;
}

double jaw_side_border(const jaw_side *j, double y) { return outline_at(&j->lower, y); }

double jaw_side_buccal_y(const jaw_side *j, double z) { return j->m2[1] + j->v_slope * (z - j->m2[2]); }

double jaw_side_lingual_y(const jaw_side *j, double z)
{
    double t = (z - j->lingual[1][1]) / (j->lingual[0][1] - j->lingual[1][1]);
    return fmax(j->lingual[1][0] + t * (j->lingual[0][0] - j->lingual[1][0]),
                jaw_side_buccal_y(j, z) + least_lingual_mm);
}

/* ---- where the cuts run ---- */

static void find_extent(jaw_side *j)
{
    for (int c = 0; c < 3; c++) {
        j->low[c] = HUGE_VAL;
        j->high[c] = -HUGE_VAL;
    }
    for (int32_t v = 0; v < j->in->mandible->vertex_count; v++) {
        double q[3];
        jaw_side_local(j, j->in->mandible->xyz + 3 * (size_t)v, q);
        if (q[0] < 0) continue;
        for (int c = 0; c < 3; c++) {
            j->low[c] = fmin(j->low[c], q[c]);
            j->high[c] = fmax(j->high[c], q[c]);
        }
    }
}

static bool find_places(jaw_side *j, err *e)
{
    char label[LANDMARK_LABEL_SIZE];
    double *const place[] = {j->l6, j->l7, j->go, j->sn, j->ra, j->rp};
    for (int k = 0; k < 6; k++) {
        double at[3];
        (void)landmark_point(j->in->points, side_label(label, labels[k], j->side), at); /* jaw_side_needs */
        jaw_side_local(j, at, place[k]);
    }
    find_extent(j);
    if (!(j->l6[0] > 0 && j->go[0] > 0 && j->ra[1] < j->rp[1] && j->l6[1] < j->ra[1]))
        return err_set(e, ERR_INPUT, "BSSO %s: L6, RA, RP, Go are not where a mandible has them", jaw_side_word(j));
    return true;
}

/* Molars of a set scale together. */
static void find_second_molar(jaw_side *j, cut_report *r)
{
    double reach = vec_distance(j->l6, j->l7), to_m2 = LOWER_M1_WIDTH_MM - cusp_to_contact_mm + LOWER_M2_WIDTH_MM,
           share = 1;
    if (reach > third_molar_mm) {
        share = to_m2 / (to_m2 + 10); /* the third molar is 10 mm wide */
        report_warning(r,
                       "BSSO %s: L7 lies %.1f mm behind L6, so it marks the third molar; the vertical cut is placed "
                       "%.1f mm in front of it, behind the second molar",
                       jaw_side_word(j), reach, (1 - share) * reach);
    }
    for (int c = 0; c < 3; c++) j->m2[c] = j->l6[c] + share * (j->l7[c] - j->l6[c]);
    j->m2[1] += behind_m2_mm;
}

/* At right angles to the lower border below it. */
static bool find_buccal_cut(jaw_side *j, err *e)
{
    double ahead = jaw_side_border(j, j->m2[1] - 8), behind = jaw_side_border(j, j->m2[1] + 8);
    if (!isfinite(ahead) || !isfinite(behind))
        return err_set(e, ERR_GEOMETRY, "BSSO %s: no bone below L7", jaw_side_word(j));
    double slope = fmin(fmax((behind - ahead) / 16, -1), 1);
    j->v_slope = -slope;
    j->border_at_v = jaw_side_border(j, jaw_side_buccal_y(j, ahead));
    return true;
}

/* A missing one is placed by the mean of 150 rami. */
static bool find_lingula(jaw_side *j, const osteotomy_params *p, cut_report *r, err *e)
{
    char label[LANDMARK_LABEL_SIZE];
    const landmark *li = landmarks_find(j->in->points, side_label(label, "Li", j->side));
    double z, out, in;
    if (li) {
        jaw_side_local(j, li->xyz, j->li);
        return true;
    }
    j->lingula_estimated = true;
    j->li[1] = j->rp[1] - p->lingula_width_share * (j->rp[1] - j->ra[1]);
    double low = jaw_side_border(j, j->li[1]);
    z = low + p->lingula_height_share * (j->sn[2] - low);
    if (!jaw_side_cross(j, j->li[1], z, &out, &in))
        return err_set(e, ERR_GEOMETRY, "BSSO %s: no ramus where the lingula is expected", jaw_side_word(j));
    j->li[0] = in;
    j->li[2] = z;
    report_warning(r,
                   "BSSO %s: %s is missing; estimated at %.0f %% of the ramus width from behind and %.0f %% of "
                   "its height",
                   jaw_side_word(j), label, 100 * p->lingula_width_share, 100 * p->lingula_height_share);
    return true;
}

static bool find_medial_cut(jaw_side *j, const osteotomy_params *p, cut_report *r, err *e)
{
    j->top = j->li[2] + p->above_lingula_mm;
    double teeth = fmax(j->l6[2], j->l7[2]) + 1;
    if (j->top < teeth) {
        report_note(r, "BSSO %s: the medial cut is raised by %.1f mm to stay above the molars", jaw_side_word(j),
                    teeth - j->top);
        j->top = teeth;
    }
    if (j->top > j->sn[2] - NOTCH_MM)
        return err_set(e, ERR_GEOMETRY,
                       "BSSO %s: the medial cut would lie %.1f mm below the sigmoid notch; %g mm are "
                       "needed",
                       jaw_side_word(j), j->sn[2] - j->top, NOTCH_MM);
    return true;
}

static bool find_lingual_cut(jaw_side *j, const osteotomy_params *p, err *e)
{
    double last = outline_at(&j->posterior, j->top), room = last - posterior_strip_mm;
    /* The foramen lies below and behind the tip of the lingula: the margin holds at its height. */
    j->lingual[0][0] = j->li[1] + p->behind_lingula_mm;
    j->lingual[0][1] = j->li[2] - FORAMEN_DROP_MM;
    if (room < j->li[1] + 1)
        return err_set(e, ERR_GEOMETRY, "BSSO %s: only %.1f mm of ramus lie behind the lingula", jaw_side_word(j),
                       last - j->li[1]);
    double y = fmax(jaw_side_buccal_y(j, j->border_at_v) + least_lingual_mm, j->go[1] - angle_mm);
    j->lingual[1][0] = fmin(y, j->lingual[0][0]);
    j->lingual[1][1] = jaw_side_border(j, j->lingual[1][0]);
    if (!(j->lingual[0][1] > j->lingual[1][1] + 1))
        return err_set(e, ERR_INPUT, "BSSO %s: the lingula lies at the lower border", jaw_side_word(j));
    if (jaw_side_lingual_y(j, j->top) > room) { /* turn it about its lower end */
        double rise = (j->lingual[0][1] - j->lingual[1][1]) / (j->top - j->lingual[1][1]);
        j->lingual[0][0] = j->lingual[1][0] + (room - j->lingual[1][0]) * rise;
    }
    return true;
}

bool jaw_side_locate(jaw_side *j, const osteotomy_params *p, cut_report *r, err *e)
{
    if (!find_places(j, e)) return false;
    find_second_molar(j, r);
    return find_buccal_cut(j, e) && find_lingula(j, p, r, e) && find_medial_cut(j, p, r, e) &&
           find_lingual_cut(j, p, e);
}
