/* fit_write: a fitted head as files. */
#pragma once
#include "app/planner/identity/fit_record.h"
#include "app/planner/store/output_dir.h"

/* PART.ply (coloured by the distance to the scan over 0 to range_mm, grey where it is guessed), PART.vtp with the
 * arrays distance_mm (NaN: no scan there) and guessed (head_guess), tissue.vtu at neutral with the way to rest and J
 * against the template, scan_PART.vtp with the scan's distance_mm to the fitted part (NaN: not covered), fit.pack, and
 * case/, a case of its own. */
bool fit_write_files(const fit_record *r, const char *case_name, double range_mm, const output_dir *d,
                     err *e) MUST_CHECK;
