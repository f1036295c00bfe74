#include "geometry/src/tissue/tissue_attach.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

/* Shape of a tet: 6 sqrt(2) V / (rms edge)^3, 1 regular, 0 flat. A move may not make the worst tet around a node
 * worse than this, nor worse than it was if it was below. */
static const double shape_floor = 0.12;
static const double good_shape = 0.35; /* tets below it are worked on afterwards */

/* Tets around each node: list[start[v] .. start[v+1]). */
static void tets_around(const tetmesh *m, int32_t **start, int32_t **list)
{
    *start = NEW_ARRAY(int32_t, m->vertex_count + 1);
    *list = NEW_ARRAY(int32_t, 4 * (size_t)m->tet_count);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) (*start)[m->tet[i] + 1]++;
    for (int32_t v = 0; v < m->vertex_count; v++) (*start)[v + 1] += (*start)[v];
    int32_t *fill = COPY_ARRAY(int32_t, *start, m->vertex_count);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) (*list)[fill[m->tet[i]]++] = (int32_t)(i / 4);
    free(fill);
}

static double shape_of(const tetmesh *m, int32_t t)
{
    const double *x[4];
    double edges = 0;
    for (int i = 0; i < 4; i++) {
        x[i] = m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)i];
        for (int j = 0; j < i; j++) {
            double d[3];
            vec_sub(x[i], x[j], d);
            edges += vec_dot(d, d);
        }
    }
    double rms = sqrt(edges / 6);
    return sqrt(2.0) * vec_six_volume(x[0], x[1], x[2], x[3]) / (rms * rms * rms);
}

static double worst_around(const tetmesh *m, const int32_t *start, const int32_t *list, int32_t v)
{
    double worst = HUGE_VAL;
    for (int32_t n = start[v]; n < start[v + 1]; n++) worst = fmin(worst, shape_of(m, list[n]));
    return worst;
}

/* Moves node v to `to` unless that would spoil a tet; true if it moved. */
static bool try_move(tetmesh *m, const int32_t *start, const int32_t *list, int32_t v, const double to[3])
{
    double *x = m->xyz + 3 * (size_t)v, from[3], before = worst_around(m, start, list, v);
    vec_copy(x, from);
    vec_copy(to, x);
    if (worst_around(m, start, list, v) >= fmin(shape_floor, before)) return true;
    vec_copy(from, x);
    return false;
}

/* Moves an inner node to where the worst tet around it is best, by a pattern search. */
static void improve_node(tetmesh *m, const int32_t *start, const int32_t *list, int32_t v)
{
    double *x = m->xyz + 3 * (size_t)v, best = worst_around(m, start, list, v), edge = 0;
    for (int k = 0; k < 4; k++)
        edge = fmax(edge, vec_distance(x, m->xyz + 3 * (size_t)m->tet[4 * (size_t)list[start[v]] + (size_t)k]));
    for (double step = edge / 4; step > edge / 100; step /= 2)
        for (int c = 0; c < 6; c++) {
            double from = x[c / 2];
            x[c / 2] += c % 2 ? step : -step;
            double now = worst_around(m, start, list, v);
            if (now > best)
                best = now;
            else
                x[c / 2] = from;
        }
}

static void improve_inside(tetmesh *m, const int32_t *start, const int32_t *list, const uint8_t *side)
{
    for (int pass = 0; pass < 4; pass++)
        for (int32_t t = 0; t < m->tet_count; t++) {
            if (shape_of(m, t) > good_shape) continue;
            for (int k = 0; k < 4; k++) {
                int32_t v = m->tet[4 * (size_t)t + (size_t)k];
                if (side[v] == SIDE_INSIDE) improve_node(m, start, list, v);
            }
        }
}

/* Pulls the inner nodes next to a boundary node that would not move half way to the mean of their neighbours. */
static void relax_inside(tetmesh *m, const int32_t *start, const int32_t *list, const uint8_t *side, int32_t v)
{
    for (int32_t n = start[v]; n < start[v + 1]; n++)
        for (int k = 0; k < 4; k++) {
            int32_t w = m->tet[4 * (size_t)list[n] + (size_t)k];
            if (side[w] != SIDE_INSIDE) continue;
            double mean[3] = {0}, to[3];
            int count = 0;
            for (int32_t a = start[w]; a < start[w + 1]; a++)
                for (int b = 0; b < 4; b++) {
                    vec_add(mean, m->xyz + 3 * (size_t)m->tet[4 * (size_t)list[a] + (size_t)b], mean);
                    count++;
                }
            for (int c = 0; c < 3; c++) to[c] = 0.5 * m->xyz[3 * (size_t)w + (size_t)c] + 0.5 * mean[c] / count;
            try_move(m, start, list, w, to);
        }
}

bool tissue_snap_to_bone(const tissue_input *in, const tissue_domain *d, tetmesh *m, uint8_t *side,
                         tissue_report *report, err *e)
{
    nearest *bone = NULL;
    if (!nearest_create(in->bones, &bone, e)) return false;
    int32_t *start, *list;
    tets_around(m, &start, &list);
    const int passes = 4;
    for (int pass = 0; pass < passes; pass++)
        for (int32_t v = 0; v < m->vertex_count; v++) {
            if (side[v] != SIDE_BONE) continue;
            double at[3], gap = nearest_point(bone, m->xyz + 3 * (size_t)v, at, NULL);
            if (gap > d->params->touch_mm) {
                side[v] = SIDE_HOLE; /* the wrap spans a gap here */
                continue;
            }
            if (gap == 0 || try_move(m, start, list, v, at)) continue;
            if (pass + 1 < passes)
                relax_inside(m, start, list, side, v);
            else if (gap > 0.05) {
                side[v] = SIDE_HOLE;
                report->not_snapped++;
            }
        }
    improve_inside(m, start, list, side);
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (side[v] == SIDE_BONE)
            report->max_bone_gap_mm =
                fmax(report->max_bone_gap_mm, nearest_point(bone, m->xyz + 3 * (size_t)v, NULL, NULL));
    free(start);
    free(list);
    nearest_destroy(&bone);
    return true;
}
