#include "sim/src/identity/registration_springs.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/tet_volume.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 256 };
static const double held = 1e-3, least_give = 1.0 / 256;

/* A third of the triangles around each vertex; the caller frees. */
static double *vertex_areas(const surface *s)
{
    double *area = NEW_ARRAY(double, s->vertex_count);
    for (size_t t = 0; t < (size_t)s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * t;
        double a[3], b[3], n[3];
        vec_sub(s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[0], a);
        vec_sub(s->xyz + 3 * (size_t)v[2], s->xyz + 3 * (size_t)v[0], b);
        vec_cross(a, b, n);
        for (int k = 0; k < 3; k++) area[v[k]] += vec_norm(n) / 6;
    }
    return area;
}

static void add_spring(registration_springs *s, const embedding *in, int32_t point, int32_t part, double area)
{
    if (in->tet[point] < 0 || !(area > 0)) return;
    size_t k = (size_t)s->t.count++;
    s->t.tet[k] = in->tet[point];
    memcpy(s->t.weight + 4 * k, in->weight + 4 * (size_t)point, 4 * sizeof(double));
    s->t.normal[3 * k + 2] = 1;
    s->t.stiffness[k] = s->t.across[k] = 1; /* until it is aimed: all that could hold the body */
    s->part[k] = part;
    s->of[k] = point;
    s->area[k] = area;
    s->give[k] = 1;
    s->gap_mm[k] = HUGE_VAL;
}

registration_springs registration_springs_make(const registration_problem *problem)
{
    const registration_anchors *anchors = problem->anchors;
    int32_t most = anchors ? anchors->carried->point_count : 0;
    for (int32_t i = 0; i < problem->part_count; i++) most += problem->part[i].moving->vertex_count;
    registration_springs s = {.problem = problem,
                              .t = targets_new(most),
                              .part = NEW_ARRAY(int32_t, most),
                              .of = NEW_ARRAY(int32_t, most),
                              .area = NEW_ARRAY(double, most),
                              .give = NEW_ARRAY(double, most),
                              .gap_mm = NEW_ARRAY(double, most)};
    s.t.count = 0;
    for (int32_t i = 0; i < problem->part_count; i++) {
        const registration_part *p = &problem->part[i];
        double *area = vertex_areas(p->moving);
        for (int32_t v = 0; p->target && v < p->moving->vertex_count; v++)
            if (!p->mute || !p->mute[v]) add_spring(&s, p->carried, v, i, p->weight * area[v]);
        free(area);
    }
    for (int32_t k = 0; anchors && k < anchors->carried->point_count; k++)
        add_spring(&s, anchors->carried, k, -1, anchors->area_mm2);
    return s;
}

void registration_springs_free(registration_springs *s)
{
    targets_free(&s->t);
    free(s->part);
    free(s->of);
    free(s->area);
    free(s->give);
    free(s->gap_mm);
    *s = (registration_springs){0};
}

typedef struct aim_job {
    registration_springs *s;
    const registration_round *round;
    const double *x;
    double **normal; /* [part_count] of the moving vertices as they are */
} aim_job;

static void aim_vertex(const aim_job *job, size_t k, const double at[3])
{
    registration_springs *s = job->s;
    const registration_part *part = &s->problem->part[s->part[k]];
    double *place = s->t.place + 3 * k, *normal = s->t.normal + 3 * k, full = job->round->stiffness_kpa_mm * s->area[k];
    target_point hit;
    const double *n = job->normal[s->part[k]] + 3 * (size_t)s->of[k];
    s->gap_mm[k] = target_surface_ask(part->target, at, n, &job->round->rules, &hit);
    if (s->gap_mm[k] < HUGE_VAL) {
        double far = s->gap_mm[k] / job->round->rules.reach_mm, w = (1 - far * far) * (1 - far * far);
        vec_copy(hit.at, place);
        vec_copy(hit.normal, normal);
        s->t.stiffness[k] = full * fmax(w * s->give[k], held);
        s->t.across[k] = job->round->across;
    } else {
        vec_copy(at, place);
        s->t.stiffness[k] = full * held;
        s->t.across[k] = 1;
    }
}

static void aim_body(int64_t begin, int64_t end, void *context)
{
    const aim_job *job = context;
    registration_springs *s = job->s;
    for (int64_t k = begin; k < end; k++) {
        double at[3];
        targets_point(&s->t, s->problem->body, job->x, (int32_t)k, at);
        if (s->part[k] >= 0) {
            aim_vertex(job, (size_t)k, at);
            continue;
        }
        vec_copy(s->problem->anchors->place + 3 * (size_t)s->of[k], s->t.place + 3 * k);
        s->gap_mm[k] = vec_distance(at, s->t.place + 3 * k);
        s->t.stiffness[k] = job->round->stiffness_kpa_mm * s->area[k] * s->give[k];
        s->t.across[k] = 1;
    }
}

/* Unit normals of a part's vertices, carried by the body at x; the caller frees. */
static double *carried_normals(const registration_problem *problem, const registration_part *p, const double *x)
{
    size_t n = 3 * (size_t)problem->body->vertex_count;
    double *u = NEW_ARRAY(double, n);
    for (size_t i = 0; i < n; i++) u[i] = x[i] - problem->body->xyz[i];
    surface now = surface_copy(p->moving);
    embedding_apply(p->carried, problem->body, u, p->moving->xyz, now.xyz);
    double *normal = surface_vertex_normals(&now);
    surface_free(&now);
    free(u);
    return normal;
}

void registration_springs_aim(registration_springs *s, const registration_round *round, const double *x)
{
    int32_t parts = s->problem->part_count;
    aim_job job = {s, round, x, NEW_ARRAY(double *, parts)};
    for (int32_t i = 0; i < parts; i++)
        if (s->problem->part[i].target) job.normal[i] = carried_normals(s->problem, &s->problem->part[i], x);
    parallel_for(s->t.count, GRAIN, aim_body, &job);
    for (int32_t i = 0; i < parts; i++) free(job.normal[i]);
    free(job.normal);
}

/* Nodes of tets that have a marked node are marked. */
static void spread(const tetmesh *m, uint8_t *node)
{
    uint8_t *was = COPY_ARRAY(uint8_t, node, m->vertex_count);
    for (size_t t = 0; t < (size_t)m->tet_count; t++) {
        const int32_t *v = m->tet + 4 * t;
        if (was[v[0]] | was[v[1]] | was[v[2]] | was[v[3]])
            for (int k = 0; k < 4; k++) node[v[k]] = 1;
    }
    free(was);
}

int32_t registration_springs_give(registration_springs *s, const double *x, double min_j)
{
    const tetmesh *m = s->problem->body;
    uint8_t *node = NEW_ARRAY(uint8_t, m->vertex_count);
    int32_t count = 0;
    for (int32_t t = 0; t < m->tet_count; t++) {
        if (tet_j(m, x, t) >= min_j) continue;
        count++;
        for (int k = 0; k < 4; k++) node[m->tet[4 * (size_t)t + (size_t)k]] = 1;
    }
    if (count) spread(m, node);
    for (size_t k = 0; count && k < (size_t)s->t.count; k++) {
        const int32_t *v = m->tet + 4 * (size_t)s->t.tet[k];
        if (node[v[0]] | node[v[1]] | node[v[2]] | node[v[3]])
            s->give[k] = fmax(s->give[k] / (s->part[k] < 0 ? 8 : 2), least_give);
    }
    free(node);
    return count;
}
