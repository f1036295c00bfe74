#include "geometry/osteotomy.h"
#include "geometry/boolean.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/src/cut/cut_plan.h"
#include "geometry/src/cut/fragments.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <string.h>

static const double balance_limit = 1e-3;

/* Cuts `piece` off *rest and adds to *kerf. */
static bool cut_off(const char *name, const cut_bodies *b, segment_id piece_id, segment_id rest_id,
                    const osteotomy_params *p, surface *rest, surface *piece, surface *kerf, cut_report *r, err *e)
{
    surface shell = {0}, off = {0}, left = {0}, dust = {0};
    double start = clock_s(), before = surface_volume(rest);
    bool ok = boolean_apply(&b->outer, &b->hollow, BOOLEAN_DIFFERENCE, &shell, NULL, e) &&
              boolean_apply(rest, &b->inner, BOOLEAN_INTERSECTION, &off, NULL, e) &&
              boolean_apply(rest, &b->outer, BOOLEAN_DIFFERENCE, &left, NULL, e) &&
              boolean_apply(rest, &shell, BOOLEAN_INTERSECTION, &dust, NULL, e);
    if (ok && (!off.triangle_count || !left.triangle_count || !dust.triangle_count))
        ok = err_set(e, ERR_GEOMETRY, "the cut misses the bone: nothing is %s",
                     !off.triangle_count    ? "cut off"
                     : !left.triangle_count ? "left"
                                            : "sawn");
    if (ok) {
        cut_balance c = {.before_mm3 = before,
                         .piece_mm3 = surface_volume(&off),
                         .rest_mm3 = surface_volume(&left),
                         .kerf_mm3 = surface_volume(&dust),
                         .seconds = clock_s() - start};
        snprintf(c.name, sizeof c.name, "%.31s", name);
        c.error_share = fabs(c.piece_mm3 + c.rest_mm3 + c.kerf_mm3 - before) / before;
        r->balance = GROW_ARRAY(cut_balance, r->balance, r->balance_count + 1);
        r->balance[r->balance_count++] = c;
        if (!(c.error_share <= balance_limit))
            ok = err_set(e, ERR_GEOMETRY, "volumes do not add up: %.1f + %.1f + %.1f of %.1f mm^3", c.piece_mm3,
                         c.rest_mm3, c.kerf_mm3, before);
    }
    if (ok) ok = fragments_settle(&off, piece_id, &left, rest_id, &dust, p->fragment_mm3, r, e);
    if (ok) {
        surface all = kerf->triangle_count ? surface_joined(kerf, &dust) : surface_copy(&dust);
        surface_free(kerf);
        *kerf = all;
        surface_free(rest);
        *rest = left;
        *piece = off;
        left = off = (surface){0};
    }
    surface_free(&shell);
    surface_free(&off);
    surface_free(&left);
    surface_free(&dust);
    return ok || err_prefix(e, "%s", name);
}

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

/* The piece that anatomy puts a landmark on. */
static const struct {
    const char *label;
    segment_id want;
} places[] = {{"U1", SEGMENT_MAXILLA},
              {"U3_L", SEGMENT_MAXILLA},
              {"U3_R", SEGMENT_MAXILLA},
              {"U6_L", SEGMENT_MAXILLA},
              {"U6_R", SEGMENT_MAXILLA},
              {"A", SEGMENT_MAXILLA},
              {"ANS", SEGMENT_MAXILLA},
              {"PNS", SEGMENT_MAXILLA},
              {"N", SEGMENT_CRANIUM},
              {"Or_L", SEGMENT_CRANIUM},
              {"Or_R", SEGMENT_CRANIUM},
              {"Zy_L", SEGMENT_CRANIUM},
              {"Zy_R", SEGMENT_CRANIUM},
              {"IOF_L", SEGMENT_CRANIUM},
              {"IOF_R", SEGMENT_CRANIUM},
              {"L1", SEGMENT_DISTAL},
              {"L3_L", SEGMENT_DISTAL},
              {"L3_R", SEGMENT_DISTAL},
              {"L6_L", SEGMENT_DISTAL},
              {"L6_R", SEGMENT_DISTAL},
              {"L7_L", SEGMENT_DISTAL},
              {"L7_R", SEGMENT_DISTAL},
              {"Li_L", SEGMENT_DISTAL},
              {"Li_R", SEGMENT_DISTAL},
              {"MF_L", SEGMENT_DISTAL},
              {"MF_R", SEGMENT_DISTAL},
              {"B", SEGMENT_DISTAL},
              {"Co_L", SEGMENT_PROXIMAL_LEFT},
              {"Cor_L", SEGMENT_PROXIMAL_LEFT},
              {"RP_L", SEGMENT_PROXIMAL_LEFT},
              {"Go_L", SEGMENT_PROXIMAL_LEFT},
              {"SN_L", SEGMENT_PROXIMAL_LEFT},
              {"Co_R", SEGMENT_PROXIMAL_RIGHT},
              {"Cor_R", SEGMENT_PROXIMAL_RIGHT},
              {"RP_R", SEGMENT_PROXIMAL_RIGHT},
              {"Go_R", SEGMENT_PROXIMAL_RIGHT},
              {"SN_R", SEGMENT_PROXIMAL_RIGHT},
              {"Me", SEGMENT_CHIN},
              {"Pog", SEGMENT_CHIN},
              {"Gn", SEGMENT_CHIN}};

static bool check_places(const osteotomy_input *in, const segments *s, cut_report *r, err *e)
{
    nearest *tree[SEGMENT_COUNT] = {0};
    bool ok = true;
    for (int i = 0; i < SEGMENT_COUNT && ok; i++)
        if (s->part[i].triangle_count) ok = nearest_create(s->part + i, tree + i, e);
    for (size_t k = 0; k < sizeof places / sizeof *places && ok; k++) {
        const landmark *l = landmarks_find(in->points, places[k].label);
        if (!l || !tree[places[k].want]) continue;
        int best = -1;
        double least = HUGE_VAL;
        for (int i = 0; i < SEGMENT_COUNT; i++) {
            double d = tree[i] ? nearest_point(tree[i], l->xyz, NULL, NULL) : HUGE_VAL;
            if (d < least) {
                least = d;
                best = i;
            }
        }
        if (best != (int)places[k].want)
            report_warning(r, "%s lies on the %s segment, not on the %s", places[k].label, segment_name(best),
                           segment_name(places[k].want));
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) nearest_destroy(tree + i);
    return ok;
}

static bool cut_segment(const osteotomy_input *in, const osteotomy_params *p, segment_id id, const nearest *jaw,
                        segments *s, cut_report *r, err *e)
{
    bool upper = id == SEGMENT_MAXILLA, planes = has_planes(in, id);
    segment_id rest = upper ? SEGMENT_CRANIUM : SEGMENT_DISTAL;
    unsigned kind = upper ? OSTEOTOMY_LE_FORT_1 : id == SEGMENT_CHIN ? OSTEOTOMY_GENIOPLASTY : OSTEOTOMY_BSSO;
    if (!planes && !(in->kinds & kind)) return true;
    cut_bodies b = {0};
    char name[64];
    snprintf(name, sizeof name, "%s%s",
             planes                        ? "planes of "
             : upper                       ? "le_fort_1"
             : id == SEGMENT_CHIN          ? "genioplasty"
             : id == SEGMENT_PROXIMAL_LEFT ? "bsso left"
                                           : "bsso right",
             planes ? segment_name(id) : "");
    bool ok = planes               ? plane_bodies(in, segment_name(id), s->part + rest, p, &b, r, e)
              : upper              ? le_fort_bodies(in, p, &b, r, e)
              : id == SEGMENT_CHIN ? genioplasty_bodies(in, p, &b, r, e)
                                   : bsso_bodies(in, p, jaw, id == SEGMENT_PROXIMAL_LEFT ? 1 : -1, &b, r, e);
    ok = ok && cut_off(name, &b, id, rest, p, s->part + rest, s->part + id, &s->kerf, r, e);
    cut_bodies_free(&b);
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
    ok = ok && check_places(in, &s, &r, e);
    nearest_destroy(&jaw);
    if (!ok) {
        segments_free(&s);
        cut_report_free(&r);
        return false;
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) r.volume_mm3[i] = surface_volume(s.part + i);
    r.kerf_mm3 = surface_volume(&s.kerf);
    *out = s;
    if (report)
        *report = r;
    else
        cut_report_free(&r);
    return true;
}
