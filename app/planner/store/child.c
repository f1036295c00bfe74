#include "app/planner/store/child.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static _Noreturn void work(child_body *body, void *context, size_t size, double cpu_limit_s, int to, pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* who waits may be killed: nobody wants the result then */
    if (getppid() != parent) _exit(1);
    struct rlimit no_core = {0, 0}, time = {(rlim_t)ceil(cpu_limit_s), (rlim_t)ceil(cpu_limit_s) + 5};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_CPU, &time);
    char *result = NEW_ARRAY(char, size);
    body(context, result);
    for (size_t sent = 0; sent < size;) {
        ssize_t n = write(to, result + sent, size - sent);
        if (n <= 0) _exit(1);
        sent += (size_t)n;
    }
    _exit(0);
}

/* CHILD_CRASHED: the other end closed before all was there. */
static child_end receive(const task *watch, int from, double deadline, char *result, size_t size)
{
    size_t have = 0;
    while (have < size) {
        if (task_interrupted(watch)) return CHILD_INTERRUPTED;
        double left = deadline - clock_s();
        if (left <= 0) return CHILD_LATE;
        struct pollfd wait = {.fd = from, .events = POLLIN};
        if (poll(&wait, 1, (int)(1000 * fmin(left, 0.5)) + 1) <= 0) continue;
        ssize_t n = read(from, result + have, size - have);
        if (n <= 0) return CHILD_CRASHED;
        have += (size_t)n;
    }
    return CHILD_DONE;
}

child_end child_run(const task *watch, child_body *body, void *context, void *result, size_t size, double cpu_limit_s,
                    child_use *use)
{
    double begin = clock_s();
    int way[2], status = 0;
    struct rusage used = {0};
    *use = (child_use){0};
    fflush(NULL);
    if (pipe(way)) return CHILD_CRASHED;
    pid_t parent = getpid(), child = fork();
    if (child == 0) {
        close(way[0]);
        work(body, context, size, cpu_limit_s, way[1], parent);
    }
    close(way[1]);
    char *got = NEW_ARRAY(char, size);
    child_end end = child < 0 ? CHILD_CRASHED : receive(watch, way[0], begin + 10 * cpu_limit_s, got, size);
    close(way[0]);
    if (child > 0) {
        if (end == CHILD_LATE || end == CHILD_INTERRUPTED) kill(child, SIGKILL);
        wait4(child, &status, 0, &used);
    }
    use->wall_s = clock_s() - begin;
    use->cpu_s = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                 1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    use->peak_mb = (double)used.ru_maxrss / 1024;
    use->signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    use->status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    if (end == CHILD_CRASHED && use->signal == SIGXCPU) end = CHILD_LATE;
    if (end == CHILD_DONE) memcpy(result, got, size);
    free(got);
    return end;
}
