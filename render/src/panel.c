#include "render/panel.h"
#include <assert.h>
#include <string.h>

static const char *const show_name[SHOW_COUNT] = {"skin",   "clear",   "bones",   "displacement",
                                                  "signed", "stretch", "contour", "tracing"};
static const char *const pose_name[POSE_COUNT] = {"before", "after", "overlay", "wipe", "checker"};

const char *panel_show_name(panel_show show)
{
    assert(show >= 0 && show < SHOW_COUNT);
    return show_name[show];
}

const char *panel_pose_name(panel_pose pose)
{
    assert(pose >= 0 && pose < POSE_COUNT);
    return pose_name[pose];
}

static int find(const char *const *names, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(names[i], name)) return i;
    return -1;
}

int panel_show_from_name(const char *name) { return find(show_name, SHOW_COUNT, name); }

int panel_pose_from_name(const char *name) { return find(pose_name, POSE_COUNT, name); }

bool panel_has_pose(panel_show show) { return show == SHOW_SKIN || show == SHOW_CLEAR || show == SHOW_BONES; }
