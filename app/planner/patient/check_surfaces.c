#include "app/planner/patient/check.h"
#include "app/planner/patient/check_parts.h"
#include "geometry/plane_file.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

/* A head's skin, from crown to neck, measures 250 to 450 mm corner to corner; a cropped face less. */
static const double head_least_mm = 150, head_most_mm = 600;

static double diagonal(const surface *s)
{
    double low[3], high[3];
    surface_bounds(s, low, high);
    return vec_distance(low, high);
}

static bool is_wrong_size(const case_file *c, double d, issue_list *issues)
{
    static const struct {
        double per_mm;
        const char *unit;
    } units[] = {{1000, "metres"}, {10, "centimetres"}, {25.4, "inches"}};
    const char *path = c->surface[CASE_SKIN];
    if (d >= head_least_mm && d <= head_most_mm) return false;
    for (int i = 0; i < 3; i++) {
        double mm = d * units[i].per_mm;
        if (mm < head_least_mm || mm > head_most_mm) continue;
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, path, 0, NULL,
                  "the skin measures %.3g corner to corner, a head in %s; save it in mm (times %g)", d, units[i].unit,
                  units[i].per_mm);
        return true;
    }
    issue_add(issues, ISSUE_ERROR, ERR_INPUT, path, 0, NULL,
              "the skin measures %.4g mm corner to corner; a head measures %g to %g mm", d, head_least_mm,
              head_most_mm);
    return true;
}

static void tell_joined(const char *path, const mesh_file_report *r, issue_list *issues)
{
    if (r->joined_vertices)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, path, 0, NULL,
                  "holds loose triangles; %d corners were joined with others within %g mm", r->joined_vertices,
                  r->joined_mm);
}

static void check_closed(const char *path, case_surface s, check_found *found, issue_list *issues)
{
    int32_t open = found->open_edges[s], crowded = found->crowded_edges[s];
    if (crowded)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, path, 0, NULL,
                  "%d edges are shared by more than two triangles; repair will try to part them", crowded);
    if (open && s == CASE_SKIN)
        issue_add(issues, ISSUE_INFO, ERR_NONE, path, 0, NULL, "the skin is open (%d edges); its holes will be closed",
                  open);
    else if (open)
        issue_add(issues, ISSUE_WARNING, ERR_NONE, path, 0, NULL,
                  "the surface is open (%d edges); its holes will be closed", open);
}

void check_surfaces(const case_file *c, check_found *found, issue_list *issues)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        const char *path = c->surface[i];
        err e = {0};
        if (!*path) continue;
        surface *s = &found->mesh[i];
        if (!mesh_read_surface(path, case_file_space(c), s, &found->read[i], &e)) {
            issue_add_err(issues, ISSUE_ERROR, &e, path);
            continue;
        }
        if (!surface_check(s, &e)) {
            issue_add(issues, ISSUE_ERROR, e.code, path, 0, NULL, "%s", e.text);
            surface_free(s);
            continue;
        }
        tell_joined(path, &found->read[i], issues);
        surface_edge_census(s, &found->open_edges[i], &found->crowded_edges[i]);
        found->diagonal_mm[i] = diagonal(s);
        if (i == CASE_SKIN) found->wrong_size[i] = is_wrong_size(c, found->diagonal_mm[i], issues);
        check_closed(path, (case_surface)i, found, issues);
    }
    const char *name[CASE_SURFACE_COUNT];
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) name[i] = c->surface[i];
    check_trees(found->mesh, name, found->tree, issues);
    check_parts(found->mesh, name, found->tree, issues);
}

/* True if p lies outside the skin: for a closed skin by the crossings of rays; for an open one by the side of the
 * nearest triangle, which may be wrong beside a sharp groove, but hardly for many points. */
static bool outside(const nearest *tree, const surface *skin, bool closed, double sign, const double p[3],
                    double *distance)
{
    double at[3], u[3], v[3], n[3], d[3];
    int32_t t;
    *distance = nearest_point(tree, p, at, &t);
    if (closed) return !nearest_inside(tree, p);
    const int32_t *corner = skin->tri + 3 * (size_t)t;
    const double *a = skin->xyz + 3 * (size_t)corner[0];
    vec_sub(skin->xyz + 3 * (size_t)corner[1], a, u);
    vec_sub(skin->xyz + 3 * (size_t)corner[2], a, v);
    vec_cross(u, v, n);
    vec_sub(p, at, d);
    return sign * vec_dot(d, n) > 0;
}

void check_bones_inside(const case_file *c, const check_found *found, issue_list *issues)
{
    enum { SAMPLES = 1000 };
    const double through_mm = 1; /* incisors may touch or cross a lip */
    const surface *skin = &found->mesh[CASE_SKIN];
    const nearest *tree = found->tree[CASE_SKIN];
    if (!tree || found->wrong_size[CASE_SKIN]) return;
    double sign = surface_volume(skin) < 0 ? -1 : 1;
    bool closed = found->open_edges[CASE_SKIN] == 0 && found->crowded_edges[CASE_SKIN] == 0;
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        const surface *bone = &found->mesh[i];
        if (!bone->vertex_count) continue;
        int count = bone->vertex_count < SAMPLES ? bone->vertex_count : SAMPLES, out = 0;
        double farthest = 0;
        for (int k = 0; k < count; k++) {
            int64_t v = (int64_t)k * bone->vertex_count / count;
            double gap;
            if (!outside(tree, skin, closed, sign, bone->xyz + 3 * v, &gap) || gap <= through_mm) continue;
            out++;
            farthest = fmax(farthest, gap);
        }
        double share = 100.0 * out / count;
        if (share > 50)
            issue_add(issues, ISSUE_ERROR, ERR_GEOMETRY, c->surface[i], 0, NULL,
                      "%.0f %% of the %s lies outside the skin, up to %.1f mm; are both of one patient, in "
                      "one frame and in mm?",
                      share, case_surface_name((case_surface)i), farthest);
        else if (share > 1)
            issue_add(issues, ISSUE_WARNING, ERR_GEOMETRY, c->surface[i], 0, NULL,
                      "%.0f %% of the %s lies outside the skin, up to %.1f mm", share,
                      case_surface_name((case_surface)i), farthest);
    }
}

void check_planes(const case_file *c, issue_list *issues)
{
    cut_plane *planes = NULL;
    int count = 0;
    err e = {0};
    if (!*c->planes) return;
    if (!planes_read(c->planes, &planes, &count, &e)) {
        issue_add_err(issues, ISSUE_ERROR, &e, c->planes);
        return;
    }
    for (int i = 0; i < c->osteotomy_count; i++) {
        const case_osteotomy *o = &c->osteotomy[i];
        bool there = o->cut != CUT_USER;
        for (int k = 0; k < count && !there; k++) there = !strcmp(planes[k].label, o->plane);
        if (!there)
            issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->planes, 0, NULL,
                      "has no plane \"%s\", which %s names for the %s", o->plane, c->path, segment_name(o->segment));
    }
    free(planes);
}

void check_found_free(check_found *found)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        nearest_destroy(&found->tree[i]);
        surface_free(&found->mesh[i]);
    }
    landmarks_free(&found->points);
}
