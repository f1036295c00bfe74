/* cut_plan: what the single osteotomies share. */
#pragma once
#include "geometry/nearest.h"
#include "geometry/osteotomy.h"
#include "geometry/src/cut/cutter.h"

typedef struct cut_bodies {
    surface inner, outer; /* smaller and larger by half the kerf */
    surface hollow;       /* inner, larger where it does not cut: outer without hollow has no face of zero thickness */
    surface sheet;        /* the middle of the cut, open; empty for user planes */
    double moved_mm;      /* farthest that a split was moved inwards for the lateral plate */
} cut_bodies;
#define HOLLOW_MM 1.0

void cut_bodies_free(cut_bodies *b);
/* Offsets of one cutter whose body is the piece. */
cut_bodies cut_bodies_from(const cutter *c, double kerf_mm);

/* What a split leaves of the lateral plate behind the molars, by moving inwards where the sheet would run nearer to the
 * outside or beyond it. */
typedef struct lateral_plate {
    double least_mm; /* 0: as the sheet is fitted */
    double reach_mm; /* of moves; a sheet twice as far out passes the alveolus and stays */
} lateral_plate;

/* The osteotomies. side: +1 left, -1 right. */
bool le_fort_bodies(const osteotomy_input *in, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e);
bool bsso_bodies(const osteotomy_input *in, const osteotomy_params *p, const nearest *mandible, int side,
                 lateral_plate plate, cut_bodies *out, cut_report *r, err *e);
bool genioplasty_bodies(const osteotomy_input *in, const osteotomy_params *p, cut_bodies *out, cut_report *r, err *e);

/* Warns of landmarks on another piece than anatomy puts them on. */
bool cut_places_check(const osteotomy_input *in, const segments *s, cut_report *r, err *e) MUST_CHECK;

/* Axes of the mandible itself, whatever the opening of the mouth: up is the normal of the lower occlusal
 * plane (L1, L6_L, L6_R), left from right to left over the paired points. */
bool jaw_frame(const landmarks *l, head_frame *out, err *e);
/* Adds the names of labels that are missing to e (one refusal for all of them); true if none is. */
bool need_landmarks(const landmarks *l, const char *what, const char *const *labels, err *e);
/* A landmark; of missing incisors (U1, L1) and first molars (U6, L6) where they would be. False if there is none. */
bool landmark_point(const landmarks *l, const char *label, double out[3]);
/* The same in local coordinates. */
bool landmark_local(const landmarks *l, const char *label, const head_frame *f, double local[3]);
/* "Go" and +1 -> "Go_L". */
const char *side_label(char buffer[LANDMARK_LABEL_SIZE], const char *base, int side);

/* Mean lengths from cusp to root tip and mesiodistal widths, mm (Wheeler's tables). */
enum { UPPER_1_MM = 23, UPPER_3_MM = 27, LOWER_1_MM = 21, LOWER_3_MM = 27 };
#define UPPER_6_MM 20.5
#define UPPER_7_MM 18.5
#define LOWER_M1_WIDTH_MM 11.0
#define LOWER_M2_WIDTH_MM 10.5
#define UPPER_M1_WIDTH_MM 10.0

/* Outline of one side of a bone: for every value of the local axis `across` the extreme of the axis `along`
 * over the section there (sign -1: lowest, +1: highest), sampled every half millimetre. */
typedef struct outline {
    double start;
    int count, sign;
    double *extreme; /* [count] infinite where there is no bone */
} outline;
outline outline_make(const surface *s, const head_frame *f, int side, int across, int along, int sign);
void outline_free(outline *o);
double outline_at(const outline *o, double x); /* infinite, of the sign opposite to `sign`, where there is no bone */

/* Adds `from` to r and leaves it empty. */
void report_take(cut_report *r, cut_report *from);
void report_clearance(cut_report *r, const char *name, double value_mm, double limit_mm, bool estimated);
void report_plane(cut_report *r, const char *label, const double point[3], const double normal[3]);
void report_warning(cut_report *r, const char *fmt, ...) PRINTF_LIKE(2, 3);
void report_note(cut_report *r, const char *fmt, ...) PRINTF_LIKE(2, 3);
