/* head_case: a head that was made, as a case of its own: surfaces, landmarks and case.json, as every verb takes them.
 */
#pragma once
#include "app/planner/identity/head.h"
#include "app/planner/store/task.h"

/* skin.ply ... lower_teeth.ply, landmarks.mrk.json and case.json into an existing folder. guessed: NULL or what of it
 * is, which the case says. */
bool head_case_write(const head_template *t, const head_shape *s, const case_guess *guessed, const char *folder,
                     const char *name, err *e) MUST_CHECK;
/* What gnathos check says of it, in the folder: refuses its first error, adds what is doubtful to `warnings`. */
bool head_case_passes(const char *folder, const task *watch, issue_list *warnings, err *e) MUST_CHECK;
