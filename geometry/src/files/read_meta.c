/* MetaImage (.mha, .mhd) as ITK reads it: LPS mm, row a of TransformMatrix is the direction of axis a. */
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/inflate.h"
#include "geometry/src/files/number_type.h"
#include "geometry/src/files/read_volume.h"
#include "geometry/src/files/scan.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

enum { VALUE_MOST = 1024, HEADER_MOST = 1 << 16 };

typedef struct meta {
    const char *path;
    double size[3], spacing[3], origin[3], direction[9], skip;
    bool has_size, has_spacing, has_origin, has_direction, swap, packed;
    number_type type;
    char file[VALUE_MOST];
} meta;

/* "Key = value" for the next line; false at the end or where a line has no =. */
static bool next_line(scan *s, char key[64], char value[VALUE_MOST])
{
    const char *line = s->at, *sign;
    size_t n;
    scan_skip_line(s);
    sign = memchr(line, '=', (size_t)(s->at - line));
    if (!sign) return false;
    for (n = (size_t)(sign - line); n && scan_is_blank(line[n - 1]);) n--;
    snprintf(key, 64, "%.*s", (int)(n < 63 ? n : 63), line);
    for (sign++; sign < s->at && scan_is_blank(*sign);) sign++;
    for (n = (size_t)(s->at - sign); n && scan_is_blank(sign[n - 1]);) n--;
    snprintf(value, VALUE_MOST, "%.*s", (int)(n < VALUE_MOST - 1 ? n : VALUE_MOST - 1), sign);
    return true;
}

static bool is_one_of(const char *key, const char *a, const char *b, const char *c)
{
    return !strcmp(key, a) || !strcmp(key, b) || !strcmp(key, c);
}

static bool read_numbers(const meta *m, const char *key, const char *value, double *out, int count, bool *has, err *e)
{
    scan s = {value, value, value + strlen(value), 0};
    int n = 0;
    double more;
    while (n < count && scan_number(&s, out + n) && isfinite(out[n])) n++;
    if (n < count || scan_number(&s, &more))
        return err_at(e, ERR_INPUT, m->path, 0, key, "must be %d numbers, is \"%.60s\"", count, value);
    *has = true;
    return true;
}

static bool read_word(const char *value, bool *out)
{
    *out = !strcasecmp(value, "True") || !strcmp(value, "1");
    return *out || !strcasecmp(value, "False") || !strcmp(value, "0");
}

static bool read_type(meta *m, const char *value, err *e)
{
    static const char *const names[] = {"MET_CHAR", "MET_UCHAR",     "MET_SHORT",      "MET_USHORT", "MET_INT",
                                        "MET_UINT", "MET_LONG_LONG", "MET_ULONG_LONG", "MET_FLOAT",  "MET_DOUBLE"};
    for (int i = 0; i < NUMBER_UNKNOWN; i++)
        if (!strcmp(names[i], value)) m->type = (number_type)i;
    if (!strcmp(value, "MET_LONG")) m->type = NUMBER_I32;
    if (!strcmp(value, "MET_ULONG")) m->type = NUMBER_U32;
    return m->type != NUMBER_UNKNOWN ||
           err_at(e, ERR_INPUT, m->path, 0, "ElementType", "values of type %.40s are not read", value);
}

/* What must have one value to be read at all. */
static bool must_be(const meta *m, const char *key, const char *value, const char *wanted, err *e)
{
    return !strcasecmp(value, wanted) ||
           err_at(e, ERR_INPUT, m->path, 0, key, "must be %s, is \"%.40s\"", wanted, value);
}

static bool read_entry(meta *m, const char *key, const char *value, err *e)
{
    bool has;
    if (!strcmp(key, "ObjectType")) return must_be(m, key, value, "Image", e);
    if (!strcmp(key, "NDims")) return must_be(m, key, value, "3", e);
    if (!strcmp(key, "BinaryData")) return must_be(m, key, value, "True", e);
    if (!strcmp(key, "ElementNumberOfChannels")) return must_be(m, key, value, "1", e);
    if (!strcmp(key, "DistanceUnits")) return must_be(m, key, value, "mm", e);
    if (!strcmp(key, "ElementType")) return read_type(m, value, e);
    if (!strcmp(key, "DimSize")) return read_numbers(m, key, value, m->size, 3, &m->has_size, e);
    if (!strcmp(key, "HeaderSize")) return read_numbers(m, key, value, &m->skip, 1, &has, e);
    if (!strcmp(key, "ElementSpacing")) return read_numbers(m, key, value, m->spacing, 3, &m->has_spacing, e);
    if (is_one_of(key, "Offset", "Position", "Origin"))
        return read_numbers(m, key, value, m->origin, 3, &m->has_origin, e);
    if (is_one_of(key, "TransformMatrix", "Orientation", "Rotation"))
        return read_numbers(m, key, value, m->direction, 9, &m->has_direction, e);
    if (is_one_of(key, "BinaryDataByteOrderMSB", "ElementByteOrderMSB", "") && !read_word(value, &m->swap))
        return err_at(e, ERR_INPUT, m->path, 0, key, "must be True or False, is \"%.40s\"", value);
    if (!strcmp(key, "CompressedData") && !read_word(value, &m->packed))
        return err_at(e, ERR_INPUT, m->path, 0, key, "must be True or False, is \"%.40s\"", value);
    return true;
}

static bool read_header(meta *m, scan *s, err *e)
{
    char key[64], value[VALUE_MOST];
    *value = 0;
    while (s->at < s->end && s->at - s->start < HEADER_MOST && next_line(s, key, value)) {
        if (!strcmp(key, "ElementDataFile")) {
            memcpy(m->file, value, sizeof value);
            break;
        }
        if (!read_entry(m, key, value, e)) return false;
    }
    if (!*m->file)
        return err_at(e, ERR_INPUT, m->path, 0, NULL,
                      "is not a complete MetaImage: the line ElementDataFile is missing");
    if (!m->has_size || m->type == NUMBER_UNKNOWN)
        return err_at(e, ERR_INPUT, m->path, 0, m->has_size ? "ElementType" : "DimSize", "missing");
    if (!m->has_spacing || !m->has_origin)
        return err_at(e, ERR_INPUT, m->path, 0, m->has_spacing ? "Offset" : "ElementSpacing", "missing");
    if (!m->has_direction)
        return err_at(e, ERR_INPUT, m->path, 0, "TransformMatrix",
                      "missing: the sides of the head are unknown (wanted: \"1 0 0 0 1 0 0 0 1\" where the axes run to "
                      "the left, back and top)");
    return true;
}

static bool place(const meta *m, volume *v, int64_t size[3], err *e)
{
    for (int a = 0; a < 3; a++) {
        const double *row = m->direction + 3 * a;
        if (!(fabs(vec_norm(row) - 1) < 1e-3))
            return err_at(e, ERR_INPUT, m->path, 0, "TransformMatrix", "row %d has length %g, must be 1", a,
                          vec_norm(row));
        if (!(m->size[a] >= 1 && m->size[a] <= INT32_MAX) || floor(m->size[a]) != m->size[a])
            return err_at(e, ERR_INPUT, m->path, 0, "DimSize", "must be whole numbers from 1 on, is %g", m->size[a]);
        size[a] = (int64_t)m->size[a];
        for (int c = 0; c < 3; c++) v->step[a][c] = m->spacing[a] * row[c];
        v->origin[a] = m->origin[a];
    }
    return true;
}

/* The bytes of the voxels: in the file itself, or in the one beside it that it names. */
static bool open_data(const meta *m, scan *s, char **beside, err *e)
{
    char path[4096];
    const char *slash = strrchr(m->path, '/');
    size_t size;
    *beside = NULL;
    if (!strcasecmp(m->file, "LOCAL")) return true;
    if (!strncasecmp(m->file, "LIST", 4) || strchr(m->file, '%'))
        return err_at(e, ERR_INPUT, m->path, 0, "ElementDataFile",
                      "a file for each slice is not read; save it as .mha");
    int folder = slash && *m->file != '/' ? (int)(slash + 1 - m->path) : 0;
    if (snprintf(path, sizeof path, "%.*s%s", folder, m->path, m->file) >= (int)sizeof path)
        return err_at(e, ERR_INPUT, m->path, 0, "ElementDataFile", "the path is too long");
    if (!input_file_load(path, INT64_MAX - 1, beside, &size, e)) return false;
    *s = (scan){*beside, *beside, *beside + size, 0};
    return true;
}

static bool read_voxels(const meta *m, scan *s, const int64_t size[3], volume *v, err *e)
{
    double voxels = m->size[0] * m->size[1] * m->size[2], bytes = voxels * (double)number_size(m->type);
    size_t have = (size_t)(s->end - s->at);
    if (s->start == s->at && m->skip > 0) { /* of a file beside */
        if (!(m->skip < (double)have)) return err_at(e, ERR_INPUT, m->path, 0, "HeaderSize", "leaves no voxels");
        s->at += (size_t)m->skip;
        have -= (size_t)m->skip;
    }
    if (s->start == s->at && m->skip == -1 && !m->packed && (double)have > bytes) {
        s->at = s->end - (size_t)bytes;
        have = (size_t)bytes;
    }
    if (!(bytes < 0x1p50) || !(m->packed ? inflate_can_give(have, (size_t)bytes) : (size_t)bytes <= have))
        return err_at(e, ERR_INPUT, m->path, 0, NULL,
                      "is not a complete MetaImage: %g bytes of voxels do not fit into the %zu%s there are", bytes,
                      have, m->packed ? " compressed ones" : "");
    if (!read_volume_allocate(m->path, size, 1, v, e)) return false;
    size_t width = number_size(m->type), count = (size_t)voxels;
    char *plain = m->packed ? NEW_ARRAY(char, bytes) : NULL;
    bool good = !plain || inflate_bytes(s->at, have, plain, (size_t)bytes) ||
                err_at(e, ERR_INPUT, m->path, 0, NULL, "is not a complete MetaImage: its compressed voxels are broken");
    const char *from = plain ? plain : s->at;
    for (size_t i = 0; good && i < count; i++) {
        double number = number_at(from + i * width, m->type, m->swap);
        good = read_volume_round(number, v->value + i) ||
               err_at(e, ERR_INPUT, m->path, 0, NULL, "voxel %zu holds %g, which does not fit into 16 bits", i, number);
    }
    free(plain);
    return good;
}

bool read_volume_meta(const char *path, volume *out, err *e)
{
    char *bytes, *beside = NULL;
    size_t size;
    int64_t voxels[3];
    if (!input_file_load(path, INT64_MAX - 1, &bytes, &size, e)) return false;
    meta *m = NEW_ARRAY(meta, 1);
    *m = (meta){.path = path, .type = NUMBER_UNKNOWN};
    scan s = {bytes, bytes, bytes + size, 0};
    bool good = read_header(m, &s, e);
    m->swap = m->swap != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    good = good && place(m, out, voxels, e) && open_data(m, &s, &beside, e) && read_voxels(m, &s, voxels, out, e);
    free(m);
    free(beside);
    free(bytes);
    return good;
}
