#include "geometry/src/files/gltf_sizes.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include <stdlib.h>
#include <string.h>

/* A whole number from 0 on; -1 for anything else, `absent` where the key is not there. */
static int64_t whole(const json_t *of, const char *key, int64_t absent)
{
    const json_t *v = json_object_get(of, key);
    if (!v) return absent;
    return json_is_integer(v) && json_integer_value(v) >= 0 ? (int64_t)json_integer_value(v) : -1;
}

static bool refuse(const char *path, const char *what, size_t i, err *e)
{
    return err_at(e, ERR_INPUT, path, 0, NULL, "%s %zu promises more than the file holds", what, i);
}

/* "%20" and its kin become bytes. */
static void unescape(const char *uri, char *to)
{
    unsigned byte;
    for (; *uri; uri++) {
        bool escaped = *uri == '%' && sscanf(uri + 1, "%2x", &byte) == 1 && byte;
        *to++ = escaped ? (char)byte : *uri;
        if (escaped) uri += 2;
    }
    *to = 0;
}

/* The bytes behind a uri: of the text itself, or of a file beside `path`; -1: refused. */
static int64_t uri_bytes(const char *path, const char *uri, err *e)
{
    const char *slash = strrchr(path, '/'), *comma = strchr(uri, ',');
    if (!strncmp(uri, "data:", 5)) return comma ? (int64_t)strlen(comma) * 3 / 4 : 0;
    size_t folder = slash ? (size_t)(slash - path) + 1 : 0, size = folder + strlen(uri) + 1;
    char *beside = NEW_ARRAY(char, size);
    snprintf(beside, size, "%.*s", (int)folder, path);
    unescape(uri, beside + folder);
    int64_t bytes = -1;
    FILE *in = input_file_open(beside, INT64_MAX, &bytes, e);
    if (in) fclose(in);
    free(beside);
    return in ? bytes : -1;
}

static bool check_buffers(const char *path, const json_t *buffers, int64_t file_size, err *e)
{
    for (size_t i = 0; i < json_array_size(buffers); i++) {
        const json_t *one = json_array_get(buffers, i);
        const char *uri = json_string_value(json_object_get(one, "uri"));
        int64_t there = uri ? uri_bytes(path, uri, e) : file_size, length = whole(one, "byteLength", -1);
        if (there < 0) return false;
        if (length < 0 || length > there) return refuse(path, "buffer", i, e);
    }
    return true;
}

static bool check_views(const char *path, const json_t *views, const json_t *buffers, err *e)
{
    for (size_t i = 0; i < json_array_size(views); i++) {
        const json_t *one = json_array_get(views, i);
        int64_t buffer = whole(one, "buffer", -1), from = whole(one, "byteOffset", 0);
        int64_t length = whole(one, "byteLength", -1);
        int64_t there = buffer < 0 ? -1 : whole(json_array_get(buffers, (size_t)buffer), "byteLength", -1);
        if (from < 0 || length < 0 || there < 0 || from > there || length > there - from)
            return refuse(path, "bufferView", i, e);
    }
    return true;
}

static int64_t component_bytes(int64_t type)
{
    switch (type) {
    case 5120: /* byte */
    case 5121: return 1;
    case 5122: /* short */
    case 5123: return 2;
    case 5125: /* unsigned int */
    case 5126: return 4;
    default: return 0;
    }
}

static int64_t components(const char *type)
{
    static const struct {
        const char *name;
        int count;
    } known[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    for (size_t i = 0; type && i < sizeof known / sizeof *known; i++)
        if (!strcmp(type, known[i].name)) return known[i].count;
    return 0;
}

/* Bytes of a view from `from` on that `count` items of `item` bytes need. */
static bool fits(const json_t *view, int64_t from, int64_t count, int64_t item)
{
    int64_t length = whole(view, "byteLength", -1), step = whole(view, "byteStride", item);
    if (!view || from < 0 || count < 1 || step < item || from > length || item > length - from) return false;
    return count - 1 <= (length - from - item) / step;
}

static bool check_accessors(const char *path, const json_t *accessors, const json_t *views, int64_t file_size, err *e)
{
    for (size_t i = 0; i < json_array_size(accessors); i++) {
        const json_t *one = json_array_get(accessors, i), *sparse = json_object_get(one, "sparse");
        int64_t view = whole(one, "bufferView", INT64_MAX), count = whole(one, "count", -1);
        int64_t item = component_bytes(whole(one, "componentType", -1)) *
                       components(json_string_value(json_object_get(one, "type")));
        if (view < 0 || count < 1 || !item || (view == INT64_MAX && count > file_size))
            return refuse(path, "accessor", i, e);
        if (view < INT64_MAX && !fits(json_array_get(views, (size_t)view), whole(one, "byteOffset", 0), count, item))
            return refuse(path, "accessor", i, e);
        if (sparse && (whole(sparse, "count", -1) < 0 || whole(sparse, "count", -1) > count))
            return refuse(path, "the sparse accessor", i, e);
    }
    return true;
}

bool gltf_sizes_check(const char *path, const json_t *root, int64_t file_size, err *e)
{
    const json_t *buffers = json_object_get(root, "buffers"), *views = json_object_get(root, "bufferViews");
    return check_buffers(path, buffers, file_size, e) && check_views(path, views, buffers, e) &&
           check_accessors(path, json_object_get(root, "accessors"), views, file_size, e);
}
