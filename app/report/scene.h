/* report_scene: what the page of an outcome is told: its record without names, and its shapes. */
#pragma once
#include "app/planner/predict/outcome_read.h"
#include "app/report/packed.h"

/* Refuses (ERR_INPUT) a record that lacks what the page shows: one of another version. */
bool report_record_check(const json_file *f, err *e) MUST_CHECK;

/* The outcome's record. Unless `names`, all free text of the user is left out: case, plan.name, plan.override,
 * landmarks with labels that gnathos does not know, and notes that name them; "withheld" lists what. */
json_t *report_record(const json_t *root, bool names);

/* What gnathos audit said of the outcome's plan or case, without the user's text unless `names`. Refuses (ERR_INPUT)
 * what is no audit, and one of another case or plan. The caller frees *out. */
bool report_audit(const json_file *audit, const json_t *outcome, bool names, json_t **out, err *e) MUST_CHECK;

/* The shapes in the order of "shapes", all triangles of each: positions (in steps of "step_mm"), for the skin its
 * displacement ("displacement_step_mm") and colours if "colours", then triangles; see packed.h and report/shapes.js. */
json_t *report_scene(const outcome_shapes *o, packed *out);
