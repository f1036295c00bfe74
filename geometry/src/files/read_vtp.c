/* VTK's XML files of PolyData: pieces of points, polygons and strips of triangles. */
#include "geometry/input_file.h"
#include "geometry/src/files/read_mesh.h"
#include "geometry/src/files/vtk_array.h"
#include <stdio.h>
#include <stdlib.h>

typedef struct cells {
    vtk_array corner, offset; /* offset: where each cell ends */
} cells;

typedef struct piece {
    vtk_array points;
    cells polygons, strips;
} piece;

static void free_piece(piece *p)
{
    free(p->points.bytes);
    free(p->polygons.corner.bytes);
    free(p->polygons.offset.bytes);
    free(p->strips.corner.bytes);
    free(p->strips.offset.bytes);
    *p = (piece){0};
}

/* Byte order, lengths, compressor, and where the appended arrays lie. NULL, or what is wrong. */
static const char *read_layout(const char *text, const char *end, vtk_layout *of)
{
    char type[24], order[24], header[16], packer[40], encoding[16];
    vtk_xml_tag tag;
    const char *at = text;
    *of = (vtk_layout){.end = end};
    do
        if (!vtk_xml_next(&at, end, &tag)) return "it has no element VTKFile";
    while (!vtk_xml_is(&tag, "VTKFile"));
    vtk_xml_attribute(&tag, "type", type, sizeof type);
    vtk_xml_attribute(&tag, "byte_order", order, sizeof order);
    vtk_xml_attribute(&tag, "header_type", header, sizeof header);
    vtk_xml_attribute(&tag, "compressor", packer, sizeof packer);
    if (strcmp(type, "PolyData")) return "it holds no PolyData; save the surface of what it holds";
    if (strcmp(order, "LittleEndian") && strcmp(order, "BigEndian")) return "its byte order is unknown";
    if (*packer && strcmp(packer, "vtkZLibDataCompressor"))
        return "it is compressed by another program than zlib; save it with zlib or without";
    of->wide = !strcmp(header, "UInt64");
    of->swap = (*order == 'L') != (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    of->zlib = *packer != 0;
    while (vtk_xml_next(&at, end, &tag)) {
        if (!vtk_xml_is(&tag, "AppendedData") || tag.closes) continue;
        vtk_xml_attribute(&tag, "encoding", encoding, sizeof encoding);
        of->base64 = strcmp(encoding, "raw") != 0;
        const char *mark = memchr(tag.after, '_', (size_t)(end - tag.after));
        if (!mark) return "its appended arrays are missing";
        of->appended = mark + 1;
        break;
    }
    return NULL;
}

static const char *add_cells(const cells *c, int64_t base, int64_t points, bool strips, polygons *out)
{
    int64_t before = 0;
    for (int64_t i = 0; i < c->offset.count; i++) {
        double end = vtk_array_at(&c->offset, i);
        if (!(end >= (double)before && end <= (double)c->corner.count)) return "the offsets of its cells are wrong";
        for (; before < (int64_t)end; before++) {
            double point = vtk_array_at(&c->corner, before);
            if (!(point >= 0 && point < (double)points)) return "a cell names a point that is not there";
            polygons_add_corner(out, base + (int64_t)point);
        }
        if (strips)
            polygons_close_strip(out);
        else
            polygons_close(out);
    }
    return NULL;
}

static const char *add_piece(const piece *p, polygons *out)
{
    int64_t base = out->point_count, points = p->points.count / 3;
    if (p->points.count % 3) return "its points have not three coordinates";
    for (int64_t i = 0; i < points; i++) {
        double x[3];
        for (int c = 0; c < 3; c++) x[c] = vtk_array_at(&p->points, 3 * i + c);
        polygons_add_point(out, x);
    }
    const char *wrong = add_cells(&p->polygons, base, points, false, out);
    return wrong ? wrong : add_cells(&p->strips, base, points, true, out);
}

/* The array that a DataArray in this section is read into, or NULL. */
static vtk_array *array_for(piece *p, const char *section, const char *name)
{
    cells *c = !strcmp(section, "Polys") ? &p->polygons : !strcmp(section, "Strips") ? &p->strips : NULL;
    if (!strcmp(section, "Points")) return &p->points;
    return !c ? NULL : !strcmp(name, "connectivity") ? &c->corner : !strcmp(name, "offsets") ? &c->offset : NULL;
}

static const char *read_space(const vtk_layout *of, const vtk_xml_tag *tag, polygons *out)
{
    vtk_array text = {0};
    const char *wrong = vtk_array_read(of, tag, &text);
    for (int64_t i = 0; !wrong && i < text.count && i < (int64_t)sizeof out->space - 1; i++) {
        double letter = vtk_array_at(&text, i);
        out->space[i] = letter >= 0 && letter < 128 ? (char)letter : '?';
    }
    free(text.bytes);
    return wrong;
}

/* DataArrays have children too. */
static bool is_section(const vtk_xml_tag *tag)
{
    static const char *const known[] = {"FieldData", "PointData", "CellData", "Points",
                                        "Verts",     "Lines",     "Strips",   "Polys"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (vtk_xml_is(tag, known[i])) return true;
    return false;
}

static const char *read_pieces(const vtk_layout *of, const char *text, polygons *out)
{
    char section[16] = "", name[32];
    piece p = {0};
    vtk_xml_tag tag;
    const char *at = text, *wrong = NULL, *end = of->appended ? of->appended : of->end;
    while (!wrong && vtk_xml_next(&at, end, &tag)) {
        bool array = vtk_xml_is(&tag, "DataArray") || vtk_xml_is(&tag, "Array");
        if (vtk_xml_is(&tag, "Piece") && tag.closes) {
            wrong = add_piece(&p, out);
            free_piece(&p);
        } else if (array && !tag.closes) {
            vtk_xml_attribute(&tag, "Name", name, sizeof name);
            vtk_array *into = array_for(&p, section, name);
            if (!strcmp(section, "FieldData") && !strcmp(name, "SPACE"))
                wrong = read_space(of, &tag, out);
            else if (into && into->bytes)
                wrong = "an array is there twice";
            else if (into)
                wrong = vtk_array_read(of, &tag, into);
            if (into && !wrong && into->type <= NUMBER_U8 && !strcmp(section, "Points")) wrong = "its points are bytes";
        } else if (is_section(&tag)) {
            snprintf(section, sizeof section, "%.*s", tag.closes ? 0 : (int)tag.length, tag.name);
        }
    }
    free_piece(&p);
    return wrong;
}

bool read_mesh_vtp(const char *path, polygons *out, err *e)
{
    char *bytes;
    size_t size;
    vtk_layout of;
    if (!input_file_load(path, INT64_MAX - 1, &bytes, &size, e)) return false;
    polygons p = polygons_new();
    const char *wrong = read_layout(bytes, bytes + size, &of);
    if (!wrong) wrong = read_pieces(&of, bytes, &p);
    free(bytes);
    if (!wrong) {
        *out = p;
        return true;
    }
    polygons_free(&p);
    return err_at(e, ERR_INPUT, path, 0, NULL, "is not a complete VTP file: %s", wrong);
}
