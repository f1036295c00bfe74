#include "render/src/light.h"
#include "geometry/vec.h"
#include <string.h>

enum { SAMPLES = 512 };

/* Everything in viewer axes: right, up, toward the viewer. Radiance, linear. A lamp is a lobe (d .
 * direction)^power: a soft box, the wider the smaller the power. */
static const struct {
    double direction[3], power, rgb[3];
} lamp[] = {
    {{-0.50, 0.58, 0.64}, 7, {2.95, 2.80, 2.62}}, /* key, upper left, a little warm */
    {{0.78, 0.12, 0.61}, 4, {0.78, 0.82, 0.88}},  /* fill, right, a little cool */
    {{0.85, 0.30, -0.44}, 8, {1.10, 1.18, 1.30}}, /* rim lights from behind: the outline stands off */
    {{-0.85, 0.30, -0.44}, 8, {0.80, 0.86, 0.95}},
};
static const double sky[3] = {0.52, 0.55, 0.60}, ground[3] = {0.26, 0.24, 0.235};

static void to_world(const camera *c, const double d[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = d[0] * c->right[i] + d[1] * c->up[i] + d[2] * c->back[i];
    vec_normalize(out);
}

lamps lamps_of(const camera *c)
{
    lamps out;
    to_world(c, lamp[0].direction, out.key);
    to_world(c, lamp[1].direction, out.fill);
    return out;
}

static void radiance(const double d[3], double rgb[3])
{
    double up = (1 + d[1]) / 2;
    for (int k = 0; k < 3; k++) rgb[k] = ground[k] + (sky[k] - ground[k]) * up;
    for (size_t l = 0; l < sizeof lamp / sizeof *lamp; l++) {
        double u[3];
        vec_copy(lamp[l].direction, u);
        vec_normalize(u);
        double cosine = vec_dot(u, d);
        if (cosine > 0) vec_axpy(rgb, pow(cosine, lamp[l].power), lamp[l].rgb, rgb);
    }
}

void lamps_project(const camera *c, const rigid *turn, float light[3 * HARMONICS])
{
    rigid back = rigid_inverse(turn);
    double sum[3 * HARMONICS] = {0};
    for (int i = 0; i < SAMPLES; i++) {
        double d[3], world[3], rgb[3], y[HARMONICS];
        sphere_direction(i, SAMPLES, d);
        radiance(d, rgb);
        to_world(c, d, world);
        rigid_rotate(&back, world, world);
        harmonics_at(world, y);
        for (int h = 0; h < HARMONICS; h++)
            for (int k = 0; k < 3; k++) sum[3 * h + k] += 4 * M_PI / SAMPLES * rgb[k] * y[h];
    }
    for (int i = 0; i < 3 * HARMONICS; i++) light[i] = (float)sum[i];
}
