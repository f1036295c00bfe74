/* Bodies over a bone: they keep out of it, or slide along it. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>

static const double round_mm = 0.25; /* about the creases of teeth and rim */

/* Teeth are sharp here: rounding takes 0.14 mm off them at most. */
double stress_depth(const known_bone *b, const double x[3])
{
    double u = x[0] - b->at[0], w = x[1] - b->at[1], down = b->at[2] - x[2], k = M_PI / 2;
    switch (b->kind) {
    case KNOWN_TEETH:
        return (down - b->size / 2 * fmax(fabs(remainder(u, 4)), fabs(remainder(w, 4)))) / hypot(1, b->size / 2);
    case KNOWN_CUSPS: return down + b->size / 2 * (cos(k * u) * cos(k * w) - 1);
    case KNOWN_BALL: return b->size - vec_distance(x, b->at);
    case KNOWN_EDGE: return fmin(down, u);
    case KNOWN_PLATE: return b->size - fabs(down);
    case KNOWN_PLANE: break;
    }
    return down;
}

/* A block tied to the maxilla at its top over a bone of the distal segment `drop` below the middle of the block's
 * bottom. Its bottom is free to touch it, or slides on it: for good where the contact is held. */
static void over(const stress_case *c, stress_scene *s, known_kind kind, double drop, node_kind bottom, bool held)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    s->bone = (known_bone){kind, {c->size[0] / 2, c->size[1] / 2, -drop}, c->p, round_mm};
    s->shape = known_shape(&s->bone);
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1);
    s->extra = NEW_ARRAY(int32_t, layer);
    for (int32_t v = 0; v < layer; v++) {
        stress_tie(&s->attach, layer * c->cells[2] + v, SEGMENT_MAXILLA);
        if (bottom == NODE_SLIDING) {
            double *n = s->attach.normal + 3 * (size_t)v;
            s->attach.kind[v] = NODE_SLIDING;
            s->attach.segment[v] = SEGMENT_DISTAL;
            s->shape.distance(&s->bone, s->mesh.xyz + 3 * (size_t)v, n, NULL);
            vec_normalize(n);
        } else
            s->extra[s->contact.extra_count++] = v;
    }
    s->contact.extra = s->extra;
    s->contact.shape[SEGMENT_DISTAL] = &s->shape;
    s->contact.params = contact_params_default();
    s->contact.held = held;
    s->touches = true;
}

void specimen_on_plane(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_PLANE, c->p, NODE_SLIDING, false); }
void specimen_on_teeth(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_TEETH, 0, NODE_SLIDING, false); }
void specimen_on_ball(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_BALL, c->p, NODE_SLIDING, false); }
void specimen_on_rim(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_EDGE, 0, NODE_SLIDING, false); }
void specimen_kept_off_ball(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_BALL, c->p, NODE_FREE, true); }
void specimen_kept_off_cusps(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_CUSPS, 0, NODE_FREE, true); }
void specimen_kept_on_ball(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_BALL, c->p, NODE_SLIDING, true); }
void specimen_kept_on_cusps(const stress_case *c, stress_scene *s) { over(c, s, KNOWN_CUSPS, 0, NODE_SLIDING, true); }
