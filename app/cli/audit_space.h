/* command_audit_space: what gnathos audit does without a plan. */
#pragma once
#include "app/cli/command.h"

enum { AUDIT_WORDS_MAX = 10 };

typedef struct audit_space_options {
    command_options common;
    const char *case_path, *out, *cache, *around;
    bool force, no_pictures, geometry_only;
    double spacing, tolerance;
    int word_count;
    const char *word[AUDIT_WORDS_MAX]; /* of --line, --pair, --box */
    int axis_count[AUDIT_WORDS_MAX];   /* 1, 2, 3 */
} audit_space_options;

int command_audit_space(const audit_space_options *in);
