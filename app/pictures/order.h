/* render_order: which pictures are asked for on the command line. */
#pragma once
#include "render/gallery.h"

enum { ORDER_VIEWS_MAX = 16, ORDER_NAME_SIZE = 96, ORDER_FRAMES_MAX = 3600 };

typedef struct order_view {
    char name[48]; /* of a standard view, or "az30_el10" */
    double azimuth_deg, elevation_deg, roll_deg;
} order_view;

typedef struct render_order {
    bool shows[SHOW_COUNT];
    int show_count;
    int pose; /* panel_pose; ORDER_BOTH: before and after side by side */
    bool pose_set;
    order_view view[ORDER_VIEWS_MAX];
    int view_count, turntable; /* frames; 0: none */
} render_order;

enum { ORDER_BOTH = POSE_COUNT };

/* A pose name, or "both". Refuses (ERR_USAGE) others, naming those that exist. */
bool order_pose(const char *text, render_order *o, err *e) MUST_CHECK;
bool order_show(const char *text, render_order *o, err *e) MUST_CHECK;
/* A standard view, or AZIMUTH,ELEVATION[,ROLL] in degrees. */
bool order_view_add(const char *text, render_order *o, err *e) MUST_CHECK;

/* One picture of an order; the panels are its own. */
typedef struct order_picture {
    char name[ORDER_NAME_SIZE]; /* without .png */
    char title[96];
    panel panels[2];
    int panel_count;
} order_picture;

/* Nothing was asked for: the standard set is meant. */
bool order_is_standard(const render_order *o);
int order_picture_count(const render_order *o);
order_picture order_picture_at(const render_order *o, int index);
