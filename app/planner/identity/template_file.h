/* template_file: a template as one file: a pack (app/planner/store/pack_file.h) with a checksum at its end.
 *
 *     version       int32     of the numbering
 *     numbering     text      hash of every whole number in the file: what hangs together with what
 *     PART.xyz      double    [3*vertices] of skin, skull, mandible, upper_teeth, lower_teeth; LPS mm
 *     PART.tri      int32     [3*triangles]
 *     PART.tooth    int32     [vertices] of the teeth: number of its tooth, from 0
 *     node.*, tet.*, pair.*, lips   the tissue at neutral (app/planner/patient/pack_arrays.h, geometry/tissue.h)
 *     node.rest     double    [3*nodes] the same at rest
 *     skin.tet, skin.weight   where the skin's vertices hang in it (geometry/embed.h)
 *     points        head_point, as in head.h
 */
#pragma once
#include "app/planner/identity/head.h"

enum { HEAD_TEMPLATE_VERSION = 1 };
/* Of version 1. A change of what makes the template, or of what meshes it, changes it: then there is a new version. */
extern const char head_template_numbering[HASH_TEXT_SIZE];

/* Fills version, numbering and hash. */
void head_template_seal(head_template *t);
bool head_template_write(const head_template *t, const char *path, err *e) MUST_CHECK;
/* Refuses (ERR_INPUT) what is not a whole template, another version, another numbering than that of the version, an
 * index out of range. The caller frees *out. */
bool head_template_read(const char *path, head_template *out, err *e) MUST_CHECK;
