/* check: the parts of `gnathos check`. Each adds issues and what it found to `found`. */
#pragma once
#include "app/planner/patient/case_file.h"
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
    landmarks points;
    bool has_frame;
    double frame_residual_mm;
} check_found;

void check_surfaces(const case_file *c, check_found *found, issue_list *issues);
/* Bones against skin; needs what check_surfaces found. */
void check_bones_inside(const case_file *c, const check_found *found, issue_list *issues);
void check_landmarks(const case_file *c, check_found *found, issue_list *issues);
/* The order of the landmarks, and that each lies on its own jaw; needs what check_surfaces found. */
void check_order(const case_file *c, const check_found *found, issue_list *issues);
void check_jaws(const case_file *c, const check_found *found, issue_list *issues);
void check_planes(const case_file *c, issue_list *issues);
void check_found_free(check_found *found);
