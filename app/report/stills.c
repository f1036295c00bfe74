#include "app/report/stills.h"
#include "app/pictures/subject.h"
#include <stdio.h>

enum { WIDTH = 1280, HEIGHT = 680 }; /* pixels */

#define FRONT 0, 0, 0
#define LEFT 90, 0, 0
#define THREE_QUARTER 45, 0, 0
#define PAIR(show, view, second)                                                                                       \
    2,                                                                                                                 \
    {                                                                                                                  \
        {show, POSE_BEFORE, view, "Before"}, { show, POSE_AFTER, view, second }                                        \
    }

const report_still report_stills[] = {
    {"front.png", "Front, before and predicted", PAIR(SHOW_SKIN, FRONT, "Predicted")},
    {"left.png", "Left profile, before and predicted", PAIR(SHOW_SKIN, LEFT, "Predicted")},
    {"three_quarter.png", "Three-quarter from the left, before and predicted",
     PAIR(SHOW_SKIN, THREE_QUARTER, "Predicted")},
    {"bones.png", "Left profile, bones before and as planned", PAIR(SHOW_CLEAR, LEFT, "Planned")},
    {"displacement.png",
     "Displacement of the skin",
     2,
     {{SHOW_DISPLACEMENT, POSE_AFTER, FRONT, "Front"}, {SHOW_DISPLACEMENT, POSE_AFTER, LEFT, "Left profile"}}},
    {"contour.png", "Profile in the midsagittal plane", 1, {{SHOW_CONTOUR, POSE_AFTER, LEFT, NULL}}},
};
const int report_still_count = sizeof report_stills / sizeof *report_stills;

static bool draw_all(gallery *g, const char *folder, err *e)
{
    for (int i = 0; i < report_still_count; i++) {
        const report_still *s = &report_stills[i];
        sheet what = {s->title, s->panels, s->panel_count, s->panel_count, WIDTH, HEIGHT};
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, s->file);
        if (!gallery_write(g, &what, path, e)) return false;
    }
    return true;
}

bool report_stills_draw(const outcome_shapes *o, bool names, const char *folder, err *e)
{
    const json_t *root = o->record.file.root;
    const char *name = json_string_value(json_object_get(root, "case")),
               *plan = json_string_value(json_object_get(json_object_get(root, "plan"), "name"));
    pictures_input in = {.case_name = names && name ? name : "",
                         .plan_text = names ? plan : NULL,
                         .hash = json_string_value(json_object_get(root, "case_hash")),
                         .skin_before = &o->skin_before,
                         .skin_after = &o->skin_after,
                         .at_rest = &o->at_rest,
                         .move = o->move,
                         .before = &o->record.before,
                         .after = &o->record.after,
                         .frame = &o->record.frame};
    pictures_subject p;
    gallery_style style = gallery_style_default();
    gallery *g = NULL;
    pictures_subject_make(&in, &p);
    bool ok = gallery_open(&p.shown, &style, &g, e) && draw_all(g, folder, e);
    gallery_close(&g);
    pictures_subject_free(&p);
    return ok;
}
