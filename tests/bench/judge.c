/* bench_judge CASE [COUNT [FILE]]: plans judged per second on a prepared case, at random within the limits of
 * moves. Prints how many come out at each level and a sum over the bits of all values and places, so that
 * builds can be compared; FILE gets every value. */
#include "app/planner/judge/judge.h"
#include "geometry/mem.h"
#include "geometry/clock.h"
#include "geometry/parallel.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct work {
    const judge *j;
    const plan_moves *moves;
    judgement *out;
    double *cpu_s;
} work;

static void run(int64_t begin, int64_t end, void *context)
{
    work *w = context;
    for (int64_t i = begin; i < end; i++) {
        double start = clock_read_s(CLOCK_THREAD_CPUTIME_ID); /* threads that wait do not count */
        judge_plan(w->j, &w->moves[i], &w->out[i]);
        w->cpu_s[i] = clock_read_s(CLOCK_THREAD_CPUTIME_ID) - start;
    }
}

/* FNV-1a over the bits. */
static uint64_t add_bits(uint64_t sum, const double *x, int count)
{
    const unsigned char *byte = (const unsigned char *)x;
    for (size_t i = 0; i < (size_t)count * sizeof *x; i++) sum = (sum ^ byte[i]) * 1099511628211u;
    return sum;
}

static void write_values(const judgement *out, int count, FILE *f)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < out[i].count; k++) {
            const finding *v = &out[i].finding[k];
            fprintf(f, "%d,%s,%s,%s,%.17g,%.17g,%.17g,%.17g\n", i, limit_default[v->limit].name, v->where,
                    limit_level_name(v->level), v->value, v->place[0], v->place[1], v->place[2]);
        }
}

static unsigned seed = 1;

static double draw(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed >> 8) / 16777216.0;
}

int main(int argc, char **argv)
{
    err e = {0};
    case_file c;
    prepared p = {0};
    judge *j;
    int count = argc > 2 ? atoi(argv[2]) : 200;
    if (argc < 2 || count < 1 || !case_file_load(argv[1], &c, &e) || !prepared_get(&c, NULL, NULL, &p, &e)) {
        fprintf(stderr, "bench_judge CASE [COUNT]: %s\n", e.text);
        return 1;
    }
    double start = clock_s();
    if (!judge_create(&c, &p, &j, &e)) {
        fprintf(stderr, "%s\n", e.text);
        return 1;
    }
    double made = clock_s(), cpu = 0;
    work w = {.j = j, .out = NEW_ARRAY(judgement, count), .cpu_s = NEW_ARRAY(double, count)};
    plan_moves *moves = NEW_ARRAY(plan_moves, count);
    for (int i = 0; i < count; i++) {
        issue_list ignored = {0};
        plan_file plan = plan_file_default();
        const segment_id long_form[2] = {SEGMENT_MAXILLA, SEGMENT_DISTAL};
        for (int k = 0; k < 2; k++) {
            plan_segment *s = &plan.segment[long_form[k]];
            s->move = (segment_move){.kind = MOVE_ANGLES, .pitch_deg = draw(-3, 3), .yaw_deg = draw(-3, 3)};
            s->move.translate_mm[0] = draw(-3, 3);
            s->move.translate_mm[1] = k ? draw(-12, 10) : draw(-8, 5);
            s->move.translate_mm[2] = draw(-4, 5);
        }
        plan.segment[SEGMENT_CHIN].short_form = true;
        plan.value[CONTROL_CHIN_ADVANCE] = draw(-5, 10);
        if (!plan_moves_set(&plan, &c, &p.points, &moves[i], &ignored)) return 1;
        issue_list_free(&ignored);
    }
    w.moves = moves;
    parallel_for(count, 1, run, &w);
    double wall = clock_s() - made;
    for (int i = 0; i < count; i++) cpu += w.cpu_s[i];
    int level[4] = {0}, reason[LIMIT_COUNT] = {0};
    uint64_t sum = 14695981039346656037u;
    for (int i = 0; i < count; i++) {
        const judgement *out = &w.out[i];
        level[out->worst]++;
        if (out->reason >= 0) reason[out->finding[out->reason].limit]++;
        for (int k = 0; k < out->count; k++) {
            sum = add_bits(sum, &out->finding[k].value, 1);
            if (out->finding[k].has_place) sum = add_bits(sum, out->finding[k].place, 3);
        }
    }
    printf("%s: made in %.2f s; %d plans on %d threads in %.2f s: %.0f per second, %.2f ms of processor each\n", c.name,
           made - start, count, parallel_threads(), wall, count / wall, 1e3 * cpu / count);
    printf("fine %d, caution %d, stop %d; decided by", level[LIMIT_FINE], level[LIMIT_CAUTION], level[LIMIT_STOP]);
    for (int l = 0; l < LIMIT_COUNT; l++)
        if (reason[l]) printf(" %s %d", limit_default[l].name, reason[l]);
    printf("; values %016llx\n", (unsigned long long)sum);
    FILE *f = argc > 3 ? fopen(argv[3], "w") : NULL;
    if (f) {
        write_values(w.out, count, f);
        fclose(f);
    }
    free(moves);
    free(w.out);
    free(w.cpu_s);
    judge_free(&j);
    prepared_free(&p);
    return 0;
}
