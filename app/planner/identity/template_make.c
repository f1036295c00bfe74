#include "app/planner/identity/template_make.h"
#include "app/planner/identity/lip_overlap.h"
#include "app/planner/patient/landmark_needs.h"
#include "app/planner/patient/prepared.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double on_surface_mm = 0.3; /* a landmark nearer to its part than this hangs on a triangle */

/* Of p, which lies in the triangle. */
static void barycentric(const surface *s, int32_t triangle, const double p[3], double weight[3])
{
    const double *x[3];
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) x[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)triangle + (size_t)k];
    vec_sub(x[1], x[0], u);
    vec_sub(x[2], x[0], v);
    vec_sub(p, x[0], w);
    double uu = vec_dot(u, u), uv = vec_dot(u, v), vv = vec_dot(v, v), wu = vec_dot(w, u), wv = vec_dot(w, v),
           det = uu * vv - uv * uv;
    weight[1] = (vv * wu - uv * wv) / det;
    weight[2] = (uu * wv - uv * wu) / det;
    weight[0] = 1 - weight[1] - weight[2];
}

/* The part that the table of landmarks names; for those inside the head and others not there the nearest one, of
 * these of the bones and teeth alone. */
static head_point hang(const landmark *l, const surface part[CASE_SURFACE_COUNT], nearest *const tree[])
{
    const landmark_row *row = landmark_row_find(l->label);
    bool inside = row && row->on == CASE_SURFACE_COUNT;
    head_point p = {.part = -1, .triangle = -1};
    snprintf(p.label, sizeof p.label, "%s", l->label);
    vec_copy(l->xyz, p.at);
    double best = HUGE_VAL, at[3] = {0};
    for (int s = inside ? CASE_SKULL : CASE_SKIN; s < CASE_SURFACE_COUNT; s++) {
        if (row && !inside && row->on != (case_surface)s) continue;
        double there[3];
        int32_t triangle;
        double far = nearest_point(tree[s], l->xyz, there, &triangle);
        if (far >= best) continue;
        best = far;
        p.part = s;
        p.triangle = triangle;
        vec_copy(there, at);
    }
    if (inside || best > on_surface_mm)
        p.triangle = -1;
    else
        barycentric(&part[p.part], p.triangle, at, p.weight);
    return p;
}

static bool hang_points(const landmarks *l, head_template *t, err *e)
{
    nearest *tree[CASE_SURFACE_COUNT] = {0};
    bool ok = true;
    for (int s = 0; ok && s < CASE_SURFACE_COUNT; s++) ok = nearest_create(&t->part[s], &tree[s], e);
    if (ok) {
        t->point_count = l->count;
        t->point = NEW_ARRAY(head_point, l->count);
        for (int32_t i = 0; i < l->count; i++) t->point[i] = hang(&l->point[i], t->part, tree);
    }
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) nearest_destroy(&tree[s]);
    return ok;
}

/* Teeth that hang together by vertices, numbered by their first triangle. */
static int32_t *number_teeth(const surface *s)
{
    int32_t *component, *tooth = NEW_ARRAY(int32_t, s->vertex_count);
    surface_components(s, &component);
    for (size_t i = 0; i < 3 * (size_t)s->triangle_count; i++) tooth[s->tri[i]] = component[i / 3];
    free(component);
    return tooth;
}

static bool read_parts(const case_file *c, head_template *t, err *e)
{
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) {
        if (!c->surface[s][0])
            return err_set(e, ERR_INPUT, "a template needs %s, which this case has not apart",
                           case_surface_name((case_surface)s));
        if (!mesh_read_surface(c->surface[s], case_file_space(c), &t->part[s], NULL, e)) return false;
        free(t->part[s].rgb);
        t->part[s].rgb = NULL;
    }
    for (int s = CASE_UPPER_TEETH; s <= CASE_LOWER_TEETH; s++) t->tooth[s] = number_teeth(&t->part[s]);
    return true;
}

static void into_frame(const head_frame *f, double *xyz, int32_t count, bool directions)
{
    head_frame at = *f;
    if (directions) memset(at.origin, 0, sizeof at.origin);
    for (int32_t i = 0; i < count; i++) {
        double p[3];
        vec_copy(xyz + 3 * (size_t)i, p);
        head_frame_to_local(&at, p, xyz + 3 * (size_t)i);
    }
}

/* The case's frame becomes the axes: the middle between the porions at zero, the Frankfort plane at z = 0. */
static void bring_into_frame(const head_frame *f, head_template *t)
{
    int32_t nodes = t->tissue.mesh.vertex_count;
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) into_frame(f, t->part[s].xyz, t->part[s].vertex_count, false);
    into_frame(f, t->tissue.mesh.xyz, nodes, false);
    into_frame(f, t->rest, nodes, false);
    into_frame(f, t->tissue.attach.normal, nodes, true);
    into_frame(f, t->tissue.attach.pair_normal, t->tissue.attach.pair_count, true);
    t->tissue.lips.frame = (head_frame){.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};
    for (int32_t i = 0; i < t->point_count; i++) into_frame(f, t->point[i].at, 1, false);
}

bool head_template_make(const case_file *c, const task *watch, head_template *out, err *e)
{
    prepared p = {0};
    head_template t = {0};
    if (!prepared_make(c, watch, &p, e)) return false;
    bool ok = read_parts(c, &t, e) && hang_points(&p.points, &t, e);
    if (ok) {
        task_progress(watch, "the lips at rest", 0.9);
        t.rest = NEW_ARRAY(double, 3 * (size_t)p.tissue.mesh.vertex_count);
        ok = lip_overlap(&p.tissue, c->material.young_kpa, c->material.poisson, t.rest, e);
    }
    if (ok && task_interrupted(watch)) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    if (ok) {
        t.tissue = p.tissue;
        t.skin_on_tissue = p.skin_on_tissue;
        p.tissue = (tissue){0};
        p.skin_on_tissue = (embedding){0};
        bring_into_frame(&p.frame, &t);
        *out = t;
    } else {
        head_template_free(&t);
    }
    prepared_free(&p);
    return ok;
}
