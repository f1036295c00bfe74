/* prepared_sound: whether what was read from a file can be a prepared case at all. A file may be damaged, edited or of
 * another program, with a right checksum; nothing in it is used as an index before it was looked at. */
#pragma once
#include "app/planner/patient/prepared.h"

/* Every index in range, every number finite, every label ended, counts that belong together equal. Arrays are as long
 * as their counts say. */
bool prepared_is_sound(const prepared *p);

/* The same of its parts, for other files. */
bool all_finite(const double *x, int64_t count);
bool all_within(const int32_t *n, int64_t count, int32_t low, int32_t end); /* low <= n < end */
bool surface_is_sound(const surface *s);
/* bones: tied and sliding nodes hang on those that are there; NULL: on any. */
bool tissue_is_sound(const tissue *t, const segments *bones);
bool embedding_is_sound(const embedding *m, int32_t points, int32_t tets);
