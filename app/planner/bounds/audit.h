/* audit: how far the controls of a plan may go on a case, and what stops them. */
#pragma once
#include "app/planner/plan/plan_vary.h"
#include "app/planner/bounds/feasible_line.h"
#include "app/planner/bounds/feasible_map.h"
#include "app/planner/store/journal.h"
#include "app/planner/judge/judge.h"
#include "app/planner/bounds/tissue_set.h"
#include "app/planner/predict/live_pool.h"

enum { AUDIT_REQUESTS_MAX = 40, AUDIT_RECORD_POINT = 1, AUDIT_RECORD_TISSUE = 2 };

typedef struct audit_request { /* one control: a line; two: a map; three: a box */
    int axis_count, axis[3];   /* numbers of controls */
} audit_request;

typedef struct audit_settings {
    double spacing;   /* of the maps, mm or degrees */
    double tolerance; /* of the bounds */
    bool tissue;      /* audit_tissue will be asked */
    int control_count;
    control control[SAMPLE_AXES_MAX];
    int request_count;
    audit_request request[AUDIT_REQUESTS_MAX];
} audit_settings;

typedef struct audit_ray { /* from the base to an end, a side or a corner of the box */
    int32_t target[SAMPLE_AXES_MAX];
    int steps, finest; /* from the base to the target; how finely the tissue's stop is looked for */
    int allowed;       /* the last step that bone and teeth allow, without a gap from the base */
    int reach;         /* the last step that the tissue allows too */
    bool limited;      /* by the tissue: reach < allowed */
    verdict v; /* of the tissue at `allowed`, or, where limited, of what stops it; of the base where allowed = 0 */
} audit_ray;

typedef struct audit {
    const case_file *patient;
    const prepared *prepared;
    audit_settings settings;
    plan_file base;                     /* opened for the controls */
    double base_value[SAMPLE_AXES_MAX]; /* of each control */
    double step;                        /* mm or degrees per step of the lattice, at most the tolerance */
    int32_t spacing;                    /* steps */
    int32_t low[SAMPLE_AXES_MAX],
        high[SAMPLE_AXES_MAX]; /* box in steps: one or two spacings past the limits of moves */
    /* The least level of each limit at the base, the corners and the middles of the sides of the box. What is there
     * throughout (a caution of the cuts, a midline that no control moves) says nothing about how far to go: it is told
     * apart, and a point counts only what is worse. */
    limit_level throughout[LIMIT_COUNT];
    sample_set points;
    feasible_line line[AUDIT_REQUESTS_MAX]; /* of requests with one control */
    feasible_map map[AUDIT_REQUESTS_MAX];   /* of the others */
    bool tissue_asked;
    tissue_set tissue;
    int ray_count;
    audit_ray *ray;
    int request_ray[AUDIT_REQUESTS_MAX]
                   [27];                  /* by direction, digits 0 none, 1 low, 2 high in base 3, first axis first */
    uint8_t *outside[AUDIT_REQUESTS_MAX]; /* of maps [node_count]: 1 stopped by the tissue, 2 further out than solved */
    /* private */
    judge *judge;
    journal *journal;
    live_pool predictions; /* during audit_tissue */
    int64_t expected;      /* points in all, a guess */
    double start_s, told_s;
    void (*progress)(int64_t done, int64_t expected, double left_s, void *context);
    void (*solved)(int round, int done, int count, void *context);
    bool (*interrupted)(void *context);
    void *context;
} audit;

/* Borrows c and p until audit_free. base may be NULL: nothing moves. *out is not to be moved. Refuses (ERR_INPUT) a
 * base that moves a controlled segment by a matrix or lies outside the box; what judge_create refuses. */
bool audit_make(const case_file *c, const prepared *p, const plan_file *base, const audit_settings *s, audit *out,
                err *e) MUST_CHECK;
void audit_free(audit *a); /* idempotent, leaves zero */
/* Hash of all that the result depends on. */
void audit_key(const audit *a, char key[HASH_TEXT_SIZE]);
/* Judges all requests by bone and teeth. What is judged is kept in the journal and taken from it. */
bool audit_bones(audit *a, journal *j, err *e) MUST_CHECK;
/* Then asks the soft tissue at the rim of what bone and teeth allow. Inside the rim it is taken to do what it does on
 * it: a move of the same direction that is smaller strains it less. */
bool audit_tissue(audit *a, journal *to, err *e) MUST_CHECK;
/* For journal_open: takes over what was judged earlier; context is the audit. */
bool audit_read_record(uint32_t kind, const void *bytes, size_t size, void *context, err *e);

double audit_value(const audit *a, int which, double steps); /* from the base's to the control's own */
/* The finding that decides in a judgement: of the worst level, `throughout` counted as fine, the nearest to its stop.
 */
const finding *audit_decisive(const audit *a, const judgement *j, limit_level *level);
verdict audit_verdict(const audit *a, const judgement *j);
bool audit_stopped(void *audit_context);    /* interrupted */
void audit_tissue_start(audit *a);          /* private: part of audit_make */
void audit_rim_mark(audit *a, int request); /* what lies outside the rim, into a map */
bool audit_read_tissue(audit *a, const void *bytes, size_t size, err *e);
/* Where a ray ends. */
void audit_ray_place(const audit_ray *r, int32_t at[SAMPLE_AXES_MAX]);
enum { AUDIT_GAPS_MAX = FINDINGS_MAX + LIMIT_COUNT };
typedef struct audit_gap {
    const char *limit, *what, *why;
} audit_gap;
/* The limits that are not judged at the base, and those of the face. */
bool audit_not_judged(const audit *a, audit_gap out[AUDIT_GAPS_MAX], int *count, err *e) MUST_CHECK;
/* The whole judgement of one point. */
bool audit_judge(const audit *a, const int32_t at[SAMPLE_AXES_MAX], judgement *out, plan_moves *moves,
                 err *e) MUST_CHECK;
