/* panel: one view of a patient: what is shown, at which time, from where. */
#pragma once
#include "geometry/err.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum panel_show {
    SHOW_SKIN,
    SHOW_CLEAR,        /* the skin, clear, over the coloured segments */
    SHOW_BONES,        /* the segments alone, with the lines of the cuts */
    SHOW_DISPLACEMENT, /* how far every point of the skin moves, on the predicted skin */
    SHOW_SIGNED,       /* signed distance of the two skins, on the predicted one */
    SHOW_STRETCH,      /* largest principal stretch of the skin, on the predicted one */
    SHOW_CONTOUR,      /* profiles in the midsagittal plane over a grid of millimetres, with landmarks */
    SHOW_TRACING,      /* lines and planes of cephalometry over a lateral view */
    SHOW_COUNT
} panel_show;

typedef enum panel_pose {
    POSE_BEFORE,
    POSE_AFTER,
    POSE_OVERLAY, /* after, and through it the outline of before */
    POSE_WIPE,    /* one picture, before on its left half */
    POSE_CHECKER, /* one picture, before and after in squares by turns */
    POSE_COUNT
} panel_pose;

const char *panel_show_name(panel_show show); /* "skin", "clear", ... */
const char *panel_pose_name(panel_pose pose);
/* -1: no such name. */
int panel_show_from_name(const char *name);
int panel_pose_from_name(const char *name);
/* Maps lie on the predicted skin, profiles hold both poses: these have no pose of their own. */
bool panel_has_pose(panel_show show);

typedef struct panel {
    panel_show show;
    panel_pose pose;                             /* of what has one */
    double azimuth_deg, elevation_deg, roll_deg; /* see camera_orbit; profiles are always seen from their side */
    const char *caption;                         /* at the top left; may be NULL */
} panel;

#ifdef __cplusplus
}
#endif
