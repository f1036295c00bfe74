#include "app/pictures.h"
#include "geometry/vec.h"
#include "render/comparison.h"
#include <stdio.h>

/* The sphere that the pictures show: the face, from brow to neck and back to the ears. */
static void find_region(const pictures_input *in, comparison *c)
{
    const landmark *nasion = landmarks_find(in->points, "N"), *menton = landmarks_find(in->points, "Me");
    if (!nasion || !menton) return;
    for (int k = 0; k < 3; k++) c->region_centre[k] = (nasion->xyz[k] + menton->xyz[k]) / 2;
    vec_axpy(c->region_centre, 22, in->frame->posterior, c->region_centre);
    c->region_radius_mm = 0.86 * vec_distance(nasion->xyz, menton->xyz);
}

bool pictures_write(const pictures_input *in, const char *folder, bool list, err *e)
{
    comparison_part part[SEGMENT_COUNT];
    comparison c = {.case_name = in->case_name,
                    .plan_text = in->plan_text,
                    .case_hash = in->hash,
                    .skin_before = in->skin_before,
                    .skin_after = in->skin_after,
                    .parts = part,
                    .frame = *in->frame};
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        if (!in->at_rest->part[s].triangle_count) continue;
        comparison_part *p = &part[c.part_count++];
        *p = (comparison_part){.bone = &in->at_rest->part[s],
                               .before = rigid_identity(),
                               .after = in->move[s],
                               .kind = MATERIAL_BONE,
                               .name = segment_name((segment_id)s)};
        comparison_segment_color((segment_id)s, p->rgb);
    }
    find_region(in, &c);
    comparison_params params = comparison_params_default();
    if (in->width) params.tile_width = in->width;
    if (in->height) params.tile_height = in->height;
    if (in->skin_opacity > 0) params.skin_opacity = in->skin_opacity;
    params.heat_high_mm = in->heat_high_mm;
    comparison_result result;
    if (!comparison_write(&c, &params, folder, &result, e)) return false;
    if (list)
        for (int i = 0; i < result.count; i++) printf("%s/%s\n", folder, result.name[i]);
    return true;
}
