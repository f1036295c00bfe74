/* read_volume: one function per format. Private. All fill size, layers, origin, step (LPS mm),
 * value and segments of *out, which the caller frees, and leave the checks of the grid to volume_file. */
#pragma once
#include "geometry/volume_file.h"

bool read_volume_nrrd(const char *path, volume *out, err *e) MUST_CHECK;                    /* teem */
bool read_volume_nifti(const char *path, volume_form form, volume *out, err *e) MUST_CHECK; /* libnifti2 */
bool read_volume_meta(const char *path, volume *out, err *e) MUST_CHECK;                    /* .mha, .mhd */

/* The three sizes in range and few enough voxels; allocates value. */
bool read_volume_allocate(const char *path, const int64_t size[3], int64_t layers, volume *out, err *e) MUST_CHECK;
/* Refuses (ERR_INPUT) a file too small for `bytes` of voxels, of which `most` can lie in one byte of the file. */
bool read_volume_room(const char *path, int64_t bytes, int64_t most, err *e) MUST_CHECK;
enum { MOST_DEFLATED = 1032 }; /* bytes that one byte of a deflated file can stand for (zlib's technical details) */
/* Rounds a stored number to 16 bits; false if it does not fit or is not finite. */
bool read_volume_round(double number, int16_t *out);
