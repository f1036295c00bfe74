/* task: how a long piece of work tells its caller where it is, and how the caller stops it. */
#pragma once
#include "geometry/err.h"

typedef struct task {
    void (*progress)(const char *stage, double fraction, void *context); /* fraction < 0: not known */
    void (*note)(const char *text, void *context);                       /* a line of advice */
    bool (*interrupted)(void *context);
    void *context;
} task;

/* A task may be NULL, and so may each of its functions: nobody listens. */
void task_progress(const task *t, const char *stage, double fraction);
void task_note(const task *t, const char *fmt, ...) PRINTF_LIKE(2, 3);
/* True: stop at the next safe point, remove what is half done, return ERR_INTERRUPTED. */
bool task_interrupted(const task *t);
