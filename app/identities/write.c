#include "app/identities/identities.h"
#include "app/identities/plot.h"
#if GNATHOS_WITH_RENDER
#include "app/identities/pictures.h"
#endif
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static bool write_json(json_t *record, const char *folder, const char *file, err *e)
{
    char path[FIELD_PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    bool ok = json_file_write(record, path, e);
    json_decref(record);
    return ok;
}

bool identities_write(const head_template *t, const identities_learnt *l, const char *folder, err *e)
{
    if (!write_json(identities_json(l), folder, "identities.json", e) || !identities_plot(&l->model, folder, e))
        return false;
#if GNATHOS_WITH_RENDER
    return identities_draw(t, &l->model, folder, e);
#else
    (void)t;
    return true;
#endif
}

bool identity_write(const head_template *t, const identities_projection *p, const char *folder, err *e)
{
    char path[FIELD_PATH_SIZE];
    head_layout l = head_layout_of(t);
    head_shape made = head_vector_shape(t, p->made);
    surface skin = head_part(t, &made, CASE_SKIN);
    double *error_mm = NEW_ARRAY(double, skin.vertex_count);
    for (int32_t i = 0; i < skin.vertex_count; i++) {
        size_t at = (size_t)l.start[HEAD_SKIN] + 3 * (size_t)i;
        error_mm[i] = p->known[at] > 0 ? vec_distance(p->phi + at, p->made + at) : (double)NAN;
    }
    const point_array array = {.name = "error_mm", .components = 1, .value = error_mm};
    snprintf(path, sizeof path, "%s/error.vtp", folder);
    bool ok = write_json(identity_json(p), folder, "identity.json", e) &&
              mesh_write_surface_arrays(&skin, &array, 1, path, e);
#if GNATHOS_WITH_RENDER
    ok = ok && identity_draw(t, p, error_mm, folder, e);
#endif
    free(error_mm);
    surface_free(&skin);
    head_shape_free(&made);
    return ok;
}
