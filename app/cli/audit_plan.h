/* command_audit_plan: the part of gnathos audit that judges one plan. */
#pragma once
#include "app/cli/command.h"

typedef struct audit_plan_options {
    command_options common;
    const char *case_path, *plan, *cache;
    const char *out; /* folder for pictures and the JSON, or NULL */
    bool force;
} audit_plan_options;

/* Prints the table, or JSON. Exit status 6 where the plan goes beyond a limit and has no override. */
int command_audit_plan(const audit_plan_options *in);
