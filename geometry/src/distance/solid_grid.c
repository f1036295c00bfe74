#include "geometry/mem.h"
#include "geometry/src/distance/grid_cubes.h"
#include <stdlib.h>

void solid_grid_free(solid_grid **g)
{
    if (!*g) return;
    free((*g)->start);
    free((*g)->item);
    free((*g)->triangle);
    free((*g)->cube);
    free(*g);
    *g = NULL;
}

/* Its own point's side is known; a point of a cube with triangles is compared with that. */
static bool same_side(const solid_grid *g, const int32_t i[3], size_t c, const double p[3])
{
    double own[3], way[3];
    own_of(g, i, own);
    vec_sub(own, p, way);
    return !(crossings(g, c, p, way, 0, 1) & 1);
}

static double outside_box(const solid_grid *g, const double p[3])
{
    double d[3];
    for (int c = 0; c < 3; c++) d[c] = fmax(fmax(g->low[c] - p[c], p[c] - (g->low[c] + g->n[c] * g->step)), 0);
    return vec_norm(d);
}

static double clear_in(const solid_grid *g, size_t c)
{
    return g->cube[c].away > 1 ? (g->cube[c].away - 1) * g->step : 0;
}

static bool inside_in(const solid_grid *g, const int32_t i[3], size_t c, const double p[3])
{
    return (g->cube[c].away || same_side(g, i, c, p)) == g->cube[c].inside;
}

bool solid_grid_inside(const solid_grid *g, const double p[3])
{
    int32_t i[3];
    locate(g, p, i);
    return within(g, i) && inside_in(g, i, place(g, i), p);
}

double solid_grid_clear(const solid_grid *g, const double p[3])
{
    int32_t i[3];
    locate(g, p, i);
    return within(g, i) ? clear_in(g, place(g, i)) : outside_box(g, p);
}

bool solid_grid_look(const solid_grid *g, const double p[3], double *clear)
{
    int32_t i[3];
    locate(g, p, i);
    if (!within(g, i)) {
        *clear = outside_box(g, p);
        return false;
    }
    size_t c = place(g, i);
    *clear = clear_in(g, c);
    return inside_in(g, i, c, p);
}
