#include "app/planner/store/task.h"
#include <stdarg.h>
#include <stdio.h>

void task_progress(const task *t, const char *stage, double fraction)
{
    if (t && t->progress) t->progress(stage, fraction, t->context);
}

void task_note(const task *t, const char *fmt, ...)
{
    char text[512];
    va_list args;
    if (!t || !t->note) return;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    t->note(text, t->context);
}

bool task_interrupted(const task *t) { return t && t->interrupted && t->interrupted(t->context); }
