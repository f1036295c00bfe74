/* command: what the verbs of the command line share: the options of all, messages, progress, interruption. */
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

/* argp child for --json, -q, --progress and -j N (which is applied at once); its input is a command_options. */
extern const struct argp_child command_common[];

/* argp_error, of one line whatever it quotes. Does not return while a command line is read. */
void command_usage(const struct argp_state *state, const char *fmt, ...) PRINTF_LIKE(2, 3);
/* A path or name as it may be shown: control bytes are \xNN. Good until four more were asked for. */
const char *command_shown(const char *text);
/* "gnathos: text" on stderr; returns the exit status. */
int command_fail(const err *e);
/* A line of advice or warning on stderr, unless -q. */
void command_note(const command_options *o, const char *fmt, ...) PRINTF_LIKE(2, 3);
/* Issues on stderr as "gnathos: file:line: field: text", errors plain, others with their level; with -q
 * errors only. */
void command_print_issues(const command_options *o, const issue_list *issues);
/* The task of a verb: its progress goes to stderr, its notes are command_note, SIGINT stops it. o must outlive it. */
task command_task(const command_options *o);
/* On stderr: a line where it is a terminal or --progress=plain, a JSON line with --progress=json. fraction < 0:
 * not known. */
void command_progress_at(const command_options *o, const char *stage, double fraction);
/* What is being done from here on, for the message of a process that runs out of memory; each stage of progress is a
 * step too. */
void command_step(const char *step);
/* Ends the process with that message and ERR_RESOURCE; nothing half done stays. Allocates nothing; any thread may call.
 */
_Noreturn void command_out_of_memory(size_t bytes);
/* Prints a record, as json_file_write puts it into a file, and frees it. */
void command_print_record(json_t *record);

/* True after SIGINT or SIGTERM: stop at the next safe point, remove what is half done, return ERR_INTERRUPTED. Who has
 * not done so 1.5 s later is ended. */
bool command_interrupted(void);
