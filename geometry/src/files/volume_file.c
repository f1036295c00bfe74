#include "geometry/volume_file.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/read_volume.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const int64_t most_voxels = INT32_MAX;

void volume_free(volume *v)
{
    free(v->value);
    free(v->segment);
    *v = (volume){0};
}

bool read_volume_allocate(const char *path, const int64_t size[3], int64_t layers, volume *out, err *e)
{
    int64_t voxels = layers;
    for (int a = 0; a < 3; a++) {
        if (size[a] < 1 || size[a] > most_voxels / voxels)
            return err_at(e, ERR_INPUT, path, 0, NULL,
                          "has %lld x %lld x %lld voxels in %lld layers; 1 to %lld are read", (long long)size[0],
                          (long long)size[1], (long long)size[2], (long long)layers, (long long)most_voxels);
        voxels *= size[a];
        out->size[a] = (int32_t)size[a];
    }
    out->layers = (int32_t)layers;
    out->value = NEW_ARRAY(int16_t, voxels);
    return true;
}

bool read_volume_room(const char *path, int64_t bytes, int64_t most, err *e)
{
    int64_t size = 0;
    FILE *in = input_file_open(path, INT64_MAX, &size, e);
    if (!in) return false;
    fclose(in);
    return bytes / most <= size ||
           err_at(e, ERR_INPUT, path, 0, NULL,
                  "is not complete: its header promises %lld bytes of voxels, the file has %lld "
                  "bytes%s",
                  (long long)bytes, (long long)size, most > 1 ? ", compressed" : "");
}

bool read_volume_round(double number, int16_t *out)
{
    double nearest = floor(number + 0.5);
    if (!(nearest >= INT16_MIN && nearest <= INT16_MAX)) return false;
    *out = (int16_t)nearest;
    return true;
}

static bool check_grid(const volume *v, const char *path, err *e)
{
    const double least_mm = 1e-3, most_mm = 100, most_cosine = 1e-3; /* 0.06 degrees: headers round their numbers */
    for (int a = 0; a < 3; a++) {
        double length = vec_norm(v->step[a]);
        if (!isfinite(v->origin[a])) return err_at(e, ERR_INPUT, path, 0, NULL, "the place of voxel 0 is not finite");
        if (!(length >= least_mm && length <= most_mm))
            return err_at(e, ERR_INPUT, path, 0, NULL, "voxels along axis %d are %g mm apart, must be %g to %g", a,
                          length, least_mm, most_mm);
    }
    for (int a = 0; a < 3; a++) {
        const double *x = v->step[a], *y = v->step[(a + 1) % 3];
        double cosine = vec_dot(x, y) / (vec_norm(x) * vec_norm(y));
        if (!(fabs(cosine) <= most_cosine))
            return err_at(e, ERR_INPUT, path, 0, NULL,
                          "axes %d and %d are not at right angles (cosine %.4f; gantry tilt?): resample the volume", a,
                          (a + 1) % 3, cosine);
    }
    return true;
}

bool volume_read(const char *path, volume *out, err *e) { return volume_read_by(path, VOLUME_FORM_EITHER, out, e); }

bool volume_read_by(const char *path, volume_form form, volume *out, err *e)
{
    bool nrrd = file_name_ends(path, ".nrrd"), nifti = file_name_ends(path, ".nii") || file_name_ends(path, ".nii.gz");
    bool meta = file_name_ends(path, ".mha") || file_name_ends(path, ".mhd");
    volume v = {0};
    if (!nrrd && !nifti && !meta)
        return file_name_refuse(path, "volume", ".nrrd .seg.nrrd .nii .nii.gz .mha .mhd",
                                " (DICOM: convert with dcm2niix)", e);
    if (!input_file_check(path, INT64_MAX, e)) return false;
    bool good = nrrd   ? read_volume_nrrd(path, &v, e)
                : meta ? read_volume_meta(path, &v, e)
                       : read_volume_nifti(path, form, &v, e);
    if (!good || !check_grid(&v, path, e)) {
        volume_free(&v);
        return false;
    }
    *out = v;
    return true;
}
