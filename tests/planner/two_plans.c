/* A program on the planner library alone: predicts a plan, moves one of its controls 1 mm on, and predicts again.
 *   two_plans CASE bones|off CONTROL
 * The first prediction counts from opening the prepared case on. Prints seconds and counts, asserts counts, and that
 * the second face is the one that a prediction from rest gives. */
#include "app/planner/planner.h"
#include "geometry/clock.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

static void stop_on(bool ok, const err *e)
{
    if (!ok) fprintf(stderr, "%s\n", e->text);
    if (!ok) exit(1);
}

static double farthest(const prediction *a, const prediction *b)
{
    double most = 0;
    for (size_t i = 0; i < 3 * (size_t)a->skin.vertex_count; i += 3)
        most = fmax(most, vec_distance(a->skin.xyz + i, b->skin.xyz + i));
    return most;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = {"first", "second", "from rest"};
    err e = {0};
    patient p;
    patient_plan plan;
    prediction face[3];
    assert(argc == 4);
    double value, wall[4] = {clock_s()}, cpu[4] = {clock_cpu_s()};
    stop_on(patient_open(argv[1], NULL, NULL, &p, &e) && contact_kind_find(argv[2], &p.options.contact), &e);
    stop_on(patient_plan_read(&p, NULL, &plan, &e) && patient_plan_set(&p, "maxilla_advance_mm", 3, &plan, &e), &e);
    stop_on(patient_plan_set(&p, "mandible_advance_mm", -2, &plan, &e), &e);
    for (int i = 0; i < 3; i++) {
        if (i == 1) stop_on(patient_plan_value(&p, argv[3], &plan, &value, &e), &e);
        if (i == 1) stop_on(patient_plan_set(&p, argv[3], value < 0 ? value - 1 : value + 1, &plan, &e), &e);
        stop_on(i < 2 ? patient_predict(&p, &plan, NULL, &face[i], &e)
                      : prediction_make(&p.file, &p.prepared, &p.shapes, &plan.moves, &p.options, NULL, &face[i], &e),
                &e);
        wall[i + 1] = clock_s(), cpu[i + 1] = clock_cpu_s();
        printf("%-9s %7.2f s, CPU %7.2f s (solve %.2f), %3d iterations, %3d factorisations, %s\n", name[i],
               wall[i + 1] - wall[i], cpu[i + 1] - cpu[i], face[i].solve_span.cpu_s, face[i].solve.iterations,
               face[i].solve.factorisations, solve_outcome_text(face[i].solve.outcome));
        assert(face[i].solve.outcome == SOLVED && face[i].scene.left_out_nodes == 0);
    }
    printf(
        "the second takes %.2f of the first by the clock, %.2f of its CPU time; its face is %.4f mm from the one from "
        "rest, %.2f mm from the first\n",
        (wall[2] - wall[1]) / (wall[1] - wall[0]), (cpu[2] - cpu[1]) / (cpu[1] - cpu[0]), farthest(&face[1], &face[2]),
        farthest(&face[1], &face[0]));
    assert(p.prepared.reused && farthest(&face[1], &face[0]) > 0.5 && farthest(&face[1], &face[2]) < 0.01);
    assert(2 * face[1].solve.factorisations <= face[0].solve.factorisations);
    for (int i = 0; i < 3; i++) prediction_free(&face[i]);
    patient_close(&p);
    return 0;
}
