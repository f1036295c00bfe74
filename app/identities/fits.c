#include "app/identities/fits.h"
#include "app/planner/identity/fit_file.h"
#include "app/planner/identity/template_get.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double guessed_told = 0.1;

static bool is_fit(const char *path, char pack[FIELD_PATH_SIZE])
{
    snprintf(pack, FIELD_PATH_SIZE, "%s/fit.pack", path);
    return !access(pack, F_OK);
}

bool fits_case(const head_template *t, const char *path, const task *watch, head_fit *out, char *name, size_t name_size,
               err *e)
{
    char pack[FIELD_PATH_SIZE];
    snprintf(name, name_size, "%s", path);
    if (is_fit(path, pack)) return head_fit_read(t, pack, out, e);
    case_file c;
    head_scan scan = {0};
    head_fit_params p = head_fit_params_default();
    bool ok = case_file_load(path, &c, e) && head_scan_read(&c, *c.landmarks != 0, &scan, e) &&
              (head_fit_is_numbered(t, &scan) ? head_fit_numbered(t, &scan, watch, out, e)
                                              : head_fit_make(t, &scan, &p, watch, out, e));
    if (ok) snprintf(name, name_size, "%s", c.name);
    head_scan_free(&scan);
    return ok;
}

double fits_guessed(const head_template *t, const head_fit *f, case_surface part)
{
    int32_t count = t->part[part].vertex_count, guessed = 0;
    for (int32_t i = 0; i < count; i++) guessed += f->guessed[part][i] != 0;
    return (double)guessed / count;
}

static norm_head_params norm_params(const identities_learn *p, int32_t i)
{
    norm_head_params n = norm_head_params_default();
    n.sex = i % 2 ? NORM_MALE : NORM_FEMALE;
    n.skeletal_class = 1 + i / 2 % 3;
    n.seed = p->seed + (uint64_t)i;
    return n;
}

/* As coarse as the template, a norm head has its numbering. */
static bool norm_head_of(const fits_source *s, int32_t i, const task *watch, head_fit *out, err *e)
{
    norm_head_params p = norm_params(s->p, i);
    norm_head h;
    if (!norm_head_shape(s->mean, &p, &h, e)) return false;
    const head_scan scan = {.part = {[CASE_SKIN] = h.skin,
                                     [CASE_SKULL] = h.skull,
                                     [CASE_MANDIBLE] = h.mandible,
                                     [CASE_UPPER_TEETH] = h.upper_teeth,
                                     [CASE_LOWER_TEETH] = h.lower_teeth}};
    bool ok = head_fit_numbered(s->t, &scan, watch, out, e);
    norm_head_free(&h); /* what the scan borrowed */
    return ok;
}

/* Many at once: none tells its own progress. */
static bool shape_of(void *context, int32_t i, head_shape *out, err *e)
{
    const fits_source *s = context;
    task quiet = {0};
    if (s->watch) quiet = (task){.interrupted = s->watch->interrupted, .context = s->watch->context};
    char name[FIELD_TEXT_SIZE];
    head_fit f;
    bool ok = i < s->p->case_count ? fits_case(s->t, s->p->cases[i], &quiet, &f, name, sizeof name, e)
                                   : norm_head_of(s, i - s->p->case_count, &quiet, &f, e);
    if (!ok) return false;
    double guessed = fits_guessed(s->t, &f, CASE_SKIN);
    if (i < s->p->case_count && guessed > guessed_told)
        task_note(s->watch, "%s: %.0f %% of its skin is not in the scan and guessed, which the model learns as it is",
                  s->names[i], 100 * guessed);
    *out = f.shape;
    f.shape = (head_shape){0};
    head_fit_free(&f);
    return true;
}

/* All that a fit depends on. */
static bool hash_case(content_hash *h, const char *path, err *e)
{
    char pack[FIELD_PATH_SIZE];
    if (is_fit(path, pack)) return content_hash_file(h, "fit", pack, e);
    case_file c;
    if (!case_file_load(path, &c, e)) return false;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++)
        if (!content_hash_file(h, case_surface_name((case_surface)i), c.surface[i], e)) return false;
    content_hash_number(h, "frame", c.frame);
    return content_hash_file(h, "landmarks", c.landmarks, e);
}

static bool make_key(fits_source *s, err *e)
{
    const identities_learn *p = s->p;
    content_hash *h = content_hash_start();
    bool ok = true;
    content_hash_text(h, "gnathos", GNATHOS_VERSION);
    for (int32_t i = 0; ok && i < p->case_count; i++) {
        ok = hash_case(h, p->cases[i], e);
        for (int32_t k = 0; ok && k < i; k++)
            if (!strcmp(p->cases[k], p->cases[i]))
                ok = err_set(e, ERR_USAGE, "%s is named twice: it would count as two heads", p->cases[i]);
    }
    content_hash_number(h, "norm", p->norm_heads);
    content_hash_number(h, "seed", (double)p->seed);
    content_hash_end(h, s->key);
    return ok;
}

bool fits_source_open(const head_template *t, const identities_learn *p, const task *watch, fits_source *out, err *e)
{
    int32_t count = p->case_count + p->norm_heads;
    *out = (fits_source){.t = t, .p = p, .watch = watch};
    out->name = mem_alloc((size_t)count, sizeof *out->name);
    out->names = NEW_ARRAY(const char *, count);
    for (int32_t i = 0; i < count; i++) {
        norm_head_params n = norm_params(p, i - p->case_count < 0 ? 0 : i - p->case_count);
        if (i < p->case_count)
            snprintf(out->name[i], HEAD_NAME_SIZE, "%s", p->cases[i]);
        else
            snprintf(out->name[i], HEAD_NAME_SIZE, "norm %s class %d seed %llu", n.sex == NORM_MALE ? "m" : "f",
                     n.skeletal_class, (unsigned long long)n.seed);
        out->names[i] = out->name[i];
    }
    out->source = (head_source){count, out->names, shape_of, out};
    task_progress(watch, "the mean norm head", -1);
    bool ok = make_key(out, e) && (!p->norm_heads || norm_mean_build(head_template_coarseness, false, &out->mean, e));
    if (!ok) fits_source_free(out);
    return ok;
}

void fits_source_free(fits_source *s)
{
    norm_mean_free(s->mean);
    free(s->name);
    free(s->names);
    *s = (fits_source){0};
}
