/* Transforms as ITK (and ANTs) write .mat: two matrices of MATLAB 4, one named as the type, one "fixed". */
#include "geometry/input_file.h"
#include "geometry/src/files/number_type.h"
#include "geometry/src/files/stored_transform.h"
#include <stdlib.h>
#include <string.h>

enum { FILE_MOST = 1 << 20, HEAD = 20, NAME_MOST = 64 };

typedef struct matrix {
    char name[NAME_MOST];
    int count;
    double number[STORED_NUMBERS_MOST];
} matrix;

/* Type (thousands: byte order; tens: 0 double, 1 float), rows, columns, whether complex, length of the name with its 0.
 * NULL, or what is wrong. */
static const char *read_matrix(const char **at, const char *end, matrix *out)
{
    double head[5];
    bool swap = false;
    if (end - *at < HEAD) return "a matrix is not whole";
    double type = number_at(*at, NUMBER_I32, false);
    if (!(type >= 0 && type < 5000)) swap = true;
    for (int i = 0; i < 5; i++) head[i] = number_at(*at + 4 * i, NUMBER_I32, swap);
    int kind = head[0] >= 0 && head[0] < 5000 ? (int)head[0] % 1000 : -1; /* hundreds: rows first */
    if (kind != 0 && kind != 10 && kind != 100 && kind != 110) return "a matrix is not of doubles or floats";
    if (head[3] != 0) return "a matrix is complex";
    if (!(head[1] >= 0 && head[2] >= 0 && head[1] * head[2] <= STORED_NUMBERS_MOST))
        return "a matrix has more numbers than a rigid transform";
    if (!(head[4] >= 1 && head[4] <= NAME_MOST)) return "a matrix has no name";
    number_type stored = kind % 100 ? NUMBER_F32 : NUMBER_F64;
    size_t name = (size_t)head[4], count = (size_t)(head[1] * head[2]), bytes = count * number_size(stored);
    if ((size_t)(end - *at - HEAD) < name + bytes) return "a matrix is not whole";
    memcpy(out->name, *at + HEAD, name);
    out->name[name - 1] = 0;
    out->count = (int)count;
    for (size_t i = 0; i < count; i++)
        out->number[i] = number_at(*at + HEAD + name + i * number_size(stored), stored, swap);
    *at += HEAD + name + bytes;
    return NULL;
}

static bool read_matrices(const char *path, const char *at, const char *end, stored_transform *s, err *e)
{
    matrix m;
    if (end - at > 7 && !memcmp(at, "MATLAB ", 7))
        return err_at(e, ERR_INPUT, path, 0, NULL,
                      "is a file of MATLAB 5 or newer; transforms are MATLAB 4 files as ITK writes them");
    while (at < end) {
        const char *wrong = read_matrix(&at, end, &m);
        if (wrong) return err_at(e, ERR_INPUT, path, 0, NULL, "is not a transform of ITK: %s", wrong);
        bool fixed = !strcmp(m.name, "fixed");
        if (!fixed && !stored_transform_type(s, m.name, path, 0, e)) return false;
        if (fixed && s->fixed_count >= 0) return err_at(e, ERR_INPUT, path, 0, "fixed", "is there twice");
        memcpy(fixed ? s->fixed : s->parameter, m.number, sizeof m.number);
        *(fixed ? &s->fixed_count : &s->parameter_count) = m.count;
    }
    return true;
}

bool read_transform_mat(const char *path, stored_transform *out, err *e)
{
    char *bytes;
    size_t size;
    if (!input_file_load(path, FILE_MOST, &bytes, &size, e)) return false;
    stored_transform s = stored_transform_new();
    bool good = read_matrices(path, bytes, bytes + size, &s, e);
    free(bytes);
    if (good) *out = s;
    return good;
}
