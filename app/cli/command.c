#include "app/cli/command.h"
#include "geometry/parallel.h"
#include "geometry/write_whole.h"
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

enum { KEY_JSON = 256, KEY_PROGRESS, THREADS_MAX = 1024 };

static const struct argp_option options[] = {
    {"json", KEY_JSON, NULL, 0, "Print the result as one JSON object", -2},
    {"progress", KEY_PROGRESS, "HOW", 0, "auto (a line on a terminal), plain, json or none", -2},
    {"quiet", 'q', NULL, 0, "Print errors only", -2},
    {"jobs", 'j', "N", 0, "Use N threads; results do not depend on it (one per core where absent)", -2},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    static const char *const how[] = {"auto", "plain", "json", "none"};
    command_options *o = state->input;
    char *end;
    long n;
    switch (key) {
    case KEY_JSON: o->json = true; return 0;
    case 'q': o->quiet = true; return 0;
    case 'j':
        n = strtol(arg, &end, 10);
        if (end == arg || *end || n < 1 || n > THREADS_MAX)
            command_usage(state, "-j %s: must be a whole number from 1 to %d", arg, THREADS_MAX);
        else
            parallel_set_threads((int)n);
        return 0;
    case KEY_PROGRESS:
        for (int i = 0; i < 4; i++) {
            if (strcmp(arg, how[i])) continue;
            o->progress = (command_progress)i;
            return 0;
        }
        command_usage(state, "--progress=%s: must be auto, plain, json or none", arg);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp common = {options, parse, NULL, NULL, NULL, NULL, NULL};
const struct argp_child command_common[] = {{&common, 0, "", -2}, {0}};

void command_usage(const struct argp_state *state, const char *fmt, ...)
{
    char text[2048];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    err_printable(text, sizeof text);
    argp_error(state, "%s", text);
}

const char *command_shown(const char *text)
{
    enum { KEPT = 4 };
    static char shown[KEPT][4096];
    static int last;
    last = (last + 1) % KEPT;
    snprintf(shown[last], sizeof shown[last], "%s", text);
    err_printable(shown[last], sizeof shown[last]);
    return shown[last];
}

int command_fail(const err *e)
{
    fprintf(stderr, "gnathos: %s\n", e->text);
    return (int)e->code;
}

void command_note(const command_options *o, const char *fmt, ...)
{
    if (o->quiet) return;
    va_list args;
    va_start(args, fmt);
    fputs("gnathos: ", stderr);
    vfprintf(stderr, fmt, args);
    fputc('\n', stderr);
    va_end(args);
}

void command_print_issues(const command_options *o, const issue_list *issues)
{
    for (int i = 0; i < issues->count; i++) {
        const issue *one = &issues->item[i];
        if (o->quiet && one->level != ISSUE_ERROR) continue;
        fputs("gnathos: ", stderr);
        if (one->file && one->line > 0)
            fprintf(stderr, "%s:%d: ", one->file, one->line);
        else if (one->file)
            fprintf(stderr, "%s: ", one->file);
        if (one->field) fprintf(stderr, "%s: ", one->field);
        if (one->level != ISSUE_ERROR) fprintf(stderr, "%s: ", issue_level_name(one->level));
        fprintf(stderr, "%s\n", one->text);
    }
    for (int l = ISSUE_ERROR; l <= ISSUE_INFO; l++)
        if (issues->left_out[l] && (l == ISSUE_ERROR || !o->quiet))
            fprintf(stderr, "gnathos: and %d more of the kind \"%s\"\n", issues->left_out[l],
                    issue_level_name((issue_level)l));
}

static char step_now[64] = "start"; /* read by a process about to end, whichever thread is the one */

void command_step(const char *step) { snprintf(step_now, sizeof step_now, "%s", step); }

void command_out_of_memory(size_t bytes)
{
    char text[160];
    int n = snprintf(text, sizeof text, "gnathos: %s: out of memory (%zu bytes cannot be had)\n", step_now, bytes);
    (void)!write(STDERR_FILENO, text, (size_t)n);
    whole_folder_abandon_all();
    _exit(ERR_RESOURCE);
}

void command_progress_at(const command_options *o, const char *stage, double fraction)
{
    command_step(stage);
    bool line = o->progress == PROGRESS_PLAIN || (o->progress == PROGRESS_AUTO && !o->quiet && isatty(2));
    if (o->progress == PROGRESS_JSON) {
        json_t *p = json_pack("{s:s}", "stage", stage);
        if (fraction >= 0) json_object_set_new(p, "fraction", json_real(fraction));
        char *text = json_dumps(p, JSON_COMPACT | JSON_REAL_PRECISION(4));
        fprintf(stderr, "%s\n", text);
        free(text);
        json_decref(p);
    } else if (line && fraction >= 0) {
        fprintf(stderr, "%s: %.0f %%\n", stage, 100 * fraction);
    } else if (line) {
        fprintf(stderr, "%s\n", stage);
    }
}

void command_print_record(json_t *record)
{
    json_dumpf(record, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    putchar('\n');
    json_decref(record);
}

static volatile sig_atomic_t interrupted;

static void on_interrupt(int number)
{
    const struct itimerval patience = {.it_value = {.tv_sec = 1, .tv_usec = 500000}};
    (void)number;
    interrupted = 1;
    setitimer(ITIMER_REAL, &patience, NULL);
}

bool command_interrupted(void) { return interrupted != 0; }

static void tell_progress(const char *stage, double fraction, void *context)
{
    command_progress_at(context, stage, fraction);
}

static void tell_note(const char *text, void *context) { command_note(context, "%s", text); }

static bool was_interrupted(void *context)
{
    (void)context;
    return command_interrupted();
}

task command_task(const command_options *o) { return (task){tell_progress, tell_note, was_interrupted, (void *)o}; }

/* Where nothing asks (CGAL and libraries that draw have no way to be asked) the process ends all the same; results
 * appear whole or not at all, so nothing half done is seen. */
static void on_deadline(int number)
{
    static const char text[] = "gnathos: interrupted\n";
    (void)number;
    (void)!write(STDERR_FILENO, text, sizeof text - 1);
    whole_folder_abandon_all();
    _exit(ERR_INTERRUPTED);
}

/* The second SIGINT or SIGTERM ends the process at once. */
__attribute__((constructor)) static void listen_for_interrupt(void)
{
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = SA_RESETHAND | SA_RESTART};
    struct sigaction deadline = {.sa_handler = on_deadline};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGALRM, &deadline, NULL);
}
