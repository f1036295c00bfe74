#include "geometry/mesh_file.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/gltf_check.h"
#include "geometry/src/files/join_corners.h"
#include "geometry/src/files/read_mesh.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum mesh_format {
    FORMAT_PLY,
    FORMAT_OFF,
    FORMAT_STL,
    FORMAT_OBJ,
    FORMAT_GLTF,
    FORMAT_VTK,
    FORMAT_VTP
} mesh_format;

static bool find_format(const char *path, mesh_format *format, err *e)
{
    static const struct {
        const char *ending;
        mesh_format format;
    } known[] = {{".ply", FORMAT_PLY},   {".off", FORMAT_OFF},  {".stl", FORMAT_STL}, {".obj", FORMAT_OBJ},
                 {".gltf", FORMAT_GLTF}, {".glb", FORMAT_GLTF}, {".vtk", FORMAT_VTK}, {".vtp", FORMAT_VTP}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (file_name_ends(path, known[i].ending)) {
            *format = known[i].format;
            return true;
        }
    return file_name_refuse(path, "mesh", ".ply .off .stl .obj .gltf .glb .vtk .vtp", "", e);
}

static bool read_space(const char *space, const char *path, int line, bool *tagged, bool *ras, err *e)
{
    *tagged = true;
    *ras = !strncmp(space, "RAS", 3);
    return *ras || !strncmp(space, "LPS", 3) ||
           err_at(e, ERR_INPUT, path, line, NULL, "unknown tag SPACE=%.6s; known are SPACE=LPS and SPACE=RAS", space);
}

/* "SPACE=LPS" as 3D Slicer writes it: in the 80 bytes or the first line of an STL, in comments of PLY and
 * OBJ, in the title of a legacy VTK. A VTP has it among its data. */
static bool find_space_tag(const char *path, mesh_format format, bool *tagged, bool *ras, err *e)
{
    FILE *in = input_file_open(path, INT64_MAX, NULL, e);
    if (!in) return false;
    char head[16385];
    size_t n = fread(head, 1, sizeof head - 1, in);
    fclose(in);
    if (!input_text_unmarked(head, n, path, e)) return false;
    *tagged = *ras = false;
    if (format == FORMAT_STL && n > 80) n = 80;
    for (size_t i = 0; i < n; i++)
        if (!head[i] || head[i] == '\r') head[i] = '\n';
    head[n] = 0;
    int number = 1;
    for (char *line = head, *next; line && *line; line = next, number++) {
        next = strchr(line, '\n');
        if (next) *next++ = 0;
        if (format == FORMAT_PLY && !strcmp(line, "end_header")) break;
        bool comment = format == FORMAT_STL || (format == FORMAT_PLY && !strncmp(line, "comment", 7)) ||
                       (format == FORMAT_OBJ && *line == '#') || (format == FORMAT_VTK && number == 2);
        const char *tag = comment ? strstr(line, "SPACE=") : NULL;
        if (!tag) continue;
        if (!read_space(tag + 6, path, format == FORMAT_STL ? 0 : number, tagged, ras, e)) return false;
    }
    return true;
}

/* Splits into triangles; a triangle that names a vertex twice is dropped. */
static bool surface_from_polygons(const polygons *p, const char *path, surface *out, mesh_file_report *r, err *e)
{
    int64_t triangles = 0;
    for (int64_t f = 0; f < p->polygon_count; f++) {
        int64_t n = p->first[f + 1] - p->first[f];
        if (n > 2) triangles += n - 2;
        for (int64_t k = p->first[f]; k < p->first[f + 1]; k++)
            if (p->corner[k] < 0 || p->corner[k] >= p->point_count)
                return err_at(e, ERR_INPUT, path, 0, NULL, "face %lld names vertex %lld, but there are %lld",
                              (long long)f, (long long)p->corner[k], (long long)p->point_count);
    }
    if (p->point_count > INT32_MAX / 3 || triangles > INT32_MAX / 3)
        return err_at(e, ERR_INPUT, path, 0, NULL, "too large: %lld vertices, %lld triangles; at most %d are read",
                      (long long)p->point_count, (long long)triangles, INT32_MAX / 3);
    for (int64_t i = 0; i < 3 * p->point_count; i++)
        if (!isfinite(p->xyz[i]))
            return err_at(e, ERR_INPUT, path, 0, NULL, "vertex %lld has a coordinate that is not a finite number",
                          (long long)(i / 3));
    surface s = surface_new((int32_t)p->point_count, (int32_t)triangles);
    if (p->point_count) memcpy(s.xyz, p->xyz, 3 * (size_t)p->point_count * sizeof *s.xyz);
    if (p->rgb) s.rgb = COPY_ARRAY(uint8_t, p->rgb, 3 * (size_t)p->point_count);
    s.triangle_count = 0;
    for (int64_t f = 0; f < p->polygon_count; f++) {
        const int64_t *corner = p->corner + p->first[f];
        int64_t n = p->first[f + 1] - p->first[f];
        if (n > 3) r->split_polygons++;
        for (int64_t k = 1; k + 1 < n; k++) {
            int32_t *v = s.tri + 3 * (size_t)s.triangle_count;
            v[0] = (int32_t)corner[0];
            v[1] = (int32_t)corner[k];
            v[2] = (int32_t)corner[k + 1];
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
                r->dropped_triangles++;
            else
                s.triangle_count++;
        }
    }
    *out = s;
    return true;
}

static int compare_places(const void *a, const void *b, void *context)
{
    const double *xyz = context;
    int32_t i = *(const int32_t *)a, j = *(const int32_t *)b;
    for (int c = 0; c < 3; c++) {
        double x = xyz[3 * (size_t)i + c], y = xyz[3 * (size_t)j + c];
        if (x != y) return x < y ? -1 : 1;
    }
    return (i > j) - (i < j);
}

void mesh_weld(surface *s, mesh_file_report *report)
{
    int32_t *order = NEW_ARRAY(int32_t, s->vertex_count), *first = NEW_ARRAY(int32_t, s->vertex_count);
    for (int32_t v = 0; v < s->vertex_count; v++) order[v] = v;
    qsort_r(order, (size_t)s->vertex_count, sizeof *order, compare_places, s->xyz);
    for (int32_t i = 0; i < s->vertex_count; i++) {
        const double *x = s->xyz + 3 * (size_t)order[i], *before = i ? s->xyz + 3 * (size_t)order[i - 1] : x;
        bool same = i && x[0] == before[0] && x[1] == before[1] && x[2] == before[2];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    int32_t *number = order, vertices = 0, triangles = 0;
    for (int32_t v = 0; v < s->vertex_count; v++) {
        if (first[v] < v) {
            number[v] = number[first[v]];
            continue;
        }
        memmove(s->xyz + 3 * (size_t)vertices, s->xyz + 3 * (size_t)v, 3 * sizeof *s->xyz);
        if (s->rgb) memmove(s->rgb + 3 * (size_t)vertices, s->rgb + 3 * (size_t)v, 3);
        number[v] = vertices++;
    }
    for (int32_t t = 0; t < s->triangle_count; t++) {
        int32_t *to = s->tri + 3 * (size_t)triangles;
        for (int k = 0; k < 3; k++) to[k] = number[s->tri[3 * (size_t)t + k]];
        if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0]) triangles++;
    }
    report->welded_vertices += s->vertex_count - vertices;
    report->dropped_triangles += s->triangle_count - triangles;
    s->vertex_count = vertices;
    s->triangle_count = triangles;
    free(order);
    free(first);
}

static void turn_to_lps(surface *s, bool gltf, bool ras)
{
    for (int32_t v = 0; v < s->vertex_count; v++) {
        double *x = s->xyz + 3 * (size_t)v;
        if (gltf) {
            double y = x[1];
            x[0] *= 1000;
            x[1] = -1000 * x[2];
            x[2] = 1000 * y;
        }
        if (ras) {
            x[0] = -x[0];
            x[1] = -x[1];
        }
    }
}

static bool read_polygons(const char *path, mesh_format format, const char *node, polygons *p, err *e)
{
    uint8_t *keep = NULL;
    int count = 0;
    switch (format) {
    case FORMAT_PLY: return read_mesh_ply(path, p, e);
    case FORMAT_OFF: return read_mesh_off(path, p, e);
    case FORMAT_VTK: return read_mesh_vtk(path, p, e);
    case FORMAT_VTP: return read_mesh_vtp(path, p, e);
    default: break;
    }
    if (format == FORMAT_GLTF && !gltf_check(path, node, &keep, &count, e)) return false;
    bool good = read_mesh_scene(path, keep, count, p, e);
    free(keep);
    return good;
}

bool mesh_read_surface(const char *file_and_node, mesh_space space, surface *out, mesh_file_report *report, err *e)
{
    mesh_format format = FORMAT_PLY;
    mesh_file_report r = {0};
    polygons p = {0};
    surface s = {0};
    char path[4096];
    const char *node = gltf_split(file_and_node, path, sizeof path);
    if (strlen(file_and_node) >= sizeof path)
        return err_at(e, ERR_INPUT, file_and_node, 0, NULL, "is a path of more than %zu bytes", sizeof path - 1);
    if (!find_format(path, &format, e) || !find_space_tag(path, format, &r.tagged, &r.ras, e) ||
        !read_polygons(path, format, node, &p, e))
        return false;
    if (*p.space && !read_space(p.space, path, 0, &r.tagged, &r.ras, e)) {
        polygons_free(&p);
        return false;
    }
    if (!r.tagged) r.ras = space == MESH_SPACE_RAS;
    bool good = surface_from_polygons(&p, path, &s, &r, e);
    polygons_free(&p);
    if (!good) return false;
    turn_to_lps(&s, format == FORMAT_GLTF, r.ras);
    if (format != FORMAT_PLY && format != FORMAT_OFF) mesh_weld(&s, &r);
    corner_join joined;
    good = join_corners(&s, path, &joined, e);
    if (good && !s.triangle_count) good = err_at(e, ERR_INPUT, path, 0, NULL, "holds no triangles");
    if (!good) {
        surface_free(&s);
        return false;
    }
    r.joined_vertices = joined.joined_vertices;
    r.joined_mm = joined.distance_mm;
    *out = s;
    if (report) *report = r;
    return true;
}
