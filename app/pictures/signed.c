#include "app/pictures/signed.h"
#include "render/gallery.h"

bool signed_picture_write(const face_compare *c, const char *title, double range_mm, const char *path, err *e)
{
    static const panel panels[] = {{SHOW_SIGNED, POSE_AFTER, 0, 0, 0, "Front"},
                                   {SHOW_SIGNED, POSE_AFTER, 90, 0, 0, "Left profile"},
                                   {SHOW_SIGNED, POSE_AFTER, -90, 0, 0, "Right profile"}};
    const sheet what = {"Actual against predicted face", panels, 3, 3, 1920, 1080};
    const surface *skin = &c->skin[PREDICTED];
    subject s = {.case_name = "",
                 .plan_text = title,
                 .skin_before = skin,
                 .skin_after = skin,
                 .signed_mm = c->signed_mm[PREDICTED],
                 .signed_caption = "actual in front +, behind -, mm",
                 .before = &c->points,
                 .after = &c->points,
                 .frame = c->frame};
    gallery_style style = gallery_style_default();
    style.signed_mm = range_mm;
    gallery *g = NULL;
    bool ok = gallery_open(&s, &style, &g, e) && gallery_write(g, &what, path, e);
    gallery_close(&g);
    return ok;
}
