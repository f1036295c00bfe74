/* head_model: what many heads of one numbering have in common and how they differ: mean, main directions, and how well
 * a head is made that was not among them. A new head is a few coefficients p, in standard deviations. Specification 1.3
 * and 3. */
#pragma once
#include "app/planner/identity/head_vector.h"
#include "app/planner/store/task.h"
#include "sim/principal.h"

enum { HEAD_MODES_MOST = 40, HEAD_NAME_SIZE = 64 };

typedef struct head_model {
    char numbering[HASH_TEXT_SIZE]; /* of the template that was fitted */
    principal modes;                /* of phi (head_vector.h) */
    char (*name)[HEAD_NAME_SIZE];   /* [modes.sample_count] of the heads it was learnt from, ends at a zero byte */
    double *score;                  /* [sample_count*mode_count] their coefficients */
    int32_t left_out_modes;         /* each head from all others: */
    double *left_out_rms_mm;        /* [left_out_modes+1] with so many modes: root of the mean over blocks and heads */
    head_gap left_out[HEAD_GAP_COUNT]; /* with all of them: mean of the heads' means and 95 %, largest of all heads */
} head_model;

/* phi[count] of heads in their Frankfort frames, name[count] what they are called. The caller frees *out. Refuses
 * (ERR_GEOMETRY) fewer than three heads, and what principal_learn refuses. */
bool head_model_learn(const head_template *t, const double *const *phi, const char *const *name, int32_t count,
                      const task *watch, head_model *out, err *e) MUST_CHECK;
void head_model_free(head_model *m);

/* A head among those that it was learnt from, drawn from the seed's state: the coefficients of one of them, drawn, and
 * something to all sides of it, so that modes which go together in heads go together in it and nobody's head comes out:
 * their density by normal kernels of 0.5 sd, cut at 2 of these, shrunk to keep its variance (Silverman, "Density
 * Estimation", 1986, 6.4). p[mode_count], within 3 sd; *state goes on. */
void head_model_draw(const head_model *m, uint64_t *state, double *p);

enum { HEAD_MODEL_VERSION = 2 };
/* Where a model is found that is not named: what GNATHOS_IDENTITIES names, else identities-VERSION.model in the user's
 * cache. path[FIELD_PATH_SIZE]. Refuses what user_cache_path refuses. */
bool head_model_place(char *path, err *e) MUST_CHECK;

/* A checksummed pack. Reading refuses (ERR_INPUT), by name, a file that is none or not whole, and a model of another
 * numbering. The caller frees *out. */
bool head_model_write(const head_model *m, const char *path, err *e) MUST_CHECK;
bool head_model_read(const char *path, const head_template *t, head_model *out, err *e) MUST_CHECK;
