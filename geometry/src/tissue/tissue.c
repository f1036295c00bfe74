#include "geometry/tissue.h"
#include "geometry/label_mesher.h"
#include "geometry/mem.h"
#include "geometry/src/tissue/tissue_attach.h"
#include "geometry/src/tissue/tissue_domain.h"
#include "geometry/src/tissue/tissue_fissure.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Keeps the largest piece of the mesh that hangs together by faces. */
static double keep_largest_piece(tetmesh *m)
{
    int32_t *across = tetmesh_neighbours(m), *piece = NEW_ARRAY(int32_t, m->tet_count),
            *stack = NEW_ARRAY(int32_t, m->tet_count), pieces = 0, best = 0, best_size = 0;
    for (int32_t t = 0; t < m->tet_count; t++) piece[t] = -1;
    for (int32_t t = 0; t < m->tet_count; t++) {
        if (piece[t] >= 0) continue;
        int32_t top = 0, size = 0;
        piece[t] = pieces;
        stack[top++] = t;
        while (top) {
            int32_t s = stack[--top];
            size++;
            for (int k = 0; k < 4; k++) {
                int32_t n = across[4 * (size_t)s + (size_t)k];
                if (n < 0 || piece[n] >= 0) continue;
                piece[n] = pieces;
                stack[top++] = n;
            }
        }
        if (size > best_size) {
            best_size = size;
            best = pieces;
        }
        pieces++;
    }
    double whole = tetmesh_measure(m).volume_mm3;
    int32_t *number = NEW_ARRAY(int32_t, m->vertex_count), vertices = 0, tets = 0;
    for (int32_t t = 0; t < m->tet_count; t++)
        if (piece[t] == best)
            for (int k = 0; k < 4; k++) number[m->tet[4 * (size_t)t + (size_t)k]] = 1;
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (!number[v]) continue;
        memmove(m->xyz + 3 * (size_t)vertices, m->xyz + 3 * (size_t)v, 3 * sizeof *m->xyz);
        number[v] = vertices++;
    }
    for (int32_t t = 0; t < m->tet_count; t++) {
        if (piece[t] != best) continue;
        for (size_t k = 0; k < 4; k++) m->tet[4 * (size_t)tets + k] = number[m->tet[4 * (size_t)t + k]];
        m->region[tets++] = m->region[t];
    }
    m->vertex_count = vertices;
    m->tet_count = tets;
    free(across);
    free(piece);
    free(stack);
    free(number);
    return whole - tetmesh_measure(m).volume_mm3;
}

static uint8_t *find_sides(const tissue_domain *d, const tetmesh *m)
{
    uint8_t *side = NEW_ARRAY(uint8_t, m->vertex_count);
    int32_t *face, faces = tetmesh_boundary(m, &face, NULL);
    for (size_t i = 0; i < 3 * (size_t)faces; i++)
        side[face[i]] = (uint8_t)tissue_domain_side(d, m->xyz + 3 * (size_t)face[i]);
    free(face);
    return side;
}

static bool check_params(const tissue_params *p, err *e)
{
    if (!(p->element_mm >= 0.5 && p->coarse_mm >= p->element_mm && p->growth >= 0))
        return err_set(e, ERR_INPUT, "tissue.element_mm must be >= 0.5 and at most tissue.coarse_mm, got %g and %g",
                       p->element_mm, p->coarse_mm);
    if (!(p->hole_mm > p->detail_mm && p->detail_mm > 0))
        return err_set(e, ERR_INPUT, "tissue.hole_mm must be above tissue.detail_mm, got %g and %g", p->hole_mm,
                       p->detail_mm);
    return true;
}

bool tissue_make(const tissue_input *in, const tissue_params *p, tissue *out, tissue_report *report, err *e)
{
    if (!check_params(p, e)) return false;
    tissue_domain d = {0};
    tissue t = {0};
    tissue_report r = {0};
    lip_pairs lips = {0};
    label_mesher_params mp = label_mesher_params_default();
    clock_span begin = clock_now();
    bool ok = tissue_domain_make(in, p, &d, e);
    r.distances = clock_lap(&begin);
    if (ok) {
        memcpy(mp.low, d.low, sizeof mp.low);
        memcpy(mp.high, d.high, sizeof mp.high);
        mp.facet_distance_mm = 0.15 * p->element_mm;
        ok = label_mesher_run(tissue_domain_label, tissue_domain_size, &d, &mp, &t.mesh, e);
        r.mesh = clock_lap(&begin);
    }
    if (ok) {
        double dropped = keep_largest_piece(&t.mesh);
        t.side = find_sides(&d, &t.mesh);
        ok = tissue_snap_to_bone(in, &d, &t.mesh, t.side, &r, e);
        snprintf(r.left_out, sizeof r.left_out,
                 "tissue behind the coronal cut, below the neck cut and above the brow cut; tongue, floor of the mouth "
                 "and pharynx; %.1f cm3 in pockets between bones",
                 dropped / 1000);
    }
    if (ok) {
        tissue_open_lips(&d, &t.mesh, &t.side, &lips);
        ok = tissue_attach(in, &d, &t.mesh, t.side, &lips, &t.attach, &r, e) && tetmesh_check(&t.mesh, e);
    }
    t.lips = d.lips;
    free(lips.node);
    tissue_domain_free(&d);
    if (!ok) {
        tissue_free(&t);
        return false;
    }
    r.attachment = clock_lap(&begin);
    r.quality = tetmesh_measure(&t.mesh);
    r.nodes = t.mesh.vertex_count;
    r.tets = t.mesh.tet_count;
    *out = t;
    if (report) *report = r;
    return true;
}

void tissue_free(tissue *t)
{
    tetmesh_free(&t->mesh);
    attach_map_free(&t->attach);
    free(t->side);
    *t = (tissue){0};
}
