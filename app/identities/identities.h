/* identities: what gnathos identities does beyond the planner: norm heads to learn from, pictures, tables, records. */
#pragma once
#include "app/planner/identity/head_gather.h"
#include "app/planner/identity/head_model.h"
#include "app/planner/identity/head_sound.h"
#include "app/planner/store/record.h"
#include <stdio.h>

typedef struct identities_learn {
    const char *const *cases; /* [case_count] */
    int32_t case_count;
    int32_t norm_heads; /* drawn besides: sexes and classes in turn, seeds from `seed` on */
    uint64_t seed;
    bool anew; /* a journal of other work makes way */
} identities_learn;

typedef struct identities_learnt {
    head_model model;
    int32_t refused, fresh; /* as head_set */
    double fit_s, learn_s;  /* wall */
    int64_t bytes;          /* of the file */
} identities_learnt;

/* Fits the template to every head, all cores at once, learns, writes the model to `path`, and removes path.journal,
 * where the fits were kept meanwhile. The caller frees the model. */
bool identities_learn_write(const head_template *t, const identities_learn *p, const char *path, const task *watch,
                            identities_learnt *out, err *e) MUST_CHECK;

typedef struct identities_projection {
    char name[FIELD_TEXT_SIZE];
    const head_model *model;
    double p[HEAD_MODES_MOST], fit_s;
    head_gap gap[HEAD_GAP_COUNT]; /* from the fitted head to what the model makes of it */
    double guessed; /* share of the skin that is not in the scan; it decides nothing and is not in the gaps */
    double *phi, *made, *known; /* owned; [length] known: 0 where the fit guessed */
} identities_projection;

/* The head of a case, or of a folder of gnathos fit, in the template, and what the model makes of it. */
bool identities_project(const head_template *t, const head_model *m, const char *path, const task *watch,
                        identities_projection *out, err *e) MUST_CHECK;
void identities_projection_free(identities_projection *p);

typedef struct identities_made {
    const head_model *model;
    bool random;
    uint64_t seed;
    int32_t p_count; /* given; the others are 0 */
    double p[HEAD_MODES_MOST];
    int32_t tries; /* of random draws, the last of which is a head */
    head_soundness sound, of_template;
    bool tissue_anew;   /* that of the modes had tetrahedra inside out: it is the elastic one between the parts */
    const char *folder; /* borrowed */
} identities_made;

enum { IDENTITIES_TRIES = 50 };
extern const double identities_sd_most; /* a coefficient is at most so many standard deviations */

/* A new head as a case in out->folder, which appears whole or not at all. Random: head_model_draw from the
 * seed; a draw that is no head is told as a note and the next is tried, at most IDENTITIES_TRIES. Refuses
 * (ERR_GEOMETRY) what head_sound and gnathos check refuse of p. */
bool identities_make(const head_template *t, const head_model *m, identities_made *made, const task *watch,
                     issue_list *warnings, err *e) MUST_CHECK;

/* Records: kinds "identities", "identity" and "identity_made". */
extern const record_table identities_table, identity_table, identity_made_table;
json_t *identities_json(const identities_learnt *l);
json_t *identity_json(const identities_projection *p);
json_t *identity_made_json(const identities_made *m);

void identities_print(const identities_learnt *l, FILE *to);
void identity_print(const identities_projection *p, FILE *to);
void identity_made_print(const identities_made *m, FILE *to);

/* identities.json, variance.png, and with GNATHOS_RENDER mean.png and mode_NN.png: what the mean is and what two
 * standard deviations of the first modes change. Into an existing folder. */
bool identities_write(const head_template *t, const identities_learnt *l, const char *folder, err *e) MUST_CHECK;
/* identity.json, error.vtp (the skin with its error_mm), error.ply (the same in colours) and error.png. */
bool identity_write(const head_template *t, const identities_projection *p, const char *folder, err *e) MUST_CHECK;
