// guard: no exception leaves geometry/cgal. Private to that folder.
#pragma once
#include "geometry/err.h"
#include <CGAL/Random.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/exceptions.h>
#include <exception>
#include <new>
#include <stdexcept>

// Thrown by our own checks deep inside; becomes err_set(code, text).
struct refusal : std::runtime_error {
    err_code code;
    refusal(err_code c, const std::string &text) : std::runtime_error(text), code(c) {}
};

inline void guard_silent(const char *, const char *, const char *, int, const char *) {}

// CGAL prints failed checks to stderr before it throws, and seeds its random numbers from the clock, per thread.
inline void guard_enter()
{
    static const bool silenced = (CGAL::set_error_handler(guard_silent), CGAL::set_warning_handler(guard_silent), true);
    (void)silenced;
    CGAL::get_default_random() = CGAL::Random(0);
}

// Runs body() -> bool. `what` names the operation in the message.
template <class Body> bool guarded(err *e, const char *what, Body &&body) noexcept
{
    try {
        guard_enter();
        return body();
    } catch (const refusal &x) {
        return err_set(e, x.code, "%s: %s", what, x.what());
    } catch (const CGAL::Failure_exception &x) {
        return err_set(e, ERR_GEOMETRY, "%s: CGAL refused: %s (%s:%d)", what, x.expression().c_str(),
                       x.filename().c_str(), x.line_number());
    } catch (const std::bad_alloc &) {
        return err_set(e, ERR_RESOURCE, "%s: out of memory", what);
    } catch (const std::exception &x) {
        return err_set(e, ERR_GEOMETRY, "%s: %s", what, x.what());
    } catch (...) {
        return err_set(e, ERR_INTERNAL, "%s: unknown exception", what);
    }
}
