/* Slicer's rule (vtkMRMLMarkupsPlaneNode): object to node = baseToNode * objectToBase, the plane's point is
 * the last column and its normal the third. For three points p0, p1, p2 the base is x = p1 - p0, z = x cross
 * (p2 - p0) at p0, whatever baseToNode says. In LPS files rows 0 and 1 of both matrices are negated (no
 * conjugation); `center` and `normal` are written but never read. */
#include "geometry/plane_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/markups.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef double matrix4[4][4];

/* The matrix `key` in RAS; the identity if the file has none. */
static bool read_matrix(const json_file *f, size_t index, const char *key, bool ras, matrix4 out, bool *present, err *e)
{
    const json_t *list = json_object_get(json_array_get(json_object_get(f->root, "markups"), index), key);
    char pointer[64];
    snprintf(pointer, sizeof pointer, "/markups/%zu/%s", index, key);
    *present = list != NULL;
    memset(out, 0, sizeof(matrix4));
    for (int i = 0; i < 4; i++) out[i][i] = 1;
    if (!list) return true;
    if (json_array_size(list) != 16) return json_file_refuse(f, pointer, e, "must be 16 numbers");
    for (int i = 0; i < 16; i++) {
        const json_t *number = json_array_get(list, (size_t)i);
        if (!json_is_number(number)) return json_file_refuse(f, pointer, e, "must be 16 numbers");
        out[i / 4][i % 4] = (ras || i >= 8 ? 1 : -1) * json_number_value(number);
    }
    return true;
}

static bool three_point_base(const json_file *f, size_t index, double p[][3], int defined, matrix4 base, err *e)
{
    char pointer[64];
    snprintf(pointer, sizeof pointer, "/markups/%zu/controlPoints", index);
    if (defined < 3)
        return json_file_refuse(f, pointer, e, "a three-point plane needs 3 defined points, has %d", defined);
    double x[3], y[3], z[3], d[3];
    vec_sub(p[1], p[0], x);
    vec_sub(p[2], p[0], d);
    double length = vec_normalize(x), other = vec_norm(d);
    vec_cross(x, d, z);
    if (!(length > 1e-6) || !(vec_normalize(z) > 1e-6 * (1 + other)))
        return json_file_refuse(f, pointer, e, "the three points lie on one line");
    vec_cross(z, x, y);
    for (int i = 0; i < 3; i++) {
        base[i][0] = x[i];
        base[i][1] = y[i];
        base[i][2] = z[i];
        base[i][3] = p[0][i];
    }
    return true;
}

static bool read_plane(const json_file *f, size_t index, cut_plane *out, err *e)
{
    const json_t *m = json_array_get(json_object_get(f->root, "markups"), index),
                 *kind = json_object_get(m, "planeType");
    const char *type = kind ? json_string_value(kind) : "3Points";
    bool ras, placed, have_base, have_object;
    char pointer[64];
    double p[3][3];
    int defined = 0;
    if (!markups_check(f, index, "Plane", &ras, e)) return false;
    for (size_t k = 0; k < markups_point_count(f, index) && defined < 3; k++) {
        const char *label;
        if (!markups_point(f, index, k, ras, &placed, &label, p[defined], e)) return false;
        if (!placed) continue;
        p[defined][0] = -p[defined][0]; /* RAS, where Slicer's rule holds */
        p[defined][1] = -p[defined][1];
        defined++;
    }
    matrix4 base, object;
    snprintf(pointer, sizeof pointer, "/markups/%zu/planeType", index);
    if (!read_matrix(f, index, "baseToNode", ras, base, &have_base, e)) return false;
    if (!read_matrix(f, index, "objectToBase", ras, object, &have_object, e)) return false;
    if (type && !strcmp(type, "3Points")) {
        if (!three_point_base(f, index, p, defined, base, e)) return false;
    } else if (type && (!strcmp(type, "PointNormal") || !strcmp(type, "pointNormal"))) {
        if (!have_base || !defined)
            return json_file_refuse(f, pointer, e, "a plane of this type needs a defined point and baseToNode");
        for (int i = 0; i < 3; i++) base[i][3] = p[0][i];
    } else {
        return json_file_refuse(f, pointer, e, "must be \"3Points\" or \"PointNormal\", is \"%s\"", type ? type : "");
    }
    double normal[3] = {0}, point[3];
    for (int i = 0; i < 3; i++) {
        point[i] = base[i][3];
        for (int k = 0; k < 3; k++) {
            normal[i] += base[i][k] * object[k][2];
            point[i] += base[i][k] * object[k][3];
        }
    }
    if (!(vec_normalize(normal) > 1e-6)) return json_file_refuse(f, pointer, e, "the plane's matrices give no normal");
    for (int i = 0; i < 3; i++) {
        out->normal[i] = i < 2 ? -normal[i] : normal[i];
        out->point[i] = i < 2 ? -point[i] : point[i];
    }
    return true;
}

/* Slicer keeps the name of a plane in the name of its file; our own files hold several and a name for each.
 */
static bool read_label(const json_file *f, size_t index, size_t count, cut_plane *out, err *e)
{
    const json_t *name = json_object_get(json_array_get(json_object_get(f->root, "markups"), index), "name");
    char pointer[64], text[512];
    snprintf(pointer, sizeof pointer, "/markups/%zu/name", index);
    if (name && !json_is_string(name)) return json_file_refuse(f, pointer, e, "must be text");
    if (name) {
        snprintf(text, sizeof text, "%s", json_string_value(name));
    } else {
        const char *base = file_name_base(f->path), *dot = strchr(base, '.');
        int length = dot && dot != base ? (int)(dot - base) : (int)strlen(base);
        if (count == 1)
            snprintf(text, sizeof text, "%.*s", length, base);
        else
            snprintf(text, sizeof text, "%.*s_%zu", length, base, index + 1);
    }
    if (!*text || strlen(text) >= sizeof out->label)
        return json_file_refuse(f, pointer, e, "the name of a plane must have 1 to 63 bytes");
    memcpy(out->label, text, strlen(text) + 1);
    return true;
}

bool planes_read(const char *path, cut_plane **out, int *count, err *e)
{
    json_file f;
    const json_t *list;
    if (!file_name_ends(path, ".json")) return file_name_refuse(path, "plane", ".mrk.json", "", e);
    if (!markups_open(path, &f, &list, e)) return false;
    size_t n = json_array_size(list);
    cut_plane *planes = NEW_ARRAY(cut_plane, n);
    bool good = true;
    for (size_t i = 0; good && i < n; i++) {
        good = read_plane(&f, i, planes + i, e) && read_label(&f, i, n, planes + i, e);
        for (size_t k = 0; good && k < i; k++)
            if (!strcmp(planes[k].label, planes[i].label))
                good = json_file_refuse(&f, "/markups", e, "the plane \"%s\" is there twice", planes[i].label);
    }
    json_file_free(&f);
    if (!good) {
        free(planes);
        return false;
    }
    *out = planes;
    *count = (int)n;
    return true;
}

bool planes_write(const cut_plane *planes, int count, const char *path, err *e)
{
    const double arm_mm = 30;
    if (!file_name_ends(path, ".mrk.json"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "planes are written as .mrk.json");
    json_t *list, *points, *document = markups_document(&list);
    for (int i = 0; i < count; i++) {
        const cut_plane *plane = planes + i;
        /* x along the axis that is farthest from the normal; x cross y = normal */
        int far = 0;
        for (int c = 1; c < 3; c++)
            if (fabs(plane->normal[c]) < fabs(plane->normal[far])) far = c;
        double axis[3] = {0}, x[3], y[3], p[3];
        axis[far] = 1;
        vec_cross(axis, plane->normal, x);
        vec_normalize(x);
        vec_cross(plane->normal, x, y);
        json_t *m = markups_new("Plane", &points);
        json_object_set_new(m, "name", json_string(plane->label));
        json_object_set_new(m, "planeType", json_string("3Points"));
        markups_add_point(points, plane->label, plane->point);
        vec_axpy(plane->point, arm_mm, x, p);
        markups_add_point(points, "x", p);
        vec_axpy(plane->point, arm_mm, y, p);
        markups_add_point(points, "y", p);
        json_array_append_new(list, m);
    }
    bool good = json_file_write(document, path, e);
    json_decref(document);
    return good;
}
