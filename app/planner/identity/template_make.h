/* template_make: a template from a case: its surfaces as they are, its tissue meshed, its landmarks hung. */
#pragma once
#include "app/planner/identity/head.h"
#include "app/planner/store/task.h"

/* The case is a whole head with its teeth apart from the bones; the template lies in its Frankfort frame. Hashes and
 * version are left to head_template_seal. Refuses what anatomy_make and tissue_make refuse; (ERR_NOT_CONVERGED) lips
 * that cannot be brought one into the other, (ERR_GEOMETRY) only with a tet turned inside out. The caller frees *out.
 */
bool head_template_make(const case_file *c, const task *watch, head_template *out, err *e) MUST_CHECK;
