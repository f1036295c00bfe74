/* check: assertions that cmocka lacks. Include instead of <cmocka.h>. */
#pragma once
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>
#include "geometry/err.h"

/* |got - want| <= tol in double (cmocka's own comparison casts to float). */
#define assert_near(got, want, tol)                                                                                    \
    do {                                                                                                               \
        double got_ = (got), want_ = (want), tol_ = (tol);                                                             \
        if (!(fabs(got_ - want_) <= tol_)) {                                                                           \
            print_error("%s = %.17g, want %.17g within %g\n", #got, got_, want_, tol_);                                \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

/* The call succeeds; prints the refusal otherwise. Declares nothing: `e` must be an err in scope. */
#define assert_ok(call)                                                                                                \
    do {                                                                                                               \
        if (!(call)) {                                                                                                 \
            print_error("%s\n", e.text);                                                                               \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

/* The call refuses with this code; clears e. */
#define assert_refused(call, want_code)                                                                                \
    do {                                                                                                               \
        assert_false(call);                                                                                            \
        assert_int_equal(e.code, want_code);                                                                           \
        e = (err){0};                                                                                                  \
    } while (0)
