/* child: work in a process of its own, so that a crash, an endless loop or a peak of memory is a result like
 * others. */
#pragma once
#include "app/planner/store/task.h"
#include <stdbool.h>
#include <stddef.h>

typedef enum child_end {
    CHILD_DONE,
    CHILD_CRASHED, /* a signal, an assertion, no memory */
    CHILD_LATE,    /* out of processor time, or out of ten times that by the wall */
    CHILD_INTERRUPTED
} child_end;

typedef struct child_use {
    double wall_s, cpu_s, peak_mb; /* of the whole process */
    int signal, status;            /* with which it ended */
} child_use;

/* Fills `size` bytes at result, plain data. */
typedef void child_body(void *context, void *result);

/* The caller must not have started threads yet. *result is written only at CHILD_DONE. */
child_end child_run(const task *watch, child_body *body, void *context, void *result, size_t size, double cpu_limit_s,
                    child_use *use);
