/* outcome_scene: what a prediction switched on and left out, and the estimated price on the skin. */
#pragma once
#include "app/planner/predict/outcome.h"
#include "app/planner/store/record.h"

enum { SCENE_WORDS_MAX = 10 };

typedef struct scene_omission {
    char what[512], why[200];
    double skin_error_mm; /* NaN: not known */
} scene_omission;

typedef struct scene_words {
    char on[SCENE_WORDS_MAX][256]; /* sentences */
    int on_count;
    scene_omission left_out[SCENE_WORDS_MAX];
    int left_out_count;
    int averaged; /* the element: 1, volume changes are averaged */
    scene_report report;
} scene_words;

void scene_words_make(const outcome *o, scene_words *out);
extern const record_table scene_words_table;
/* Which element the tissue has, and why. */
void outcome_element_words(const outcome *o, char *out, size_t size);
/* What the tissue that was left out costs the skin at most, mm, by estimate. */
double outcome_left_out_mm(const outcome *o);
