/* dicom_file: a CT as a folder of DICOM slices. What places the slices is checked here; the voxels are read by
 * dcm2niix, where it is installed. */
#pragma once
#include "geometry/volume_file.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct dicom_series {
    int32_t slices;
    double spacing_mm; /* from slice to slice */
} dicom_series;

/* Reads the headers of all slices in the folder (not below it). Refuses (ERR_INPUT, with the file) a folder without
 * slices or with several series, slices without a place or of other directions, a gantry that was tilted, slices that
 * are missing, doubled or unevenly spaced, signed voxels in fewer bits than their words (dcm2niix misreads them),
 * encodings that are not read (big endian, deflated). */
bool dicom_check(const char *folder, dicom_series *out, err *e) MUST_CHECK;
/* dicom_check, then the volume. Refuses (ERR_RESOURCE) where dcm2niix is not installed, (ERR_INPUT) what it cannot make
 * one volume of. The caller frees *out. */
bool dicom_read(const char *folder, volume *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
