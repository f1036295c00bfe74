#include "geometry/osteotomy.h"
#include "geometry/boolean.h"
#include "geometry/handles.h"
#include "geometry/src/cut/sawn.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <string.h>

/* A box around the bone, cut down by every plane of this label. */
static bool plane_bodies(const osteotomy_input *in, const char *label, const surface *bone, const osteotomy_params *p,
                         cut_bodies *out, cut_report *r, err *e)
{
    double low[3], high[3], centre[3], size;
    surface_bounds(bone, low, high);
    for (int c = 0; c < 3; c++) centre[c] = (low[c] + high[c]) / 2;
    size = 2 * vec_distance(low, high);
    surface body[3] = {{0}, {0}, {0}}; /* inner, outer, hollow */
    bool ok = true;
    for (int i = 0; i < in->plane_count && ok; i++) {
        const cut_plane *q = in->plane + i;
        if (strcmp(q->label, label)) continue;
        head_frame f = {0};
        double helper[3] = {fabs(q->normal[0]) < 0.7, fabs(q->normal[0]) >= 0.7, 0};
        vec_copy(q->normal, f.up);
        vec_normalize(f.up);
        vec_cross(helper, f.up, f.left);
        vec_normalize(f.left);
        vec_cross(f.up, f.left, f.posterior);
        vec_sub(centre, q->point, f.origin); /* the foot of the bone's centre on the plane */
        vec_axpy(centre, -vec_dot(f.origin, f.up), f.up, f.origin);
        for (int k = 0; k < 3 && ok; k++) {
            /* Boxes of several planes differ in size, so that they share no face. */
            double far = size * (1 + 0.01 * i) + (k == 2 ? HOLLOW_MM : 0), start = (k == 1 ? -1 : 1) * p->kerf_mm / 2;
            cutter box = cutter_box(&f, (double[3]){-far, -far, start}, (double[3]){far, far, start + far});
            if (!body[k].triangle_count) {
                body[k] = surface_copy(&box.body);
            } else {
                surface both = {0};
                ok = boolean_apply(body + k, &box.body, BOOLEAN_INTERSECTION, &both, NULL, e);
                if (ok && !both.triangle_count)
                    ok = err_set(e, ERR_INPUT, "planes of %s have nothing in common", label);
                surface_free(body + k);
                body[k] = both;
            }
            cutter_free(&box);
        }
        report_plane(r, label, q->point, q->normal);
    }
    if (!ok) {
        for (int k = 0; k < 3; k++) surface_free(body + k);
        return false;
    }
    *out = (cut_bodies){.inner = body[0], .outer = body[1], .hollow = body[2]};
    return true;
}

static bool has_planes(const osteotomy_input *in, segment_id id)
{
    for (int i = 0; i < in->plane_count; i++)
        if (!strcmp(in->plane[i].label, segment_name(id))) return true;
    return false;
}

static bool check_input(const osteotomy_input *in, err *e)
{
    for (int i = 0; i < in->plane_count; i++) {
        int id = segment_from_name(in->plane[i].label);
        if (id < 0)
            return err_set(e, ERR_INPUT,
                           "plane \"%s\": its label must name the segment to be cut off: maxilla, "
                           "proximal_left, proximal_right or chin",
                           in->plane[i].label);
        if (id == SEGMENT_CRANIUM || id == SEGMENT_DISTAL)
            return err_set(e, ERR_INPUT,
                           "plane \"%s\": this segment is what the other cuts leave; name the piece that "
                           "comes off",
                           in->plane[i].label);
        if (!(fabs(vec_norm(in->plane[i].normal) - 1) < 1e-3))
            return err_set(e, ERR_INPUT, "plane \"%s\": the normal is not a unit vector", in->plane[i].label);
    }
    bool skull = (in->kinds & OSTEOTOMY_LE_FORT_1) || has_planes(in, SEGMENT_MAXILLA);
    bool mandible = (in->kinds & (OSTEOTOMY_BSSO | OSTEOTOMY_GENIOPLASTY)) || has_planes(in, SEGMENT_CHIN) ||
                    has_planes(in, SEGMENT_PROXIMAL_LEFT) || has_planes(in, SEGMENT_PROXIMAL_RIGHT);
    if (skull && !in->skull) return err_set(e, ERR_INPUT, "the maxilla is to be cut but the case has no skull");
    if (mandible && !in->mandible) return err_set(e, ERR_INPUT, "the mandible is to be cut but the case has none");
    return true;
}

/* One cut of a bone; plate as in bsso_bodies. */
static bool cut_once(const osteotomy_input *in, const osteotomy_params *p, segment_id id, const nearest *jaw,
                     lateral_plate plate, const surface *bone, sawn *out, err *e)
{
    bool upper = id == SEGMENT_MAXILLA, planes = has_planes(in, id);
    cut_bodies b = {0};
    cut_report *r = &out->report;
    char name[64];
    snprintf(name, sizeof name, "%s%s",
             planes                        ? "planes of "
             : upper                       ? "le_fort_1"
             : id == SEGMENT_CHIN          ? "genioplasty"
             : id == SEGMENT_PROXIMAL_LEFT ? "bsso left"
                                           : "bsso right",
             planes ? segment_name(id) : "");
    bool ok = planes               ? plane_bodies(in, segment_name(id), bone, p, &b, r, e)
              : upper              ? le_fort_bodies(in, p, &b, r, e)
              : id == SEGMENT_CHIN ? genioplasty_bodies(in, p, &b, r, e)
                                   : bsso_bodies(in, p, jaw, id == SEGMENT_PROXIMAL_LEFT ? 1 : -1, plate, &b, r, e);
    ok = ok && sawn_make(name, &b, id, upper ? SEGMENT_CRANIUM : SEGMENT_DISTAL, p, bone, out, e);
    cut_bodies_free(&b);
    return ok;
}

/* A split that came out of the lateral plate is laid anew further inside, for a thicker plate until no window is left;
 * then from farther out. */
static void lay_anew(const osteotomy_input *in, const osteotomy_params *p, segment_id id, const nearest *jaw,
                     const surface *bone, sawn *s)
{
    const breach first = s->where;
    for (int k = 0; s->made > 0 && k < 12; k++) {
        lateral_plate plate = {1.5 + k % 4, p->buccal_depth_mm * (1 + k / 4)};
        sawn again = {0};
        err unused = {0}; /* a cut that cannot be laid there is no fault of the one that can */
        bool better = cut_once(in, p, id, jaw, plate, bone, &again, &unused) && again.made < s->made;
        if (better) {
            sawn worse = *s;
            *s = again;
            again = worse;
            report_warning(&s->report,
                           "%s: as first laid, the split came out of the lateral plate in a window of %.1f mm near %s "
                           "(%.1f, %.1f, %.1f); it was moved inwards by up to %.1f mm to leave a plate of %.1f mm",
                           segment_name(id), first.wide_mm, breach_landmark(&first, in->points), first.place[0],
                           first.place[1], first.place[2], s->moved_mm, plate.least_mm);
        }
        sawn_free(&again);
    }
}

static bool cut_segment(const osteotomy_input *in, const osteotomy_params *p, segment_id id, const nearest *jaw,
                        segments *s, cut_report *r, err *e)
{
    segment_id rest = id == SEGMENT_MAXILLA ? SEGMENT_CRANIUM : SEGMENT_DISTAL;
    unsigned kind = id == SEGMENT_MAXILLA ? OSTEOTOMY_LE_FORT_1
                    : id == SEGMENT_CHIN  ? OSTEOTOMY_GENIOPLASTY
                                          : OSTEOTOMY_BSSO;
    bool planes = has_planes(in, id);
    if (!planes && !(in->kinds & kind)) return true;
    sawn cut = {0};
    bool ok = cut_once(in, p, id, jaw, (lateral_plate){0}, s->part + rest, &cut, e);
    if (ok && !planes && kind == OSTEOTOMY_BSSO) lay_anew(in, p, id, jaw, s->part + rest, &cut);
    if (ok) {
        surface kerf = surface_joined(&s->kerf, &cut.kerf), bone = s->part[rest];
        if (cut.made > 0)
            report_warning(
                &cut.report,
                "%s: the cut meets no bone in a window of %.1f mm near %s (%.1f, %.1f, %.1f): handles of the "
                "bone %d, of its pieces %d",
                segment_name(id), cut.where.wide_mm, breach_landmark(&cut.where, in->points), cut.where.place[0],
                cut.where.place[1], cut.where.place[2], cut.handles, cut.handles + cut.made);
        report_take(r, &cut.report);
        surface_free(&s->kerf);
        s->kerf = kerf;
        s->part[id] = cut.piece;
        s->part[rest] = cut.rest;
        cut.piece = (surface){0};
        cut.rest = bone;
    }
    sawn_free(&cut);
    return ok;
}

bool osteotomy_cut(const osteotomy_input *in, const osteotomy_params *p, segments *out, cut_report *report, err *e)
{
    if (!osteotomy_params_check(p, e) || !check_input(in, e)) return false;
    segments s = {0};
    cut_report r = {0};
    nearest *jaw = NULL;
    if (in->skull) s.part[SEGMENT_CRANIUM] = surface_copy(in->skull);
    if (in->mandible) s.part[SEGMENT_DISTAL] = surface_copy(in->mandible);
    bool ok = !in->mandible || nearest_create(in->mandible, &jaw, e);
    static const segment_id order[] = {SEGMENT_MAXILLA, SEGMENT_PROXIMAL_LEFT, SEGMENT_PROXIMAL_RIGHT, SEGMENT_CHIN};
    for (int i = 0; i < 4 && ok; i++) ok = cut_segment(in, p, order[i], jaw, &s, &r, e);
    ok = ok && cut_places_check(in, &s, &r, e);
    nearest_destroy(&jaw);
    if (!ok) {
        segments_free(&s);
        cut_report_free(&r);
        return false;
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) {
        r.volume_mm3[i] = surface_volume(s.part + i);
        r.handles[i] = surface_handles(s.part + i);
    }
    r.kerf_mm3 = surface_volume(&s.kerf);
    *out = s;
    if (report)
        *report = r;
    else
        cut_report_free(&r);
    return true;
}
