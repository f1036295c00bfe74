/* label_choice: which labels of a segmentation make which part of a case, by words of the user or by the preset of a
 * tool. A label makes one part at most; what a name or a number stands for is taken whole. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "geometry/mask.h"

typedef struct label_use {
    case_surface part;
    int32_t label, layer;
    char word[64]; /* as it was asked for */
} label_use;

typedef struct label_choice {
    int count;
    label_use *use;
} label_choice;
void label_choice_free(label_choice *c);

/* Names of the presets, separated by commas. */
const char *label_preset_names(void);
/* Refuses (ERR_USAGE) a name that is no preset's. */
bool label_preset_check(const char *name, err *e) MUST_CHECK;

/* Adds the labels of `words` (names where the file has names, else numbers; separated by commas): every segment of that
 * name. Refuses (ERR_INPUT, with the labels there are) a word that is none or has no voxels, and (ERR_USAGE) one that
 * makes another part already. path: of the volume, for messages. */
bool label_choose_words(const volume *v, const char *path, case_surface part, const char *words, label_choice *c,
                        err *e) MUST_CHECK;
/* Adds the labels that the preset's tool makes of the part, by name where the file has names; none where the file lacks
 * an optional one. Refuses what label_choose_words refuses, and a file that lacks a required one. */
bool label_choose_preset(const volume *v, const char *path, const char *preset, case_surface part, label_choice *c,
                         err *e) MUST_CHECK;
/* Adds to *m the voxels of the part's labels. */
void label_choice_mask(const label_choice *c, const volume *v, case_surface part, mask *m);
/* The labels of the volume that no part uses, in words; "" where there are none. Returns how many. */
int label_choice_unused(const label_choice *c, const volume *v, char *text, size_t size);
