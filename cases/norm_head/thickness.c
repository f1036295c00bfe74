#include "thickness.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stddef.h>

/* Near which point of which bone, and along what (zeros: the bone's normal). */
static const struct {
    measure_id id;
    body_id body;
    double guess[3], direction[3];
} sites[THICKNESS_SITES] = {
    {GLABELLA_SOFT_MM, BODY_SKULL, {0, -92, 40}, {0, -1, 0}},
    {MID_NASAL_SOFT_MM, BODY_SKULL, {0, -92, 15}, {0, 0, 0}},
    {RHINION_SOFT_MM, BODY_SKULL, {0, -95.5, 7.5}, {0, -0.85, 0.53}},
    {MID_PHILTRUM_SOFT_MM, BODY_SKULL, {0, -86.5, -38.5}, {0, -1, 0}},
    {MID_SUPRAORBITAL_SOFT_MM, BODY_SKULL, {31, -83, 38}, {0, 0, 0}},
    {MID_INFRAORBITAL_SOFT_MM, BODY_SKULL, {31, -81, -4}, {0.2, -0.98, 0}},
    {ALAR_CURVATURE_SOFT_MM, BODY_SKULL, {21, -82, -23}, {0.3, -0.95, 0}},
    {ZYGION_SOFT_MM, BODY_SKULL, {62.2, -34, -1}, {1, 0, 0}},
    {SUPRA_CANINE_SOFT_MM, BODY_SKULL, {18, -83, -37}, {0.3, -0.95, 0}},
    {INFRA_CANINE_SOFT_MM, BODY_MANDIBLE, {14, -82, -66}, {0.3, -0.95, 0}},
    {SUPRA_M2_SOFT_MM, BODY_SKULL, {29, -52, -36}, {1, 0, 0}},
    {INFRA_M2_SOFT_MM, BODY_MANDIBLE, {38, -50, -60}, {0.9, -0.43, 0}},
    {MID_RAMUS_SOFT_MM, BODY_MANDIBLE, {48.8, -25, -45}, {1, 0, 0}},
    {GONION_SOFT_MM, BODY_MANDIBLE, {48.5, -14, -57}, {0.9, 0.1, -0.4}},
    {MID_BORDER_SOFT_MM, BODY_MANDIBLE, {38, -46, -70}, {0.75, -0.2, -0.63}},
};

void thickness_sites(const bodies *b, thickness_site out[THICKNESS_SITES])
{
    for (int i = 0; i < THICKNESS_SITES; i++) {
        thickness_site *s = &out[i];
        *s = (thickness_site){.id = sites[i].id,
                              .on = sites[i].body == BODY_SKULL ? ON_SKULL : ON_MANDIBLE,
                              .midline = sites[i].guess[0] == 0};
        vec_copy(sites[i].guess, s->bone);
        place_project(b, sites[i].body, s->midline, s->bone);
        vec_copy(sites[i].direction, s->direction);
        if (vec_dot(s->direction, s->direction) == 0) body_normal(b, sites[i].body, s->bone, s->direction);
        if (s->midline) s->direction[0] = 0;
        vec_normalize(s->direction);
        vec_copy(s->bone, s->skin);
        for (int k = 0; k < 2000; k++) {
            double d = body_distance(b, BODY_SKIN, s->skin);
            if (d > -1e-4) break;
            vec_axpy(s->skin, fmax(-0.5 * d, 1e-3), s->direction, s->skin);
        }
    }
}

static void on_side(const double left[3], int side, double out[3])
{
    vec_copy(left, out);
    out[0] *= side;
}

void thickness_targets(const thickness_site site[THICKNESS_SITES], const warp *upper, const warp *lower,
                       const double asked[MEASURE_COUNT], warp_pairs *skin)
{
    for (int i = 0; i < THICKNESS_SITES; i++)
        for (int side = 1; side >= (site[i].midline ? 1 : -1); side -= 2) {
            double bone[3], along[3], from[3], to[3];
            on_side(site[i].bone, side, bone);
            on_side(site[i].direction, side, along);
            on_side(site[i].skin, side, from);
            warp_apply(site[i].on == ON_SKULL ? upper : lower, bone, bone);
            vec_axpy(bone, asked[site[i].id], along, to);
            warp_add(skin, from, to);
        }
}

bool thickness_measure(const thickness_site site[THICKNESS_SITES], const warp *upper, const warp *lower,
                       const surface *skull, const surface *mandible, const surface *skin,
                       const double asked[MEASURE_COUNT], double obtained[MEASURE_COUNT], err *e)
{
    nearest *bones[2] = {NULL, NULL}, *outside = NULL;
    bool ok = nearest_create(skull, &bones[0], e) && nearest_create(mandible, &bones[1], e) &&
              nearest_create(skin, &outside, e);
    for (int i = 0; ok && i < THICKNESS_SITES; i++) {
        bool worst = false;
        for (int side = 1; ok && side >= (site[i].midline ? 1 : -1); side -= 2) {
            double bone[3], along[3], hit[3];
            on_side(site[i].bone, side, bone);
            on_side(site[i].direction, side, along);
            bool upper_bone = site[i].on == ON_SKULL;
            warp_apply(upper_bone ? upper : lower, bone, bone);
            nearest_point(bones[upper_bone ? 0 : 1], bone, bone, NULL);
            ok = nearest_ray(outside, bone, along, hit, NULL);
            if (!ok) {
                err_set(e, ERR_GEOMETRY, "%s: no skin over the bone at (%.1f, %.1f, %.1f) mm",
                        measures[site[i].id].name, bone[0], bone[1], bone[2]);
                break;
            }
            double depth = vec_distance(bone, hit), *kept = &obtained[site[i].id];
            if (!worst || fabs(depth - asked[site[i].id]) > fabs(*kept - asked[site[i].id])) *kept = depth;
            worst = true;
        }
    }
    nearest_destroy(&bones[0]);
    nearest_destroy(&bones[1]);
    nearest_destroy(&outside);
    return ok;
}
