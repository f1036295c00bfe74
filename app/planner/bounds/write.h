/* write: the results of an audit, as data and as files. */
#pragma once
#include "app/planner/bounds/audit.h"
#include "app/planner/store/output_dir.h"

/* What ends the feasible run of a line at one end (-1 low, +1 high). */
typedef struct audit_bound {
    bool feasible;      /* false: the base itself is stopped, nothing else is set */
    double fine, reach; /* last fine, last feasible value of the control; fine is NaN where the base is not */
    bool ended, warned; /* a stop, a caution was met in the box, and by what */
    finding stop, caution;
    const audit_ray *ray; /* of the tissue; NULL: not asked */
    double bones;         /* where the tissue limits the ray: what bone and teeth allow */
} audit_bound;

bool audit_bound_of(const audit *a, int request, int end, audit_bound *out, err *e) MUST_CHECK;

/* audit.json as a new object. Nothing in it depends on time, threads or interruptions. */
bool audit_json(const audit *a, json_t **out, err *e) MUST_CHECK;
/* audit.json, samples.csv, and map_*.csv and .vti of every map. */
bool audit_write_files(const audit *a, const output_dir *dir, err *e) MUST_CHECK;
/* How many of the judged points bone and teeth allow. */
int64_t audit_points_allowed(const audit *a);

/* "map_A_B" in a new string; the caller frees it. */
char *audit_map_name(const audit *a, int request, const char *ending);
const char *audit_level_name(int verdict_level);
