/* plan_vary: a plan whose moves a program changes: bounds and remedies. */
#pragma once
#include "app/planner/plan/plan_file.h"

/* The short form of every segment becomes a long one of the same move. The only place where that is done. */
void plan_vary_open(plan_file *p, const head_frame *f);
/* The same, and the control's segment gets a long form in any case. Refuses (ERR_INPUT) a plan that moves the
 * control's segment by a matrix. */
bool plan_vary_open_for(const control *x, const head_frame *f, plan_file *p, err *e) MUST_CHECK;
double plan_vary_value(const control *x, const head_frame *f, const plan_file *p);
/* The control only; the plan was opened for it. */
void plan_vary_set(const control *x, const head_frame *f, double value, plan_file *p);
