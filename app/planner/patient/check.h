/* check: what is wrong with a case, told by `gnathos check`, and asked by everything that prepares one. Each part adds
 * issues and what it found to `found`. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "app/planner/store/task.h"
#include "geometry/landmarks.h"
#include "geometry/nearest.h"
#include "geometry/json_file.h"

typedef struct check_found {
    surface mesh[CASE_SURFACE_COUNT]; /* vertex_count 0: not read */
    mesh_file_report read[CASE_SURFACE_COUNT];
    int32_t open_edges[CASE_SURFACE_COUNT], crowded_edges[CASE_SURFACE_COUNT];
    double diagonal_mm[CASE_SURFACE_COUNT];
    nearest *tree[CASE_SURFACE_COUNT];   /* over mesh; NULL: none */
    bool wrong_size[CASE_SURFACE_COUNT]; /* not a head in mm: what is measured on it says nothing */
    bool misplaced[CASE_SURFACE_COUNT];  /* its landmarks lie off it all in one way, which is told */
    landmarks points;
    bool has_frame;
    double frame_residual_mm;
} check_found;

/* All parts in their order. An interruption leaves the rest out; watch may be NULL. The caller frees *found. */
void check_case(const case_file *c, const task *watch, check_found *found, issue_list *issues);
/* The same for who goes on with the case: refuses the first error, in its words and with its code, and an interruption;
 * adds the warnings to `warnings`. */
bool check_case_passes(const case_file *c, const task *watch, issue_list *warnings, err *e) MUST_CHECK;

void check_surfaces(const case_file *c, check_found *found, issue_list *issues);
/* Bones against skin; needs what check_surfaces found. */
void check_bones_inside(const case_file *c, const check_found *found, issue_list *issues);
void check_landmarks(const case_file *c, check_found *found, issue_list *issues);
/* Surfaces off which their landmarks lie all in one way: moved, scaled, turned, mirrored, in other axes or units. */
void check_place(const case_file *c, check_found *found, issue_list *issues);
/* A landmark far from its usual place, and bones at an unusual depth below the skin; needs what check_place found. */
void check_usual(const case_file *c, const check_found *found, issue_list *issues);
void check_depth(const case_file *c, const check_found *found, issue_list *issues);
/* The order of the landmarks, and that each lies on its own jaw; needs what check_surfaces found. */
void check_order(const case_file *c, const check_found *found, issue_list *issues);
void check_jaws(const case_file *c, const check_found *found, issue_list *issues);
void check_planes(const case_file *c, issue_list *issues);
/* What gnathos fit guessed (case_guess.h); needs the landmarks. */
void check_guessed(const case_file *c, const check_found *found, issue_list *issues);
void check_found_free(check_found *found);
