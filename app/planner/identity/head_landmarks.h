/* head_landmarks: the landmarks of a patient, carried there by a fitted template and then moved to where the patient's
 * own surfaces have what their definitions ask for. */
#pragma once
#include "app/planner/identity/head_fit.h"

typedef struct head_landmark {
    char label[LANDMARK_LABEL_SIZE];
    case_surface on;        /* CASE_SURFACE_COUNT: inside the head */
    double at[3], doubt_mm; /* about how far off it may be: from all that follows */
    double moved_mm;        /* from where the template carried it, by its definition */
    double spread_mm;       /* of where it ends, carried 2 mm to each side */
    double gap_mm;      /* between fitted template and patient within 12 mm of it; NAN: the scan has nothing there */
    bool by_definition; /* false: no definition on a surface, or not found: the nearest place, or as carried */
} head_landmark;

typedef struct head_landmarks {
    int32_t count;
    head_landmark *item;
    bool mouth_open; /* Stms and Stmi, no Stm */
} head_landmarks;

/* On the scan that the fit is of. Refuses what head_frame_from_landmarks refuses: a head that is turned. The caller
 * frees *out. */
bool head_landmarks_find(const head_template *t, const head_scan *s, const head_fit *f, head_landmarks *out,
                         err *e) MUST_CHECK;
void head_landmarks_free(head_landmarks *l);
/* With their doubts; the caller frees. */
landmarks head_landmarks_points(const head_landmarks *l);

/* Finds or makes the template, fits it without asking the scan's own landmarks, and finds. Refuses what the steps
 * refuse, and (ERR_GEOMETRY) a head in other axes, with what would mend it. */
bool head_landmarks_place(const head_scan *s, const task *watch, head_landmarks *out, err *e) MUST_CHECK;
