/* verb: what a verb of the command line is, and what it is handed when it runs.
 *
 * A verb lives in app/cli/NAME.c and describes itself by one `const verb verb_NAME`. To add one: declare it below, give
 * it a row in the table of main.c and its file a line in app/cli/CMakeLists.txt. The runner (run.c) reads the command
 * line, opens what the verb needs, calls it, frees everything and maps a refusal to the exit status, one of err_code.
 *
 *     command line -> case -> landmarks -> early() -> plan -> output folder -> what is prepared -> run()
 *
 * so that a wrong word, plan or folder is told before the minutes of preparation. Results go to stdout, messages to
 * stderr. */
#pragma once
#include "app/cli/command.h"
#include "app/planner/plan/plan_moves.h"
#include "app/planner/store/output_dir.h"
#if GNATHOS_WITH_CGAL
#include "app/planner/patient/prepared.h"
#endif

typedef enum verb_need {
    NEED_CASE = 1,          /* argument[0] is a case */
    NEED_POINTS = 2,        /* its landmarks */
    NEED_PLAN = 4,          /* plan_path where it is named; a move beyond a limit's stop range is refused */
    NEED_PLAN_JUDGED = 8,   /* the same, limits are not asked: the verb judges */
    NEED_PLAN_OF_CASE = 16, /* with one of the two: CASE/plan.json where no plan is named */
    NEED_OUTPUT = 32,       /* the folder out_path where it is named */
    NEED_PREPARED = 64      /* what depends on the case alone */
} verb_need;

enum { KEY_CACHE = 300, KEY_OWN, KEY_MOST = 340 }; /* of options without a letter; a verb's own from KEY_OWN on */

struct verb;
typedef struct run_context {
    const struct verb *verb;
    unsigned need; /* the verb's; its parse may change it */
    /* from the command line */
    command_options common;
    const char *argument[2], *plan_path, *out_path, *cache;
    const char *given[KEY_MOST]; /* by key, what an option was given that has a value */
    bool force;
    void *own; /* options of the verb */
    /* opened, and freed after run() */
    task watch;
    case_file patient;
    landmarks points;
    plan_file plan;
    plan_moves moves;
    output_dir dir; /* run() closes it, what is not closed is abandoned */
#if GNATHOS_WITH_CGAL
    prepared prepared;
#endif
    clock_span start; /* clock_now() before anything was opened */
    int status;       /* exit status where run() does not refuse */
} run_context;

typedef struct verb {
    const char *arguments, *about;     /* for --help */
    const struct argp_option *options; /* all but those of every verb (command.h); NULL: none */
    int argument_count;                /* at most */
    /* what is said where it is missing; NULL: it may be missing */
    const char *missing_argument, *missing_plan, *missing_output;
    unsigned need;
    size_t own_size;
    void (*defaults)(void *own); /* NULL: zeros */
    /* The verb's own options and checks, by the rules of argp; asked before OPTION_PLAN and the like. NULL: none. */
    error_t (*parse)(int key, char *arg, run_context *r, struct argp_state *state);
    const int
        *often; /* keys of options with a value that may be given often, 0 at the end; all others once. NULL: none */
    bool (*early)(run_context *r, err *e); /* what can be told once case and landmarks are read; NULL: nothing */
    bool (*run)(run_context *r, err *e);
} verb;

/* Rows of `options` that the runner reads. */
#define OPTION_PLAN(help, group)                                                                                       \
    {                                                                                                                  \
        "plan", 'p', "FILE", 0, help, group                                                                            \
    }
#define OPTION_OUTPUT(help)                                                                                            \
    {                                                                                                                  \
        "output", 'o', "DIR", 0, help, 0                                                                               \
    }
#define OPTION_FORCE                                                                                                   \
    {                                                                                                                  \
        "force", 'f', NULL, 0, "Replace an earlier output in DIR", 0                                                   \
    }
#define OPTION_CACHE                                                                                                   \
    {                                                                                                                  \
        "cache", KEY_CACHE, "DIR", 0, "Keep what is prepared in DIR instead of CASE/prepared", 0                       \
    }

/* Runs a verb; argv[0] is "gnathos <verb>". Returns the exit status. Leaves by itself (argp) on a wrong command line.
 */
int verb_run(const verb *v, int argc, char **argv);
/* What NEED_PREPARED does, for verbs that do something before: fills r->prepared and tells what is doubtful about the
 * case, in the words of gnathos check. */
bool verb_prepare_case(run_context *r, err *e) MUST_CHECK;

extern const verb verb_audit, verb_ceph, verb_check, verb_compare, verb_cut, verb_export, verb_fit, verb_help,
    verb_identities, verb_import, verb_landmarks, verb_new, verb_predict, verb_prepare, verb_render, verb_report,
    verb_stress, verb_study, verb_template;

typedef struct verb_row {
    const char *name, *help;
    const verb *verb; /* NULL: refused with `refusal` */
    const char *refusal;
} verb_row;
extern const verb_row verbs[];
extern const int verb_count;
