/* fit_pictures: the fitted template beside the scan, and how far they are apart. Needs GNATHOS_RENDER. */
#pragma once
#include "app/planner/identity/head_fit.h"

typedef struct fit_pictures {
    const head_template *head;
    const head_fit *fit;
    const head_scan *scan;
    const char *title;
} fit_pictures;

/* The fitted skin coloured by its distance to the scan over 0 to range_mm, grey where it is guessed; from the
 * front and both sides; the same of bones and teeth. Refuses what gallery_open and gallery_write refuse. */
bool fit_residual_write(const fit_pictures *p, bool bones, double range_mm, const char *path, err *e) MUST_CHECK;
/* The scan's skin coloured by its distance to the fitted one the same way, grey where the template does not cover it.
 */
bool fit_scan_write(const fit_pictures *p, double range_mm, const char *path, err *e) MUST_CHECK;
/* Above the scan, below the fitted template: skin from the front and the left, bones and teeth the same. */
bool fit_beside_write(const fit_pictures *p, const char *path, err *e) MUST_CHECK;
