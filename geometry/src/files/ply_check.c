#include "geometry/src/files/ply_check.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 4096, ELEMENTS_MOST = 16, PROPERTIES_MOST = 64, NAME_SIZE = 32 };

typedef struct property {
    char name[NAME_SIZE];
    int size, count_size; /* bytes of a value, and of a list's count: 0 where it is no list */
    bool real;            /* float or double */
} property;

typedef struct element {
    char name[NAME_SIZE];
    long long count;
    int properties;
    property property[PROPERTIES_MOST];
} element;

typedef enum ply_format { ASCII, LITTLE, BIG } ply_format;

typedef struct header {
    const char *path;
    FILE *in;
    int64_t left; /* bytes behind the header that nothing is known of yet */
    int line, elements;
    ply_format format;
    element element[ELEMENTS_MOST];
} header;

static bool refuse(const header *h, const char *what, err *e)
{
    return err_at(e, ERR_INPUT, h->path, h->line, NULL, "is not a PLY file that is read: %s", what);
}

static bool find_type(const char *word, property *p)
{
    static const struct {
        const char *name, *other;
        int size;
        bool real;
    } known[] = {{"char", "int8", 1, false},     {"uchar", "uint8", 1, false},  {"short", "int16", 2, false},
                 {"ushort", "uint16", 2, false}, {"int", "int32", 4, false},    {"uint", "uint32", 4, false},
                 {"float", "float32", 4, true},  {"double", "float64", 8, true}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(word, known[i].name) || !strcmp(word, known[i].other)) {
            p->size = known[i].size;
            p->real = known[i].real;
            return true;
        }
    return false;
}

static const property *find_property(const element *el, const char *name)
{
    for (int i = 0; i < el->properties; i++)
        if (!strcmp(el->property[i].name, name)) return el->property + i;
    return NULL;
}

static bool add_element(header *h, const char *line, err *e)
{
    char name[NAME_SIZE], digits[NAME_SIZE], rest;
    if (sscanf(line, " element %31s %31s %c", name, digits, &rest) != 2 || strlen(digits) > 18 ||
        strspn(digits, "0123456789") != strlen(digits))
        return refuse(h, "an element has a name and a count", e);
    if (h->elements == ELEMENTS_MOST) return refuse(h, "too many elements", e);
    for (int i = 0; i < h->elements; i++)
        if (!strcmp(h->element[i].name, name)) return refuse(h, "an element is there twice", e);
    element *el = h->element + h->elements++;
    *el = (element){.count = atoll(digits)};
    strcpy(el->name, name);
    return true;
}

static bool add_property(header *h, const char *line, err *e)
{
    char word[4][NAME_SIZE], rest;
    int n = sscanf(line, " property %31s %31s %31s %31s %c", word[0], word[1], word[2], word[3], &rest);
    property p = {0}, count = {0};
    bool list = n > 0 && !strcmp(word[0], "list");
    if (!h->elements) return refuse(h, "a property stands before every element", e);
    if (n != (list ? 4 : 2)) return refuse(h, "a property has a type and a name, or list, two types and a name", e);
    if (list && (!find_type(word[1], &count) || count.real))
        return refuse(h, "the count of a list is no whole number", e);
    if (!find_type(word[list ? 2 : 0], &p)) return refuse(h, "the type of a property is unknown", e);
    element *el = h->element + h->elements - 1;
    strcpy(p.name, word[list ? 3 : 1]);
    p.count_size = count.size;
    if (find_property(el, p.name)) return refuse(h, "an element has a property twice", e);
    if (el->properties == PROPERTIES_MOST) return refuse(h, "an element has too many properties", e);
    el->property[el->properties++] = p;
    return true;
}

static bool read_header(header *h, err *e)
{
    char line[LINE_SIZE], format[NAME_SIZE], keyword[NAME_SIZE];
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (bool good = true; good;) {
        if (!fgets(line, sizeof line, h->in)) return refuse(h, "the header has no end_header", e);
        h->line++;
        size_t n = strlen(line);
        if (n == 0 || line[n - 1] != '\n') return refuse(h, "the header has no end_header", e);
        while (n && (line[n - 1] == '\n' || line[n - 1] == '\r')) line[--n] = 0;
        if (sscanf(line, "%31s", keyword) != 1) return refuse(h, "a line of the header is empty", e);
        if (h->line == 1) {
            if (strcmp(keyword, "ply") != 0) return refuse(h, "it does not begin with ply", e);
        } else if (h->line == 2) {
            int known = -1;
            for (int i = 0; i < 3 && sscanf(line, " format %31s 1.0", format) == 1; i++)
                if (!strcmp(format, formats[i])) known = i;
            if (known < 0) return refuse(h, "the second line names no known format", e);
            h->format = (ply_format)known;
        } else if (!strcmp(keyword, "element")) {
            good = add_element(h, line, e);
        } else if (!strcmp(keyword, "property")) {
            good = add_property(h, line, e);
        } else if (!strcmp(keyword, "end_header")) {
            h->left -= ftell(h->in);
            return true;
        } else if (strcmp(keyword, "comment") != 0 && strcmp(keyword, "obj_info") != 0) {
            return refuse(h, "a line of the header begins with an unknown word", e);
        }
    }
    return false;
}

static const element *find_element(const header *h, const char *name)
{
    for (int i = 0; i < h->elements; i++)
        if (!strcmp(h->element[i].name, name)) return h->element + i;
    return NULL;
}

static bool check_names(const header *h, err *e)
{
    static const char *const axis[] = {"x", "y", "z"};
    const element *vertex = find_element(h, "vertex"), *face = find_element(h, "face");
    if (!face) face = find_element(h, "faces");
    if (!vertex || !face) return refuse(h, "it has no elements vertex and face", e);
    for (int c = 0; c < 3; c++) {
        const property *p = find_property(vertex, axis[c]);
        if (!p || !p->real || p->count_size) return refuse(h, "x, y and z of a vertex must be float or double", e);
    }
    const property *list = find_property(face, "vertex_indices");
    if (!list) list = find_property(face, "vertex_index");
    if (!list || !list->count_size || list->real || list->size != 4)
        return refuse(h, "a face needs the list vertex_indices of int or uint", e);
    return true;
}

/* Bytes of a row at least: a number of a text has a digit and a blank. */
static int64_t row_bytes(const header *h, const element *el)
{
    int64_t bytes = 0;
    for (int i = 0; i < el->properties; i++) {
        const property *p = el->property + i;
        bytes += h->format == ASCII ? 2 : p->count_size ? p->count_size : p->size;
    }
    return bytes ? bytes : 1;
}

static bool check_counts(header *h, err *e)
{
    int64_t room = h->left + 1; /* the last number of a text may end the file */
    for (int i = 0; i < h->elements; i++) {
        const element *el = h->element + i;
        int64_t row = row_bytes(h, el);
        if (el->count > room / row)
            return err_at(e, ERR_INPUT, h->path, 0, NULL,
                          "is not a complete PLY file: it promises %lld of the element %s, but ends after %lld bytes",
                          el->count, el->name, (long long)h->left);
        room -= el->count * row;
    }
    return true;
}

static bool read_count(const header *h, int size, uint64_t *count)
{
    unsigned char b[4];
    if (h->format == ASCII) {
        long long value;
        bool good = fscanf(h->in, "%lld", &value) == 1 && value >= 0;
        *count = good ? (uint64_t)value : 0;
        return good;
    }
    if (fread(b, 1, (size_t)size, h->in) != (size_t)size) return false;
    *count = 0;
    for (int i = 0; i < size; i++) *count = *count << 8 | b[h->format == BIG ? i : size - 1 - i];
    return true;
}

static bool skip(const header *h, uint64_t values, int size)
{
    if (h->format != ASCII) return !values || !fseek(h->in, (long)(values * (uint64_t)size), SEEK_CUR);
    for (; values; values--)
        if (fscanf(h->in, "%*s") == EOF) return false;
    return true;
}

/* Lists whose counts have more than a byte can promise gigabytes: their rows are walked. */
static bool check_lists(const header *h, int64_t size, err *e)
{
    for (int i = 0; i < h->elements; i++) {
        const element *el = h->element + i;
        for (long long row = 0; row < el->count; row++)
            for (int k = 0; k < el->properties; k++) {
                const property *p = el->property + k;
                uint64_t values = 1;
                bool good = !p->count_size || read_count(h, p->count_size, &values);
                uint64_t bytes = h->format == ASCII ? 2 : (uint64_t)p->size;
                good = good && values <= (uint64_t)(size - ftell(h->in) + 1) / bytes && skip(h, values, p->size);
                if (!good)
                    return err_at(e, ERR_INPUT, h->path, 0, NULL,
                                  "is not a complete PLY file: %s %lld does not end in the file", el->name, row);
            }
    }
    return true;
}

bool ply_check(const char *path, err *e)
{
    header *h = NEW_ARRAY(header, 1);
    int64_t size;
    h->in = input_file_open(path, INT64_MAX, &size, e);
    bool good = h->in != NULL, wide = false;
    h->path = path;
    h->left = good ? size : 0;
    good = good && read_header(h, e) && check_names(h, e) && check_counts(h, e);
    for (int i = 0; good && i < h->elements; i++)
        for (int k = 0; k < h->element[i].properties; k++) wide = wide || h->element[i].property[k].count_size > 1;
    good = good && (!wide || check_lists(h, size, e));
    if (h->in) fclose(h->in);
    free(h);
    return good;
}
