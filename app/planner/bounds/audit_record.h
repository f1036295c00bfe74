/* audit_record: audit.json of a case's bounds. */
#pragma once
#include "app/planner/bounds/write.h"
#include "app/planner/store/record.h"

extern const record_table audit_table; /* kind "audit" */

/* The rest is for report.c, which fills it. */
typedef struct audit_place { /* values of all controls */
    const audit *of;
    int32_t at[SAMPLE_AXES_MAX];
} audit_place;

typedef struct audit_finding {
    const char *limit, *where, *unit;
    double value, stop[2], place[3];
    bool estimated, has_place;
    limit_level level; /* LIMIT_NOT_JUDGED: not told */
} audit_finding;

typedef struct audit_ray_view {
    audit_place reach;
    bool solved, limited;
    int level;         /* verdict_level */
    const char *limit; /* and this, where solved */
    double value;
} audit_ray_view;

typedef struct audit_end {
    double fine, reach;
    bool has_caution, has_stop, has_ray;
    audit_finding caution, stop;
    audit_ray_view ray;
} audit_end;

typedef struct audit_line_view {
    const audit *of;
    const feasible_line *line;
    int which; /* control */
    const char *control, *unit;
    double base, box[2];
    bool base_feasible;
    audit_end low, high;
} audit_line_view;

typedef struct audit_map_view {
    const audit *of;
    int request;
    const feasible_map *map;
    char *files;
    int64_t judged, further;
    bool asked; /* of the tissue */
    audit_place feasible, stopped;
} audit_map_view;

typedef struct audit_tissue_view {
    const char *contact;
    int64_t allowed, left_out, warm, iterations;
    int solves, rounds;
} audit_tissue_view;

typedef struct audit_view {
    const audit *of;
    const case_file *patient;
    const char *case_name, *hash;
    double spacing, tolerance, step;
    audit_place base;
    int64_t points;
    int lines, maps, always, unknown;
    audit_line_view *line;
    audit_map_view *map;
    audit_finding *throughout;
    audit_gap gap[AUDIT_GAPS_MAX];
    bool has_tissue;
    audit_tissue_view tissue;
} audit_view;

/* What the tissue says at the end of a ray: the level at the outermost point that bone and teeth allow, or of the stop.
 */
audit_ray_view audit_ray_view_of(const audit *a, const audit_ray *r);
