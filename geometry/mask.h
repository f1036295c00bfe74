/* mask: one yes or no per voxel of a volume, and the few operations that make a solid of it. */
#pragma once
#include "geometry/volume_file.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct mask {
    int32_t size[3]; /* as of the volume, i fastest */
    uint8_t *on;     /* [size0*size1*size2] 0 or 1 */
} mask;

mask mask_new(const int32_t size[3]); /* all off */
void mask_free(mask *m);
int64_t mask_voxels(const mask *m);
int64_t mask_count(const mask *m); /* voxels that are on */

/* Adds the voxels of the label in the layer. */
void mask_add_label(mask *m, const volume *v, int32_t label, int32_t layer);
/* Voxels of layer 0 above the value. */
void mask_add_above(mask *m, const volume *v, double value);

/* Turns off components (26 neighbours) of fewer than `least` voxels; returns how many, *voxels what they
 * held. */
int32_t mask_drop_islands(mask *m, int64_t least, int64_t *voxels);
/* Keeps the largest component (6 neighbours; of equals the first); returns how many others there were. */
int32_t mask_keep_largest(mask *m);
/* Turns on what is enclosed: off voxels that no path of off voxels (6 neighbours) joins with the border of
 * the volume. Returns how many. */
int64_t mask_fill_cavities(mask *m);
/* Turns on every off voxel that a ball of radius_mm, rolling in from the sides of the volume, cannot reach:
 * narrow openings are sealed with all that lies behind them. The ball starts at the faces across which the
 * head does not go on: those whose axis is not mainly up and down (LPS z). */
void mask_seal(mask *m, const volume *grid, double radius_mm);
/* Pairs of neighbouring voxels (6), one on in a, the other on in b: where two bones touch. */
int64_t mask_contacts(const mask *a, const mask *b);
/* First and last index of on voxels along each axis; false if there are none. */
bool mask_bounds(const mask *m, int32_t low[3], int32_t high[3]);

#ifdef __cplusplus
}
#endif
