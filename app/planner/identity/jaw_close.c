/* An open mouth closed: how far the mandible turns until the bite stops it. */
#include "app/planner/identity/head_jaw.h"
#include "app/planner/identity/head_sound.h"
#include "geometry/rig.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double open_mm = 2; /* what a bite may differ from the template's by without being an open mouth */
static const double overlap_allowed_mm = 0.1;
/* A mandible opens by some 20 to 25 mm as a hinge; beyond it the condyles glide (Okeson, "Management of
 * temporomandibular disorders and occlusion", ch. 4). */
static const double hinge_mm = 25;
enum { HALVINGS = 12 };

typedef struct hinge {
    const head_template *t;
    const head_shape *s;
    head_frame frame;
    double condyle[2][3], upper[3], lower[3]; /* and the incisors' edges */
    double bite_mm; /* by which the upper edge lies below the lower one in a closed mouth, along frame.up */
} hinge;

static rigid motion_of(const hinge *h, double up_deg)
{
    const jaw_motion j = {.open_deg = -up_deg};
    return rig_jaw_motion(&j, &h->frame, h->condyle);
}

static double open_by(const hinge *h, double up_deg)
{
    double x[3], d[3];
    rigid m = motion_of(h, up_deg);
    rigid_apply(&m, h->lower, x);
    vec_sub(h->upper, x, d);
    return vec_dot(d, h->frame.up) + h->bite_mm;
}

static const head_point *point_of(const head_template *t, const char *label)
{
    for (int32_t i = 0; i < t->point_count; i++)
        if (!strcmp(t->point[i].label, label)) return &t->point[i];
    return NULL;
}

/* Up is where the template's up was placed. */
static head_frame frame_of(const head_place *place)
{
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    head_frame f = {0};
    rigid_rotate(&place->motion, axis[0], f.left);
    rigid_rotate(&place->motion, axis[1], f.posterior);
    rigid_rotate(&place->motion, axis[2], f.up);
    return f;
}

static bool hinge_make(const head_template *t, const head_place *place, const head_shape *s, hinge *out, err *e)
{
    static const char *const label[4] = {"Co_L", "Co_R", "U1", "L1"};
    *out = (hinge){.t = t, .s = s, .frame = frame_of(place)};
    double *at[4] = {out->condyle[0], out->condyle[1], out->upper, out->lower};
    landmarks points = head_points(t, s);
    bool ok = true;
    for (int i = 0; ok && i < 4; i++) {
        const landmark *p = landmarks_find(&points, label[i]);
        if (p)
            vec_copy(p->xyz, at[i]);
        else
            ok = err_set(e, ERR_INPUT, "the template has no landmark %s about which a jaw could be closed", label[i]);
    }
    if (ok) out->bite_mm = place->scale * (point_of(t, "L1")->at[2] - point_of(t, "U1")->at[2]);
    landmarks_free(&points);
    return ok;
}

static bool overlap(const hinge *h, double up_deg, double *mm, err *e)
{
    rigid m = motion_of(h, up_deg);
    surface upper = head_part(h->t, h->s, CASE_UPPER_TEETH), lower = head_part(h->t, h->s, CASE_LOWER_TEETH);
    for (size_t v = 0; v < (size_t)lower.vertex_count; v++) rigid_apply(&m, lower.xyz + 3 * v, lower.xyz + 3 * v);
    bool ok = head_teeth_overlap(&upper, &lower, mm, e);
    surface_free(&upper);
    surface_free(&lower);
    return ok;
}

/* The angle, 0 to most_deg, at which the mouth is open by `mm` (it falls with the angle). */
static double angle_at(const hinge *h, double mm, double most_deg)
{
    double low = 0, high = most_deg;
    if (open_by(h, high) > mm) return high;
    for (int k = 0; k < 40; k++) {
        double middle = 0.5 * (low + high);
        *(open_by(h, middle) > mm ? &low : &high) = middle;
    }
    return high;
}

/* The largest angle up to *deg at which teeth lie no deeper in each other than allowed. */
static bool stop_at_teeth(const hinge *h, double allowed_mm, double *deg, head_closing *c, err *e)
{
    double mm, low = 0, high = *deg;
    if (!overlap(h, high, &mm, e)) return false;
    if (mm <= allowed_mm) return true;
    c->stop = JAW_AT_TEETH;
    for (int k = 0; k < HALVINGS; k++) {
        double middle = 0.5 * (low + high);
        if (!overlap(h, middle, &mm, e)) return false;
        *(mm <= allowed_mm ? &low : &high) = middle;
    }
    *deg = low;
    return true;
}

bool head_jaw_close(const head_template *t, const head_place *place, const task *watch, head_shape *s,
                    head_closing *out, err *e)
{
    hinge h;
    double of_template;
    if (!hinge_make(t, place, s, &h, e)) return false;
    *out = (head_closing){.stop = JAW_NOT_OPEN, .open_mm = open_by(&h, 0)};
    out->left_mm = out->open_mm;
    if (out->open_mm < open_mm) return true;
    task_progress(watch, "closing the mouth", -1);
    double most_deg = angle_at(&h, out->open_mm - hinge_mm, 45), deg = angle_at(&h, 0, most_deg);
    out->stop = open_by(&h, deg) > 0.01 ? JAW_AT_LIMIT : JAW_AT_BITE;
    if (!head_teeth_overlap(&t->part[CASE_UPPER_TEETH], &t->part[CASE_LOWER_TEETH], &of_template, e) ||
        !stop_at_teeth(&h, place->scale * of_template + overlap_allowed_mm, &deg, out, e))
        return false;
    if (open_by(&h, deg) > out->open_mm - 0.5 * open_mm) { /* teeth meet as it is: an open bite, not an open mouth */
        out->stop = JAW_NOT_OPEN;
        return true;
    }
    rigid m = motion_of(&h, deg);
    out->turn_deg = deg;
    out->left_mm = open_by(&h, deg);
    return head_jaw_turn(t, &m, s, e);
}

const char *head_closing_text(const head_closing *c, char *text, size_t size)
{
    static const char *const why[] = {"", "to the overlap of the template's incisors", "until other teeth meet",
                                      "as far as the joint turns without gliding"};
    if (c->stop == JAW_NOT_OPEN)
        snprintf(text, size, "the mouth is closed");
    else
        snprintf(text, size, "the mandible is turned up by %.1f deg, %s: of %.1f mm %.1f stay open", c->turn_deg,
                 why[c->stop], c->open_mm, fmax(c->left_mm, 0));
    return text;
}
