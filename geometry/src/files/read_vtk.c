/* Legacy VTK, PolyData, text or binary, versions 1 to 5. What belongs to points and cells is not read. */
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/number_type.h"
#include "geometry/src/files/read_mesh.h"
#include <stdlib.h>

static const long long count_most = INT64_C(1) << 52;

typedef struct vtk {
    const char *path;
    scan text;
    bool binary, offsets; /* offsets: cells as of version 5 */
} vtk;

static bool refuse(const vtk *v, const char *what, err *e)
{
    return err_at(e, ERR_INPUT, v->path, v->binary ? 0 : scan_line(&v->text), NULL,
                  "is not a complete VTK file of PolyData: %s", what);
}

static number_type type_named(const char *name)
{
    static const struct {
        const char *name;
        number_type type;
    } known[] = {{"float", NUMBER_F32},        {"double", NUMBER_F64},         {"int", NUMBER_I32},
                 {"unsigned_int", NUMBER_U32}, {"long", NUMBER_I64},           {"unsigned_long", NUMBER_U64},
                 {"vtktypeint64", NUMBER_I64}, {"vtktypeint32", NUMBER_I32},   {"vtkIdType", NUMBER_I32},
                 {"short", NUMBER_I16},        {"unsigned_short", NUMBER_U16}, {"char", NUMBER_I8},
                 {"unsigned_char", NUMBER_U8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(known[i].name, name)) return known[i].type;
    return NUMBER_UNKNOWN;
}

/* Binary numbers have their high byte first. */
static bool next_number(vtk *v, number_type type, double *out)
{
    return number_next(&v->text, v->binary, __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, type, out);
}

static bool next_whole(vtk *v, number_type type, int64_t *out)
{
    double number;
    if (!next_number(v, type, &number) || !(number >= -1e15 && number <= 1e15)) return false;
    *out = (int64_t)number;
    return (double)*out == number;
}

static bool read_points(vtk *v, polygons *p, err *e)
{
    char word[32] = "";
    long long count;
    if (!scan_count(&v->text, count_most, &count) || !scan_word(&v->text, word, sizeof word))
        return refuse(v, "POINTS has no number and type", e);
    number_type type = type_named(word);
    if (type == NUMBER_UNKNOWN) return refuse(v, "POINTS are of an unknown type", e);
    if (p->point_count) return refuse(v, "POINTS are there twice", e);
    scan_skip_line(&v->text);
    for (long long i = 0; i < count; i++) {
        double x[3];
        for (int c = 0; c < 3; c++)
            if (!next_number(v, type, x + c)) return refuse(v, "a point is missing or broken", e);
        polygons_add_point(p, x);
    }
    return true;
}

/* One cell of `corners` corners; keep: 0 lines and vertices are stepped over, 1 polygons, 2 strips of triangles. */
static bool read_cell(vtk *v, number_type type, int64_t corners, int keep, polygons *p)
{
    for (int64_t k = 0; k < corners; k++) {
        int64_t point;
        if (!next_whole(v, type, &point)) return false;
        if (keep) polygons_add_corner(p, point);
    }
    if (keep == 1) polygons_close(p);
    if (keep == 2) polygons_close_strip(p);
    return corners >= 0;
}

static bool read_type(vtk *v, const char *title, number_type *type)
{
    char word[32] = "";
    if (!scan_word(&v->text, word, sizeof word) || strcmp(word, title) || !scan_word(&v->text, word, sizeof word))
        return false;
    *type = type_named(word);
    scan_skip_line(&v->text);
    return *type != NUMBER_UNKNOWN;
}

static bool read_offset_cells(vtk *v, long long offsets, int keep, polygons *p)
{
    number_type type;
    int64_t *at = NULL, room = 0, have = 0, before;
    bool good = read_type(v, "OFFSETS", &type);
    for (; good && have < offsets; have++) {
        if (have == room) at = GROW_ARRAY(int64_t, at, (size_t)(room = 2 * room + 8));
        good = next_whole(v, type, at + have);
    }
    good = good && read_type(v, "CONNECTIVITY", &type);
    before = good && have ? at[0] : 0;
    for (int64_t i = 1; good && i < have; before = at[i++]) good = read_cell(v, type, at[i] - before, keep, p);
    free(at);
    return good;
}

static bool read_cells(vtk *v, int keep, polygons *p, err *e)
{
    long long first, second;
    bool good = scan_count(&v->text, count_most, &first) && scan_count(&v->text, count_most, &second);
    if (good) scan_skip_line(&v->text);
    if (good && v->offsets)
        good = read_offset_cells(v, first, keep, p);
    else
        for (long long i = 0; good && i < first; i++) {
            int64_t corners;
            good = next_whole(v, NUMBER_I32, &corners) && read_cell(v, NUMBER_I32, corners, keep, p);
        }
    return good || refuse(v, "a cell is missing or broken", e);
}

static bool skip_fields(vtk *v, err *e)
{
    char word[64] = "";
    long long arrays = 0, parts = 0, tuples = 0;
    double number;
    if (!scan_word(&v->text, word, sizeof word) || !scan_count(&v->text, count_most, &arrays))
        return refuse(v, "FIELD has no name and number", e);
    for (long long i = 0; i < arrays; i++) {
        bool good = scan_word(&v->text, word, sizeof word) && scan_count(&v->text, count_most, &parts) &&
                    scan_count(&v->text, count_most, &tuples) && scan_word(&v->text, word, sizeof word);
        number_type type = type_named(word);
        if (!good || type == NUMBER_UNKNOWN)
            return refuse(v, good ? "a FIELD of text or bits is not read; save it as .vtp" : "a FIELD is broken", e);
        scan_skip_line(&v->text);
        for (long long k = 0; k < tuples; k++)
            for (long long c = 0; c < parts; c++)
                if (!next_number(v, type, &number)) return refuse(v, "a FIELD is broken", e);
        if (!parts && tuples) return refuse(v, "a FIELD has no components", e);
    }
    return true;
}

static void skip_metadata(vtk *v) /* behind the next empty line */
{
    bool empty = false;
    scan_skip_line(&v->text); /* of the word METADATA itself */
    while (!empty && v->text.at < v->text.end) {
        const char *line = v->text.at;
        scan_skip_line(&v->text);
        empty = line[*line == '\r'] == '\n';
    }
}

static bool read_header(vtk *v, err *e)
{
    static const char begin[] = "# vtk DataFile Version ";
    char word[32] = "", kind[32] = "";
    if (strncmp(v->text.at, begin, sizeof begin - 1)) return refuse(v, "it does not begin with its version", e);
    v->offsets = strtod(v->text.at + sizeof begin - 1, NULL) >= 5;
    scan_skip_line(&v->text);
    scan_skip_line(&v->text); /* the title */
    scan_word(&v->text, word, sizeof word);
    if (strcmp(word, "BINARY") && strcmp(word, "ASCII")) return refuse(v, "neither BINARY nor ASCII", e);
    bool binary = *word == 'B';
    if (!scan_word(&v->text, word, sizeof word) || strcmp(word, "DATASET"))
        return refuse(v, "the line DATASET is missing", e);
    scan_word(&v->text, kind, sizeof kind);
    if (strcmp(kind, "POLYDATA"))
        return err_at(e, ERR_INPUT, v->path, scan_line(&v->text), "DATASET",
                      "is %s, not a surface; save its surface as POLYDATA", kind);
    v->binary = binary;
    return true;
}

static bool read_sections(vtk *v, polygons *p, err *e)
{
    char word[32];
    while (scan_word(&v->text, word, sizeof word)) {
        bool good = true;
        if (!strcmp(word, "POINTS"))
            good = read_points(v, p, e);
        else if (!strcmp(word, "POLYGONS") || !strcmp(word, "TRIANGLE_STRIPS"))
            good = read_cells(v, *word == 'P' ? 1 : 2, p, e);
        else if (!strcmp(word, "VERTICES") || !strcmp(word, "LINES"))
            good = read_cells(v, 0, p, e);
        else if (!strcmp(word, "FIELD"))
            good = skip_fields(v, e);
        else if (!strcmp(word, "METADATA"))
            skip_metadata(v);
        else if (!strcmp(word, "POINT_DATA") || !strcmp(word, "CELL_DATA"))
            return true;
        else
            good = refuse(v, "an unknown section", e);
        if (!good) return false;
    }
    return true;
}

bool read_mesh_vtk(const char *path, polygons *out, err *e)
{
    char *bytes;
    size_t size;
    if (!input_file_load(path, INT64_MAX - 1, &bytes, &size, e)) return false;
    vtk v = {.path = path, .text = {bytes, bytes, bytes + size, 0}};
    polygons p = polygons_new();
    bool good = read_header(&v, e) && read_sections(&v, &p, e);
    free(bytes);
    if (good)
        *out = p;
    else
        polygons_free(&p);
    return good;
}
