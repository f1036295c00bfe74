/* norm_case: a norm head as a case folder, and the recipe it is made from. */
#pragma once
#include "norm_head.h"

/* Reads recipe.json: {"gnathos": 1, "sex": "f", "class": 3, "seed": 0, "open_bite_mm": 0, "asymmetry_mm": 0,
 * "coarseness": 1, "set": {"snb_deg": 84}}; what is absent keeps its default. Refuses (ERR_INPUT, with file
 * and line) other keys, wrong kinds, and what norm_head_params_check refuses. */
bool norm_case_read_recipe(const char *path, norm_head_params *out, err *e) MUST_CHECK;

/* Writes skin.ply, skull.ply, mandible.ply, upper_teeth.ply, lower_teeth.ply, landmarks.mrk.json, case.json,
 * measures.csv and (p not NULL) recipe.json into an existing folder; files of these names are replaced, others stay. */
bool norm_case_write(const norm_head *h, const norm_head_params *p, const char *folder, const char *name,
                     err *e) MUST_CHECK;
