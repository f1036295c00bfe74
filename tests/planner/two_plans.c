/* A program on the planner library alone: predicts a plan, moves one of its controls 1 mm on, and predicts again.
 *   two_plans CASE bones|off CONTROL
 * The first prediction counts from opening the prepared case on. Prints seconds and counts of both; asserts counts, and
 * that the second face is the one that a prediction from rest gives. */
#include "app/planner/planner.h"
#include "geometry/clock.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

static const double face_mm = 0.01; /* that two ways to one equilibrium may differ by */

static void stop_on(bool ok, const err *e)
{
    if (ok) return;
    fprintf(stderr, "%s\n", e->text);
    exit(1);
}

static double farthest(const surface *a, const surface *b)
{
    double most = 0;
    assert(a->vertex_count == b->vertex_count && a->vertex_count > 0);
    for (size_t i = 0; i < 3 * (size_t)a->vertex_count; i += 3) most = fmax(most, vec_distance(a->xyz + i, b->xyz + i));
    return most;
}

static void tell(const char *which, const prediction *p, double wall_s, double cpu_s)
{
    const equilibrium *q = &p->solve;
    printf("%-9s %8.2f s, CPU %8.2f s (solve %.2f), %3d iterations, %3d factorisations, %s\n", which, wall_s, cpu_s,
           p->cpu_s, q->iterations, q->factorisations, solve_outcome_text(q->outcome));
    assert(q->outcome == SOLVED && p->skin.vertex_count > 0 && p->scene.full && p->scene.left_out_nodes == 0);
}

int main(int argc, char **argv)
{
    err e = {0};
    patient p;
    patient_plan plan;
    prediction face[3]; /* of the first plan, of the second, of the second from rest */
    assert(argc == 4);
    double wall[4], cpu[4], value;
    setvbuf(stdout, NULL, _IOLBF, 0);
    wall[0] = clock_s(), cpu[0] = clock_cpu_s();
    stop_on(patient_open(argv[1], NULL, NULL, &p, &e), &e);
    stop_on(p.prepared.reused && contact_kind_find(argv[2], &p.options.contact), &e);
    stop_on(patient_plan_read(&p, NULL, &plan, &e) && patient_plan_set(&p, "maxilla_advance_mm", 3, &plan, &e) &&
                patient_plan_set(&p, "mandible_advance_mm", -2, &plan, &e),
            &e);
    stop_on(patient_predict(&p, &plan, NULL, &face[0], &e), &e);
    wall[1] = clock_s(), cpu[1] = clock_cpu_s();
    stop_on(patient_plan_value(&p, argv[3], &plan, &value, &e) &&
                patient_plan_set(&p, argv[3], value < 0 ? value - 1 : value + 1, &plan, &e),
            &e);
    stop_on(patient_predict(&p, &plan, NULL, &face[1], &e), &e);
    wall[2] = clock_s(), cpu[2] = clock_cpu_s();
    stop_on(prediction_make(&p.file, &p.prepared, &p.shapes, &plan.moves, &p.options, NULL, &face[2], &e), &e);
    wall[3] = clock_s(), cpu[3] = clock_cpu_s();
    for (int i = 0; i < 3; i++)
        tell(i == 0 ? "first" : i == 1 ? "second" : "from rest", &face[i], wall[i + 1] - wall[i], cpu[i + 1] - cpu[i]);
    double off = farthest(&face[1].skin, &face[2].skin), moved = farthest(&face[0].skin, &face[1].skin);
    printf("the second takes %.2f of the first by the clock, %.2f of its CPU time; its face is %.4f mm from the one "
           "from rest, %.2f mm from the first\n",
           (wall[2] - wall[1]) / (wall[1] - wall[0]), (cpu[2] - cpu[1]) / (cpu[1] - cpu[0]), off, moved);
    assert(moved > 0.5 && off < face_mm);
    assert(2 * face[1].solve.factorisations <= face[0].solve.factorisations);
    for (int i = 0; i < 3; i++) prediction_free(&face[i]);
    patient_close(&p);
    return 0;
}
