#include "app/planner/identity/fit_lattice.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double off_lattice_mm = 40; /* points farther from every tet stay */

static embedding carry(const tetmesh *body, const double *xyz, int32_t count)
{
    return embed_points(body, xyz, count, off_lattice_mm, NULL, NULL);
}

/* Those of part 0 that are known. */
static registration_anchors anchors_of(const fit_lattice *f, const embedding *first, embedding *known, double **place)
{
    int32_t count = 0;
    *known = (embedding){.tet = NEW_ARRAY(int32_t, first->point_count),
                         .weight = NEW_ARRAY(double, 4 * (size_t)first->point_count)};
    *place = NEW_ARRAY(double, 3 * (size_t)first->point_count);
    for (size_t v = 0; v < (size_t)first->point_count; v++) {
        if (isnan(f->fixed[3 * v])) continue;
        known->tet[count] = first->tet[v];
        memcpy(known->weight + 4 * (size_t)count, first->weight + 4 * v, 4 * sizeof(double));
        vec_copy(f->fixed + 3 * v, *place + 3 * (size_t)count++);
    }
    known->point_count = count;
    double area = f->moved[0]->vertex_count ? surface_area(f->moved[0]) / f->moved[0]->vertex_count : 0;
    return (registration_anchors){known, *place, area};
}

static void move(const fit_lattice *f, const tetmesh *body, const embedding *in, const double *x)
{
    size_t n = 3 * (size_t)body->vertex_count;
    double *u = NEW_ARRAY(double, n);
    for (size_t i = 0; i < n; i++) u[i] = x[i] - body->xyz[i];
    for (int p = 0; p < f->part_count; p++) embedding_apply(&in[p], body, u, f->moved[p]->xyz, f->moved[p]->xyz);
    if (f->points) {
        embedding points = carry(body, f->points, f->point_count);
        embedding_apply(&points, body, u, f->points, f->points);
        embedding_free(&points);
    }
    free(u);
}

static void add_cost(fit_cost *cost, const registration *r)
{
    cost->rounds += r->rounds;
    cost->iterations += r->iterations;
    cost->factorisations += r->factorisations;
    cost->min_j = fmin(cost->min_j, r->min_j);
}

bool fit_lattice_draw(const fit_lattice *f, fit_cost *cost, err *e)
{
    tetmesh body;
    embedding in[FIT_LATTICE_PARTS] = {0}, known = {0};
    double *place = NULL;
    registration_part part[FIT_LATTICE_PARTS];
    registration r;
    if (!lattice_cover((const surface *const *)f->moved, f->part_count, f->edge_mm, f->margin_mm, &body, e))
        return false;
    for (int p = 0; p < f->part_count; p++) {
        in[p] = carry(&body, f->moved[p]->xyz, f->moved[p]->vertex_count);
        part[p] = (registration_part){f->moved[p], &in[p], f->target[p], f->mute[p], f->weight[p]};
    }
    registration_problem problem = {.body = &body, .part_count = f->part_count, .part = part};
    registration_anchors anchors;
    if (f->fixed) {
        anchors = anchors_of(f, &in[0], &known, &place);
        problem.anchors = &anchors;
    }
    bool ok = registration_run(&problem, &f->how, &r, e);
    if (ok) {
        move(f, &body, in, r.xyz);
        add_cost(cost, &r);
        registration_free(&r);
    }
    for (int p = 0; p < f->part_count; p++) embedding_free(&in[p]);
    embedding_free(&known);
    free(place);
    tetmesh_free(&body);
    return ok;
}
