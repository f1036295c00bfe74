/* ITK's text transforms (itkTxtTransformIO): x' = M (x - c) + c + t, M row-major, LPS mm. */
#include "geometry/transform_file.h"
#include "geometry/input_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NUMBERS = 16 };

typedef enum transform_kind { KIND_AFFINE, KIND_EULER, KIND_VERSOR } transform_kind;

static const struct {
    const char *name;
    transform_kind kind;
    int parameters, fixed_least, fixed_most;
} known[] = {{"AffineTransform", KIND_AFFINE, 12, 3, 3},
             {"MatrixOffsetTransformBase", KIND_AFFINE, 12, 3, 3},
             {"Euler3DTransform", KIND_EULER, 6, 3, 4}, /* 4th: 1 for the order Z Y X */
             {"VersorRigid3DTransform", KIND_VERSOR, 6, 3, 3}};
enum { KNOWN = sizeof known / sizeof *known };

typedef struct stored {
    int type; /* index into known */
    int type_line, parameter_line;
    int parameter_count, fixed_count; /* -1: not seen */
    double parameter[MAX_NUMBERS], fixed[MAX_NUMBERS];
} stored;

static bool read_numbers(const char *text, const char *path, int line, const char *key, double *out, int *count, err *e)
{
    if (*count >= 0) return err_at(e, ERR_INPUT, path, line, key, "is there twice; one transform per file is read");
    int n = 0;
    for (;;) {
        text += strspn(text, " \t\r\n");
        if (!*text) break;
        char *end;
        double value = strtod(text, &end);
        if (end == text || !isfinite(value))
            return err_at(e, ERR_INPUT, path, line, key, "\"%.20s\" is not a finite number", text);
        if (n == MAX_NUMBERS) return err_at(e, ERR_INPUT, path, line, key, "too many numbers");
        out[n++] = value;
        text = end;
    }
    *count = n;
    return true;
}

static bool read_type(char *text, const char *path, int line, stored *s, err *e)
{
    if (s->type >= 0) return err_at(e, ERR_INPUT, path, line, "Transform", "a second transform; one per file is read");
    text[strcspn(text, " \t\r\n")] = 0;
    for (int i = 0; i < KNOWN; i++) {
        size_t n = strlen(known[i].name);
        if (strncmp(text, known[i].name, n) || text[n] != '_') continue;
        if (strcmp(text + n, "_double_3_3") && strcmp(text + n, "_float_3_3")) continue;
        s->type = i;
        s->type_line = line;
        return true;
    }
    return err_at(e, ERR_INPUT, path, line, "Transform",
                  "%s is not read; harden it into a rigid AffineTransform_double_3_3 and save it as Text (.tfm)", text);
}

static bool read_line(char *text, const char *path, int line, stored *s, err *e)
{
    text += strspn(text, " \t\r\n");
    if (!*text || *text == '#') return true;
    char *colon = strchr(text, ':');
    if (!colon) return err_at(e, ERR_INPUT, path, line, NULL, "must be \"name: value\"");
    char *value = colon + 1 + strspn(colon + 1, " \t");
    *colon = 0;
    if (!strcmp(text, "Transform")) return read_type(value, path, line, s, e);
    if (s->type < 0) return err_at(e, ERR_INPUT, path, line, NULL, "\"Transform:\" must come first");
    if (!strcmp(text, "Parameters")) {
        s->parameter_line = line;
        return read_numbers(value, path, line, text, s->parameter, &s->parameter_count, e);
    }
    if (!strcmp(text, "FixedParameters")) return read_numbers(value, path, line, text, s->fixed, &s->fixed_count, e);
    return err_at(e, ERR_INPUT, path, line, NULL, "unknown entry \"%.40s\"", text);
}

static void multiply(const double a[9], const double b[9], double out[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

/* M of three angles: Rz Rx Ry, or Rz Ry Rx (itkEuler3DTransform). */
static void euler_matrix(const double angle[3], bool zyx, double m[9])
{
    double c[3], s[3], left[9];
    for (int i = 0; i < 3; i++) {
        c[i] = cos(angle[i]);
        s[i] = sin(angle[i]);
    }
    const double x[9] = {1, 0, 0, 0, c[0], -s[0], 0, s[0], c[0]}, y[9] = {c[1], 0, s[1], 0, 1, 0, -s[1], 0, c[1]},
                 z[9] = {c[2], -s[2], 0, s[2], c[2], 0, 0, 0, 1};
    multiply(z, zyx ? y : x, left);
    multiply(left, zyx ? x : y, m);
}

/* The unit quaternion whose vector part is v. False if |v| > 1. */
static bool versor_matrix(const double v[3], double m[9])
{
    double square = vec_dot(v, v);
    if (!(square <= 1 + 1e-9)) return false;
    double w = square < 1 ? sqrt(1 - square) : 0, x = v[0], y = v[1], z = v[2];
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    memcpy(m, r, sizeof r);
    return true;
}

/* The transform as stored: points of the moved bone to points of the bone before. */
static bool stored_transform(const stored *s, const char *path, rigid *out, err *e)
{
    if (s->type < 0) return err_at(e, ERR_INPUT, path, 0, NULL, "holds no transform");
    if (s->parameter_count < 0)
        return err_at(e, ERR_INPUT, path, s->type_line, NULL, "the line \"Parameters:\" is missing");
    if (s->fixed_count < 0)
        return err_at(e, ERR_INPUT, path, s->type_line, NULL, "the line \"FixedParameters:\" is missing");
    if (s->parameter_count != known[s->type].parameters || s->fixed_count < known[s->type].fixed_least ||
        s->fixed_count > known[s->type].fixed_most)
        return err_at(e, ERR_INPUT, path, s->parameter_line, NULL,
                      "%s has %d parameters and %d fixed ones, must be %d and %d", known[s->type].name,
                      s->parameter_count, s->fixed_count, known[s->type].parameters, known[s->type].fixed_least);
    double m[9], moved[3], matrix[16] = {0};
    const double *t = s->parameter + (known[s->type].kind == KIND_AFFINE ? 9 : 3);
    if (known[s->type].kind == KIND_AFFINE) memcpy(m, s->parameter, sizeof m);
    if (known[s->type].kind == KIND_EULER) euler_matrix(s->parameter, s->fixed_count == 4 && s->fixed[3] != 0, m);
    if (known[s->type].kind == KIND_VERSOR && !versor_matrix(s->parameter, m))
        return err_at(e, ERR_INPUT, path, s->parameter_line, NULL, "the versor is longer than 1");
    mat_apply(m, s->fixed, moved);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) matrix[4 * i + j] = m[3 * i + j];
        matrix[4 * i + 3] = t[i] + s->fixed[i] - moved[i];
    }
    matrix[15] = 1;
    err why = {0};
    if (!rigid_from_matrix(matrix, out, &why))
        return err_at(e, ERR_INPUT, path, s->parameter_line, "Parameters", "%s", why.text);
    return true;
}

bool transform_read(const char *path, rigid *out, err *e)
{
    if (file_name_ends(path, ".h5") || file_name_ends(path, ".hdf5"))
        return err_at(e, ERR_INPUT, path, 0, NULL, "HDF5 transforms are not read; save it as Text (.tfm)");
    if (!file_name_ends(path, ".tfm") && !file_name_ends(path, ".txt"))
        return err_at(e, ERR_INPUT, path, 0, NULL, "unknown kind of transform file; read are .tfm and .txt");
    FILE *in = input_file_open_text(path, e);
    if (!in) return false;
    stored s = {.type = -1, .parameter_count = -1, .fixed_count = -1};
    char *text = NULL;
    size_t size = 0;
    bool good = true;
    for (int line = 1; good && getline(&text, &size, in) >= 0; line++) {
        if (line == 1 && strncmp(text, "#Insight Transform File", 23))
            good = err_at(e, ERR_INPUT, path, 1, NULL,
                          "not a text transform: must begin with \"#Insight Transform File\"");
        else
            good = read_line(text, path, line, &s, e);
    }
    if (good && ferror(in)) good = err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read: %s", strerror(errno));
    free(text);
    fclose(in);
    rigid resampling;
    if (!good || !stored_transform(&s, path, &resampling, e)) return false;
    *out = rigid_inverse(&resampling);
    return true;
}

bool transform_write(const rigid *motion, const char *path, err *e)
{
    if (!file_name_ends(path, ".tfm")) return err_at(e, ERR_USAGE, path, 0, NULL, "transforms are written as .tfm");
    rigid a = rigid_inverse(motion);
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    fprintf(w.stream, "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters:");
    for (int i = 0; i < 9; i++) fprintf(w.stream, " %.17g", a.r[i]);
    for (int i = 0; i < 3; i++) fprintf(w.stream, " %.17g", a.t[i]);
    fprintf(w.stream, "\nFixedParameters: 0 0 0\n");
    return whole_file_close(&w, e);
}
