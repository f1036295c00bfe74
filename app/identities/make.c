#include "app/identities/identities.h"
#include "app/planner/identity/head_case.h"
#include "app/planner/identity/head_fit.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double identities_sd_most = 3; /* beyond it a normal distribution has one head in 400 per mode */

/* Where a text begins with the folder in which the head is made for now: the name that it will have. */
static void name_target(const char *now, const char *target, const char *text, char *out, size_t size)
{
    size_t n = strlen(now);
    if (text && !strncmp(text, now, n))
        snprintf(out, size, "%s%s", target, text + n);
    else
        snprintf(out, size, "%s", text ? text : "");
}

/* Sums of modes are no elastic tissue: where they turn tetrahedra inside out, the tissue is sought anew between the
 * parts that they made. What cannot be had stays as it was. */
static bool mend_tissue(const head_template *t, identities_made *made, head_shape *s, err *e)
{
    head_scan parts = {0};
    head_fit f;
    err why = {0};
    made->tissue_anew = made->sound.inverted_tets > 0;
    if (!made->tissue_anew) return true;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) parts.part[i] = head_part(t, s, (case_surface)i);
    bool found = head_fit_numbered(t, &parts, NULL, &f, &why);
    head_scan_free(&parts);
    if (!found) return why.code == ERR_NOT_CONVERGED || err_set(e, why.code, "%s", why.text);
    head_shape_free(s);
    *s = f.shape;
    f.shape = (head_shape){0};
    head_fit_free(&f);
    return head_soundness_of(t, s, &made->sound, e);
}

/* Writes it where everything but check, which reads files, finds nothing wrong. */
static bool make_one(const head_template *t, const head_model *m, identities_made *made, const char *folder,
                     const task *watch, issue_list *warnings, err *e)
{
    double *phi = NEW_ARRAY(double, m->modes.length);
    principal_make(&m->modes, made->p, made->p_count, phi);
    head_shape s = head_vector_shape(t, phi);
    free(phi);
    const char *slash = strrchr(made->folder, '/'), *name = slash && slash[1] ? slash + 1 : made->folder;
    bool ok = head_soundness_of(t, &s, &made->sound, e) && mend_tissue(t, made, &s, e) &&
              head_sound(&made->sound, made->of_template.teeth_overlap_mm, e) &&
              head_case_write(t, &s, NULL, folder, name, e) && head_case_passes(folder, watch, warnings, e);
    head_shape_free(&s);
    return ok;
}

static bool try_all(const head_template *t, const head_model *m, identities_made *made, const char *folder,
                    const task *watch, issue_list *warnings, err *e)
{
    uint64_t state = made->seed;
    int tries = made->random ? IDENTITIES_TRIES : 1;
    for (made->tries = 1;; made->tries++) {
        if (made->random) {
            made->p_count = m->modes.mode_count;
            head_model_draw(m, &state, made->p);
        }
        issue_list found = {0};
        err why = {0};
        task_progress(watch, "a head", (double)(made->tries - 1) / tries);
        bool ok = make_one(t, m, made, folder, watch, &found, &why);
        for (int i = 0; ok && i < found.count; i++) {
            const issue *f = &found.item[i];
            char file[FIELD_PATH_SIZE];
            name_target(folder, made->folder, f->file, file, sizeof file);
            issue_add(warnings, f->level, f->code, *file ? file : NULL, f->line, f->field, "%s", f->text);
        }
        issue_list_free(&found);
        if (ok) return true;
        char text[sizeof why.text];
        name_target(folder, made->folder, why.text, text, sizeof text);
        bool again = made->random && (why.code == ERR_GEOMETRY || why.code == ERR_INPUT) && made->tries < tries;
        if (!again && made->random && made->tries == tries)
            return err_set(e, why.code, "none of %d draws is a head; the last: %s", tries, text);
        if (!again) return err_set(e, why.code, "%s", text);
        task_note(watch, "draw %d of seed %llu: %s", made->tries, (unsigned long long)made->seed, text);
    }
}

bool identities_make(const head_template *t, const head_model *m, identities_made *made, const task *watch,
                     issue_list *warnings, err *e)
{
    whole_folder folder;
    made->model = m;
    for (int32_t k = 0; k < made->p_count; k++)
        if (!(fabs(made->p[k]) <= identities_sd_most))
            return err_set(e, ERR_USAGE, "p[%d] is %g: -%g to %g standard deviations are heads", k, made->p[k],
                           identities_sd_most, identities_sd_most);
    if (made->p_count > m->modes.mode_count)
        return err_set(e, ERR_USAGE, "%d coefficients are given, the model has %d modes", made->p_count,
                       m->modes.mode_count);
    head_shape own = head_shape_of(t);
    bool ok = head_soundness_of(t, &own, &made->of_template, e);
    head_shape_free(&own);
    if (!ok || !whole_folder_open(made->folder, &folder, e)) return false;
    ok = try_all(t, m, made, folder.temporary, watch, warnings, e) && whole_folder_close(&folder, e);
    if (!ok) whole_folder_abandon(&folder);
    return ok;
}
