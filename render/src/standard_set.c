#include "render/standard_set.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRONT 0, 0, 0
#define LEFT 90, 0, 0
#define RIGHT -90, 0, 0
#define THREE_QUARTER 45, 0, 0
#define PAIR(show, view, second)                                                                                       \
    2, 2,                                                                                                              \
    {                                                                                                                  \
        {show, POSE_BEFORE, view, "Before"}, { show, POSE_AFTER, view, second }                                        \
    }

const standard_picture standard_set[] = {
    {"overview.png",
     "Overview",
     8,
     4,
     {{SHOW_SKIN, POSE_BEFORE, FRONT, "Before"},
      {SHOW_SKIN, POSE_BEFORE, LEFT, NULL},
      {SHOW_SKIN, POSE_BEFORE, THREE_QUARTER, NULL},
      {SHOW_CLEAR, POSE_BEFORE, LEFT, NULL},
      {SHOW_SKIN, POSE_AFTER, FRONT, "Predicted"},
      {SHOW_SKIN, POSE_AFTER, LEFT, NULL},
      {SHOW_SKIN, POSE_AFTER, THREE_QUARTER, NULL},
      {SHOW_CLEAR, POSE_AFTER, LEFT, NULL}}},
    {"before_after_front.png", "Front", PAIR(SHOW_SKIN, FRONT, "Predicted")},
    {"before_after_left.png", "Left profile", PAIR(SHOW_SKIN, LEFT, "Predicted")},
    {"before_after_right.png", "Right profile", PAIR(SHOW_SKIN, RIGHT, "Predicted")},
    {"before_after_three_quarter.png", "Three-quarter, left", PAIR(SHOW_SKIN, THREE_QUARTER, "Predicted")},
    {"bones_front.png", "Front, bones", PAIR(SHOW_CLEAR, FRONT, "Planned")},
    {"bones_left.png", "Left profile, bones", PAIR(SHOW_CLEAR, LEFT, "Planned")},
    {"bones_three_quarter.png", "Three-quarter, bones", PAIR(SHOW_CLEAR, THREE_QUARTER, "Planned")},
    {"heat.png",
     "Displacement of the skin",
     3,
     3,
     {{SHOW_DISPLACEMENT, POSE_AFTER, FRONT, "Front"},
      {SHOW_DISPLACEMENT, POSE_AFTER, LEFT, "Left profile"},
      {SHOW_DISPLACEMENT, POSE_AFTER, THREE_QUARTER, "Three-quarter, left"}}},
    {"contour.png", "Profile in the midsagittal plane", 1, 1, {{SHOW_CONTOUR, POSE_AFTER, LEFT, NULL}}},
    {"tracing.png", "Cephalometric tracing", 1, 1, {{SHOW_TRACING, POSE_AFTER, LEFT, NULL}}},
};
const int standard_set_count = sizeof standard_set / sizeof standard_set[0];

static bool can_draw(const gallery *g, const standard_picture *p)
{
    for (int i = 0; i < p->panel_count; i++) {
        err why = {0};
        if (!gallery_can_show(g, p->panels[i].show, &why)) return false;
    }
    return true;
}

bool standard_set_write(gallery *g, int width, int height, const char *folder, bool *written, err *e)
{
    for (int i = 0; i < standard_set_count; i++) {
        const standard_picture *p = standard_set + i;
        bool can = can_draw(g, p), ok = true;
        if (written) written[i] = can;
        if (!can) continue;
        size_t size = strlen(folder) + strlen(p->file) + 2;
        char *path = NEW_ARRAY(char, size);
        snprintf(path, size, "%s/%s", folder, p->file);
        sheet what = {p->title, p->panels, p->panel_count, p->columns, width, height};
        ok = gallery_write(g, &what, path, e);
        free(path);
        if (!ok) return false;
    }
    return true;
}
