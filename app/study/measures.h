/* measures: what the literature reports of standard moves, as numbers taken from one solved run. */
#pragma once
#include "app/study/study.h"

typedef struct standard_move {
    const char *name, *file; /* file: no spaces */
    struct {
        const char *name; /* of a control, or NULL */
        double value;
    } control[2];
} standard_move;
extern const standard_move study_moves[];
extern const int study_move_count;

enum { STUDY_FORWARD, STUDY_UP };
typedef enum study_measure_kind {
    MEASURE_FOLLOWS, /* move of soft along soft_axis over that of hard along hard_axis */
    MEASURE_TURNS,   /* change of a cephalometric angle (named in soft), degrees per mm of hard */
    MEASURE_WIDENS,  /* change of the distance between two points, mm */
    MEASURE_THICKENS /* move of soft less that of hard, forward, mm */
} study_measure_kind;

typedef struct study_measure {
    int move, kind;
    const char *soft, *hard; /* landmarks */
    int soft_axis, hard_axis;
    double low, high;      /* window; infinite: open on that side */
    const char *published; /* range of the papers */
} study_measure;
enum { STUDY_MEASURES = 42 };
extern const study_measure study_measures[STUDY_MEASURES];

/* Refuses what rig_motion refuses: a jaw that turns, in a case without condyles. */
bool study_move_motion(const standard_move *m, const prepared *p, rigid motion[SEGMENT_COUNT], err *e) MUST_CHECK;
/* Adds the lips' edges at stomion, "Stms" and "Stmi", where a head has but one point for both. */
void study_add_lips(prepared *p);
/* NaN where a landmark is missing or the bone hardly moves. p: with study_add_lips, as the run was. */
double study_measure_value(const study_measure *m, const prepared *p, const study_run *r);
void study_measure_name(const study_measure *m, char *out, size_t size);
/* The first landmark that the head has not; NULL: none is missing. */
const char *study_measure_lacks(const study_measure *m, const prepared *p);
