/* gnathos prepare CASE: everything that does not depend on a plan, made and kept. */
#include "app/cli/prepared_print.h"
#include "app/cli/verb.h"
#include "app/planner/patient/prepared_report.h"
#include <stdio.h>

static const struct argp_option options[] = {OPTION_CACHE, {0}};

static bool run(run_context *r, err *e)
{
    (void)e;
    const prepared *p = &r->prepared;
    if (r->common.json) {
        command_print_record(prepared_record_json(p));
    } else {
        printf("%s: %s, %.16s\n", r->patient.name, p->reused ? "was prepared already" : "prepared", p->hash);
        prepared_print(p);
    }
    return true;
}

const verb verb_prepare = {.arguments = "CASE",
                           .about =
                               "Repair and cut the bones of a case and mesh its soft tissue, once; plans reuse it.",
                           .options = options,
                           .argument_count = 1,
                           .missing_argument = "name a case",
                           .need = NEED_CASE | NEED_PREPARED,
                           .run = run};
