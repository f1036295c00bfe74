/* The one file that includes libnifti2. NIfTI counts x to the right and y to the front: both change sign. */
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/read_volume.h"
#include <math.h>
#include <nifti2_io.h>

static double number_at(const nifti_image *n, int64_t i)
{
    switch (n->datatype) {
    case DT_UINT8: return ((const uint8_t *)n->data)[i];
    case DT_INT8: return ((const int8_t *)n->data)[i];
    case DT_UINT16: return ((const uint16_t *)n->data)[i];
    case DT_INT16: return ((const int16_t *)n->data)[i];
    case DT_UINT32: return ((const uint32_t *)n->data)[i];
    case DT_INT32: return ((const int32_t *)n->data)[i];
    case DT_FLOAT32: return (double)((const float *)n->data)[i];
    case DT_FLOAT64: return ((const double *)n->data)[i];
    default: return (double)NAN; /* not reached: known_type */
    }
}

static bool known_type(int type)
{
    return type == DT_UINT8 || type == DT_INT8 || type == DT_UINT16 || type == DT_INT16 || type == DT_UINT32 ||
           type == DT_INT32 || type == DT_FLOAT32 || type == DT_FLOAT64;
}

static double length_of(const nifti_dmat44 *m, int axis)
{
    return hypot(hypot(m->m[0][axis], m->m[1][axis]), m->m[2][axis]);
}

static double handed(const nifti_dmat44 *a)
{
    const double(*m)[4] = a->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The farthest that the two forms place a corner apart, in the file's unit; 0 where rounding explains it. The
 * quaternion is stored without its first part, as floats: near half a turn that costs angle, but neither place nor
 * length. */
static double forms_apart(const nifti_image *n, double least)
{
    const nifti_dmat44 *s = &n->sto_xyz, *q = &n->qto_xyz;
    const int64_t size[3] = {n->nx, n->ny, n->nz};
    double first = 1 - n->quatern_b * n->quatern_b - n->quatern_c * n->quatern_c - n->quatern_d * n->quatern_d;
    double lost = 2e-7, turn = 2 * (first > lost ? lost / (2 * sqrt(first)) : sqrt(lost)), worst = 0, reach = 0;
    bool apart = false;
    for (int a = 0; a < 3; a++) {
        double extent = (double)(size[a] - 1);
        apart |= fabs(length_of(s, a) - length_of(q, a)) * extent > least;
        reach = hypot(reach, length_of(s, a) * extent);
    }
    for (int corner = 0; corner < 8; corner++) {
        double d[3];
        for (int c = 0; c < 3; c++) {
            d[c] = s->m[c][3] - q->m[c][3];
            for (int a = 0; a < 3; a++)
                if (corner >> a & 1) d[c] += (s->m[c][a] - q->m[c][a]) * (double)(size[a] - 1);
        }
        double far = hypot(hypot(d[0], d[1]), d[2]);
        if (!(far <= worst)) worst = far;
        apart |= !(far <= (corner ? least + turn * reach : least));
    }
    return apart ? worst : 0;
}

/* sform or qform; NULL: refused. */
static const nifti_dmat44 *choose_form(const nifti_image *n, const char *path, double mm, volume_form form, err *e)
{
    if (n->sform_code <= 0) return &n->qto_xyz;
    if (n->qform_code <= 0 || form == VOLUME_FORM_SFORM) return &n->sto_xyz;
    if (form == VOLUME_FORM_QFORM) return &n->qto_xyz;
    double apart = forms_apart(n, 0.01 / mm) * mm;
    if (apart == 0) return &n->sto_xyz;
    bool mirrored = handed(&n->sto_xyz) * handed(&n->qto_xyz) < 0;
    (void)err_at(e, ERR_INPUT, path, 0, NULL,
                 "its sform (code %d) and its qform (code %d) place a corner %.3g mm apart%s; say which is right with "
                 "--nifti-form sform or --nifti-form qform",
                 n->sform_code, n->qform_code, apart, mirrored ? ", one a mirror image of the other" : "");
    return NULL;
}

static bool from_nifti(const nifti_image *n, const char *path, volume_form form, volume *v, err *e)
{
    if (n->nt > 1 || n->nu > 1 || n->nv > 1 || n->nw > 1)
        return err_at(e, ERR_INPUT, path, 0, NULL, "more than three dimensions");
    if (!known_type(n->datatype))
        return err_at(e, ERR_INPUT, path, 0, NULL, "values of type %s are not read",
                      nifti_datatype_string(n->datatype));
    if (n->sform_code <= 0 && n->qform_code <= 0)
        return err_at(e, ERR_INPUT, path, 0, NULL,
                      "has neither sform nor qform: place and sides of the head are unknown");
    double mm = n->xyz_units == NIFTI_UNITS_METER ? 1000 : n->xyz_units == NIFTI_UNITS_MICRON ? 1e-3 : 1;
    const nifti_dmat44 *m = choose_form(n, path, mm, form, e);
    if (!m) return false;
    for (int c = 0; c < 3; c++) {
        double scale = c < 2 ? -mm : mm;
        for (int a = 0; a < 3; a++) v->step[a][c] = scale * m->m[c][a];
        v->origin[c] = scale * m->m[c][3];
    }
    const int64_t size[3] = {n->nx, n->ny, n->nz};
    if (!read_volume_allocate(path, size, 1, v, e)) return false;
    bool scaled = n->scl_slope != 0 && isfinite(n->scl_slope) && isfinite(n->scl_inter);
    int64_t voxels = size[0] * size[1] * size[2];
    for (int64_t i = 0; i < voxels; i++) {
        double number = number_at(n, i);
        if (scaled) number = n->scl_slope * number + n->scl_inter;
        if (!read_volume_round(number, v->value + i))
            return err_at(e, ERR_INPUT, path, 0, NULL, "voxel %lld holds %g, which does not fit into 16 bits",
                          (long long)i, number);
    }
    return true;
}

bool read_volume_nifti(const char *path, volume_form form, volume *out, err *e)
{
    nifti_set_debug_level(0); /* it prints to stderr otherwise */
    nifti_image *n = nifti_image_read(path, 0);
    bool whole = n && n->nvox > 0 && n->nbyper > 0 && n->nvox <= INT64_MAX / n->nbyper;
    bool good =
        !whole || read_volume_room(path, n->nvox * n->nbyper, file_name_ends(path, ".gz") ? MOST_DEFLATED : 1, e);
    whole = whole && good && !nifti_image_load(n) && n->data;
    if (good && !whole) good = err_at(e, ERR_INPUT, path, 0, NULL, "is not a complete NIfTI file");
    good = good && from_nifti(n, path, form, out, e);
    if (n) nifti_image_free(n);
    return good;
}
