#include "app/planner/identity/head_model.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCKS_THAT_COUNT = HEAD_BLOCK_COUNT - 1 }; /* tissue at rest and at neutral count as one */

/* Each head from all others, and how far it is from itself then. */
static bool leave_out(const head_template *t, const double *const *phi, const double *weight, const task *watch,
                      head_model *m, err *e)
{
    int32_t count = m->modes.sample_count, length = m->modes.length;
    principal_left_out l;
    if (!principal_leave_out(phi, count, length, weight, HEAD_MODES_MOST, &l, e)) return false;
    m->left_out_modes = l.mode_count;
    m->left_out_rms_mm = NEW_ARRAY(double, l.mode_count + 1);
    for (int32_t k = 0; k <= l.mode_count; k++) m->left_out_rms_mm[k] = l.rms[k] / sqrt(BLOCKS_THAT_COUNT);
    double *made = NEW_ARRAY(double, length);
    bool ok = true;
    for (int32_t s = 0; ok && s < count; s++) {
        task_progress(watch, "each head from the others", (double)s / count);
        head_gap gap[HEAD_GAP_COUNT];
        principal_left_out_make(&l, phi, length, s, made);
        head_vector_gaps(t, made, phi[s], NULL, gap);
        for (int b = 0; b < HEAD_GAP_COUNT; b++) {
            m->left_out[b].mean_mm += gap[b].mean_mm / count;
            m->left_out[b].p95_mm += gap[b].p95_mm / count;
            m->left_out[b].max_mm = fmax(m->left_out[b].max_mm, gap[b].max_mm);
        }
        ok = !task_interrupted(watch) || err_set(e, ERR_INTERRUPTED, "interrupted");
    }
    free(made);
    principal_left_out_free(&l);
    return ok;
}

bool head_model_learn(const head_template *t, const double *const *phi, const char *const *name, int32_t count,
                      const task *watch, head_model *out, err *e)
{
    if (count < 3)
        return err_set(e, ERR_GEOMETRY, "%d heads: a model is learnt from at least three, better a hundred", count);
    head_model m = {0};
    memcpy(m.numbering, t->numbering, sizeof m.numbering);
    head_layout l = head_layout_of(t);
    double *weight = head_vector_weights(t);
    task_progress(watch, "main directions", -1);
    bool ok = principal_learn(phi, count, l.start[HEAD_BLOCK_COUNT], weight, HEAD_MODES_MOST, &m.modes, e);
    if (ok) {
        m.name = mem_alloc((size_t)count, sizeof *m.name);
        for (int32_t s = 0; s < count; s++) strncpy(m.name[s], name[s], sizeof m.name[s] - 1);
        m.score = NEW_ARRAY(double, (size_t)count *(size_t)m.modes.mode_count);
        for (int32_t s = 0; s < count; s++)
            principal_project(&m.modes, phi[s], m.score + (size_t)s * (size_t)m.modes.mode_count);
        ok = leave_out(t, phi, weight, watch, &m, e);
    }
    free(weight);
    if (ok)
        *out = m;
    else
        head_model_free(&m);
    return ok;
}

void head_model_free(head_model *m)
{
    principal_free(&m->modes);
    free(m->name);
    free(m->score);
    free(m->left_out_rms_mm);
    *m = (head_model){0};
}

/* S. Vigna's splitmix64. */
static uint64_t next_bits(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static double uniform(uint64_t *state) { return ((double)(next_bits(state) >> 11) + 0.5) / 9007199254740992.0; }

/* Normally distributed (Box and Muller 1958), drawn again beyond 2. */
static double normal(uint64_t *state)
{
    for (;;) {
        double r = sqrt(-2 * log(uniform(state))), x = r * cos(2 * M_PI * uniform(state));
        if (fabs(x) <= 2) return x;
    }
}

void head_model_draw(const head_model *m, uint64_t *state, double *p)
{
    static const double kernel_sd = 0.5, most_sd = 3;
    int32_t modes = m->modes.mode_count;
    const double *of = m->score + (size_t)modes * (size_t)(uniform(state) * m->modes.sample_count);
    for (int32_t k = 0; k < modes; k++) {
        double x = (of[k] + kernel_sd * normal(state)) / hypot(1, kernel_sd);
        p[k] = fmax(-most_sd, fmin(most_sd, x));
    }
}
