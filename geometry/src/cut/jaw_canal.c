/* The mandibular canal beside a split. */
#include "geometry/src/cut/jaw_side.h"
#include "geometry/vec.h"
#include <math.h>
#include <stddef.h>

static const double foramen_reach_mm = 8;

/* Behind the lingula, then along the body at 9 mm above the lower border and a third of the bone from inside,
 * to the mental foramen: only an estimate. */
static void estimate(jaw_side *j, cut_report *r)
{
    char label[LANDMARK_LABEL_SIZE];
    const landmark *mf = landmarks_find(j->in->points, side_label(label, "MF", j->side));
    double out, in;
    j->canal_estimated = true;
    vec_copy(j->li, j->canal[0]);
    j->canal[0][1] += 2;
    j->canal[0][2] -= FORAMEN_DROP_MM;
    if (jaw_side_cross(j, j->canal[0][1], j->canal[0][2], &out, &in)) j->canal[0][0] = in + 1;
    j->canal_count = 1;
    for (int k = 1; k <= 4; k++) {
        double y = j->canal[0][1] + k / 5.0 * (j->l6[1] - j->canal[0][1]), low = jaw_side_border(j, y), bowed = low + 9,
               z = k < 3 ? fmax(bowed, j->canal[0][2] - 6.0 * k) : bowed;
        if (!jaw_side_cross(j, y, z, &out, &in)) continue;
        double *q = j->canal[j->canal_count++];
        q[0] = in + fmin((out - in) / 3, 4);
        q[1] = y;
        q[2] = z;
    }
    if (mf)
        jaw_side_local(j, mf->xyz, j->canal[j->canal_count++]);
    else
        report_warning(r, "%s is missing: the %s canal is estimated up to the first molar only", label,
                       jaw_side_word(j));
}

bool jaw_side_take_canal(jaw_side *j, cut_report *r, err *e)
{
    int which = j->side > 0 ? 0 : 1;
    const osteotomy_input *in = j->in;
    if (!in->canal[which]) {
        estimate(j, r);
        return true;
    }
    if (in->canal_count[which] < 2 || in->canal_count[which] > CANAL_POINTS_MAX)
        return err_set(e, ERR_INPUT, "a canal needs 2 to %d points, got %d", CANAL_POINTS_MAX, in->canal_count[which]);
    j->canal_count = in->canal_count[which];
    for (int i = 0; i < j->canal_count; i++) jaw_side_local(j, in->canal[which] + 3 * (size_t)i, j->canal[i]);
    return true;
}

bool jaw_side_canal_at(const jaw_side *j, double y, double out[3])
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

int osteotomy_canal(const surface *mandible, const landmarks *points, const osteotomy_params *p, int side, double *xyz)
{
    const osteotomy_input in = {.mandible = mandible, .points = points};
    jaw_side j = {0};
    cut_report ignored = {0};
    err e = {0};
    nearest *tree = NULL;
    char label[6][LANDMARK_LABEL_SIZE];
    const char *needed[7];
    jaw_side_needs(side, label, needed);
    if (!need_landmarks(points, "", needed, &e)) return 0;
    if (!nearest_create(mandible, &tree, &e)) return 0;
    if (jaw_side_open(&in, tree, side, &j, &e) && jaw_side_locate(&j, p, &ignored, &e)) estimate(&j, &ignored);
    for (int i = 0; i < j.canal_count; i++) jaw_side_world(&j, j.canal[i], xyz + 3 * (size_t)i);
    jaw_side_close(&j);
    cut_report_free(&ignored);
    nearest_destroy(&tree);
    return j.canal_count;
}
