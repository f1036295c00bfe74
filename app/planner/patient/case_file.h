/* case_file: a patient as described by case.json, checked, defaults filled in. Plain data; nothing to free.
 */
#pragma once
#include "app/planner/store/fields.h"
#include "app/planner/patient/limit.h"
#include "geometry/mesh_file.h"
#include "geometry/osteotomy.h"
#include "geometry/segments.h"
#include "geometry/tissue.h"

enum { CASE_OSTEOTOMIES_MAX = 8 };

/* Numbers of the words "LPS" and "RAS" in the field table. */
typedef enum case_frame { CASE_LPS, CASE_RAS } case_frame;

typedef enum case_surface {
    CASE_SKIN,
    CASE_SKULL,
    CASE_MANDIBLE,
    CASE_UPPER_TEETH, /* optional: fused with the bone if the path is empty */
    CASE_LOWER_TEETH,
    CASE_SURFACE_COUNT
} case_surface;

typedef enum case_cut { CUT_LE_FORT_1, CUT_BSSO, CUT_GENIOPLASTY, CUT_USER } case_cut;

typedef struct case_osteotomy {
    case_cut cut;
    /* CUT_USER only: a plane of the planes file in place of the default cut that frees `segment`. */
    char plane[64];
    segment_id segment;
} case_osteotomy;

typedef struct case_material {
    double young_kpa, poisson;
    int element; /* element_kind: auto, linear, averaged */
} case_material;

enum { CASE_GUESSED_POINTS_MAX = 128 };

/* What no scan shows (case_guess.h). */
typedef struct case_guess {
    double share[CASE_SURFACE_COUNT]; /* of the part's vertices, 0 to 1 */
    double jaw_turned_deg;            /* up, to close a mouth that the scan has open */
    int point_count;
    char point[CASE_GUESSED_POINTS_MAX][LANDMARK_LABEL_SIZE];
} case_guess;

typedef struct case_file {
    char path[FIELD_PATH_SIZE];   /* of case.json; "" for the default */
    char folder[FIELD_PATH_SIZE]; /* of case.json, without the last slash */
    char name[FIELD_TEXT_SIZE];
    int version, units;
    int frame;                                         /* case_frame: axes of meshes without a tag */
    char surface[CASE_SURFACE_COUNT][FIELD_PATH_SIZE]; /* existing files, or "" */
    char landmarks[FIELD_PATH_SIZE];                   /* existing file; "" after case_file_load_bare alone */
    char planes[FIELD_PATH_SIZE];                      /* user planes, or "" */
    int osteotomy_count;
    case_osteotomy osteotomy[CASE_OSTEOTOMIES_MAX];
    osteotomy_params cuts;
    tissue_params tissue;
    case_material material;
    limit_range limits[LIMIT_COUNT];
    bool limit_from_case[LIMIT_COUNT]; /* false: the default and its source hold */
    case_guess guessed;
} case_file;

case_file case_file_default(void);
/* path: case.json or its folder. Everything wrong becomes an issue; true if none of them is an error. *out is
 * filled in any case, a wrong field with its default or "". Paths in *out start with the folder as given. */
bool case_file_read(const char *path, case_file *out, issue_list *issues) MUST_CHECK;
/* The same for who wants only the first error; after one, *out is untouched. */
bool case_file_load(const char *path, case_file *out, err *e) MUST_CHECK;
/* The same for who needs no landmarks: where the case names none, or a file that is not there, its landmarks are "". */
bool case_file_load_bare(const char *path, case_file *out, err *e) MUST_CHECK;
/* The same for who makes do without bones too: where the case names no skull or no mandible, their path is "". */
bool case_file_load_skin(const char *path, case_file *out, err *e) MUST_CHECK;

bool case_file_cuts(const case_file *c, case_cut cut);
/* The case has a cut that frees this segment. */
bool case_file_frees(const case_file *c, segment_id segment);
const char *case_surface_name(case_surface s); /* "skin", ... */
mesh_space case_file_space(const case_file *c);

const field_table *case_fields(void);
