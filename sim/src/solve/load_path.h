/* load_path: from the bones at rest to where they go, in as many loads as it takes.
 *
 *    GUESS --- solved ----------------------------> REACHED
 *      | failed: from rest                           ^  ^
 *      v                                             |  |
 *    EVERY --- the last load is solved --------------+  |
 *      ^  `--- failed, no halving left --> STOPPED      |
 *      | failed: from rest                              |
 *    LATE ---- the last load is solved -----------------+
 *
 * and in LATE and EVERY from load to load: solved, the next one is aimed at; failed in EVERY, the step is halved, and
 * doubled again from the second load on that is solved.
 *
 * GUESS  one load, the whole way, from a guess at the result
 * LATE   steps from rest, contact at the last load only: what is held keeps in touch without it
 * EVERY  steps from rest, contact at each
 *
 * A path begins at GUESS where there is one, else at LATE where contact is held, else at EVERY. A new beginning counts
 * as a halving; where none is allowed, the first failure stops. */
#pragma once
#include <stdbool.h>

typedef enum path_phase { PATH_GUESS, PATH_LATE, PATH_EVERY, PATH_REACHED, PATH_STOPPED } path_phase;

typedef struct load_path {
    path_phase phase;
    double reached, target; /* of the load, 0..1: last solved, and being solved */
    double step, longest;   /* of the load; as asked for */
    int eased;              /* loads solved since the step was halved */
    int halvings, most_halvings;
} load_path;

/* steps >= 1 loads if all goes well. */
load_path load_path_begin(bool from_guess, bool held_contact, int steps, int most_halvings);
/* The one transition: the load up to target was solved, or failed. */
void load_path_go_on(load_path *p, bool solved);
/* Does contact, where there is any, count at the present load? */
bool load_path_touches(const load_path *p);
/* Is it the first with contact on a way from rest? */
bool load_path_first_touch(const load_path *p);
