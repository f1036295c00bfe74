/* with_template: what every test of the template of heads begins and ends with. GNATHOS_TEMPLATE names the file. */
#pragma once
#include "app/planner/identity/template_get.h"

static head_template t;

static inline int open_template(void **state)
{
    (void)state;
    err e = {0};
    if (head_template_get(NULL, &t, NULL, &e)) return 0;
    print_error("%s\n", e.text);
    return -1;
}

static inline int close_template(void **state)
{
    (void)state;
    head_template_free(&t);
    return 0;
}
