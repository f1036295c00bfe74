/* PLY, text and binary in both byte orders. Of the elements `vertex` and `face` are kept, others are stepped over. */
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/number_type.h"
#include "geometry/src/files/read_mesh.h"
#include <stdlib.h>

enum { ELEMENTS_MOST = 16, PROPERTIES_MOST = 64 };

typedef enum role { ROLE_NONE, ROLE_X, ROLE_Y, ROLE_Z, ROLE_RED, ROLE_GREEN, ROLE_BLUE, ROLE_CORNERS } role;

typedef struct property {
    number_type type, length; /* length: of the number before a list; NUMBER_UNKNOWN: no list */
    role is;
} property;

typedef struct element {
    char name[24];
    long long count;
    int property_count;
    property property[PROPERTIES_MOST];
} element;

typedef struct ply {
    const char *path;
    scan text;
    bool binary, swap;
    int element_count;
    element element[ELEMENTS_MOST];
} ply;

static bool refuse(const ply *p, const char *why, const char *word, err *e)
{
    return err_at(e, ERR_INPUT, p->path, scan_line(&p->text), NULL, "is not a complete PLY file: %s \"%s\"", why, word);
}

static number_type type_named(const char *name)
{
    static const char *const names[][10] = {
        {"char", "uchar", "short", "ushort", "int", "uint", "", "", "float", "double"},
        {"int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"}};
    for (int i = 0; i < 20; i++)
        if (*name && !strcmp(names[i / 10][i % 10], name)) return (number_type)(i % 10);
    return NUMBER_UNKNOWN;
}

static role role_of(const element *of, const property *p, const char *name)
{
    static const char *const names[][2] = {{"x", ""},
                                           {"y", ""},
                                           {"z", ""},
                                           {"red", "r"},
                                           {"green", "g"},
                                           {"blue", "b"},
                                           {"vertex_indices", "vertex_index"}};
    bool list = p->length != NUMBER_UNKNOWN;
    if (strcmp(of->name, list ? "face" : "vertex")) return ROLE_NONE;
    for (int i = 0; i < ROLE_CORNERS; i++) {
        role is = (role)(i + 1);
        if (strcmp(names[i][0], name) && strcmp(names[i][1], name)) continue;
        if (list != (is == ROLE_CORNERS) || (is >= ROLE_RED && !list && p->type != NUMBER_U8)) return ROLE_NONE;
        return is;
    }
    return ROLE_NONE;
}

static bool read_property(ply *p, err *e)
{
    char word[32] = "", name[32] = "";
    property is = {.length = NUMBER_UNKNOWN};
    element *of = p->element + p->element_count - 1;
    scan_word(&p->text, word, sizeof word);
    if (!p->element_count || of->property_count == PROPERTIES_MOST)
        return refuse(p, p->element_count ? "too many properties in" : "no element before the property",
                      p->element_count ? of->name : word, e);
    if (!strcmp(word, "list")) {
        scan_word(&p->text, word, sizeof word);
        is.length = type_named(word);
        if (is.length >= NUMBER_F32) return refuse(p, "a list cannot be counted by", word, e);
        scan_word(&p->text, word, sizeof word);
    }
    is.type = type_named(word);
    if (is.type == NUMBER_UNKNOWN) return refuse(p, "unknown type", word, e);
    if (!scan_word(&p->text, name, sizeof name)) return refuse(p, "no name after", word, e);
    is.is = role_of(of, &is, name);
    for (int i = 0; is.is && i < of->property_count; i++)
        if (of->property[i].is == is.is) return refuse(p, "there twice is", name, e);
    of->property[of->property_count++] = is;
    return true;
}

static bool read_element(ply *p, err *e)
{
    element *is = p->element + p->element_count;
    if (p->element_count++ == ELEMENTS_MOST) return refuse(p, "too many elements", "", e);
    *is = (element){0};
    if (!scan_word(&p->text, is->name, sizeof is->name) || !scan_count(&p->text, INT64_C(1) << 52, &is->count))
        return refuse(p, "no number of the element", is->name, e);
    if (!strcmp(is->name, "tristrips")) return refuse(p, "triangle strips are not read, save triangles:", is->name, e);
    return true;
}

static bool read_format(ply *p, err *e)
{
    char word[32] = "";
    scan_word(&p->text, word, sizeof word);
    p->binary = strcmp(word, "ascii") != 0;
    p->swap = !strcmp(word, "binary_big_endian");
    return !p->binary || p->swap || !strcmp(word, "binary_little_endian") || refuse(p, "unknown format", word, e);
}

static bool read_header(ply *p, err *e)
{
    char word[32] = "";
    bool format = false;
    if (!scan_word(&p->text, word, sizeof word) || strcmp(word, "ply")) return refuse(p, "it begins with", word, e);
    while (scan_word(&p->text, word, sizeof word)) {
        bool good = true;
        if (!strcmp(word, "end_header")) {
            scan_skip_line(&p->text);
            return format || refuse(p, "no format before", word, e);
        }
        if (!strcmp(word, "format"))
            good = format = read_format(p, e);
        else if (!strcmp(word, "element"))
            good = read_element(p, e);
        else if (!strcmp(word, "property"))
            good = read_property(p, e);
        else if (strcmp(word, "comment") && strcmp(word, "obj_info"))
            good = refuse(p, "unknown line", word, e);
        if (!good) return false;
        scan_skip_line(&p->text);
    }
    return refuse(p, "missing is", "end_header", e);
}

static bool read_item(ply *p, const element *of, polygons *out)
{
    double number = 0, xyz[3] = {0}, length = 1;
    uint8_t rgb[3] = {0};
    for (int i = 0; i < of->property_count; i++) {
        const property *is = of->property + i;
        length = 1;
        if (is->length != NUMBER_UNKNOWN &&
            (!number_next(&p->text, p->binary, p->swap, is->length, &length) || !(length >= 0 && length <= 1e15)))
            return false;
        for (int64_t k = 0; k < (int64_t)length; k++) {
            if (!number_next(&p->text, p->binary, p->swap, is->type, &number)) return false;
            if (is->is != ROLE_CORNERS) continue;
            if (!(number >= -1e15 && number <= 1e15) || (double)(int64_t)number != number) return false;
            polygons_add_corner(out, (int64_t)number);
        }
        if (is->is >= ROLE_X && is->is <= ROLE_Z) xyz[is->is - ROLE_X] = number;
        if (is->is >= ROLE_RED && is->is <= ROLE_BLUE) {
            if (!(number >= 0 && number <= 255)) return false;
            rgb[is->is - ROLE_RED] = (uint8_t)number;
        }
        if (is->is == ROLE_CORNERS) polygons_close(out);
    }
    if (strcmp(of->name, "vertex")) return true;
    if (out->rgb) memcpy(out->rgb + 3 * (size_t)out->point_count, rgb, 3);
    polygons_add_point(out, xyz);
    return true;
}

static int roles(const element *of, role first, role last)
{
    int count = 0;
    for (int i = 0; i < of->property_count; i++) count += of->property[i].is >= first && of->property[i].is <= last;
    return count;
}

static bool read_body(ply *p, polygons *out, err *e)
{
    for (int i = 0; i < p->element_count; i++) {
        const element *of = p->element + i;
        bool vertices = !strcmp(of->name, "vertex");
        for (int k = 0; k < i; k++)
            if (!strcmp(p->element[k].name, of->name)) return refuse(p, "there twice is", of->name, e);
        if (vertices && roles(of, ROLE_X, ROLE_Z) < 3) return refuse(p, "x, y or z is missing in", of->name, e);
        if (!of->property_count) continue;
        size_t left = (size_t)(p->text.end - p->text.at) + 1, least = (p->binary ? 1 : 2) * (size_t)of->property_count;
        if ((size_t)of->count > left / least)
            return err_at(e, ERR_INPUT, p->path, 0, NULL,
                          "is not a complete PLY file: %lld items of \"%s\" do not fit into its %zu bytes", of->count,
                          of->name, left - 1);
        if (vertices && roles(of, ROLE_RED, ROLE_BLUE) == 3) out->rgb = NEW_ARRAY(uint8_t, 3 * of->count);
        for (long long k = 0; k < of->count; k++)
            if (!read_item(p, of, out))
                return err_at(e, ERR_INPUT, p->path, p->binary ? 0 : scan_line(&p->text), NULL,
                              "is not a complete PLY file: %s %lld of %lld is missing or broken", of->name, k,
                              of->count);
    }
    return true;
}

bool read_mesh_ply(const char *path, polygons *out, err *e)
{
    char *bytes;
    size_t size;
    if (!input_file_load(path, INT64_MAX - 1, &bytes, &size, e)) return false;
    ply *p = NEW_ARRAY(ply, 1);
    *p = (ply){.path = path, .text = {bytes, bytes, bytes + size, 0}};
    polygons made = polygons_new();
    bool good = read_header(p, e) && read_body(p, &made, e);
    free(p);
    free(bytes);
    if (good)
        *out = made;
    else
        polygons_free(&made);
    return good;
}
