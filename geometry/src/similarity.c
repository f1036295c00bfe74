#include "geometry/similarity.h"
#include "geometry/vec.h"
#include <string.h>

enum { UNKNOWNS = 7 }; /* turn, shift, size */
static const double open_motion = 1e-9;

similarity similarity_identity(void) { return (similarity){1, rigid_identity()}; }

void similarity_apply(const similarity *s, const double x[3], double out[3])
{
    vec_scale(x, s->scale, out);
    rigid_apply(&s->motion, out, out);
}

similarity similarity_inverse(const similarity *s)
{
    similarity out = {1 / s->scale, rigid_inverse(&s->motion)};
    vec_scale(out.motion.t, out.scale, out.motion.t);
    return out;
}

static void middle_of(const double *x, const double *weight, int32_t count, double out[3])
{
    double sum = 0;
    memset(out, 0, 3 * sizeof *out);
    for (int32_t i = 0; i < count; i++) {
        double w = weight ? weight[i] : 1;
        vec_axpy(out, w, x + 3 * (size_t)i, out);
        sum += w;
    }
    vec_scale(out, 1 / sum, out);
}

/* The eigenvector of the largest eigenvalue of a symmetric 4x4: its powers, squared over and over. */
static void largest_eigenvector(const double n[4][4], double q[4])
{
    double p[4][4], square[4][4], shift = 0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) shift = fmax(shift, 4 * fabs(n[i][k]));
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) p[i][k] = n[i][k] + (i == k ? shift : 0);
    for (int round = 0; round < 60; round++) {
        double most = 0;
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++) {
                square[i][k] = 0;
                for (int m = 0; m < 4; m++) square[i][k] += p[i][m] * p[m][k];
                most = fmax(most, fabs(square[i][k]));
            }
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++) p[i][k] = most > 0 ? square[i][k] / most : 0;
    }
    int best = 0;
    for (int k = 1; k < 4; k++)
        if (p[k][k] > p[best][best]) best = k;
    double norm = 0;
    for (int i = 0; i < 4; i++) norm += p[i][best] * p[i][best];
    for (int i = 0; i < 4; i++) q[i] = norm > 0 ? p[i][best] / sqrt(norm) : i == 0;
}

static void turn_of_quaternion(const double q[4], double r[9])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    const double out[9] = {w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
                           2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
                           2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
    memcpy(r, out, sizeof out);
}

double similarity_of_pairs(const double *from, const double *to, const double *weight, int32_t count, bool with_scale,
                           similarity *out)
{
    double a[3], b[3], m[3][3] = {{0}}, spread_a = 0, spread_b = 0, q[4], sum = 0, left = 0;
    middle_of(from, weight, count, a);
    middle_of(to, weight, count, b);
    for (int32_t i = 0; i < count; i++) {
        double u[3], v[3], w = weight ? weight[i] : 1;
        vec_sub(from + 3 * (size_t)i, a, u);
        vec_sub(to + 3 * (size_t)i, b, v);
        spread_a += w * vec_dot(u, u);
        spread_b += w * vec_dot(v, v);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) m[r][c] += w * u[r] * v[c];
    }
    const double n[4][4] = {{m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]},
                            {m[1][2] - m[2][1], m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]},
                            {m[2][0] - m[0][2], m[0][1] + m[1][0], m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]},
                            {m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], m[2][2] - m[0][0] - m[1][1]}};
    largest_eigenvector(n, q);
    out->scale = with_scale && spread_a > 0 ? sqrt(spread_b / spread_a) : 1;
    out->motion = rigid_identity();
    turn_of_quaternion(q, out->motion.r);
    similarity_apply(out, a, a);
    vec_sub(b, a, out->motion.t);
    for (int32_t i = 0; i < count; i++) {
        double x[3], w = weight ? weight[i] : 1;
        similarity_apply(out, from + 3 * (size_t)i, x);
        vec_sub(x, to + 3 * (size_t)i, x);
        left += w * vec_dot(x, x);
        sum += w;
    }
    return sqrt(left / sum);
}

/* Symmetric elimination without pivots; the unknowns are scaled alike. false: singular. */
static bool solve(int n, double a[UNKNOWNS][UNKNOWNS], double x[UNKNOWNS])
{
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, a[i][i]);
    for (int k = 0; k < n; k++) {
        if (!(a[k][k] > open_motion * largest)) return false;
        for (int i = k + 1; i < n; i++) {
            double f = a[i][k] / a[k][k];
            for (int c = k; c < n; c++) a[i][c] -= f * a[k][c];
            x[i] -= f * x[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int c = k + 1; c < n; c++) x[k] -= a[k][c] * x[c];
        x[k] /= a[k][k];
    }
    return true;
}

double similarity_plane_step(const plane_pair *p, int32_t count, bool with_scale, similarity *s)
{
    int n = with_scale ? UNKNOWNS : UNKNOWNS - 1;
    double middle[3] = {0}, spread = 0, sum = 0, a[UNKNOWNS][UNKNOWNS] = {{0}}, x[UNKNOWNS] = {0};
    for (int32_t i = 0; i < count; i++) {
        vec_axpy(middle, p[i].weight, p[i].at, middle);
        sum += p[i].weight;
    }
    if (!(sum > 0)) return 0;
    vec_scale(middle, 1 / sum, middle);
    for (int32_t i = 0; i < count; i++) spread += p[i].weight * vec_distance(p[i].at, middle) / sum;
    if (!(spread > 0)) return 0;
    for (int32_t i = 0; i < count; i++) {
        double arm[3], gap[3], row[UNKNOWNS];
        vec_sub(p[i].at, middle, arm);
        vec_scale(arm, 1 / spread, arm);
        vec_cross(arm, p[i].normal, row);
        vec_copy(p[i].normal, row + 3);
        row[6] = vec_dot(arm, p[i].normal);
        vec_sub(p[i].to, p[i].at, gap);
        double off = vec_dot(gap, p[i].normal);
        for (int r = 0; r < n; r++) {
            for (int c = 0; c < n; c++) a[r][c] += p[i].weight * row[r] * row[c];
            x[r] += p[i].weight * row[r] * off;
        }
    }
    if (!solve(n, a, x)) return 0;
    double axis[3] = {x[0] / spread, x[1] / spread, x[2] / spread}, angle = vec_normalize(axis);
    double grow = with_scale ? exp(x[6] / spread) : 1;
    rigid turn = angle > 0 ? rigid_rotation(middle, axis, angle) : rigid_identity();
    double middle_kept[3]; /* grows about the middle of the points */
    vec_scale(middle, 1 - grow, middle_kept);
    s->scale *= grow;
    vec_scale(s->motion.t, grow, s->motion.t);
    vec_add(s->motion.t, middle_kept, s->motion.t);
    s->motion = rigid_compose(&turn, &s->motion);
    vec_add(s->motion.t, x + 3, s->motion.t);
    return angle * spread + vec_norm(x + 3) + fabs(log(grow)) * spread;
}
