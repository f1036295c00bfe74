/* prepared: what depends on the case alone, made once and kept on disk under the hash of its inputs. */
#pragma once
#include "app/planner/patient/anatomy.h"
#include "app/planner/patient/bone_fields.h"
#include "app/planner/store/content_hash.h"
#include "geometry/tissue.h"
#include "geometry/json_file.h"

/* What its stages took; nothing of them is known where it was read from disk. */
typedef struct prepared_stages {
    clock_span check, repair, cuts, distances, mesh, attachment, fields;
} prepared_stages;

typedef struct prepared {
    char hash[HASH_TEXT_SIZE];
    bool reused; /* read from disk */
    landmarks points;
    head_frame frame;
    surface skin; /* as read, LPS mm: what is shown */
    segments segments;
    tissue tissue;
    bone_fields fields;
    embedding skin_on_tissue; /* one point per vertex of skin */
    json_t *report;           /* repair, cuts, mesh quality, attachment: goes into outcome.json as it is */
    prepared_stages stages;
} prepared;

/* Takes it from CASE/prepared (or `cache` if not NULL) where a file of the right hash lies there, else makes
 * it and keeps it. A damaged file is made anew. The caller frees *out. */
bool prepared_get(const case_file *c, const char *cache, const task *watch, prepared *out, err *e) MUST_CHECK;
/* The same, kept nowhere and without its hash. */
bool prepared_make(const case_file *c, const task *watch, prepared *out, err *e) MUST_CHECK;
/* The hash of everything it depends on. */
bool prepared_hash(const case_file *c, char text[HASH_TEXT_SIZE], err *e) MUST_CHECK;
void prepared_free(prepared *p);
