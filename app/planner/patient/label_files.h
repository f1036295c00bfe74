/* label_files: one segmentation from several files of one grid, as tools write them that save each structure apart. */
#pragma once
#include "geometry/volume_file.h"

/* One file is read as it is. Of several each becomes a segment that bears the file's name without folder and ending;
 * a file that names its segments brings these. Structures that overlap lie in layers. Refuses (ERR_INPUT, with the
 * file) what volume_read_by refuses, a grid more than 0.01 mm off that of the first file, and a file of several labels
 * without names. The caller frees *out. */
bool label_files_read(const char *const *path, int count, volume_form form, volume *out, err *e) MUST_CHECK;
