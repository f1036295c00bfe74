/* spots: which runs a picture of a study marks, where, and under which name. */
#pragma once
#include "app/study/study.h"

enum { PLAIN, AVERAGED, TOLERANCES, SCENES, HALVED, SERIES };
enum { SPOTS_MAX = 96 };

typedef struct spot {
    double x, y; /* wall time, s, or mean size of a tet, mm; mean error, mm */
    int run, series;
    char label[24]; /* "": none */
} spot;

/* Fills s and returns how many. Over time: every run that can be compared with the reference. Over size:
 * meshes made anew against the reference, and meshes with halves of their own against the finest of these. */
int spots_collect(const study_table *t, bool over_time, spot s[SPOTS_MAX]);
