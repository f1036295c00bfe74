/* volume_file: label maps and CT on a regular grid, from NRRD (.nrrd, .seg.nrrd; teem), NIfTI (.nii,
 * .nii.gz) and MetaImage (.mha, .mhd with its file of voxels beside it). */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct volume_segment { /* a named label of a segmentation file; choose by name, numbers change on
                                   saving */
    char name[64];
    int32_t label, layer;
} volume_segment;

typedef struct volume {
    int32_t size[3];   /* voxels along i, j, k (i fastest) */
    int32_t layers;    /* 1, or the number of overlapping layers of a .seg.nrrd */
    double origin[3];  /* centre of voxel 0, LPS mm */
    double step[3][3]; /* step[a]: LPS mm vector from one voxel to the next along axis a */
    int16_t *value;    /* [layers*size0*size1*size2] layer slowest: label or HU */
    int32_t segment_count;
    volume_segment *segment;
} volume;

/* By which of NIfTI's two forms a volume is placed, where they disagree. */
typedef enum volume_form { VOLUME_FORM_EITHER, VOLUME_FORM_SFORM, VOLUME_FORM_QFORM } volume_form;

void volume_free(volume *v);
/* Numbers are rounded to whole ones (after NIfTI's slope and intercept). RAS and LAS files are turned to LPS.
 * Refuses (ERR_INPUT, with file and field) unknown extensions, unknown or missing space, units other than mm
 * (NIfTI's other lengths are converted), sheared or degenerate axes, values beyond 16 bits, truncated files.
 * The caller frees *out. */
bool volume_read(const char *path, volume *out, err *e) MUST_CHECK;
/* The same; a NIfTI file with an sform and a qform that lie more than 0.01 mm apart somewhere is read by `form` and
 * refused by volume_read. A file with one of them is read by that. */
bool volume_read_by(const char *path, volume_form form, volume *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
