#include "geometry/src/files/markups.h"
#include <stdio.h>
#include <string.h>

#define SCHEMA                                                                                                         \
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"                \
    "markups-schema-v1.0.3.json#"

static const json_t *markup_at(const json_file *f, size_t index)
{
    return json_array_get(json_object_get(f->root, "markups"), index);
}

bool markups_open(const char *path, json_file *out, const json_t **list, err *e)
{
    json_file f;
    if (!json_file_read(path, &f, e)) return false;
    const json_t *markups = json_object_get(f.root, "markups");
    bool good = true;
    if (!json_is_array(markups) || !json_array_size(markups))
        good = json_file_refuse(&f, "", e, "not a markups file of 3D Slicer: it has no list \"markups\"");
    for (size_t i = 0; good && i < json_array_size(markups); i++) {
        char pointer[64];
        snprintf(pointer, sizeof pointer, "/markups/%zu", i);
        const json_t *points = json_object_get(json_array_get(markups, i), "controlPoints");
        if (!json_is_object(json_array_get(markups, i)))
            good = json_file_refuse(&f, pointer, e, "must be an object");
        else if (points && !json_is_array(points))
            good = json_file_refuse(&f, pointer, e, "controlPoints must be a list");
    }
    if (!good) {
        json_file_free(&f);
        return false;
    }
    *list = markups;
    *out = f;
    return true;
}

bool markups_check(const json_file *f, size_t index, const char *type, bool *ras, err *e)
{
    const json_t *m = markup_at(f, index), *units = json_object_get(m, "coordinateUnits");
    const json_t *system = json_object_get(m, "coordinateSystem");
    const char *is = json_string_value(json_object_get(m, "type"));
    char pointer[64];
    snprintf(pointer, sizeof pointer, "/markups/%zu/type", index);
    bool curve = is && !strcmp(type, "Fiducial") && (!strcmp(is, "Curve") || !strcmp(is, "ClosedCurve"));
    if (!curve && (!is || strcmp(is, type)))
        return json_file_refuse(f, pointer, e, "must be \"%s\", is \"%s\"", type, is ? is : "");
    if (json_is_array(units)) units = json_array_get(units, 0); /* ["mm", "UCUM", "millimeter"] */
    snprintf(pointer, sizeof pointer, "/markups/%zu/coordinateUnits", index);
    if (units && (!json_is_string(units) || strcmp(json_string_value(units), "mm")))
        return json_file_refuse(f, pointer, e, "must be \"mm\", is \"%s\"",
                                json_is_string(units) ? json_string_value(units) : "no text");
    const char *axes = system ? json_string_value(system) : "LPS"; /* the schema's default */
    snprintf(pointer, sizeof pointer, "/markups/%zu/coordinateSystem", index);
    if (!axes || (strcmp(axes, "LPS") && strcmp(axes, "RAS")))
        return json_file_refuse(f, pointer, e, "must be \"LPS\" or \"RAS\", is \"%s\"", axes ? axes : "no text");
    *ras = !strcmp(axes, "RAS");
    return true;
}

size_t markups_point_count(const json_file *f, size_t index)
{
    return json_array_size(json_object_get(markup_at(f, index), "controlPoints"));
}

bool markups_point(const json_file *f, size_t index, size_t k, bool ras, bool *defined, const char **label,
                   double xyz[3], err *e)
{
    const json_t *p = json_array_get(json_object_get(markup_at(f, index), "controlPoints"), k);
    const json_t *status = json_object_get(p, "positionStatus"), *name = json_object_get(p, "label");
    char pointer[96];
    snprintf(pointer, sizeof pointer, "/markups/%zu/controlPoints/%zu", index, k);
    if (!json_is_object(p)) return json_file_refuse(f, pointer, e, "must be an object");
    if (name && !json_is_string(name)) return json_file_refuse(f, pointer, e, "label must be text");
    const char *placed = status ? json_string_value(status) : "defined";
    *label = name ? json_string_value(name) : "";
    *defined = placed && !strcmp(placed, "defined");
    if (!placed || (!*defined && strcmp(placed, "undefined") && strcmp(placed, "preview")))
        return json_file_refuse(f, pointer, e, "positionStatus must be \"defined\", \"undefined\" or \"preview\"");
    if (!*defined) return true;
    const json_t *position = json_object_get(p, "position");
    if (!position) return json_file_refuse(f, pointer, e, "the point \"%s\" has no position", *label);
    snprintf(pointer, sizeof pointer, "/markups/%zu/controlPoints/%zu/position", index, k);
    if (!json_file_vec3(f, position, pointer, xyz, e)) return false;
    if (ras) {
        xyz[0] = -xyz[0];
        xyz[1] = -xyz[1];
    }
    return true;
}

json_t *markups_document(json_t **list)
{
    *list = json_array();
    /* Slicer looks for the schema's name in the first 300 bytes, so it comes first. */
    return json_pack("{s:s, s:o}", "@schema", SCHEMA, "markups", *list);
}

json_t *markups_new(const char *type, json_t **points)
{
    *points = json_array();
    return json_pack("{s:s, s:s, s:s, s:b, s:s, s:o}", "type", type, "coordinateSystem", "LPS", "coordinateUnits", "mm",
                     "locked", 0, "labelFormat", "%N-%d", "controlPoints", *points);
}

const char *markups_point_description(const json_file *f, size_t index, size_t k)
{
    const json_t *p = json_array_get(json_object_get(markup_at(f, index), "controlPoints"), k);
    const char *text = json_string_value(json_object_get(p, "description"));
    return text ? text : "";
}

void markups_add_point(json_t *points, const char *label, const double xyz[3])
{
    markups_add_described(points, label, xyz, "", true);
}

void markups_add_described(json_t *points, const char *label, const double xyz[3], const char *description, bool placed)
{
    char id[24];
    snprintf(id, sizeof id, "%zu", json_array_size(points) + 1);
    /* orientation: the identity of RAS. Some releases take a point without a status as not placed. */
    json_t *p = json_pack("{s:s, s:s, s:s, s:s, s:[fff], s:[fffffffff], s:b, s:b, s:b, s:s}", "id", id, "label", label,
                          "description", description, "associatedNodeID", "", "position", xyz[0], xyz[1], xyz[2],
                          "orientation", -1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, "selected", 1, "locked", 0,
                          "visibility", 1, "positionStatus", placed ? "defined" : "preview");
    json_array_append_new(points, p);
}
