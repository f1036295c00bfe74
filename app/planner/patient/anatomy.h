/* anatomy: the surfaces of a case, read, repaired and cut. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "app/planner/store/task.h"
#include "geometry/clock.h"
#include "geometry/landmarks.h"
#include "geometry/osteotomy.h"
#include "geometry/repair.h"

typedef struct anatomy {
    landmarks points;
    head_frame frame;
    surface skin;            /* as read, LPS mm */
    surface closed_skin;     /* the same with its openings filled */
    surface skull, mandible; /* solid, teeth united with their jaw */
    segments segments;
    repair_report skin_repair, skull_repair, mandible_repair;
    cut_report cuts;
    issue_list warnings; /* of check_case, then of the cuts */
    clock_span check_span, repair_span, cut_span;
} anatomy;

/* Checks the case, reads and repairs skull and mandible and cuts them. `skin` false leaves the skin out. Asks watch,
 * which may be NULL, between its steps. Refuses what check_case_passes refuses before anything long. The caller frees
 * *out. */
bool anatomy_make(const case_file *c, bool skin, const task *watch, anatomy *out, err *e) MUST_CHECK;
void anatomy_free(anatomy *a);
