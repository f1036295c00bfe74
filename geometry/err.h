/* err: the one error idiom.
 *
 * A function that can refuse its input returns bool and takes `err *e` last. false means: *e is filled,
 * outputs are untouched, nothing leaked. The first failure wins: err_set on a filled err keeps the old text.
 * Three things are never mixed: wrong input -> err; a computation that did not succeed -> a field of the
 * result; our own bug -> assert, on in every build. Only app/ prints and exits. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define MUST_CHECK __attribute__((warn_unused_result))
#define PRINTF_LIKE(f, a) __attribute__((format(printf, f, a)))

/* The value of each code is the exit status of the command line. */
typedef enum err_code {
    ERR_NONE = 0,
    ERR_INTERNAL = 1,      /* our fault */
    ERR_USAGE = 2,         /* the command line is wrong */
    ERR_INPUT = 3,         /* an input file is wrong or missing */
    ERR_GEOMETRY = 4,      /* the geometry is unusable */
    ERR_NOT_CONVERGED = 5, /* the solve did not reach equilibrium */
    ERR_INFEASIBLE = 6,    /* the plan leaves a bound */
    ERR_RESOURCE = 7,      /* memory, time or disk */
    ERR_INTERRUPTED = 130
} err_code;

typedef struct err {
    err_code code;
    char text[1024]; /* one line, no newline */
} err;

/* Always return false, so that a refusal is one line: `return err_set(e, ERR_INPUT, "...", ...);` */
bool err_set(err *e, err_code code, const char *fmt, ...) PRINTF_LIKE(3, 4);
/* "path:line: field: text"; line <= 0 and NULL path or field are left out. */
bool err_at(err *e, err_code code, const char *path, int line, const char *field, const char *fmt, ...)
    PRINTF_LIKE(6, 7);
/* Puts "prefix: " before the text of a filled err; returns false. */
/* Writes each control byte of the text (size bytes in all) as \xNN, so that it is one line and does nothing to a
 * terminal; what does not fit is cut off. */
void err_printable(char *text, size_t size);
bool err_prefix(err *e, const char *fmt, ...) PRINTF_LIKE(2, 3);

#ifdef __cplusplus
}
#endif
