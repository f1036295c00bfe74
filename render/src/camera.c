#include "render/camera.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stddef.h>

static const struct {
    const char *name;
    double toward[3]; /* from the target to the viewer: left, posterior, up */
    double up[3];
} table[VIEW_COUNT] = {
    [VIEW_FRONT] = {"front", {0, -1, 0}, {0, 0, 1}},
    [VIEW_LEFT] = {"left", {1, 0, 0}, {0, 0, 1}},
    [VIEW_RIGHT] = {"right", {-1, 0, 0}, {0, 0, 1}},
    /* 45 degrees, the clinical oblique view */
    [VIEW_THREE_QUARTER_LEFT] = {"three_quarter_left", {1, -1, 0}, {0, 0, 1}},
    [VIEW_THREE_QUARTER_RIGHT] = {"three_quarter_right", {-1, -1, 0}, {0, 0, 1}},
    /* 60 degrees below the horizon: the chin, the lips and the base of the nose at once */
    [VIEW_SUBMENTAL] = {"submental", {0, -0.5, -0.8660254037844386}, {0, -0.8660254037844386, 0.5}},
    [VIEW_SUPERIOR] = {"superior", {0, 0, 1}, {0, 1, 0}},
    [VIEW_POSTERIOR] = {"posterior", {0, 1, 0}, {0, 0, 1}},
};

const char *camera_view_name(camera_view view)
{
    assert(view >= 0 && view < VIEW_COUNT);
    return table[view].name;
}

void camera_view_angles(camera_view view, double *azimuth_deg, double *elevation_deg)
{
    assert(view >= 0 && view < VIEW_COUNT);
    const double *t = table[view].toward;
    *elevation_deg = atan2(t[2], hypot(t[0], t[1])) * (180 / M_PI);
    /* above and below, the direction of the picture's upper border tells where one looks from */
    *azimuth_deg = hypot(t[0], t[1]) > 0 ? atan2(t[0], -t[1]) * (180 / M_PI) : 0;
}

camera camera_orbit(double azimuth_deg, double elevation_deg, double roll_deg, const head_frame *frame,
                    const double target[3])
{
    double a = azimuth_deg * M_PI / 180, b = elevation_deg * M_PI / 180, roll = roll_deg * M_PI / 180;
    double toward_local[3] = {cos(b) * sin(a), -cos(b) * cos(a), sin(b)},
           up_local[3] = {-sin(b) * sin(a), sin(b) * cos(a), cos(b)}, toward[3] = {0}, up[3] = {0}, tipped[3];
    const double *axis[3] = {frame->left, frame->posterior, frame->up};
    for (int k = 0; k < 3; k++) {
        vec_axpy(toward, toward_local[k], axis[k], toward);
        vec_axpy(up, up_local[k], axis[k], up);
    }
    camera c;
    err e = {0};
    bool ok = camera_custom(toward, up, target, &c, &e);
    assert(ok);
    for (int k = 0; k < 3; k++) tipped[k] = cos(roll) * c.up[k] - sin(roll) * c.right[k];
    ok = camera_custom(toward, tipped, target, &c, &e);
    assert(ok);
    return c;
}

bool camera_custom(const double toward_viewer[3], const double up[3], const double target[3], camera *out, err *e)
{
    camera c = {.half_height_mm = 100, .depth_mm = 1000};
    vec_copy(target, c.target);
    vec_copy(toward_viewer, c.back);
    if (!(vec_normalize(c.back) > 0)) return err_set(e, ERR_INPUT, "the viewing direction is zero");
    double u[3] = {up[0], up[1], up[2]};
    vec_normalize(u);
    vec_cross(u, c.back, c.right);
    if (!(vec_normalize(c.right) > 1e-6))
        return err_set(e, ERR_INPUT, "the up vector of the view is zero or parallel to the viewing direction");
    vec_cross(c.back, c.right, c.up);
    *out = c;
    return true;
}

camera camera_standard(camera_view view, const head_frame *frame, const double target[3])
{
    assert(view >= 0 && view < VIEW_COUNT);
    double toward[3] = {0}, up[3] = {0};
    const double *axis[3] = {frame->left, frame->posterior, frame->up};
    for (int k = 0; k < 3; k++) {
        vec_axpy(toward, table[view].toward[k], axis[k], toward);
        vec_axpy(up, table[view].up[k], axis[k], up);
    }
    camera c;
    err e = {0};
    bool ok = camera_custom(toward, up, target, &c, &e);
    assert(ok);
    return c;
}

void camera_fit(camera *c, double radius_mm, int width, int height, double margin)
{
    assert(radius_mm > 0 && width > 0 && height > 0 && margin >= 0 && margin < 0.5);
    double usable = (width < height ? (double)width / height : 1.0) * (1 - 2 * margin);
    c->half_height_mm = radius_mm / usable;
    c->depth_mm = 2 * radius_mm;
}

void camera_fit_surfaces(camera *c, const surface *const *surfaces, int count, int width, int height, double margin)
{
    const double *axis[3] = {c->right, c->up, c->back};
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int s = 0; s < count; s++)
        for (int32_t v = 0; v < surfaces[s]->vertex_count; v++)
            for (int k = 0; k < 3; k++) {
                double x = vec_dot(surfaces[s]->xyz + 3 * (size_t)v, axis[k]);
                low[k] = fmin(low[k], x);
                high[k] = fmax(high[k], x);
            }
    if (!(low[0] <= high[0])) return;
    for (int i = 0; i < 3; i++) {
        c->target[i] = 0;
        for (int k = 0; k < 3; k++) c->target[i] += (low[k] + high[k]) / 2 * axis[k][i];
    }
    double usable = 1 - 2 * margin;
    double by_height = (high[1] - low[1]) / 2 / usable;
    double by_width = (high[0] - low[0]) / 2 / usable * height / width;
    c->half_height_mm = fmax(fmax(by_height, by_width), 1e-3);
    /* Parts that move are drawn with the same camera: leave room in depth. */
    c->depth_mm = (high[2] - low[2]) + c->half_height_mm;
}

void camera_set_perspective(camera *c, double angle_rad)
{
    assert(angle_rad > 0 && angle_rad < 3);
    c->eye_mm = c->half_height_mm / tan(angle_rad / 2);
    c->depth_mm = fmin(c->depth_mm, 0.95 * c->eye_mm);
}

double camera_scale(const camera *c, int height) { return height / (2 * c->half_height_mm); }

void camera_project(const camera *c, int width, int height, const double p[3], double *x, double *y, double *near_mm)
{
    double d[3];
    vec_sub(p, c->target, d);
    *near_mm = vec_dot(d, c->back);
    double scale = camera_scale(c, height);
    if (c->eye_mm > 0) scale *= c->eye_mm / (c->eye_mm - *near_mm);
    *x = width / 2.0 + scale * vec_dot(d, c->right);
    *y = height / 2.0 - scale * vec_dot(d, c->up);
}
