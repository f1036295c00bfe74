/* The one file that includes teem. Segment keys as 3D Slicer writes them into .seg.nrrd. */
#include "geometry/mem.h"
#include "geometry/src/files/read_volume.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <teem/nrrd.h>

/* teem tells the whole chain of callers, outermost first; the last line is the reason. */
static bool refuse_teem(const char *path, err *e)
{
    char *chain = biffGetDone(NRRD), *reason = chain ? chain : (char *)"unknown reason";
    for (size_t n = chain ? strlen(chain) : 0; n && chain[n - 1] == '\n'; n--) chain[n - 1] = 0;
    char *last = strrchr(reason, '\n');
    err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read as NRRD: %s", last ? last + 1 : reason);
    free(chain);
    return false;
}

/* Signs that take the file's axes to LPS. */
static bool find_space(const Nrrd *n, const char *path, double sign[2], err *e)
{
    sign[0] = sign[1] = 1;
    if (n->spaceDim != 3 || n->space == nrrdSpaceUnknown)
        return err_at(e, ERR_INPUT, path, 0, "space",
                      "missing: the sides of the head are unknown (wanted: "
                      "left-posterior-superior)");
    if (n->space == nrrdSpaceRightAnteriorSuperior || n->space == nrrdSpaceLeftAnteriorSuperior) {
        sign[0] = n->space == nrrdSpaceRightAnteriorSuperior ? -1 : 1;
        sign[1] = -1;
    } else if (n->space != nrrdSpaceLeftPosteriorSuperior) {
        return err_at(e, ERR_INPUT, path, 0, "space",
                      "%s is not read; known are left-posterior-superior, "
                      "right-anterior-superior and left-anterior-superior",
                      airEnumStr(nrrdSpace, n->space));
    }
    for (int c = 0; c < 3; c++)
        if (n->spaceUnits[c] && *n->spaceUnits[c] && strcasecmp(n->spaceUnits[c], "mm") &&
            strcasecmp(n->spaceUnits[c], "millimeter"))
            return err_at(e, ERR_INPUT, path, 0, "space units", "must be mm, is \"%s\"", n->spaceUnits[c]);
    return true;
}

/* The number in key SegmentN_what; *found false if there is no such key. */
static bool read_key(const Nrrd *n, const char *path, int number, const char *what, int32_t *out, bool *found, err *e)
{
    char key[64], *end;
    snprintf(key, sizeof key, "Segment%d_%s", number, what);
    char *text = nrrdKeyValueGet(n, key);
    *found = text != NULL;
    if (!text) return true;
    long value = strtol(text, &end, 10);
    bool good = end != text && !*end && value >= 0 && value <= INT16_MAX;
    if (!good) err_at(e, ERR_INPUT, path, 0, key, "must be a whole number from 0 to %d, is \"%s\"", INT16_MAX, text);
    free(text);
    *out = (int32_t)value;
    return good;
}

/* Numbers of the segments that the file tells of, ascending, in a new array: they may begin anywhere and have gaps. */
static int *segment_numbers(const Nrrd *n, int *count)
{
    int *number = NULL;
    *count = 0;
    for (unsigned i = 0; i < nrrdKeyValueSize(n); i++) {
        char *key = NULL, *value = NULL, what[32] = "";
        int k = -1, end = 0;
        nrrdKeyValueIndex(n, &key, &value, i);
        bool named = key && sscanf(key, "Segment%d_%31[A-Za-z]%n", &k, what, &end) == 2 && !key[end] && k >= 0 &&
                     (!strcmp(what, "Name") || !strcmp(what, "LabelValue"));
        free(key);
        free(value);
        int at = 0;
        while (named && at < *count && number[at] < k) at++;
        if (!named || (at < *count && number[at] == k)) continue;
        number = GROW_ARRAY(int, number, *count + 1);
        memmove(number + at + 1, number + at, (size_t)(*count - at) * sizeof *number);
        number[at] = k;
        ++*count;
    }
    return number;
}

static bool read_segment(const Nrrd *n, const char *path, int number, volume *v, err *e)
{
    char key[64];
    bool found;
    volume_segment segment = {0};
    snprintf(key, sizeof key, "Segment%d_Name", number);
    char *name = nrrdKeyValueGet(n, key);
    size_t length = name ? strlen(name) : 0;
    memcpy(segment.name, name ? name : "", length < sizeof segment.name ? length : 0);
    free(name);
    if (!length || length >= sizeof segment.name)
        return err_at(e, ERR_INPUT, path, 0, key, "must have 1 to %zu bytes", sizeof segment.name - 1);
    if (!read_key(n, path, number, "LabelValue", &segment.label, &found, e)) return false;
    if (!found)
        return err_at(e, ERR_INPUT, path, 0, key, "has no label value; save it again with Slicer 4.11 or newer");
    if (!read_key(n, path, number, "Layer", &segment.layer, &found, e)) return false;
    if (segment.layer >= v->layers)
        return err_at(e, ERR_INPUT, path, 0, key, "is in layer %d of %d", segment.layer, v->layers);
    v->segment = GROW_ARRAY(volume_segment, v->segment, v->segment_count + 1);
    v->segment[v->segment_count++] = segment;
    return true;
}

static bool read_segments(const Nrrd *n, const char *path, volume *v, err *e)
{
    int count, *number = segment_numbers(n, &count);
    bool good = true;
    for (int i = 0; good && i < count; i++) good = read_segment(n, path, number[i], v, e);
    free(number);
    return good;
}

static bool from_nrrd(const Nrrd *n, const char *path, volume *v, err *e)
{
    unsigned first = n->dim == 4 ? 1 : 0; /* overlapping segments: layers come first, without a direction */
    double sign[2];
    if (n->dim != 3 && (n->dim != 4 || n->axis[0].kind != nrrdKindList))
        return err_at(e, ERR_INPUT, path, 0, "dimension", "%u-dimensional data that are not layers of a segmentation",
                      n->dim);
    if (!find_space(n, path, sign, e)) return false;
    for (unsigned a = 0; a < 3; a++)
        for (unsigned c = 0; c < 3; c++) {
            double step = n->axis[first + a].spaceDirection[c], origin = n->spaceOrigin[c];
            if (!isfinite(step)) return err_at(e, ERR_INPUT, path, 0, "space directions", "missing for axis %u", a);
            if (!isfinite(origin)) return err_at(e, ERR_INPUT, path, 0, "space origin", "missing");
            v->step[a][c] = c < 2 ? sign[c] * step : step;
            v->origin[c] = c < 2 ? sign[c] * origin : origin;
        }
    const int64_t size[3] = {(int64_t)n->axis[first].size, (int64_t)n->axis[first + 1].size,
                             (int64_t)n->axis[first + 2].size};
    int64_t layers = first ? (int64_t)n->axis[0].size : 1;
    if (!read_volume_allocate(path, size, layers, v, e)) return false;
    int64_t voxels = size[0] * size[1] * size[2];
    double (*look)(const void *, size_t) = nrrdDLookup[n->type];
    for (int64_t i = 0; i < voxels; i++)
        for (int64_t k = 0; k < layers; k++) {
            double number = look(n->data, (size_t)(i * layers + k));
            if (!read_volume_round(number, v->value + k * voxels + i))
                return err_at(e, ERR_INPUT, path, 0, NULL, "voxel %lld holds %g, which does not fit into 16 bits",
                              (long long)i, number);
        }
    return read_segments(n, path, v, e);
}

/* The bytes of voxels that a header promises, those of a text at least; -1: too many to count. */
static int64_t promised_bytes(const Nrrd *n, bool text)
{
    int64_t bytes = text ? 1 : (int64_t)nrrdElementSize(n);
    for (unsigned a = 0; a < n->dim; a++) {
        if (n->axis[a].size > (size_t)(INT64_MAX / bytes)) return -1;
        bytes *= (int64_t)n->axis[a].size;
    }
    return bytes;
}

/* teem makes room for what the header promises before it reads a voxel. */
static bool check_room(const char *path, err *e)
{
    Nrrd *n = nrrdNew();
    NrrdIoState *io = nrrdIoStateNew();
    io->skipData = AIR_TRUE;
    bool good = !nrrdLoad(n, path, io) || refuse_teem(path, e);
    if (good && n->type == nrrdTypeBlock) good = err_at(e, ERR_INPUT, path, 0, "type", "blocks are not read");
    if (good && (io->dataFNArr->len || io->dataFNFormat))
        good = err_at(e, ERR_INPUT, path, 0, "data file", "its voxels lie in another file: save both as one .nrrd");
    if (good) {
        int64_t bytes = promised_bytes(n, io->encoding == nrrdEncodingAscii);
        int64_t most = io->encoding == nrrdEncodingGzip    ? MOST_DEFLATED
                       : io->encoding == nrrdEncodingBzip2 ? 1 << 20
                                                           : 1;
        good = bytes < 0 ? err_at(e, ERR_INPUT, path, 0, "sizes", "are too large")
                         : read_volume_room(path, bytes, most, e);
    }
    nrrdIoStateNix(io);
    nrrdNuke(n);
    return good;
}

bool read_volume_nrrd(const char *path, volume *out, err *e)
{
    Nrrd *n = nrrdNew();
    bool good = check_room(path, e) && (nrrdLoad(n, path, NULL) ? refuse_teem(path, e) : from_nrrd(n, path, out, e));
    nrrdNuke(n);
    return good;
}
