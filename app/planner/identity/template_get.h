/* template_get: the template that this gnathos works with: found, or made once and kept. */
#pragma once
#include "app/planner/identity/template_file.h"
#include "app/planner/store/task.h"

typedef enum template_place { TEMPLATE_NAMED, TEMPLATE_INSTALLED, TEMPLATE_CACHED } template_place;

typedef struct template_source {
    char path[FIELD_PATH_SIZE];
    template_place place;
    bool made;             /* now, and kept there */
    double made_s, open_s; /* wall; made_s 0 where it was found */
} template_source;

extern const double
    head_template_coarseness; /* of its parts: norm heads as coarse (norm_head.h) have their numbering */

/* The file that GNATHOS_TEMPLATE names; without it template-VERSION.pack in the installed data, else in
 * $XDG_CACHE_HOME/gnathos or ~/.cache/gnathos. One that is not there is made, about a minute, and kept under its name
 * in one step: several processes at once do no harm. A cached one that is damaged or not of this version is made anew;
 * others are refused. source may be NULL. Refuses what head_template_read and head_template_make refuse, (ERR_RESOURCE)
 * a folder that cannot be written, (ERR_GEOMETRY) a machine on which the mesher numbers otherwise. The caller frees
 * *out. */
bool head_template_get(const task *watch, head_template *out, template_source *source, err *e) MUST_CHECK;
