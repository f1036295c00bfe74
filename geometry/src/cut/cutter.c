#include "geometry/src/cut/cutter.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>

void cutter_free(cutter *c)
{
    surface_free(&c->body);
    free(c->moves);
    *c = (cutter){0};
}

static void polygon_normal(int nodes, const double *xyz, double n[3])
{
    n[0] = n[1] = n[2] = 0;
    for (int i = 1; i + 1 < nodes; i++) {
        double a[3], b[3], c[3];
        vec_sub(xyz + 3 * i, xyz, a);
        vec_sub(xyz + 3 * (i + 1), xyz, b);
        vec_cross(a, b, c);
        vec_add(n, c, n);
    }
    vec_normalize(n);
}

/* Twice the area of the triangle seen against n. */
static double turn(const double *a, const double *b, const double *c, const double n[3])
{
    double u[3], v[3], w[3];
    vec_sub(b, a, u);
    vec_sub(c, a, v);
    vec_cross(u, v, w);
    return vec_dot(w, n);
}

/* Area over squared longest edge of a triangle seen against n; <= 0 where it is turned over. */
static double fatness(const double *a, const double *b, const double *c, const double n[3])
{
    double longest = fmax(vec_distance(a, b), fmax(vec_distance(b, c), vec_distance(c, a)));
    return longest > 0 ? turn(a, b, c, n) / (longest * longest) : 0;
}

/* The triangulation of a simple polygon whose leanest triangle is fattest: corners in a row do not become a sliver,
 * which the offset of the cutter could turn over. The polygon runs counter-clockwise seen against its normal; triangles
 * that all keep that turn cannot overlap. Dynamic programming over chains of corners, for a handful of them. Writes
 * tri[3*(nodes-2)]. */
static void triangulate(int nodes, const double *xyz, int32_t *tri)
{
    double n[3], *best = NEW_ARRAY(double, nodes *nodes); /* of the polygon i..j closed by the chord j, i */
    int *apex = NEW_ARRAY(int, nodes *nodes), *stack = NEW_ARRAY(int, 4 * nodes), top = 0, made = 0;
    polygon_normal(nodes, xyz, n);
    for (int i = 0; i + 1 < nodes; i++) best[i * nodes + i + 1] = HUGE_VAL;
    for (int span = 2; span < nodes; span++)
        for (int i = 0; i + span < nodes; i++) {
            int j = i + span;
            best[i * nodes + j] = -HUGE_VAL;
            for (int k = i + 1; k < j; k++) {
                double lean = fmin(fatness(xyz + 3 * i, xyz + 3 * k, xyz + 3 * j, n),
                                   fmin(best[i * nodes + k], best[k * nodes + j]));
                if (!(lean > best[i * nodes + j])) continue;
                best[i * nodes + j] = lean;
                apex[i * nodes + j] = k;
            }
        }
    assert(best[nodes - 1] > 0); /* else not simple */
    stack[top++] = 0;
    stack[top++] = nodes - 1;
    while (top) {
        int j = stack[--top], i = stack[--top], k = apex[i * nodes + j];
        if (j - i < 2) continue;
        const int corner[3] = {i, k, j};
        for (int c = 0; c < 3; c++) tri[3 * made + c] = corner[c];
        made++;
        stack[top++] = i;
        stack[top++] = k;
        stack[top++] = k;
        stack[top++] = j;
    }
    free(best);
    free(apex);
    free(stack);
}

cutter cutter_stack(int levels, int nodes, const double *xyz, const uint8_t *side_moves, bool first_cap_moves,
                    bool last_cap_moves)
{
    assert(levels >= 2 && nodes >= 3);
    int32_t cap = nodes - 2, count = 2 * cap + 2 * (levels - 1) * nodes, t = 0;
    cutter c = {.body = surface_new(levels * nodes, count), .moves = NEW_ARRAY(uint8_t, count)};
    for (int i = 0; i < 3 * levels * nodes; i++) c.body.xyz[i] = xyz[i];
    int32_t *tri = c.body.tri;
    triangulate(nodes, xyz, tri);
    for (int32_t i = 0; i < cap; i++) { /* the first cap looks away from the stack */
        int32_t keep = tri[3 * i + 1];
        tri[3 * i + 1] = tri[3 * i + 2];
        tri[3 * i + 2] = keep;
        c.moves[t++] = first_cap_moves;
    }
    triangulate(nodes, xyz + 3 * (size_t)(levels - 1) * nodes, tri + 3 * (size_t)t);
    for (int32_t i = 0; i < cap; i++) {
        for (int k = 0; k < 3; k++) tri[3 * t + k] += (levels - 1) * nodes;
        c.moves[t++] = last_cap_moves;
    }
    for (int l = 0; l + 1 < levels; l++)
        for (int j = 0; j < nodes; j++) {
            int32_t a = l * nodes + j, b = l * nodes + (j + 1) % nodes, up = nodes;
            int32_t quad[6] = {a, b, b + up, a, b + up, a + up};
            for (int k = 0; k < 6; k++) tri[3 * t + k] = quad[k];
            c.moves[t] = c.moves[t + 1] = side_moves[j];
            t += 2;
        }
    assert(t == count);
    if (surface_volume(&c.body) < 0) surface_flip(&c.body);
    return c;
}

cutter cutter_box(const head_frame *f, const double low[3], const double high[3])
{
    double xyz[24];
    for (int i = 0; i < 8; i++) {
        int corner = i % 4;
        double local[3] = {corner == 1 || corner == 2 ? high[0] : low[0], corner >= 2 ? high[1] : low[1],
                           i >= 4 ? high[2] : low[2]};
        head_frame_to_world(f, local, xyz + 3 * i);
    }
    return cutter_stack(2, 4, xyz, (const uint8_t[4]){0}, false, false);
}

/* Turns the symmetric a into its eigenvalues (diagonal) and the columns of q into its eigenvectors: Jacobi rotations.
 */
static void eigen3(double a[9], double q[9])
{
    for (int i = 0; i < 9; i++) q[i] = i % 4 == 0;
    for (int sweep = 0; sweep < 12; sweep++)
        for (int i = 0; i < 2; i++)
            for (int j = i + 1; j < 3; j++) {
                if (fabs(a[3 * i + j]) < 1e-300) continue;
                double theta = (a[4 * j] - a[4 * i]) / (2 * a[3 * i + j]);
                double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1);
                double s = t * c;
                for (int k = 0; k < 3; k++) { /* columns, then rows */
                    double x = a[3 * k + i], y = a[3 * k + j], u = q[3 * k + i], v = q[3 * k + j];
                    a[3 * k + i] = c * x - s * y;
                    a[3 * k + j] = s * x + c * y;
                    q[3 * k + i] = c * u - s * v;
                    q[3 * k + j] = s * u + c * v;
                }
                for (int k = 0; k < 3; k++) {
                    double x = a[3 * i + k], y = a[3 * j + k];
                    a[3 * i + k] = c * x - s * y;
                    a[3 * j + k] = s * x + c * y;
                }
            }
}

/* Least squares with the directions left out in which the planes are nearly parallel (within about 8 degrees): there
 * a corner would shoot off along the fold. */
static void solve_offset(double a[9], const double b[3], double x[3])
{
    const double parallel = 0.02;
    double q[9];
    eigen3(a, q);
    double largest = fmax(a[0], fmax(a[4], a[8]));
    for (int c = 0; c < 3; c++) x[c] = 0;
    for (int k = 0; k < 3; k++) {
        if (!(a[4 * k] > parallel * largest)) continue;
        double along = (q[k] * b[0] + q[3 + k] * b[1] + q[6 + k] * b[2]) / a[4 * k];
        for (int c = 0; c < 3; c++) x[c] += along * q[3 * c + k];
    }
}

surface cutter_offset(const cutter *c, double moving_mm, double fixed_mm)
{
    surface out = surface_copy(&c->body);
    double *a = NEW_ARRAY(double, 9 * (size_t)out.vertex_count), *b = NEW_ARRAY(double, 3 * (size_t)out.vertex_count);
    for (int32_t t = 0; t < out.triangle_count; t++) {
        const int32_t *v = c->body.tri + 3 * (size_t)t;
        double u[3], w[3], n[3], amount = c->moves[t] ? moving_mm : fixed_mm;
        vec_sub(c->body.xyz + 3 * (size_t)v[1], c->body.xyz + 3 * (size_t)v[0], u);
        vec_sub(c->body.xyz + 3 * (size_t)v[2], c->body.xyz + 3 * (size_t)v[0], w);
        vec_cross(u, w, n);
        if (!(vec_normalize(n) > 0)) continue;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) a[9 * (size_t)v[k] + 3 * i + j] += n[i] * n[j];
                b[3 * (size_t)v[k] + i] += amount * n[i];
            }
    }
    for (int32_t v = 0; v < out.vertex_count; v++) {
        double d[3];
        solve_offset(a + 9 * (size_t)v, b + 3 * (size_t)v, d);
        vec_add(out.xyz + 3 * (size_t)v, d, out.xyz + 3 * (size_t)v);
    }
    free(a);
    free(b);
    return out;
}

surface cutter_sheet(const cutter *c) { return surface_select(&c->body, c->moves); }
