/* head_gather: many heads as vectors, each worked out on one thread and as many at once as there are threads, kept in a
 * journal as they come: after an interruption the same work goes on where it was. */
#pragma once
#include "app/planner/identity/head_vector.h"
#include "app/planner/store/task.h"

typedef struct head_source {
    int32_t count;
    const char *const *name; /* [count] */
    /* Shape of head i in the template's numbering, in any frame; the caller frees *out. Called by several threads at
     * once. A refusal of ERR_GEOMETRY or ERR_NOT_CONVERGED is that head's alone, any other ends the work. */
    bool (*shape)(void *context, int32_t i, head_shape *out, err *e);
    void *context;
} head_source;

typedef struct head_set {
    int32_t count;     /* heads that were gathered, in the order of the source */
    double **phi;      /* [count][length of head_layout_of] in their Frankfort frames */
    const char **name; /* [count] borrowed from the source */
    int32_t refused;   /* heads that could not be had */
    double seconds;    /* wall, of those that were not in the journal */
    int32_t fresh;     /* so many */
} head_set;

/* key: a hash of all that the source depends on besides its names. The journal stays when the work is done; delete it
 * when what was made of the heads is kept. One of other work is refused (ERR_INPUT), or with `anew` begun again. Each
 * head that is refused is told as a note; refuses, with the first reason, where they are more than one in ten, and
 * (ERR_INTERRUPTED) when stopped. The caller frees *out. */
bool head_gather(const head_template *t, const head_source *from, const char *key, const char *journal_path, bool anew,
                 const task *watch, head_set *out, err *e) MUST_CHECK;
void head_set_free(head_set *s);
