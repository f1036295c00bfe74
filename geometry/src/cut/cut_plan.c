#include "geometry/src/cut/cut_plan.h"
#include "geometry/incisor.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include "geometry/vec.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void cut_bodies_free(cut_bodies *b)
{
    surface_free(&b->inner);
    surface_free(&b->outer);
    surface_free(&b->hollow);
    surface_free(&b->sheet);
}

cut_bodies cut_bodies_from(const cutter *c, double kerf_mm)
{
    return (cut_bodies){.inner = cutter_offset(c, -kerf_mm / 2, 0),
                        .outer = cutter_offset(c, kerf_mm / 2, 0),
                        .hollow = cutter_offset(c, -kerf_mm / 2, HOLLOW_MM),
                        .sheet = cutter_sheet(c)};
}

bool landmark_point(const landmarks *l, const char *label, double out[3])
{
    const landmark *p = landmarks_find(l, label);
    molar m;
    incisor edge;
    bool front = !strcmp(label, "U1") || !strcmp(label, "L1");
    bool first_molar = !strncmp(label, "U6_", 3) || !strncmp(label, "L6_", 3);
    if (p)
        vec_copy(p->xyz, out);
    else if (first_molar && strlen(label) == 4 && molar_find(l, label[0] == 'U', label[3] == 'L' ? 1 : -1, &m))
        vec_copy(m.xyz, out);
    else if (front && incisor_find(l, label[0] == 'U', &edge))
        vec_copy(edge.xyz, out);
    else
        return false;
    return true;
}

bool need_landmarks(const landmarks *l, const char *what, const char *const *labels, err *e)
{
    char missing[400] = "";
    double at[3];
    for (int i = 0; labels[i]; i++)
        if (!landmark_point(l, labels[i], at)) {
            size_t used = strlen(missing);
            snprintf(missing + used, sizeof missing - used, "%s%s", used ? ", " : "", labels[i]);
        }
    if (missing[0]) return err_set(e, ERR_INPUT, "%s needs landmarks that are missing: %s", what, missing);
    return true;
}

bool landmark_local(const landmarks *l, const char *label, const head_frame *f, double local[3])
{
    double at[3];
    if (!landmark_point(l, label, at)) return false;
    head_frame_to_local(f, at, local);
    return true;
}

const char *side_label(char buffer[LANDMARK_LABEL_SIZE], const char *base, int side)
{
    snprintf(buffer, LANDMARK_LABEL_SIZE, "%s_%c", base, side > 0 ? 'L' : 'R');
    return buffer;
}

bool jaw_frame(const landmarks *l, head_frame *out, err *e)
{
    static const char *const needed[] = {"L1", "L6_L", "L6_R", NULL}, *const pairs[] = {"L6", "Go", "RA", "RP", "Co"};
    if (!need_landmarks(l, "the frame of the mandible", needed, e)) return false;
    head_frame f = {0};
    double front[3], middle[3], back[3], across[3], left[3], right[3];
    (void)(landmark_point(l, "L1", front) && landmark_point(l, "L6_L", left) &&
           landmark_point(l, "L6_R", right)); /* needed above */
    for (int c = 0; c < 3; c++) middle[c] = (left[c] + right[c]) / 2;
    vec_sub(middle, front, back);
    vec_sub(left, right, across);
    if (!(vec_norm(back) > 5) || !(vec_norm(across) > 10))
        return err_set(e, ERR_INPUT, "L1, L6_L and L6_R are too close to each other to give the lower occlusal plane");
    vec_cross(across, back, f.up);
    if (!(vec_normalize(f.up) > 0)) return err_set(e, ERR_INPUT, "L1, L6_L and L6_R lie on one line");
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char label[LANDMARK_LABEL_SIZE];
        const landmark *a = landmarks_find(l, side_label(label, pairs[i], 1)),
                       *b = landmarks_find(l, side_label(label, pairs[i], -1));
        double d[3];
        if (!a || !b) continue;
        vec_sub(a->xyz, b->xyz, d);
        vec_normalize(d);
        vec_add(f.left, d, f.left);
    }
    vec_axpy(f.left, -vec_dot(f.left, f.up), f.up, f.left);
    vec_normalize(f.left);
    vec_cross(f.up, f.left, f.posterior);
    vec_copy(middle, f.origin);
    *out = f;
    return true;
}

static const double outline_step_mm = 0.5;

outline outline_make(const surface *s, const head_frame *f, int side, int across, int along, int sign)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    double *local = NEW_ARRAY(double, 3 * (size_t)s->vertex_count);
    for (int32_t v = 0; v < s->vertex_count; v++) {
        double *p = local + 3 * (size_t)v;
        head_frame_to_local(f, s->xyz + 3 * (size_t)v, p);
        p[0] *= side;
        low = fmin(low, p[across]);
        high = fmax(high, p[across]);
    }
    outline o = {.start = low, .count = 1 + (int)ceil((high - low) / outline_step_mm), .sign = sign};
    o.extreme = NEW_ARRAY(double, o.count);
    for (int i = 0; i < o.count; i++) o.extreme[i] = -sign * HUGE_VAL;
    for (size_t i = 0; i < 3 * (size_t)s->triangle_count; i++) { /* the extreme of a section lies on an edge */
        const double *a = local + 3 * (size_t)s->tri[i], *b = local + 3 * (size_t)s->tri[i % 3 == 2 ? i - 2 : i + 1];
        double span = b[across] - a[across];
        if (!(span > 0)) continue; /* the other triangle of the edge runs upwards */
        int k = (int)ceil((a[across] - low) / outline_step_mm);
        for (; k < o.count && low + k * outline_step_mm <= b[across]; k++) {
            double t = (low + k * outline_step_mm - a[across]) / span;
            if (a[0] + t * (b[0] - a[0]) <= 0) continue;
            double value = a[along] + t * (b[along] - a[along]);
            o.extreme[k] = sign > 0 ? fmax(o.extreme[k], value) : fmin(o.extreme[k], value);
        }
    }
    free(local);
    return o;
}

void outline_free(outline *o)
{
    free(o->extreme);
    *o = (outline){0};
}

double outline_at(const outline *o, double x)
{
    double at = (x - o->start) / outline_step_mm;
    int i = (int)floor(at);
    if (!(at >= 0) || i + 1 >= o->count) return -o->sign * HUGE_VAL;
    double a = o->extreme[i], b = o->extreme[i + 1];
    if (!isfinite(a) || !isfinite(b)) return isfinite(a) ? a : b;
    return a + (at - i) * (b - a);
}

void report_take(cut_report *r, cut_report *from)
{
#define TAKE(type, list)                                                                                               \
    r->list = GROW_ARRAY(type, r->list, r->list##_count + from->list##_count);                                         \
    for (int i = 0; i < from->list##_count; i++) r->list[r->list##_count++] = from->list[i]
    TAKE(cut_balance, balance);
    TAKE(cut_clearance, clearance);
    TAKE(cut_fragment, fragment);
    TAKE(cut_plane, plane);
#undef TAKE
    for (int i = 0; i < from->warning_count; i++) report_warning(r, "%s", from->warning[i]);
    for (int i = 0; i < from->note_count; i++) report_note(r, "%s", from->note[i]);
    cut_report_free(from);
}

void report_clearance(cut_report *r, const char *name, double value_mm, double limit_mm, bool estimated)
{
    r->clearance = GROW_ARRAY(cut_clearance, r->clearance, r->clearance_count + 1);
    cut_clearance *c = r->clearance + r->clearance_count++;
    *c =
        (cut_clearance){.value_mm = value_mm, .limit_mm = limit_mm, .ok = value_mm >= limit_mm, .estimated = estimated};
    snprintf(c->name, sizeof c->name, "%s", name);
}

void report_plane(cut_report *r, const char *label, const double point[3], const double normal[3])
{
    r->plane = GROW_ARRAY(cut_plane, r->plane, r->plane_count + 1);
    cut_plane *p = r->plane + r->plane_count++;
    *p = (cut_plane){0};
    snprintf(p->label, sizeof p->label, "%s", label);
    vec_copy(point, p->point);
    vec_copy(normal, p->normal);
    vec_normalize(p->normal);
}

void report_warning(cut_report *r, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    r->warning = mem_grow(r->warning, (size_t)r->warning_count + 1, sizeof *r->warning);
    vsnprintf(r->warning[r->warning_count++], sizeof *r->warning, fmt, args);
    va_end(args);
}

void report_note(cut_report *r, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    r->note = mem_grow(r->note, (size_t)r->note_count + 1, sizeof *r->note);
    vsnprintf(r->note[r->note_count++], sizeof *r->note, fmt, args);
    va_end(args);
}

void cut_report_free(cut_report *r)
{
    free(r->balance);
    free(r->clearance);
    free(r->fragment);
    free(r->plane);
    free(r->warning);
    free(r->note);
    *r = (cut_report){0};
}
