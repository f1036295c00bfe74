#include "geometry/rest_gap.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

const double rest_gap_exact_mm = 20;

/* Nodes joined by edges of the tissue's surface: next[start[v] .. start[v + 1]) are those of v. */
typedef struct neighbours {
    int32_t *start, *next;
} neighbours;

static neighbours find_neighbours(const tetmesh *m)
{
    int32_t *face, faces = tetmesh_boundary(m, &face, NULL);
    neighbours n = {NEW_ARRAY(int32_t, (size_t)m->vertex_count + 1), NEW_ARRAY(int32_t, 6 * (size_t)faces)};
    for (int32_t i = 0; i < 3 * faces; i++) n.start[face[i] + 1] += 2;
    for (int32_t v = 0; v < m->vertex_count; v++) n.start[v + 1] += n.start[v];
    int32_t *at = COPY_ARRAY(int32_t, n.start, m->vertex_count);
    for (int32_t f = 0; f < faces; f++)
        for (int k = 0; k < 3; k++) {
            int32_t v = face[3 * (size_t)f + (size_t)k];
            n.next[at[v]++] = face[3 * (size_t)f + (size_t)((k + 1) % 3)];
            n.next[at[v]++] = face[3 * (size_t)f + (size_t)((k + 2) % 3)];
        }
    free(at);
    free(face);
    return n;
}

/* From node to node over the tissue's surface. An edge shorter than the gap at one of its ends does not pass the bone's
 * surface: both ends are on one side, and the gap at the other end is at least what is left of it. */
typedef struct flood {
    const tetmesh *mesh;
    const nearest *to;
    double *gap, *place; /* [nodes]; [3*nodes] the nearest point, */
    int32_t *triangle;   /* [nodes] in this triangle; -1: the gap is a bound */
} flood;

static void reach(flood *f, int32_t v, int32_t from)
{
    const double *x = f->mesh->xyz + 3 * (size_t)v;
    double way = from < 0 ? 0 : vec_distance(x, f->mesh->xyz + 3 * (size_t)from);
    double before = from < 0 ? 0 : fabs(f->gap[from]), gap = before - way, *place = f->place + 3 * (size_t)v;
    bool inside = from >= 0 && f->gap[from] < 0;
    f->triangle[v] = from < 0 ? -1 : f->triangle[from];
    if (gap > rest_gap_exact_mm)
        f->triangle[v] = -1;
    else if (f->triangle[v] >= 0) {
        vec_copy(f->place + 3 * (size_t)from, place);
        gap = nearest_point_onward(f->to, x, place, &f->triangle[v]);
    } else
        gap = nearest_point(f->to, x, place, &f->triangle[v]);
    if (from < 0 || !(way < fmax(gap, before))) inside = nearest_inside(f->to, x);
    f->gap[v] = inside ? -gap : gap;
}

static double *find_gaps(const tissue *t, const neighbours *n, const nearest *to)
{
    int32_t count = t->mesh.vertex_count, *stack = NEW_ARRAY(int32_t, count);
    flood f = {&t->mesh, to, NEW_ARRAY(double, count), NEW_ARRAY(double, 3 * (size_t)count), NEW_ARRAY(int32_t, count)};
    for (int32_t v = 0; v < count; v++) f.gap[v] = (double)NAN;
    for (int32_t first = 0; first < count; first++) {
        if (!isnan(f.gap[first]) || !rest_gap_asks(t, first)) continue;
        reach(&f, first, -1);
        stack[0] = first;
        for (int32_t waiting = 1; waiting > 0;) {
            int32_t v = stack[--waiting];
            for (int32_t k = n->start[v]; k < n->start[v + 1]; k++) {
                int32_t u = n->next[k];
                if (!isnan(f.gap[u]) || !rest_gap_asks(t, u)) continue;
                reach(&f, u, v);
                stack[waiting++] = u;
            }
        }
    }
    free(stack);
    free(f.place);
    free(f.triangle);
    return f.gap;
}

typedef struct gap_job {
    const tissue *t;
    const neighbours *edges;
    const segment_trees *bones;
    rest_gap *out;
} gap_job;

/* Of each segment, then of the saw cuts. */
static void gap_body(int64_t begin, int64_t end, void *context)
{
    const gap_job *job = context;
    for (int64_t s = begin; s < end; s++) {
        const nearest *to = s < SEGMENT_COUNT ? job->bones->part[s] : job->bones->kerf;
        if (to) *(s < SEGMENT_COUNT ? &job->out->part[s] : &job->out->kerf) = find_gaps(job->t, job->edges, to);
    }
}

void rest_gap_make(const tissue *t, const segment_trees *bones, rest_gap *out)
{
    neighbours n = find_neighbours(&t->mesh);
    *out = (rest_gap){0};
    parallel_for(SEGMENT_COUNT + 1, 1, gap_body, &(gap_job){t, &n, bones, out});
    free(n.start);
    free(n.next);
}

void rest_gap_free(rest_gap *g)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) free(g->part[s]);
    free(g->kerf);
    *g = (rest_gap){0};
}
