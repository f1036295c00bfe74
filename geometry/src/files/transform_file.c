#include "geometry/transform_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/stored_transform.h"
#include "geometry/write_whole.h"

bool transform_read(const char *path, rigid *out, err *e)
{
    stored_transform s;
    bool text = file_name_ends(path, ".tfm") || file_name_ends(path, ".txt"), mat = file_name_ends(path, ".mat");
    if (!text && !mat && !file_name_ends(path, ".h5") && !file_name_ends(path, ".hdf5"))
        return file_name_refuse(path, "transform", ".tfm .txt .h5 .hdf5 .mat", "", e);
    bool good = text  ? read_transform_text(path, &s, e)
                : mat ? read_transform_mat(path, &s, e)
                      : read_transform_h5(path, &s, e);
    return good && stored_transform_motion(&s, path, out, e);
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
