/* Bodies that keep out of a bone of known shape, or slide along it without leaving it. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <string.h>

/* A ball of radius p under the middle of the block. */
static double ball_distance(const void *context, const double x[3], double grad[3], double *hess)
{
    const stress_case *c = context;
    double r[3] = {x[0] - c->size[0] / 2, x[1] - c->size[1] / 2, x[2] + c->p};
    double size = vec_norm(r);
    if (!(size > 0)) return HUGE_VAL;
    vec_scale(r, 1 / size, grad);
    for (int i = 0; hess && i < 9; i++) hess[i] = ((i % 4 == 0) - grad[i / 3] * grad[i % 3]) / size;
    return size - c->p;
}

static bool leaves_ball(const void *context, const double x[3], const double direction[3], double reach_mm, double hit[3],
                        double normal[3])
{
    const stress_case *c = context;
    double r[3] = {x[0] - c->size[0] / 2, x[1] - c->size[1] / 2, x[2] + c->p}, unit[3];
    vec_copy(direction, unit);
    vec_normalize(unit);
    double along = vec_dot(r, unit), rest = along * along - vec_dot(r, r) + c->p * c->p;
    if (!(rest >= 0) || sqrt(rest) < along || sqrt(rest) - along > reach_mm) return false;
    vec_axpy(x, sqrt(rest) - along, unit, hit);
    vec_axpy(r, sqrt(rest) - along, unit, normal);
    return vec_normalize(normal) > 0;
}

/* Rounded cusps p high, every 4 mm: the height over them, which is no distance but has the same zero. */
static double cusp_distance(const void *context, const double x[3], double grad[3], double *hess)
{
    const stress_case *c = context;
    double k = M_PI / 2, a = k * (x[0] - c->size[0] / 2), b = k * (x[1] - c->size[1] / 2), h = c->p / 2;
    vec_copy((double[]){h * k * sin(a) * cos(b), h * k * cos(a) * sin(b), 1}, grad);
    if (hess) {
        double same = h * k * k * cos(a) * cos(b), other = -h * k * k * sin(a) * sin(b);
        memcpy(hess, (double[]){same, other, 0, other, same, 0, 0, 0, 0}, 9 * sizeof *hess);
    }
    return x[2] - stress_height(c, x[0], x[1]);
}

static bool leaves_cusps(const void *context, const double x[3], const double direction[3], double reach_mm, double hit[3],
                         double normal[3])
{
    const stress_case *c = context;
    if (!(direction[2] > 0) || x[2] > stress_height(c, x[0], x[1])) return false;
    vec_copy((double[]){x[0], x[1], stress_height(c, x[0], x[1])}, hit);
    cusp_distance(c, hit, normal, NULL);
    return vec_distance(x, hit) <= reach_mm && vec_normalize(normal) > 0;
}

/* A block tied to the maxilla at its top, its bottom free or sliding on the distal bone. */
static void over(const stress_case *c, stress_scene *s, node_kind bottom, bone_shape shape)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1);
    s->extra = NEW_ARRAY(int32_t, layer);
    for (int32_t v = 0; v < layer; v++) {
        stress_tie(&s->attach, layer * c->cells[2] + v, SEGMENT_MAXILLA);
        if (bottom == NODE_SLIDING) {
            double *n = s->attach.normal + 3 * (size_t)v;
            s->attach.kind[v] = NODE_SLIDING;
            s->attach.segment[v] = SEGMENT_DISTAL;
            shape.distance(c, s->mesh.xyz + 3 * (size_t)v, n, NULL);
            vec_normalize(n);
        } else
            s->extra[s->contact.extra_count++] = v;
    }
    s->shape = shape;
    s->shape.context = c;
    s->contact.extra = s->extra;
    s->contact.shape[SEGMENT_DISTAL] = &s->shape;
    s->contact.params = contact_params_default();
    s->contact.held = s->touches = true;
}

void specimen_kept_off_ball(const stress_case *c, stress_scene *s)
{
    over(c, s, NODE_FREE, (bone_shape){.distance = ball_distance, .leave = leaves_ball});
}
void specimen_kept_off_cusps(const stress_case *c, stress_scene *s)
{
    over(c, s, NODE_FREE, (bone_shape){.distance = cusp_distance, .leave = leaves_cusps});
}
void specimen_kept_on_ball(const stress_case *c, stress_scene *s)
{
    over(c, s, NODE_SLIDING, (bone_shape){.distance = ball_distance, .leave = leaves_ball});
}
void specimen_kept_on_cusps(const stress_case *c, stress_scene *s)
{
    over(c, s, NODE_SLIDING, (bone_shape){.distance = cusp_distance, .leave = leaves_cusps});
}
