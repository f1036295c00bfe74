/* One case, solved and judged. */
#include "app/stress/stress.h"
#include "app/planner/store/child.h"
#include "geometry/clock.h"
#include <math.h>
#include <string.h>

static stress_result nothing_known(void)
{
    double unknown = (double)NAN;
    return (stress_result){.residual_mn = unknown,
                           .tolerance_mn = unknown,
                           .checked_mn = unknown,
                           .correction_mm = unknown,
                           .energy_uj = unknown,
                           .min_j = unknown,
                           .max_stretch = unknown,
                           .moved_mm = unknown,
                           .depth_mm = unknown,
                           .seconds = unknown,
                           .cpu_s = unknown,
                           .memory_mb = unknown};
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
    if (r->code != c->code)
        snprintf(r->wrong, sizeof r->wrong, "refused with status %d, not %d", r->code, c->code);
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
    double begin = clock_s(), cpu = clock_cpu_s();
    bool ok = equilibrium_solve(&problem, &s.params, &q, &e);
    r.seconds = clock_s() - begin;
    r.cpu_s = clock_cpu_s() - cpu;
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

static void solve_in_child(void *context, void *result)
{
    stress_result own = stress_solve(context);
    memcpy(result, &own, sizeof own);
}

stress_result stress_run(const stress_case *c, double patience, const task *watch)
{
    double limit = patience * (c->limit_s > 0 ? c->limit_s : 60);
    stress_result r = nothing_known();
    child_use use;
    child_end end = child_run(watch, solve_in_child, (void *)c, &r, sizeof r, limit, &use);
    if (end != CHILD_DONE) {
        r.kind = end == CHILD_CRASHED ? STRESS_CRASHED : STRESS_TIMED_OUT;
        r.seconds = use.wall_s;
        r.cpu_s = use.cpu_s;
    }
    if (end == CHILD_LATE) snprintf(r.text, sizeof r.text, "no end in %.0f s", limit);
    if (end == CHILD_CRASHED && use.signal) snprintf(r.text, sizeof r.text, "killed by signal %d", use.signal);
    if (end == CHILD_CRASHED && !use.signal) snprintf(r.text, sizeof r.text, "ended with status %d", use.status);
    r.memory_mb = use.peak_mb;
    judge(c, &r);
    return r;
}
