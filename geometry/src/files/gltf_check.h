/* gltf_check: what a glTF file says of itself, read before assimp sees it. Private. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>

/* Where path is FILE.glb#NODE or FILE.gltf#NODE, copies FILE and returns NODE, which points into path; else copies path
 * and returns NULL. */
const char *gltf_split(const char *path, char *file, size_t size);

/* Which nodes with a mesh, in the order of the scene's tree (a node before its children), are meant: those of the name
 * `node` and below, or the only one where node is NULL. The name of a node without one is its mesh's, else "node 3".
 * keep[count] is 1 for each; the caller frees it. Several primitives of a mesh are one surface.
 *
 * Refuses (ERR_INPUT): several meshes where none is named, with their names; a name that none bears; required
 * extensions that change the shape or are not known (Draco, meshopt, quantization); positions that are not floats;
 * morph targets that are switched on; glTF other than 2; a tree that is none. Source: Khronos glTF 2.0, 3.5, 3.7, 3.12,
 * 4.4. */
bool gltf_check(const char *path, const char *node, uint8_t **keep, int *count, err *e) MUST_CHECK;
