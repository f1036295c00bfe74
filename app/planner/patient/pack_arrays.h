/* pack_arrays: surfaces, tissue and embedding as arrays of a pack file, each under its name. What is taken is as long
 * as the counts say; whether its numbers are sound is asked of prepared_sound.h. */
#pragma once
#include "app/planner/store/pack_file.h"
#include "geometry/distance_field.h"
#include "geometry/tissue.h"

/* As pack_take; NULL too for more elements than four times which an int32_t can count. */
void *pack_take_array(const pack_file *f, const char *name, size_t element, int32_t *count);
char *pack_text(const pack_file *f, const char *name); /* NULL where it does not end; the caller frees */

/* NAME.xyz, NAME.tri and NAME.rgb; of the name 24 bytes count. */
void pack_put_surface(pack_file *f, const char *name, const surface *s);
bool pack_take_surface(const pack_file *f, const char *name, surface *s);
/* NAME.block, NAME.centre and NAME.value; of the name 24 bytes count. */
void pack_put_samples(pack_file *f, const char *name, const distance_samples *s);
bool pack_take_samples(const pack_file *f, const char *name, distance_samples *s);
/* node.*, tet.*, pair.* and lips */
void pack_put_tissue(pack_file *f, const tissue *t);
bool pack_take_tissue(const pack_file *f, tissue *t);
/* skin.tet and skin.weight */
void pack_put_skin(pack_file *f, const embedding *skin);
bool pack_take_skin(const pack_file *f, embedding *skin);
