/* camera: where the viewer stands. Standard views come from the head frame, so that a tilted scan is shown
 * upright.
 *
 * Orthographic is the default: one scale holds for the whole picture, so that a scale bar is true. Before and
 * after share one camera: fit it once to a region (centre + radius) and draw both with it. */
#pragma once
#include "geometry/frame.h"
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum camera_view {
    VIEW_FRONT,              /* the patient's left is on the viewer's right */
    VIEW_LEFT,               /* the patient's left profile, looking to the viewer's left */
    VIEW_RIGHT,              /* the patient's right profile, looking to the viewer's right */
    VIEW_THREE_QUARTER_LEFT, /* between front and left profile */
    VIEW_THREE_QUARTER_RIGHT,
    VIEW_SUBMENTAL, /* from below, the nose up */
    VIEW_SUPERIOR,  /* from above, the nose down */
    VIEW_POSTERIOR,
    VIEW_COUNT
} camera_view;

typedef struct camera {
    double target[3];                /* mm, seen in the middle of the picture */
    double right[3], up[3], back[3]; /* unit, right-handed; back points from the target to the viewer */
    double half_height_mm;           /* half the height of the picture, in the plane of the target */
    double depth_mm;                 /* what is nearer or farther than this from the target plane is clipped */
    double eye_mm;                   /* perspective: distance of the eye from the target; 0: orthographic */
} camera;

const char *camera_view_name(camera_view view); /* "front", "left", "three_quarter_left", ... */
/* A standard view onto `target`. The size is set with camera_fit. */
camera camera_standard(camera_view view, const head_frame *frame, const double target[3]);
/* From anywhere on a sphere about the target: azimuth 0 is the front and 90 the patient's left, elevation 90
 * is from above, roll tips the head clockwise in the picture. */
camera camera_orbit(double azimuth_deg, double elevation_deg, double roll_deg, const head_frame *frame,
                    const double target[3]);
/* A standard view as such angles. */
void camera_view_angles(camera_view view, double *azimuth_deg, double *elevation_deg);
/* Any view. Refuses (ERR_INPUT) a zero direction and an up vector parallel to it. */
bool camera_custom(const double toward_viewer[3], const double up[3], const double target[3], camera *out,
                   err *e) MUST_CHECK;
/* Makes a sphere about the target fill the smaller side of a width x height picture, leaving margin (0.05: 5
 * %). */
void camera_fit(camera *c, double radius_mm, int width, int height, double margin);
/* Same, for the extents that these surfaces have in this view; recentres the target on them. Surfaces with no
 * vertices are left out. */
void camera_fit_surfaces(camera *c, const surface *const *surfaces, int count, int width, int height, double margin);
/* Perspective with this full vertical angle; the size at the target plane stays. */
void camera_set_perspective(camera *c, double angle_rad);
/* Pixels per mm: everywhere (orthographic) or in the plane of the target (perspective). */
double camera_scale(const camera *c, int height);
/* Pixel coordinates of a point (x from the left, y from the top) and its distance in front of the target
 * plane. */
void camera_project(const camera *c, int width, int height, const double p[3], double *x, double *y, double *near_mm);

#ifdef __cplusplus
}
#endif
