/* command: what the verbs of the command line share.
 *
 * A verb lives in app/command_<verb>.c, which defines `int command_<verb>(int argc, char **argv)`. To add
 * one: declare it below, name it in the table of main.c, and name its file in app/CMakeLists.txt. argv[0] is
 * "gnathos <verb>". Results go to stdout, messages to stderr; the return value is the exit status, one of
 * err_code. The pattern:
 *
 *     struct input { command_options common; const char *case_path; };
 *     static error_t parse(int key, char *arg, struct argp_state *state) {
 *         struct input *in = state->input;
 *         switch (key) {
 *         case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
 *         case ARGP_KEY_ARG: return command_take(arg, &in->case_path, 1, state);
 *         case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
 *         default: return ARGP_ERR_UNKNOWN;
 *         }
 *     }
 *     int command_cut(int argc, char **argv) {
 *         static const struct argp argp = {NULL, parse, "CASE", "Cut the bones of a case.", command_common,
 * NULL, NULL}; struct input in = {0}; argp_parse(&argp, argc, argv, 0, NULL, &in);       // leaves with
 * status 2 by itself err e = {0};
 *         ... if (!work(&e)) return command_fail(&e);
 *         return 0;
 *     }
 */
#pragma once
#include "app/planner/store/issue.h"
#include "app/planner/store/task.h"
#include <argp.h>
#include "geometry/json_file.h"

typedef enum command_progress { PROGRESS_AUTO, PROGRESS_PLAIN, PROGRESS_JSON, PROGRESS_NONE } command_progress;

typedef struct command_options {
    bool json;  /* --json: the result as one JSON object */
    bool quiet; /* -q: errors only */
    command_progress progress;
} command_options;

/* argp child for --json, -q, --progress and -j N (which is applied at once); its input is a command_options.
 */
extern const struct argp_child command_common[];

/* Puts a plain argument into the next slot of `slot` that is NULL; refuses (usage) one too many. */
error_t command_take(char *arg, const char **slot, int slots, struct argp_state *state);

/* "gnathos: text" on stderr; returns the exit status. */
int command_fail(const err *e);
/* A line of advice or warning on stderr, unless -q. */
void command_note(const command_options *o, const char *fmt, ...) PRINTF_LIKE(2, 3);
/* Issues on stderr as "gnathos: file:line: field: text", errors plain, others with their level; with -q
 * errors only. */
void command_print_issues(const command_options *o, const issue_list *issues);
/* On stderr: a line where it is a terminal or --progress=plain, a JSON line with --progress=json. fraction <
 * 0: not known. */
/* The task of a verb: its progress goes to stderr, its notes are command_note, SIGINT stops it. o must outlive it. */
task command_task(const command_options *o);
void command_progress_at(const command_options *o, const char *stage, double fraction);
/* Prints the object with "schema" ("gnathos.<verb>.1") and "version" set, and frees it. */
void command_print_json(json_t *object, const char *verb_name);

/* True after SIGINT: stop at the next safe point, remove what is half done, return ERR_INTERRUPTED. */
bool command_interrupted(void);

int command_audit(int argc, char **argv);
int command_ceph(int argc, char **argv);
int command_check(int argc, char **argv);
int command_compare(int argc, char **argv);
int command_cut(int argc, char **argv);
int command_export(int argc, char **argv);
int command_import(int argc, char **argv);
int command_new(int argc, char **argv);
int command_help(int argc, char **argv);
int command_prepare(int argc, char **argv);
int command_predict(int argc, char **argv);
int command_render(int argc, char **argv);
int command_report(int argc, char **argv);
int command_stress(int argc, char **argv);
int command_study(int argc, char **argv);

typedef struct verb {
    const char *name, *help;
    int (*run)(int argc, char **argv); /* NULL: refused with `refusal` */
    const char *refusal;
} verb;
extern const verb verbs[];
extern const int verb_count;
