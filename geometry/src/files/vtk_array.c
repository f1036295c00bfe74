#include "geometry/src/files/vtk_array.h"
#include "geometry/mem.h"
#include "geometry/src/files/inflate.h"
#include "geometry/src/files/scan.h"

bool vtk_xml_next(const char **at, const char *end, vtk_xml_tag *tag)
{
    const char *from = memchr(*at, '<', (size_t)(end - *at)),
               *to = from ? memchr(from, '>', (size_t)(end - from)) : NULL;
    if (!to) return false;
    *tag = (vtk_xml_tag){.name = from + 1, .end = to, .after = to + 1};
    if (*tag->name == '/') {
        tag->closes = true;
        tag->name++;
    }
    while (tag->name + tag->length < to && !scan_is_blank(tag->name[tag->length]) && tag->name[tag->length] != '/')
        tag->length++;
    *at = tag->after;
    return true;
}

bool vtk_xml_is(const vtk_xml_tag *tag, const char *name)
{
    return strlen(name) == tag->length && !memcmp(name, tag->name, tag->length);
}

void vtk_xml_attribute(const vtk_xml_tag *tag, const char *key, char *value, size_t size)
{
    size_t n = strlen(key);
    *value = 0;
    for (const char *at = tag->name + tag->length; at + n + 2 < tag->end; at++) {
        if (!scan_is_blank(at[0]) || memcmp(at + 1, key, n) || at[1 + n] != '=' || at[2 + n] != '"') continue;
        const char *from = at + n + 3, *to = memchr(from, '"', (size_t)(tag->end - from));
        if (!to || (size_t)(to - from) >= size) return;
        memcpy(value, from, (size_t)(to - from));
        value[to - from] = 0;
        return;
    }
}

typedef struct source {
    const char *at, *end;
    bool base64;
} source;

static size_t stored_size(const source *s, size_t n) { return s->base64 ? (n + 2) / 3 * 4 : n; }

static bool can_take(const source *s, size_t n)
{
    size_t left = (size_t)(s->end - s->at);
    return n <= left && stored_size(s, n) <= left;
}

static int six_bits(char c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
           : c == '='             ? 0
                                  : -1;
}

/* n bytes without moving on. */
static bool peek(const source *s, void *out, size_t n)
{
    if (!can_take(s, n)) return false;
    if (!s->base64) {
        memcpy(out, s->at, n);
        return true;
    }
    for (size_t i = 0; i < n; i += 3) {
        int32_t word = 0;
        for (size_t k = 0; k < 4; k++) {
            int bits = six_bits(s->at[i / 3 * 4 + k]);
            if (bits < 0) return false;
            word = word << 6 | bits;
        }
        for (size_t k = 0; k < 3 && i + k < n; k++) ((uint8_t *)out)[i + k] = (uint8_t)(word >> (16 - 8 * (int)k));
    }
    return true;
}

/* The next n bytes in memory of their own; NULL: not there. */
static char *take(source *s, size_t n)
{
    if (!can_take(s, n)) return NULL;
    char *bytes = NEW_ARRAY(char, n);
    if (!peek(s, bytes, n)) {
        free(bytes);
        return NULL;
    }
    s->at += stored_size(s, n);
    return bytes;
}

static uint64_t word_at(const vtk_layout *of, const char *words, size_t i)
{
    number_type type = of->wide ? NUMBER_U64 : NUMBER_U32;
    double word = number_at(words + i * number_size(type), type, of->swap);
    return word < 0x1p52 ? (uint64_t)word : UINT64_C(1) << 52;
}

/* A length, and that many bytes in the same code. */
static char *read_plain(const vtk_layout *of, source *s, size_t *size)
{
    size_t head = of->wide ? 8 : 4;
    char word[8];
    if (!peek(s, word, head)) return NULL;
    *size = (size_t)word_at(of, word, 0);
    char *all = take(s, head + *size);
    if (all) memmove(all, all + head, *size);
    return all;
}

/* Number of blocks, size of a block, of the last one (0: whole), sizes of the compressed blocks; then the blocks. */
static char *read_zlib(const vtk_layout *of, source *s, size_t *size)
{
    size_t head = of->wide ? 8 : 4, packed_size = 0, done = 0, left = (size_t)(s->end - s->at);
    char word[8];
    *size = 0;
    if (!peek(s, word, head)) return NULL;
    size_t blocks = (size_t)word_at(of, word, 0);
    if (!blocks) return NEW_ARRAY(char, 0);
    if (blocks > left / head) return NULL;
    char *words = take(s, (3 + blocks) * head);
    if (!words) return NULL;
    size_t whole = (size_t)word_at(of, words, 1), last = (size_t)word_at(of, words, 2);
    for (size_t i = 0; i < blocks && packed_size <= left; i++) packed_size += (size_t)word_at(of, words, 3 + i);
    double total = (double)(blocks - (last > 0)) * (double)whole + (double)last;
    bool good = packed_size <= left && total < 0x1p52 && inflate_can_give(packed_size, (size_t)total);
    *size = good ? (size_t)total : 0;
    char *packed = good ? take(s, packed_size) : NULL;
    char *bytes = packed ? NEW_ARRAY(char, *size) : NULL;
    good = packed != NULL;
    for (size_t i = 0, at = 0; good && i < blocks; i++) {
        size_t n = (size_t)word_at(of, words, 3 + i), into = i + 1 == blocks && last ? last : whole;
        good = inflate_bytes(packed + at, n, bytes + done, into);
        at += n;
        done += into;
    }
    free(words);
    free(packed);
    if (good) return bytes;
    free(bytes);
    return NULL;
}

static const char *read_text(scan s, vtk_array *out)
{
    size_t room = 0;
    double *number = NULL;
    while (scan_skip_blank(&s)) {
        if ((size_t)out->count == room) number = GROW_ARRAY(double, number, room = 2 * room + 8);
        if (scan_number(&s, number + out->count)) {
            out->count++;
            continue;
        }
        free(number);
        return "a number is broken";
    }
    *out = (vtk_array){NUMBER_F64, false, number ? (char *)number : NEW_ARRAY(char, 0), out->count};
    return NULL;
}

static number_type type_named(const char *name)
{
    static const char *const names[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                        "UInt32", "Int64", "UInt64", "Float32", "Float64"};
    for (int i = 0; i < NUMBER_UNKNOWN; i++)
        if (!strcmp(names[i], name)) return (number_type)i;
    return strcmp(name, "String") ? NUMBER_UNKNOWN : NUMBER_U8;
}

const char *vtk_array_read(const vtk_layout *of, const vtk_xml_tag *tag, vtk_array *out)
{
    char type[16], format[16], offset[24], *end;
    vtk_xml_attribute(tag, "type", type, sizeof type);
    vtk_xml_attribute(tag, "format", format, sizeof format);
    vtk_xml_attribute(tag, "offset", offset, sizeof offset);
    vtk_array a = {type_named(type), of->swap, NULL, 0};
    if (a.type == NUMBER_UNKNOWN) return "an array is of an unknown type";
    const char *next = memchr(tag->after, '<', (size_t)(of->end - tag->after));
    source s = {tag->after, next ? next : of->end, true};
    if (!strcmp(format, "ascii")) {
        /* a copy, because a scan ends at a byte 0 */
        char *text = NEW_ARRAY(char, s.end - s.at + 1);
        memcpy(text, s.at, (size_t)(s.end - s.at));
        const char *wrong = read_text((scan){text, text, text + (s.end - s.at), 0}, &a);
        free(text);
        if (!wrong) *out = a;
        return wrong;
    }
    if (!strcmp(format, "appended")) {
        unsigned long long at = strtoull(offset, &end, 10);
        if (!of->appended || end == offset || at > (size_t)(of->end - of->appended)) return "an array lies outside";
        s = (source){of->appended + at, of->end, of->base64};
    } else if (strcmp(format, "binary")) {
        return "an array is of an unknown format";
    }
    while (s.base64 && s.at < s.end && scan_is_blank(*s.at)) s.at++;
    size_t size = 0;
    a.bytes = of->zlib ? read_zlib(of, &s, &size) : read_plain(of, &s, &size);
    if (!a.bytes) return "an array is not whole";
    a.count = (int64_t)(size / number_size(a.type));
    *out = a;
    return NULL;
}
