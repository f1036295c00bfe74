/* transform_file: rigid moves as transforms of ITK (.tfm, .h5, .mat), as 3D Slicer and ANTs read and write them.
 *
 * The file stores the resampling direction: a node that moves bone by A is stored as the inverse of A. Both
 * functions here speak of A, the motion of the bone, in LPS mm. */
#pragma once
#include "geometry/rigid.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Reads AffineTransform, MatrixOffsetTransformBase, Euler3DTransform, VersorRigid3DTransform (double or
 * float) from .tfm or .txt (text), .h5 or .hdf5 (HDF5) and .mat (MATLAB 4). Refuses (ERR_INPUT, with line) other types,
 * more than one transform, a non-rigid matrix. */
bool transform_read(const char *path, rigid *out, err *e) MUST_CHECK;
bool transform_write(const rigid *motion, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
