/* anatomy: the surfaces of a case, read, repaired and cut. */
#pragma once
#include "app/case_file.h"
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
} anatomy;

typedef void anatomy_progress(const char *stage, double fraction, void *context);

/* Reads and repairs skull and mandible and cuts them. `skin` false leaves the skin out. progress may be NULL.
 * The caller frees *out. */
bool anatomy_make(const case_file *c, bool skin, anatomy_progress *progress, void *context, anatomy *out,
                  err *e) MUST_CHECK;
void anatomy_free(anatomy *a);
