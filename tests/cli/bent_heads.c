/* bent_heads MODEL: a model of identities learnt from seven heads that are the template, bent smoothly: no fit is
 * needed, and what comes out is known. */
#include "app/planner/identity/head_model.h"
#include "app/planner/identity/template_get.h"
#include "tests/small_head.h"
#include <stdio.h>

enum { HEADS = 7 };

int main(int argc, char **argv)
{
    err e = {0};
    head_template t = {0};
    head_model m = {0};
    if (argc != 2) return ERR_USAGE;
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
