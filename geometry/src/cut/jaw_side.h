/* jaw_side: one side of a mandible that is to be split: its landmarks, its borders and where the cuts of the split run.
 *
 * Coordinates are those of jaw_frame, with x counted from the midline outwards on either side. */
#pragma once
#include "geometry/src/cut/cut_plan.h"

enum { SAGITTAL_TERMS = 5 };

typedef struct jaw_side {
    const osteotomy_input *in;
    const nearest *tree; /* of the mandible */
    head_frame frame;
    int side;               /* +1 left, -1 right */
    double low[3], high[3]; /* of the mandible on this side */
    double li[3], l6[3], l7[3], go[3], sn[3], ra[3], rp[3], m2[3];
    double top;                 /* height of the horizontal cut */
    double v_slope;             /* dy/dz of the buccal cut */
    double lingual[2][2];       /* y, z of the lingual cut: above and below */
    double border_at_v;         /* height of the lower border there */
    double fit[SAGITTAL_TERMS]; /* sagittal cut: x = 1, y, z, y^2, yz */
    lateral_plate plate;        /* outside it behind the molars */
    double canal[CANAL_POINTS_MAX][3];
    int canal_count;
    outline lower, posterior; /* lower border over y, posterior border over z */
    bool lingula_estimated, canal_estimated;
} jaw_side;

/* Distances that the cuts and their report share. */
#define FORAMEN_DROP_MM 3.0 /* mandibular foramen below the tip of the lingula */
#define NOTCH_MM 3.0        /* least distance of the horizontal cut below the sigmoid notch */

/* The landmarks that a side needs, "L6_L" and so on; label[6] holds them, needed[7] ends with NULL. */
void jaw_side_needs(int side, char label[6][LANDMARK_LABEL_SIZE], const char *needed[7]);
/* Borrows in and mandible until jaw_side_close. Needs the landmarks above. */
bool jaw_side_open(const osteotomy_input *in, const nearest *mandible, int side, jaw_side *out, err *e);
void jaw_side_close(jaw_side *j);
/* Finds the landmarks and the lines of the cuts; without the sagittal one and without the canal. */
bool jaw_side_locate(jaw_side *j, const osteotomy_params *p, cut_report *r, err *e);
const char *jaw_side_word(const jaw_side *j); /* "left" */

void jaw_side_local(const jaw_side *j, const double world[3], double local[3]);
void jaw_side_world(const jaw_side *j, const double local[3], double world[3]);
/* Outermost and innermost bone on the horizontal line across the jaw at (y, z). */
bool jaw_side_cross(const jaw_side *j, double y, double z, double *outside, double *inside);
double jaw_side_border(const jaw_side *j, double y);   /* height of the lower border */
double jaw_side_buccal_y(const jaw_side *j, double z); /* of the vertical cut */
double jaw_side_lingual_y(const jaw_side *j, double z);

/* The canal: given, or estimated from lingula and mental foramen. */
bool jaw_side_take_canal(jaw_side *j, cut_report *r, err *e);
/* x and z of the canal at y, by its polyline, and how much longer than across the jaw its distance to a sheet
 * beside it must be, because it runs aslant. */
bool jaw_side_canal_at(const jaw_side *j, double y, double out[3]);
/* The sagittal cut: false where there is no bone to fit it to. */
bool jaw_side_fit_sagittal(jaw_side *j, const osteotomy_params *p);
/* Needs the canal too. */
double jaw_side_sagittal_x(const jaw_side *j, const osteotomy_params *p, double y, double z);
