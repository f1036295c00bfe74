/* The one file that includes libnifti2. NIfTI counts x to the right and y to the front: both change sign. */
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

static bool from_nifti(const nifti_image *n, const char *path, volume *v, err *e)
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
    const nifti_dmat44 *m = n->sform_code > 0 ? &n->sto_xyz : &n->qto_xyz;
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

bool read_volume_nifti(const char *path, volume *out, err *e)
{
    nifti_set_debug_level(0); /* it prints to stderr otherwise */
    nifti_image *n = nifti_image_read(path, 1);
    if (!n || !n->data) {
        if (n) nifti_image_free(n);
        return err_at(e, ERR_INPUT, path, 0, NULL, "is not a complete NIfTI file");
    }
    bool good = from_nifti(n, path, out, e);
    nifti_image_free(n);
    return good;
}
