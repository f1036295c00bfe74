/* import: what a case is made of, read from surfaces, a label map or a CT, measured, and written as a case
 * folder. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "app/planner/store/task.h"
#include "geometry/label_surface.h"
#include "geometry/landmarks.h"

enum { IMPORT_TIMES_MOST = 64 };
typedef struct import_words { /* of an option that may be given several times, all of which count */
    int count;
    const char *word[IMPORT_TIMES_MOST];
} import_words;

/* Landmarks of a head, with their doubts. The caller frees *out. */
typedef bool import_place(const surface part[CASE_SURFACE_COUNT], const task *watch, landmarks *out, err *e);

typedef struct import_params {
    /* For each surface mesh files or, with `labels`, labels separated by commas: names, or numbers where the
     * file names none. Several are joined. Count 0: none, or what the preset says. */
    import_words from[CASE_SURFACE_COUNT];
    import_words labels;       /* a label map, or several of one grid (label_files.h) */
    const char *preset;        /* NULL, or one of label_preset_names */
    const char *ct;            /* the skin is the head in this CT, or NULL */
    bool ct_is_dicom;          /* ct is a folder of DICOM slices */
    double skin_hu;            /* above: not air */
    bool skin_hu_given;        /* by the user, who then knows the scale of the values */
    double seal_mm;            /* openings of the skin narrower than this are sealed, with the airways behind them */
    label_surface_params mesh; /* its least_mm3 holds for islands of voxels too */
    const char *landmarks;
    import_place *place; /* who places the landmarks on what was read; NULL: nobody */
    const char *name;    /* NULL: the folder's */
    mesh_space space;    /* of mesh files without a tag */
    volume_form form;    /* of NIfTI files whose two forms disagree */
    double unit_mm;      /* length unit of mesh files; 0: mm, refused where that makes no head */
} import_params;

typedef struct import_part {
    surface mesh; /* vertex_count 0: not part of the case */
    char source[1200];
    mesh_file_report read;
    bool from_labels, thresholded; /* thresholded: cut out of a CT by its grey value, not by hand */
    int32_t islands_dropped;       /* of labels */
    int64_t cavity_voxels, island_voxels, sealed_voxels;
    double label_mm3; /* volume of the voxels the surface was made of */
    label_surface_report made;
    int32_t components, open_edges, holes, crowded_edges, self_intersections;
    double diagonal_mm, area_mm2, volume_mm3; /* volume: of closed surfaces */
} import_part;

enum { IMPORT_INTERSECTIONS_MOST = 10000 }; /* counting stops here */

typedef struct import_result {
    import_part part[CASE_SURFACE_COUNT];
    landmarks points;
    bool has_points;
    int32_t points_skipped;
    int64_t contacts; /* pairs of voxels where upper and lower jaw touch; -1: not from labels */
} import_result;

import_params import_params_default(void);
/* Reads and measures everything; advice goes to `notes`. The caller frees *out. */
bool import_read(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e) MUST_CHECK;
/* Writes the folder, whole or not at all; refuses one that is there and not empty. */
bool import_write(const import_params *p, const import_result *r, const char *folder, err *e) MUST_CHECK;
void import_result_free(import_result *r);

/* Adds what check will say of bones against skin and of landmarks. */
void import_note_as_case(const import_params *p, const import_result *r, issue_list *notes);
/* Reads the landmarks, or has them placed. */
bool import_points(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e) MUST_CHECK;
/* The parts that come from a label map or a CT. */
bool import_labels(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e) MUST_CHECK;
bool import_is_mesh_name(const char *text);
