/* One case, solved and judged; in a child process, so that a crash or an endless loop is a result like others. */
#include "app/stress/stress.h"
#include "app/command.h"
#include "geometry/mem.h"
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double now_s(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static stress_result nothing_known(void)
{
    double unknown = (double)NAN;
    return (stress_result){.residual_mn = unknown, .tolerance_mn = unknown, .checked_mn = unknown,
                           .correction_mm = unknown, .energy_uj = unknown, .min_j = unknown,
                           .max_stretch = unknown, .moved_mm = unknown, .depth_mm = unknown,
                           .seconds = unknown, .cpu_s = unknown, .memory_mb = unknown};
}

static void judge(const stress_case *c, stress_result *r)
{
    static const char *const what[] = {"solved", "refused", "gave up", "crashed", "ran out of time"};
    bool right = false;
    switch ((stress_want)c->want) {
    case WANT_SOLVED: right = r->kind == STRESS_SOLVED; break;
    case WANT_REFUSED: right = r->kind == STRESS_REFUSED; break;
    case MAY_GIVE_UP: right = r->kind == STRESS_SOLVED || r->kind == STRESS_GAVE_UP; break;
    case MUST_GIVE_UP: right = r->kind == STRESS_GAVE_UP; break;
    }
    if (!right && !r->wrong[0]) snprintf(r->wrong, sizeof r->wrong, "%s", what[r->kind]);
    if (r->kind != STRESS_REFUSED || r->wrong[0]) return;
    if (r->code != c->code) snprintf(r->wrong, sizeof r->wrong, "refused with status %d, not %d", r->code, c->code);
    else if (c->words && !strstr(r->text, c->words))
        snprintf(r->wrong, sizeof r->wrong, "the refusal does not say \"%s\"", c->words);
}

stress_result stress_solve(const stress_case *c)
{
    stress_result r = nothing_known();
    stress_scene s;
    stress_scene_make(c, 0, &s);
    equilibrium_problem problem = stress_problem(&s);
    equilibrium q = {0};
    err e = {0};
    r.nodes = s.mesh.vertex_count;
    r.tets = s.mesh.tet_count;
    double begin = now_s(CLOCK_MONOTONIC), cpu = now_s(CLOCK_PROCESS_CPUTIME_ID);
    bool ok = equilibrium_solve(&problem, &s.params, &q, &e);
    r.seconds = now_s(CLOCK_MONOTONIC) - begin;
    r.cpu_s = now_s(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    if (!ok) {
        r.kind = STRESS_REFUSED;
        r.code = e.code;
        snprintf(r.text, sizeof r.text, "%.*s", (int)sizeof r.text - 1, e.text);
        if (e.code == ERR_NONE || !e.text[0]) snprintf(r.wrong, sizeof r.wrong, "refused without a reason");
    } else {
        r.kind = q.outcome == SOLVED ? STRESS_SOLVED : STRESS_GAVE_UP;
        snprintf(r.text, sizeof r.text, "%s", solve_outcome_text(q.outcome));
        r.unknowns = q.unknown_count;
        r.iterations = q.iterations;
        r.factorisations = q.factorisations;
        r.loads = q.loads;
        r.inverted = q.extremes.inverted_count;
        r.residual_mn = q.residual_mn;
        r.tolerance_mn = q.tolerance_mn;
        r.energy_uj = q.energy_uj;
        r.min_j = q.extremes.min_j;
        r.max_stretch = q.extremes.max_stretch;
        if (s.touches) r.depth_mm = q.contact.depth_mm;
        stress_verify(c, &s, &q, &r);
        equilibrium_free(&q);
    }
    stress_scene_free(&s);
    return r;
}

/* Reads the child's result; false: it ended, or the time did, before all of it was there. */
static bool receive(int from, double deadline, stress_result *r, bool *late)
{
    size_t have = 0;
    stress_result got;
    *late = false;
    while (have < sizeof got) {
        double left = deadline - now_s(CLOCK_MONOTONIC);
        struct pollfd wait = {.fd = from, .events = POLLIN};
        if (left <= 0 || app_interrupted()) {
            *late = true;
            return false;
        }
        if (poll(&wait, 1, (int)(1000 * (left < 1 ? left : 1)) + 1) <= 0) continue;
        ssize_t n = read(from, (char *)&got + have, sizeof got - have);
        if (n <= 0) return false;
        have += (size_t)n;
    }
    *r = got;
    return true;
}

stress_result stress_run(const stress_case *c, double patience)
{
    double limit = patience * (c->limit_s > 0 ? c->limit_s : 60), begin = now_s(CLOCK_MONOTONIC);
    int way[2];
    stress_result r = nothing_known();
    r.kind = STRESS_CRASHED;
    fflush(NULL);
    if (pipe(way)) {
        snprintf(r.text, sizeof r.text, "no pipe to a child process");
        return r;
    }
    pid_t child = fork();
    if (child == 0) {
        close(way[0]);
        struct rlimit no_core = {0, 0}, time = {(rlim_t)ceil(limit), (rlim_t)ceil(limit) + 5};
        setrlimit(RLIMIT_CORE, &no_core);
        setrlimit(RLIMIT_CPU, &time);
        stress_result own = stress_solve(c);
        for (size_t sent = 0; sent < sizeof own;) {
            ssize_t n = write(way[1], (const char *)&own + sent, sizeof own - sent);
            if (n <= 0) _exit(1);
            sent += (size_t)n;
        }
        _exit(0);
    }
    close(way[1]);
    bool late = false, whole = child > 0 && receive(way[0], begin + 10 * limit, &r, &late);
    close(way[0]);
    int status = 0;
    struct rusage used = {0};
    if (child > 0) {
        if (!whole && late) kill(child, SIGKILL);
        while (wait4(child, &status, 0, &used) < 0 && !app_interrupted()) {}
    }
    if (!whole && (late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))) {
        r.kind = STRESS_TIMED_OUT;
        snprintf(r.text, sizeof r.text, "no end in %.0f s", limit);
    } else if (!whole || !WIFEXITED(status) || WEXITSTATUS(status)) {
        r.kind = STRESS_CRASHED;
        if (WIFSIGNALED(status)) snprintf(r.text, sizeof r.text, "killed by signal %d", WTERMSIG(status));
        else snprintf(r.text, sizeof r.text, "ended with status %d", WEXITSTATUS(status));
    }
    r.memory_mb = (double)used.ru_maxrss / 1024;
    if (!(r.seconds >= 0)) r.seconds = now_s(CLOCK_MONOTONIC) - begin;
    judge(c, &r);
    return r;
}
