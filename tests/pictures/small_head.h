/* small_head: a head made of a few formulas, with bones, landmarks and a plan, for the picture tests. */
#pragma once
#include "tests/pictures/stage.h"
#include "render/gallery.h"
#include "geometry/vec.h"

enum { SMALL_HEAD_PARTS = 3 };

typedef struct small_head {
    surface before, after, bone[SMALL_HEAD_PARTS];
    subject_part part[SMALL_HEAD_PARTS];
    double rim[6 * 4]; /* of the maxilla: a square around its top */
    landmarks points, planned;
    double *signed_mm, *stretch_percent;
    subject shown;
} small_head;

static inline double bump(double a, double b, double at_a, double at_b, double width)
{
    double u = (a - at_a) / width, v = (b - at_b) / width;
    return exp(-(u * u + v * v));
}

/* The skin in the direction of side (left) and height angles, seen from the middle of the head: an egg with
 * nose, lips and chin. The jaw's share comes forward by jaw_mm. */
static inline void head_point(double side, double height, double jaw_mm, double out[3])
{
    double front = cos(side) > 0 ? cos(side) : 0;
    double r = 78 + 17 * bump(side, height, 0, -0.12, 0.20) + 5 * bump(side, height, 0, -0.52, 0.13) +
               6 * bump(side, height, 0, -0.70, 0.13) + 8 * bump(side, height, 0, -1.02, 0.24) -
               5 * bump(side, height, 0.42, 0.12, 0.22) - 5 * bump(side, height, -0.42, 0.12, 0.22);
    out[0] = 0.85 * r * cos(height) * sin(side);
    out[1] = -r * cos(height) * cos(side);
    out[2] = 1.15 * r * sin(height);
    double jaw = front * front * (height < -0.6 ? 1 : height > -0.3 ? 0 : (-0.3 - height) / 0.3);
    out[1] -= jaw * jaw_mm;
}

/* A sphere of directions as in ball(), placed by head_point. */
static inline surface head_skin(double jaw_mm, int n)
{
    surface s = ball((double[3]){0, 0, 0}, 1, n);
    for (int32_t v = 0; v < s.vertex_count; v++) {
        double *x = s.xyz + 3 * v;
        head_point(atan2(x[0], -x[1]), asin(fmax(-1, fmin(1, x[2]))), jaw_mm, x);
    }
    return s;
}

static inline void put_soft(landmarks *l, const char *label, double side, double height, double jaw_mm)
{
    double p[3];
    head_point(side, height, jaw_mm, p);
    landmarks_set(l, label, p);
}

/* jaw_mm forward for lower jaw and lower face, jaw_mm / 2 for the upper jaw; free with small_head_free. */
static inline void small_head_make(double jaw_mm, small_head *h)
{
    static const struct {
        const char *label;
        double height;
    } soft[] = {{"G'", 0.35},   {"N'", 0.16},       {"Pn", -0.12}, {"Sn", -0.36}, {"Ls", -0.50},
                {"Stm", -0.60}, {"Li_soft", -0.70}, {"B'", -0.84}, {"Pg'", -1.0}, {"Me'", -1.2}};
    static const struct {
        const char *label;
        double xyz[3];
        int part; /* that carries it */
    } hard[] = {{"N", {0, -68, 14}, 0},     {"S", {0, -10, 12}, 0},        {"Po_L", {60, 0, 0}, 0},
                {"Po_R", {-60, 0, 0}, 0},   {"Or_L", {30, -62, 0}, 0},     {"Or_R", {-30, -62, 0}, 0},
                {"ANS", {0, -66, -28}, 1},  {"PNS", {0, -24, -28}, 1},     {"A", {0, -64, -34}, 1},
                {"U1", {0, -66, -50}, 1},   {"U1_apex", {0, -60, -34}, 1}, {"B", {0, -60, -66}, 2},
                {"Pog", {0, -58, -76}, 2},  {"Gn", {0, -56, -79}, 2},      {"Me", {0, -52, -80}, 2},
                {"L1", {0, -63, -48}, 2},   {"Co_L", {50, -4, -6}, 2},     {"Co_R", {-50, -4, -6}, 2},
                {"Go_L", {40, -8, -60}, 2}, {"Go_R", {-40, -8, -60}, 2}};
    static const segment_id id[SMALL_HEAD_PARTS] = {SEGMENT_CRANIUM, SEGMENT_MAXILLA, SEGMENT_DISTAL};
    *h = (small_head){.before = head_skin(0, 36), .after = head_skin(jaw_mm, 36)};
    h->bone[0] = box(-46, -66, -22, 46, 60, 50);
    h->bone[1] = box(-26, -64, -50, 26, -20, -23);
    h->bone[2] = box(-34, -60, -80, 34, -10, -52);
    double move[SMALL_HEAD_PARTS] = {0, jaw_mm / 2, jaw_mm};
    for (int i = 0; i < SMALL_HEAD_PARTS; i++) {
        h->part[i] = (subject_part){.bone = &h->bone[i],
                                    .before = rigid_identity(),
                                    .after = rigid_translation((double[3]){0, -move[i], 0}),
                                    .kind = MATERIAL_BONE,
                                    .name = segment_name(id[i])};
        segment_color(id[i], h->part[i].rgb);
    }
    static const double corner[5][3] = {
        {-26, -64, -23}, {26, -64, -23}, {26, -20, -23}, {-26, -20, -23}, {-26, -64, -23}};
    for (int i = 0; i < 4; i++) {
        vec_copy(corner[i], h->rim + 6 * i);
        vec_copy(corner[i + 1], h->rim + 6 * i + 3);
    }
    h->part[1].rim = h->rim;
    h->part[1].rim_count = 4;
    for (size_t i = 0; i < sizeof soft / sizeof *soft; i++) {
        put_soft(&h->points, soft[i].label, 0, soft[i].height, 0);
        put_soft(&h->planned, soft[i].label, 0, soft[i].height, jaw_mm);
    }
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++) {
        double p[3];
        landmarks_set(&h->points, hard[i].label, hard[i].xyz);
        rigid_apply(&h->part[hard[i].part].after, hard[i].xyz, p);
        landmarks_set(&h->planned, hard[i].label, p);
    }
    h->signed_mm = NEW_ARRAY(double, h->before.vertex_count);
    h->stretch_percent = NEW_ARRAY(double, h->before.vertex_count);
    for (int32_t v = 0; v < h->before.vertex_count; v++) {
        h->signed_mm[v] = h->before.xyz[3 * v + 1] - h->after.xyz[3 * v + 1] - 1;
        h->stretch_percent[v] = fabs(h->before.xyz[3 * v + 2]) / 4;
    }
    h->shown = (subject){.case_name = "small head",
                         .plan_text = "jaw forward",
                         .case_hash = "0123abcd",
                         .skin_before = &h->before,
                         .skin_after = &h->after,
                         .signed_mm = h->signed_mm,
                         .stretch_percent = h->stretch_percent,
                         .parts = h->part,
                         .part_count = SMALL_HEAD_PARTS,
                         .before = &h->points,
                         .after = &h->planned,
                         .frame = straight_frame()};
}

static inline void small_head_free(small_head *h)
{
    surface_free(&h->before);
    surface_free(&h->after);
    for (int i = 0; i < SMALL_HEAD_PARTS; i++) surface_free(&h->bone[i]);
    landmarks_free(&h->points);
    landmarks_free(&h->planned);
    free(h->signed_mm);
    free(h->stretch_percent);
}

static inline gallery *open_gallery(const small_head *h, const gallery_style *style)
{
    err e = {0};
    gallery *g = NULL;
    assert_ok(gallery_open(&h->shown, style, &g, &e));
    return g;
}
