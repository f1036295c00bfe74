/* bent_heads MODEL FOLDER: a model of identities learnt from seven heads that are the template, bent smoothly, and
 * these heads as fits, FOLDER/NAME/fit.pack: no fit is needed, and what comes out is known. */
#include "app/planner/identity/fit_file.h"
#include "app/planner/identity/head_model.h"
#include "app/planner/identity/template_get.h"
#include "tests/small_head.h"
#include <stdio.h>
#include <sys/stat.h>

enum { HEADS = 7 };

static bool write_fit(const head_template *t, const head_shape *s, const char *folder, const char *name, err *e)
{
    head_fit f = {.shape = *s, .place = {.motion = rigid_identity(), .scale = 1}, .min_j = 1};
    char path[1024];
    for (int k = 0; k < CASE_SURFACE_COUNT; k++) {
        f.gap_mm[k] = NEW_ARRAY(double, t->part[k].vertex_count);
        f.guessed[k] = NEW_ARRAY(uint8_t, t->part[k].vertex_count);
        f.gaps[k] = (registration_gaps){.vertices = t->part[k].vertex_count, .with_target = t->part[k].vertex_count};
    }
    snprintf(path, sizeof path, "%s/%s", folder, name);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/%s/fit.pack", folder, name);
    bool ok = head_fit_write(t, &f, path, e);
    f.shape = (head_shape){0};
    head_fit_free(&f);
    return ok;
}

int main(int argc, char **argv)
{
    err e = {0};
    head_template t = {0};
    head_model m = {0};
    if (argc != 3) return ERR_USAGE;
    bool ok = head_template_get(NULL, &t, NULL, &e);
    double *phi[HEADS] = {0};
    static const char *const name[HEADS] = {"wide", "narrow", "long", "short", "deep", "shallow", "bent"};
    for (int s = 0; ok && s < HEADS; s++) {
        double c[SMALL_BENDS] = {0};
        c[s < 2 ? 0 : s < 4 ? 2 : s < 6 ? 4 : 1] = s % 2 ? -3 : 3;
        head_shape h = small_shape(&t, c);
        phi[s] = NEW_ARRAY(double, head_layout_of(&t).start[HEAD_BLOCK_COUNT]);
        ok = head_shape_to_frankfort(&t, &h, NULL, &e);
        head_vector_of(&t, &h, phi[s]);
        ok = ok && write_fit(&t, &h, argv[2], name[s], &e);
        head_shape_free(&h);
    }
    ok = ok && head_model_learn(&t, (const double *const *)phi, name, HEADS, NULL, &m, &e) &&
         head_model_write(&m, argv[1], &e);
    if (!ok) fprintf(stderr, "%s\n", e.text);
    for (int s = 0; s < HEADS; s++) free(phi[s]);
    head_model_free(&m);
    head_template_free(&t);
    return (int)e.code;
}
