/* gltf_sizes: what the accessors, views and buffers of a glTF file promise, held against each other and against the
 * bytes that are there. assimp takes room for a false count, and reads zeros where an accessor names no data. */
#pragma once
#include "geometry/err.h"
#include "geometry/json_file.h"

/* file_size: bytes of the whole file `path`, of which `root` is the JSON. Buffers may lie in it (.glb), in the JSON
 * (data:) or in files beside it. Refuses (ERR_INPUT) the first that does not fit. */
bool gltf_sizes_check(const char *path, const json_t *root, int64_t file_size, err *e) MUST_CHECK;
