#include "geometry/mesh_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the binary writers store the machine's own byte order");

static void put(FILE *to, const void *bytes, size_t size) { (void)!fwrite(bytes, 1, size, to); }

static void write_ply(const surface *s, bool floats, FILE *to)
{
    const char *type = floats ? "float" : "double";
    fprintf(to,
            "ply\nformat binary_little_endian 1.0\ncomment gnathos " GNATHOS_VERSION
            "\ncomment SPACE=LPS\nelement vertex %d\nproperty %s x\nproperty %s y\nproperty %s z\n%s"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
            s->vertex_count, type, type, type,
            s->rgb ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "", s->triangle_count);
    for (int32_t v = 0; v < s->vertex_count; v++) {
        const double *x = s->xyz + 3 * (size_t)v;
        const float rounded[3] = {(float)x[0], (float)x[1], (float)x[2]};
        if (floats)
            put(to, rounded, sizeof rounded);
        else
            put(to, x, 3 * sizeof *x);
        if (s->rgb) put(to, s->rgb + 3 * (size_t)v, 3);
    }
    for (int32_t t = 0; t < s->triangle_count; t++) {
        fputc(3, to);
        put(to, s->tri + 3 * (size_t)t, 3 * sizeof *s->tri);
    }
}

static void write_stl(const surface *s, FILE *to)
{
    char head[80] = "gnathos " GNATHOS_VERSION ". SPACE=LPS"; /* must not begin with "solid", which means text */
    uint32_t count = (uint32_t)s->triangle_count;
    put(to, head, sizeof head);
    put(to, &count, sizeof count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const double *p[3];
        for (int k = 0; k < 3; k++) p[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + k];
        double a[3], b[3], n[3];
        vec_sub(p[1], p[0], a);
        vec_sub(p[2], p[0], b);
        vec_cross(a, b, n);
        vec_normalize(n);
        float record[12];
        for (int c = 0; c < 3; c++) record[c] = (float)n[c];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) record[3 + 3 * k + c] = (float)p[k][c];
        put(to, record, sizeof record);
        put(to, "\0", 2);
    }
}

static void write_obj(const surface *s, FILE *to)
{
    fprintf(to, "# gnathos " GNATHOS_VERSION "\n# SPACE=LPS\n");
    for (int32_t v = 0; v < s->vertex_count; v++) {
        const double *x = s->xyz + 3 * (size_t)v;
        fprintf(to, "v %.17g %.17g %.17g\n", x[0], x[1], x[2]);
    }
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        fprintf(to, "f %d %d %d\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
}

static bool write_surface(const surface *s, bool floats, const char *path, err *e)
{
    bool ply = file_name_ends(path, ".ply"), stl = file_name_ends(path, ".stl");
    if (!ply && !stl && !file_name_ends(path, ".obj"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of mesh file; written are .ply .stl .obj");
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    if (ply)
        write_ply(s, floats, w.stream);
    else if (stl)
        write_stl(s, w.stream);
    else
        write_obj(s, w.stream);
    return whole_file_close(&w, e);
}

bool mesh_write_surface(const surface *s, const char *path, err *e) { return write_surface(s, false, path, e); }

bool mesh_write_surface_float(const surface *s, const char *path, err *e) { return write_surface(s, true, path, e); }
