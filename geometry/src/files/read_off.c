/* OFF as text (Geomview): a line for each vertex, which may go on with colour or normal, then one for each face. */
#include "geometry/input_file.h"
#include "geometry/src/files/read_mesh.h"
#include "geometry/src/files/scan.h"
#include <stdlib.h>

static bool refuse(const scan *s, const char *path, const char *what, long long at, long long of, err *e)
{
    return err_at(e, ERR_INPUT, path, scan_line(s), NULL, "is not a complete OFF file: %s %lld of %lld is %s", what, at,
                  of, s->at == s->end ? "missing" : "broken");
}

static bool read_kind(scan *s, const char *path, err *e)
{
    char word[16] = "", *kind = word;
    scan_word(s, word, sizeof word);
    if (!strncmp(kind, "ST", 2)) kind += 2;
    kind += *kind == 'C';
    kind += *kind == 'N';
    if (strcmp(kind, "OFF"))
        return err_at(e, ERR_INPUT, path, 0, NULL, "is not a complete OFF file: it begins with \"%s\", not with OFF",
                      word);
    scan next = *s;
    if (scan_word(&next, word, sizeof word) && !strcmp(word, "BINARY"))
        return err_at(e, ERR_INPUT, path, 0, NULL, "is a binary OFF file; save it as text");
    return true;
}

static bool read_vertices(scan *s, const char *path, long long count, polygons *p, err *e)
{
    for (long long v = 0; v < count; v++) {
        double x[3];
        for (int c = 0; c < 3; c++)
            if (!scan_number(s, x + c)) return refuse(s, path, "vertex", v, count, e);
        scan_skip_line(s);
        polygons_add_point(p, x);
    }
    return true;
}

static bool read_faces(scan *s, const char *path, long long count, polygons *p, err *e)
{
    for (long long f = 0; f < count; f++) {
        long long corners;
        double point;
        if (!scan_count(s, INT64_C(1) << 40, &corners)) return refuse(s, path, "face", f, count, e);
        for (long long k = 0; k < corners; k++) {
            if (!scan_number(s, &point) || !(point >= -1e15 && point <= 1e15) || point != (double)(int64_t)point)
                return refuse(s, path, "face", f, count, e);
            polygons_add_corner(p, (int64_t)point);
        }
        scan_skip_line(s);
        polygons_close(p);
    }
    return true;
}

bool read_mesh_off(const char *path, polygons *out, err *e)
{
    char *text;
    size_t size;
    long long vertices = 0, faces = 0, most = INT64_C(1) << 52;
    if (!input_file_load(path, INT64_MAX - 1, &text, &size, e)) return false;
    scan s = {text, text, text + size, '#'};
    polygons p = polygons_new();
    bool good = read_kind(&s, path, e);
    if (good && (!scan_count(&s, most, &vertices) || !scan_count(&s, most, &faces)))
        good = err_at(e, ERR_INPUT, path, scan_line(&s), NULL,
                      "is not a complete OFF file: the numbers of vertices and faces are missing");
    if (good) scan_skip_line(&s);
    good = good && read_vertices(&s, path, vertices, &p, e) && read_faces(&s, path, faces, &p, e);
    free(text);
    if (good)
        *out = p;
    else
        polygons_free(&p);
    return good;
}
