/* compose: several pictures on one sheet with a title. */
#pragma once
#include "render/image.h"
#include "render/label.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct compose_tile {
    const image *picture;
    const char *caption; /* written at the top left of the tile; may be NULL */
} compose_tile;

typedef struct compose_params {
    int columns;
    int gap;                       /* pixels between tiles */
    double font_size;              /* of captions; the title is larger */
    int sheet_width, sheet_height; /* pixels of the whole; 0: as the tiles need */
    const char *title;             /* NULL: no strip */
    const char *subtitle;          /* right end of the title strip, e.g. the plan; may be NULL */
    label_fonts fonts;
} compose_params;

compose_params compose_params_default(void); /* 2 columns, 6 pixels, 22 */
/* The size of each of `count` tiles that fills a sheet of the given size; below 1 where there is no room. */
void compose_tile_size(int count, const compose_params *params, int *width, int *height);
/* Rows from the top left. All pictures have the same size. *out is created; the caller frees it. Refuses
 * (ERR_USAGE) pictures of different sizes and a sheet over IMAGE_SIZE_MAX. */
bool compose_sheet(const compose_tile *tiles, int count, const compose_params *params, image *out, err *e) MUST_CHECK;
int compose_title_height(const compose_params *params); /* pixels of the title strip */

#ifdef __cplusplus
}
#endif
