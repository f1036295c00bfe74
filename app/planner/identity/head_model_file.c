/* Models of identities in files. */
#include "app/planner/identity/head_model.h"
#include "app/planner/store/fields.h"
#include "app/planner/store/pack_file.h"
#include "app/planner/store/user_cache.h"
#include "geometry/mem.h"
#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char format[] = "gnathos identities 2";

bool head_model_write(const head_model *m, const char *path, err *e)
{
    const principal *p = &m->modes;
    size_t n = (size_t)p->length, modes = (size_t)p->mode_count, samples = (size_t)p->sample_count;
    pack_file f = {0};
    pack_put(&f, "format", format, sizeof format);
    pack_put(&f, "numbering", m->numbering, sizeof m->numbering);
    pack_put(&f, "names", m->name, samples * sizeof *m->name);
    pack_put(&f, "weights", p->weight, n * sizeof *p->weight);
    pack_put(&f, "mean", p->mean, n * sizeof *p->mean);
    pack_put(&f, "modes", p->mode, n * modes * sizeof *p->mode);
    pack_put(&f, "sd", p->sd, modes * sizeof *p->sd);
    pack_put(&f, "scores", m->score, samples * modes * sizeof *m->score);
    pack_put(&f, "variance", &p->variance, sizeof p->variance);
    pack_put(&f, "left out rms", m->left_out_rms_mm, (size_t)(m->left_out_modes + 1) * sizeof(double));
    pack_put(&f, "left out", m->left_out, sizeof m->left_out);
    bool ok = pack_write(&f, path, e);
    pack_free(&f);
    return ok;
}

bool head_model_place(char *path, err *e)
{
    static const char variable[] = "GNATHOS_IDENTITIES";
    const char *named = getenv(variable);
    char file[64];
    if (named && *named)
        return snprintf(path, FIELD_PATH_SIZE, "%s", named) < FIELD_PATH_SIZE ||
               err_set(e, ERR_INPUT, "%s is longer than %d bytes", variable, FIELD_PATH_SIZE - 1);
    snprintf(file, sizeof file, "identities-%d.model", HEAD_MODEL_VERSION);
    return user_cache_path(file, "the model of identities", variable, path, FIELD_PATH_SIZE, e);
}

/* Its bytes; refuses where they are not `want` items (0: any number but none). */
static void *take(const pack_file *f, const char *path, const char *name, size_t element, size_t want, size_t *count,
                  err *e)
{
    size_t n = 0;
    void *bytes = pack_take(f, name, element, &n);
    if (bytes && n && (!want || n == want)) {
        if (count) *count = n;
        return bytes;
    }
    free(bytes);
    err_at(e, ERR_INPUT, path, 0, name, "holds %zu numbers, not %zu", n, want);
    return NULL;
}

static double *take_numbers(const pack_file *f, const char *path, const char *name, size_t want, size_t *count, err *e)
{
    size_t n = 0;
    double *number = take(f, path, name, sizeof *number, want, &n, e);
    for (size_t i = 0; number && i < n; i++) {
        if (isfinite(number[i])) continue;
        err_at(e, ERR_INPUT, path, 0, name, "number %zu is not finite", i);
        free(number);
        return NULL;
    }
    if (count) *count = n;
    return number;
}

static bool same_numbering(const pack_file *f, const char *path, const head_template *t, err *e)
{
    size_t n = 0;
    char *hash = take(f, path, "numbering", 1, HASH_TEXT_SIZE, &n, e);
    if (!hash) return false;
    bool same = !strncmp(hash, t->numbering, HASH_TEXT_SIZE);
    if (!same)
        err_at(e, ERR_INPUT, path, 0, NULL,
               "was learnt on a template of another numbering (%.12s) than this program's (%.12s): learn it again",
               hash, t->numbering);
    free(hash);
    return same;
}

static bool take_modes(const pack_file *f, const char *path, const head_template *t, head_model *m, err *e)
{
    principal *p = &m->modes;
    size_t modes = 0, samples = 0;
    p->length = head_layout_of(t).start[HEAD_BLOCK_COUNT];
    m->name = take(f, path, "names", sizeof *m->name, 0, &samples, e);
    p->weight = m->name ? take_numbers(f, path, "weights", (size_t)p->length, NULL, e) : NULL;
    p->mean = p->weight ? take_numbers(f, path, "mean", (size_t)p->length, NULL, e) : NULL;
    p->sd = p->mean ? take_numbers(f, path, "sd", 0, &modes, e) : NULL;
    p->mode = p->sd ? take_numbers(f, path, "modes", modes * (size_t)p->length, NULL, e) : NULL;
    m->score = p->mode ? take_numbers(f, path, "scores", samples * modes, NULL, e) : NULL;
    double *variance = m->score ? take_numbers(f, path, "variance", 1, NULL, e) : NULL;
    if (!variance) return false;
    p->sample_count = (int32_t)samples;
    p->mode_count = (int32_t)modes;
    p->variance = *variance;
    free(variance);
    for (size_t k = 0; k < modes; k++)
        if (!(p->sd[k] > 0)) return err_at(e, ERR_INPUT, path, 0, "sd", "number %zu is not above 0", k);
    for (size_t s = 0; s < samples; s++)
        if (m->name[s][HEAD_NAME_SIZE - 1]) return err_at(e, ERR_INPUT, path, 0, "names", "name %zu has no end", s);
    return modes <= HEAD_MODES_MOST ||
           err_at(e, ERR_INPUT, path, 0, "sd", "holds %zu modes, at most %d can be", modes, HEAD_MODES_MOST);
}

bool head_model_read(const char *path, const head_template *t, head_model *out, err *e)
{
    pack_file f = {0};
    err why = {0};
    if (access(path, R_OK)) return err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read: %s", strerror(errno));
    size_t n = 0;
    char *kind = pack_read(path, &f, &why) ? pack_take(&f, "format", 1, &n) : NULL;
    bool ok = kind && n == sizeof format && !memcmp(kind, format, n);
    if (!ok)
        err_at(e, ERR_INPUT, path, 0, NULL, "is not a whole model of identities; gnathos identities learn makes one");
    free(kind);
    head_model m = {0};
    ok = ok && same_numbering(&f, path, t, e) && take_modes(&f, path, t, &m, e);
    size_t rms = 0;
    m.left_out_rms_mm = ok ? take_numbers(&f, path, "left out rms", 0, &rms, e) : NULL;
    double *gap = m.left_out_rms_mm ? take_numbers(&f, path, "left out", 3 * HEAD_GAP_COUNT, NULL, e) : NULL;
    ok = gap != NULL;
    if (ok) {
        m.left_out_modes = (int32_t)rms - 1;
        memcpy(m.left_out, gap, sizeof m.left_out);
        memcpy(m.numbering, t->numbering, sizeof m.numbering);
        *out = m;
    } else {
        head_model_free(&m);
    }
    free(gap);
    pack_free(&f);
    return ok;
}
