/* ITK's rule: x' = M (x - c) + c + t, M row-major, LPS mm. */
#include "geometry/src/files/stored_transform.h"
#include "geometry/vec.h"
#include <string.h>

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

stored_transform stored_transform_new(void)
{
    return (stored_transform){.type = -1, .parameter_count = -1, .fixed_count = -1};
}

bool stored_transform_type(stored_transform *s, const char *name, const char *path, int line, err *e)
{
    if (s->type >= 0) return err_at(e, ERR_INPUT, path, line, "Transform", "a second transform; one per file is read");
    for (int i = 0; i < KNOWN; i++) {
        size_t n = strlen(known[i].name);
        if (strncmp(name, known[i].name, n) || name[n] != '_') continue;
        if (strcmp(name + n, "_double_3_3") && strcmp(name + n, "_float_3_3")) continue;
        s->type = i;
        return true;
    }
    return err_at(e, ERR_INPUT, path, line, "Transform",
                  "%.64s is not read; harden it into a rigid AffineTransform_double_3_3 and save it as Text (.tfm)",
                  name);
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

bool stored_transform_motion(const stored_transform *s, const char *path, rigid *out, err *e)
{
    if (s->type < 0) return err_at(e, ERR_INPUT, path, 0, NULL, "holds no transform");
    if (s->parameter_count < 0) return err_at(e, ERR_INPUT, path, 0, "Parameters", "missing");
    if (s->fixed_count < 0) return err_at(e, ERR_INPUT, path, 0, "FixedParameters", "missing");
    if (s->parameter_count != known[s->type].parameters || s->fixed_count < known[s->type].fixed_least ||
        s->fixed_count > known[s->type].fixed_most)
        return err_at(e, ERR_INPUT, path, s->parameter_line, NULL,
                      "%s has %d parameters and %d fixed ones, must be %d and %d", known[s->type].name,
                      s->parameter_count, s->fixed_count, known[s->type].parameters, known[s->type].fixed_least);
    for (int i = 0; i < STORED_NUMBERS_MOST; i++)
        if ((i < s->parameter_count && !isfinite(s->parameter[i])) || (i < s->fixed_count && !isfinite(s->fixed[i])))
            return err_at(e, ERR_INPUT, path, s->parameter_line, NULL, "has a number that is not finite");
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
    rigid resampling;
    if (!rigid_from_matrix(matrix, &resampling, &why))
        return err_at(e, ERR_INPUT, path, s->parameter_line, "Parameters", "%s", why.text);
    *out = rigid_inverse(&resampling);
    return true;
}
