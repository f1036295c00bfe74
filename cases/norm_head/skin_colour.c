#include "skin_colour.h"
#include "bodies.h"
#include "geometry/mem.h"
#include "sdf.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

static void blend(double rgb[3], const double to[3], double share)
{
    for (int c = 0; c < 3; c++) rgb[c] = sdf_mix(rgb[c], to[c], share);
}

/* 1 on the vermilion, falling to 0 within about a millimetre outside its border. */
static double vermilion(double x, double y, double z)
{
    if (y > -78) return 0;
    double top = skin_lip_top(x), bottom = skin_lip_bottom(x);
    return (1 - sdf_step(top - 0.8, top + 0.6, z)) * sdf_step(bottom - 0.6, bottom + 1.2, z) *
           (1 - sdf_step(23, 25, x));
}

static double brow(double x, double y, double z)
{
    if (y > -50) return 0;
    double t = (x - 10.5) / 38; /* from the inner end to the tail */
    if (t < -0.1 || t > 1.1) return 0;
    double centre = 33.2 + 5.2 * sin(M_PI * 0.72 * sdf_clamp(t, 0, 1)) - 0.8 * t, half = 3.3 * (1 - 0.7 * t);
    return 0.7 * (1 - sdf_step(0.3 * half, 1.5 * half, fabs(z - centre))) * sdf_step(-0.1, 0.2, t) *
           (1 - sdf_step(0.8, 1.1, t));
}

/* Close-cropped hair: 1 well above the hairline, which runs from the forehead over the temple to the front of
 * the ear and behind it down to the nape. The ear stays bare. */
static double scalp(double x, double y, double z)
{
    static const double line[][2] = {{-110, 84}, {-85, 80}, {-68, 66}, {-55, 52}, {-42, 46}, {-30, 30},
                                     {-20, 10},  {-8, 6},   {12, -6},  {24, -26}, {50, -44}, {120, -52}};
    double height = line[0][1];
    for (int i = 0; i + 1 < COUNT(line); i++)
        if (y > line[i][0])
            height =
                sdf_mix(line[i][1], line[i + 1][1], sdf_clamp((y - line[i][0]) / (line[i + 1][0] - line[i][0]), 0, 1));
    double ear = hypot((y - 5) / 19, (z - 2) / 33);
    double bare = x > 55 ? 1 - sdf_step(0.9, 1.15, ear) : 0;
    return 0.62 * sdf_step(-3, 13, z - height) * (1 - bare);
}

uint8_t *skin_colours(const surface *skin)
{
    static const double base[3] = {222, 178, 152}, lip[3] = {196, 126, 114}, cheek[3] = {222, 156, 136};
    static const double hair[3] = {104, 76, 60}, lash[3] = {120, 88, 74};
    uint8_t *rgb = NEW_ARRAY(uint8_t, 3 * skin->vertex_count);
    for (int i = 0; i < skin->vertex_count; i++) {
        double x = fabs(skin->xyz[3 * i]), y = skin->xyz[3 * i + 1], z = skin->xyz[3 * i + 2], c[3];
        vec_copy(base, c);
        double d = hypot(hypot(x - 40, y + 78), z + 14);
        blend(c, cheek, 0.45 * exp(-d * d / 420));
        d = hypot(x, z + 18);
        if (y < -98) blend(c, cheek, 0.4 * exp(-d * d / 120));
        blend(c, lip, vermilion(x, y, z));
        blend(c, hair, fmax(brow(x, y, z), scalp(x, y, z)));
        if (y < -70 && x > 15 && x < 47) {
            double off = fabs(z - skin_lid_line(x));
            blend(c, lash, 0.7 * (1 - sdf_step(0.3, 1.4, off)) * sdf_step(16, 19, x) * (1 - sdf_step(43, 46, x)));
        }
        for (int k = 0; k < 3; k++) rgb[3 * i + k] = (uint8_t)(sdf_clamp(c[k], 0, 255) + 0.5);
    }
    return rgb;
}
