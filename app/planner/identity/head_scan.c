#include "app/planner/identity/head_scan.h"

bool head_scan_read(const case_file *c, bool with_points, head_scan *out, err *e)
{
    head_scan s = {0};
    bool ok = *c->surface[CASE_SKIN] ||
              err_at(e, ERR_INPUT, c->path, 0, "surfaces.skin", "is missing; a head is recognised by its skin");
    for (int i = 0; ok && i < CASE_SURFACE_COUNT; i++)
        if (*c->surface[i]) ok = mesh_read_surface(c->surface[i], case_file_space(c), &s.part[i], NULL, e);
    if (ok && with_points && *c->landmarks) ok = landmarks_read(c->landmarks, &s.points, NULL, e);
    if (ok)
        *out = s;
    else
        head_scan_free(&s);
    return ok;
}

void head_scan_free(head_scan *s)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) surface_free(&s->part[i]);
    landmarks_free(&s->points);
}
