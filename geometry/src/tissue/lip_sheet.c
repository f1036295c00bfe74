#include "geometry/tissue.h"
#include "geometry/vec.h"
#include <stddef.h>

double lip_sheet_height(const lip_sheet *s, double x)
{
    const double *u = s->x, *z = s->z;
    if (x <= u[0]) return z[0];
    if (x >= u[2]) return z[2];
    double a = (x - u[1]) * (x - u[2]) / ((u[0] - u[1]) * (u[0] - u[2]));
    double b = (x - u[0]) * (x - u[2]) / ((u[1] - u[0]) * (u[1] - u[2]));
    return a * z[0] + b * z[1] + (1 - a - b) * z[2];
}

void lip_sheet_normal(const lip_sheet *s, double x, double n[3])
{
    const double h = 0.5;
    double slope = (lip_sheet_height(s, x + h) - lip_sheet_height(s, x - h)) / (2 * h);
    vec_axpy(s->frame.up, -slope, s->frame.left, n);
    vec_normalize(n);
}

typedef struct carried {
    const tissue *t;
    const double *xyz;
} carried;

static bool same_lip(int32_t point, int32_t tet, void *context)
{
    const carried *c = context;
    const lip_sheet *s = &c->t->lips;
    double local[3];
    head_frame_to_local(&s->frame, c->xyz + 3 * (size_t)point, local);
    if (local[0] <= s->x[0] || local[0] >= s->x[2]) return true;
    return c->t->mesh.region[tet] == (local[2] > lip_sheet_height(s, local[0]) ? REGION_UPPER : REGION_LOWER);
}

embedding tissue_carry(const tissue *t, const double *xyz, int32_t count, double reach_mm)
{
    carried c = {t, xyz};
    return embed_points(&t->mesh, xyz, count, reach_mm, same_lip, &c);
}
