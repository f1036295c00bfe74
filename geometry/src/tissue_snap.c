#include "geometry/src/tissue_attach.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double keep_share = 0.25;     /* a tet may lose three quarters of its volume, no more */
static const double min_volume_mm3 = 1e-3;

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

static double volume6(const tetmesh *m, int32_t t)
{
    const int32_t *v = m->tet + 4 * (size_t)t;
    return vec_six_volume(m->xyz + 3 * (size_t)v[0], m->xyz + 3 * (size_t)v[1], m->xyz + 3 * (size_t)v[2],
                          m->xyz + 3 * (size_t)v[3]);
}

/* Moves node v to `to` unless one of its tets would become too flat; true if it moved. */
static bool try_move(tetmesh *m, const int32_t *start, const int32_t *list, const double *rest6, int32_t v,
                     const double to[3])
{
    double *x = m->xyz + 3 * (size_t)v, from[3];
    vec_copy(x, from);
    vec_copy(to, x);
    for (int32_t n = start[v]; n < start[v + 1]; n++)
        if (!(volume6(m, list[n]) > fmax(keep_share * rest6[list[n]], 6 * min_volume_mm3))) {
            vec_copy(from, x);
            return false;
        }
    return true;
}

/* Pulls the inner nodes next to a boundary node that would not move half way to the mean of their neighbours. */
static void relax_inside(tetmesh *m, const int32_t *start, const int32_t *list, const double *rest6,
                         const uint8_t *side, int32_t v)
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
            try_move(m, start, list, rest6, w, to);
        }
}

bool tissue_snap_to_bone(const tissue_input *in, const tissue_domain *d, tetmesh *m, uint8_t *side,
                         tissue_report *report, err *e)
{
    nearest *bone = NULL;
    if (!nearest_create(in->bones, &bone, e)) return false;
    int32_t *start, *list;
    tets_around(m, &start, &list);
    double *rest6 = NEW_ARRAY(double, m->tet_count);
    for (int32_t t = 0; t < m->tet_count; t++) rest6[t] = volume6(m, t);
    const int passes = 4;
    for (int pass = 0; pass < passes; pass++)
        for (int32_t v = 0; v < m->vertex_count; v++) {
            if (side[v] != SIDE_BONE) continue;
            double at[3], gap = nearest_point(bone, m->xyz + 3 * (size_t)v, at, NULL);
            if (gap > d->params->touch_mm) {
                side[v] = SIDE_HOLE; /* the wrap spans a gap here */
                continue;
            }
            if (gap == 0 || try_move(m, start, list, rest6, v, at)) continue;
            if (pass + 1 < passes) relax_inside(m, start, list, rest6, side, v);
            else if (gap > 0.05) {
                side[v] = SIDE_HOLE;
                report->not_snapped++;
            }
        }
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (side[v] == SIDE_BONE)
            report->max_bone_gap_mm =
                fmax(report->max_bone_gap_mm, nearest_point(bone, m->xyz + 3 * (size_t)v, NULL, NULL));
    free(start);
    free(list);
    free(rest6);
    nearest_destroy(&bone);
    return true;
}
