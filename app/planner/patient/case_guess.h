/* case_guess: what of a case no scan shows, because gnathos fit guessed it. */
#pragma once
#include "app/planner/patient/case_file.h"

/* The labels of "guessed": { "landmarks": [...] }; an issue for what is no list of labels. */
void case_guess_read(const json_file *f, case_guess *io, issue_list *issues);
/* The value of "guessed" as a new object. */
json_t *case_guess_json(const case_guess *g);
bool case_guess_is_any(const case_guess *g);
/* A part of which more than this is guessed is warned of. */
extern const double case_guess_told;
/* "skin 12 %, upper_teeth 100 %, 7 landmarks, the bite (mandible turned up by 5.2 deg)"; "" where there is nothing to
 * tell. */
const char *case_guess_text(const case_guess *g, char *text, size_t size);
