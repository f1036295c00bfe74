#include "app/cli/fit_write.h"
#include "app/planner/identity/fit_file.h"
#include "app/planner/identity/head_case.h"
#include "geometry/mem.h"
#include "geometry/tet_volume.h"
#if GNATHOS_WITH_RENDER
#include "render/colormap.h"
#endif
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void colour(surface *s, const head_fit *f, case_surface part, double range_mm)
{
#if GNATHOS_WITH_RENDER
    s->rgb = NEW_ARRAY(uint8_t, 3 * (size_t)s->vertex_count);
    for (size_t v = 0; v < (size_t)s->vertex_count; v++) {
        double rgb[3];
        colormap_color(COLORMAP_VIRIDIS, fit_shown_mm(f, part, v), 0, range_mm, rgb);
        for (size_t c = 0; c < 3; c++) s->rgb[3 * v + c] = (uint8_t)lround(255 * rgb[c]);
    }
#else
    (void)s, (void)f, (void)part, (void)range_mm;
#endif
}

static bool write_part(const fit_record *r, case_surface part, double range_mm, const output_dir *d, err *e)
{
    surface s = head_part(r->head, &r->fit->shape, part);
    double *guessed = NEW_ARRAY(double, s.vertex_count);
    for (int32_t v = 0; v < s.vertex_count; v++) guessed[v] = r->fit->guessed[part][v];
    const point_array arrays[] = {{"distance_mm", 1, r->fit->gap_mm[part]}, {"guessed", 1, guessed}};
    char file[64];
    snprintf(file, sizeof file, "%s.ply", case_surface_name(part));
    char *ply = output_dir_file(d, file);
    snprintf(file, sizeof file, "%s.vtp", case_surface_name(part));
    char *vtp = output_dir_file(d, file);
    bool ok = mesh_write_surface_arrays(&s, arrays, 2, vtp, e);
    colour(&s, r->fit, part, range_mm);
    ok = ok && mesh_write_surface(&s, ply, e);
    free(ply);
    free(vtp);
    free(guessed);
    surface_free(&s);
    return ok;
}

static bool write_scan(const fit_record *r, case_surface part, const output_dir *d, err *e)
{
    if (!r->fit->back_mm[part]) return true;
    const point_array array = {"distance_mm", 1, r->fit->back_mm[part]};
    char file[64];
    snprintf(file, sizeof file, "scan_%s.vtp", case_surface_name(part));
    char *vtp = output_dir_file(d, file);
    bool ok = mesh_write_surface_arrays(&r->scan->part[part], &array, 1, vtp, e);
    free(vtp);
    return ok;
}

/* The smallest J of the tets around each node. */
static double *node_j(const fit_record *r)
{
    const tetmesh *m = &r->head->tissue.mesh;
    double *j = NEW_ARRAY(double, m->vertex_count), size = pow(r->fit->place.scale, 3);
    for (int32_t v = 0; v < m->vertex_count; v++) j[v] = HUGE_VAL;
    for (size_t t = 0; t < (size_t)m->tet_count; t++) {
        const int32_t *tet = m->tet + 4 * t;
        double here = tet_j(m, r->fit->shape.neutral, (int32_t)t) / size;
        for (int k = 0; k < 4; k++) j[tet[k]] = fmin(j[tet[k]], here);
    }
    return j;
}

static bool write_tissue(const fit_record *r, const output_dir *d, err *e)
{
    const tissue *flesh = &r->head->tissue;
    size_t nodes = (size_t)flesh->mesh.vertex_count;
    tetmesh m = flesh->mesh;
    double *kind = NEW_ARRAY(double, nodes), *segment = NEW_ARRAY(double, nodes), *rest = NEW_ARRAY(double, 3 * nodes),
           *j = node_j(r);
    m.xyz = r->fit->shape.neutral;
    for (size_t v = 0; v < nodes; v++) {
        kind[v] = flesh->attach.kind[v];
        segment[v] = flesh->attach.segment[v];
        for (size_t c = 3 * v; c < 3 * v + 3; c++) rest[c] = r->fit->shape.rest[c] - m.xyz[c];
    }
    const point_array arrays[] = {{"J", 1, j}, {"to_rest", 3, rest}, {"attachment", 1, kind}, {"segment", 1, segment}};
    char *path = output_dir_file(d, "tissue.vtu");
    bool ok = mesh_write_tets(&m, arrays, 4, path, e);
    free(path);
    free(kind);
    free(segment);
    free(rest);
    free(j);
    return ok;
}

static bool write_case(const fit_record *r, const char *name, const output_dir *d, err *e)
{
    char *folder = output_dir_file(d, "case"), title[FIELD_TEXT_SIZE];
    case_guess guessed = fit_case_guess(r);
    snprintf(title, sizeof title, "%.200s, fitted", name);
    bool ok = !mkdir(folder, 0777) || err_at(e, ERR_RESOURCE, folder, 0, NULL, "cannot be made (%s)", strerror(errno));
    ok = ok && head_case_write(r->head, &r->fit->shape, &guessed, folder, title, e);
    free(folder);
    return ok;
}

bool fit_write_files(const fit_record *r, const char *case_name, double range_mm, const output_dir *d, err *e)
{
    bool ok = true;
    for (int p = 0; ok && p < CASE_SURFACE_COUNT; p++)
        ok = write_part(r, (case_surface)p, range_mm, d, e) && write_scan(r, (case_surface)p, d, e);
    char *pack = output_dir_file(d, "fit.pack");
    ok = ok && write_tissue(r, d, e) && head_fit_write(r->head, r->fit, pack, e) && write_case(r, case_name, d, e);
    free(pack);
    return ok;
}
