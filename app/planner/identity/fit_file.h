/* fit_file: a fitted head as one file: a pack with a checksum at its end.
 *
 *     numbering           text    of the template whose numbering it has
 *     PART.xyz            double  [3*vertices] of skin, skull, mandible, upper_teeth, lower_teeth; LPS mm
 *     PART.gap, PART.guessed      [vertices] double mm (NaN: no target there), uint8_t
 *     node.rest, node.neutral     double [3*nodes] of the tissue
 *     numbers             double  place, gaps and costs in the order of fit_file.c
 */
#pragma once
#include "app/planner/identity/head_fit.h"

bool head_fit_write(const head_template *t, const head_fit *f, const char *path, err *e) MUST_CHECK;
/* Refuses (ERR_INPUT) what is no whole fit, a fit of a template with another numbering, counts that are not those of
 * the template, coordinates that are not finite. The caller frees *out. */
bool head_fit_read(const head_template *t, const char *path, head_fit *out, err *e) MUST_CHECK;
