/* A question with an exact answer: a thick tube in plane strain, its outer wall held and its inner wall
 * turned. The solver sees a ring of tets between two bones and two planes; the answer comes from the radial
 * equations d(R P_rr)/dR = P_tt + R P_tr g',   R r P_tr = const.   at  F = [r' 0 0; r g' r/R 0; 0 0 1] for
 * the place r(R) and the turn g(R) of each shell, solved on 1920 shells. */
#include "app/study/study.h"
#include "app/planner/store/child.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHELLS = 1920 };
static const double inner = 10, outer = 20, turn = 0.45;

/* Energy derivatives of one shell in (r0, g0, r1, g1): half[2] of each end, and the 4 x 4 matrix. */
static void shell(const material *m, int i, const double *y, double force[4], double K[16])
{
    double h = (outer - inner) / SHELLS, R = inner + (i + 0.5) * h;
    double slope = (y[2] - y[0]) / h, r = (y[2] + y[0]) / 2, g = (y[3] - y[1]) / h;
    double F[9] = {slope, 0, 0, r * g, r / R, 0, 0, 0, 1}, P[9], H[81];
    material_stress(m, F, P);
    material_hessian(m, F, H);
    /* dF (entries rr, tr, tt) by the four unknowns; tr holds the product r g' */
    const double d[3][4] = {{-1 / h, 0, 1 / h, 0}, {g / 2, -r / h, g / 2, r / h}, {0.5 / R, 0, 0.5 / R, 0}};
    const double cross[16] = {0, -0.5 / h, 0, 0.5 / h, -0.5 / h, 0, -0.5 / h, 0,
                              0, -0.5 / h, 0, 0.5 / h, 0.5 / h,  0, 0.5 / h,  0};
    static const int at[3] = {0, 3, 4};
    for (int a = 0; a < 4; a++) {
        force[a] = 0;
        for (int k = 0; k < 3; k++) force[a] += h * R * P[at[k]] * d[k][a];
        for (int b = 0; b < 4; b++) {
            double sum = P[3] * cross[4 * a + b];
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++) sum += d[k][a] * H[9 * at[k] + at[l]] * d[l][b];
            K[4 * a + b] = h * R * sum;
        }
    }
}

static void invert2(const double A[4], double out[4])
{
    double det = A[0] * A[3] - A[1] * A[2];
    out[0] = A[3] / det;
    out[1] = -A[1] / det;
    out[2] = -A[2] / det;
    out[3] = A[0] / det;
}

/* y -= K^-1 f over the inner shells' ends, block tridiagonal; returns the largest change. D, U: [4*ends]. */
static double newton_step(const material *m, double *y, double *D, double *U, double *f)
{
    int n = SHELLS + 1;
    memset(D, 0, 4 * (size_t)n * sizeof *D);
    memset(f, 0, 2 * (size_t)n * sizeof *f);
    for (int i = 0; i < SHELLS; i++) {
        double g[4], K[16];
        shell(m, i, y + 2 * i, g, K);
        for (int a = 0; a < 2; a++) {
            f[2 * i + a] += g[a];
            f[2 * i + 2 + a] += g[2 + a];
            for (int b = 0; b < 2; b++) {
                D[4 * i + 2 * a + b] += K[4 * a + b];
                D[4 * i + 4 + 2 * a + b] += K[4 * (a + 2) + b + 2];
                U[4 * i + 2 * a + b] = K[4 * a + b + 2];
            }
        }
    }
    for (int i = 2; i < SHELLS; i++) { /* eliminate downwards; the ends 0 and SHELLS are held */
        double inverse[4], L[4];
        invert2(D + 4 * (i - 1), inverse);
        const double *u = U + 4 * (i - 1);
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) L[2 * a + b] = u[a] * inverse[b] + u[2 + a] * inverse[2 + b];
        for (int a = 0; a < 2; a++) {
            for (int b = 0; b < 2; b++) D[4 * i + 2 * a + b] -= L[2 * a] * u[b] + L[2 * a + 1] * u[2 + b];
            f[2 * i + a] -= L[2 * a] * f[2 * i - 2] + L[2 * a + 1] * f[2 * i - 1];
        }
    }
    double largest = 0, after[2] = {0};
    for (int i = SHELLS - 1; i > 0; i--) {
        double inverse[4], rhs[2], step[2];
        invert2(D + 4 * i, inverse);
        for (int a = 0; a < 2; a++)
            rhs[a] = f[2 * i + a] - U[4 * i + 2 * a] * after[0] - U[4 * i + 2 * a + 1] * after[1];
        for (int a = 0; a < 2; a++) {
            step[a] = inverse[2 * a] * rhs[0] + inverse[2 * a + 1] * rhs[1];
            largest = fmax(largest, fabs(step[a]));
            y[2 * i + a] -= step[a];
        }
        memcpy(after, step, sizeof after);
    }
    return largest;
}

/* r and g at the SHELLS + 1 ends; the turn is reached in ten parts. False: no solution found. */
static bool exact(const material *m, double *y)
{
    int n = SHELLS + 1;
    double *work = NEW_ARRAY(double, 10 * (size_t)n), change = 1;
    for (int i = 0; i < n; i++) y[2 * i] = inner + (outer - inner) * i / SHELLS;
    for (int part = 1; part <= 10; part++) {
        for (int i = 0; i < SHELLS; i++) y[2 * i + 1] += turn / 10 * (SHELLS - i) / SHELLS;
        for (int k = 0; k < 30; k++) {
            change = newton_step(m, y, work, work + 4 * n, work + 8 * n);
            if (change < 1e-12) break;
        }
    }
    free(work);
    return change < 1e-9;
}

static void ring(int n, tetmesh *out, attach_map *hang)
{
    static const int five[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    int around = 8 * n, high = 2;
    double height = high * (outer - inner) / n;
    tetmesh m = tetmesh_new((n + 1) * around * (high + 1), 5 * n * around * high);
    attach_map a = attach_map_new(m.vertex_count, 0);
    for (int k = 0; k <= high; k++)
        for (int j = 0; j < around; j++)
            for (int i = 0; i <= n; i++) {
                int32_t v = (k * around + j) * (n + 1) + i;
                double R = inner + (outer - inner) * i / n, angle = 2 * M_PI * j / around;
                double at[3] = {R * cos(angle), R * sin(angle), height * k / high};
                vec_copy(at, m.xyz + 3 * (size_t)v);
                bool wall = i == 0 || i == n, end = k == 0 || k == high;
                if (!wall && !end) continue;
                a.kind[v] = wall ? NODE_TIED : NODE_SLIDING;
                a.segment[v] = i == 0 ? SEGMENT_MAXILLA : SEGMENT_CRANIUM;
                if (!wall) a.normal[3 * (size_t)v + 2] = k ? -1 : 1;
            }
    int32_t *tet = m.tet;
    for (int k = 0; k < high; k++)
        for (int j = 0; j < around; j++)
            for (int i = 0; i < n; i++)
                for (int t = 0; t < 5; t++, tet += 4) {
                    for (int c = 0; c < 4; c++) {
                        int corner = five[t][c] ^ ((i + j + k) % 2 ? 1 : 0);
                        tet[c] = ((k + (corner >> 2)) * around + (j + (corner >> 1 & 1)) % around) * (n + 1) + i +
                                 (corner & 1);
                    }
                    const double *x[4];
                    for (int c = 0; c < 4; c++) x[c] = m.xyz + 3 * (size_t)tet[c];
                    if (vec_six_volume(x[0], x[1], x[2], x[3]) > 0) continue;
                    int32_t keep = tet[2];
                    tet[2] = tet[3];
                    tet[3] = keep;
                }
    *out = m;
    *hang = a;
}

typedef struct job {
    const study_task *task;
    study_tube *row;
} job;

/* Root mean square distance of the free nodes from their exact places. */
static double distance(const tetmesh *m, const attach_map *a, const double *xyz, const double *y)
{
    double sum = 0;
    int32_t count = 0;
    for (int32_t v = 0; v < m->vertex_count; v++) {
        const double *X = m->xyz + 3 * (size_t)v;
        if (a->kind[v] == NODE_TIED) continue;
        double R = hypot(X[0], X[1]), at = (R - inner) / (outer - inner) * SHELLS;
        int i = (int)fmin(floor(at), SHELLS - 1);
        double part = at - i, r = (1 - part) * y[2 * i] + part * y[2 * i + 2],
               g = (1 - part) * y[2 * i + 1] + part * y[2 * i + 3];
        double angle = atan2(X[1], X[0]) + g, want[3] = {r * cos(angle), r * sin(angle), X[2]};
        double off = vec_distance(want, xyz + 3 * (size_t)v);
        sum += off * off;
        count++;
    }
    return sqrt(sum / count);
}

static void work(void *context, void *result)
{
    const job *j = context;
    study_tube row = *j->row;
    err e = {0};
    tetmesh m;
    attach_map a;
    region_material table = {.region = REGION_ANY};
    double *y = NEW_ARRAY(double, 2 * (SHELLS + 1));
    ring(row.cells, &m, &a);
    bool ok = material_make(MATERIAL_SNH_LOG, j->task->patient->material.young_kpa, row.poisson, &table.material, &e) &&
              element_choose(&table.material, row.average ? ELEMENT_AVERAGED : ELEMENT_LINEAR, &e) &&
              exact(&table.material, y);
    equilibrium_problem problem = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    for (int s = 0; s < SEGMENT_COUNT; s++) problem.motion[s] = rigid_identity();
    problem.motion[SEGMENT_MAXILLA] = rigid_rotation((double[3]){0}, (double[]){0, 0, 1}, turn);
    solve_params params = solve_params_default();
    equilibrium q = {0};
    double begin = clock_s();
    ok = ok && equilibrium_solve(&problem, &params, &q, &e);
    row.wall_s = clock_s() - begin;
    row.solved = ok && q.outcome == SOLVED;
    row.unknowns = q.unknown_count;
    row.iterations = q.iterations;
    row.error_mm = row.solved ? distance(&m, &a, q.xyz, y) : (double)NAN;
    memcpy(result, &row, sizeof row);
}

bool study_tubes(const study_task *t, study_tube out[STUDY_TUBES], err *e)
{
    static const double poisson[2] = {0.45, 0.49};
    for (int i = 0; i < STUDY_TUBES; i++) {
        study_tube row = {
            .cells = 4 << i % 3, .average = i / 3 % 2, .poisson = poisson[i / 6], .error_mm = (double)NAN};
        job j = {t, &row};
        child_use use;
        if (child_run(t->watch, work, &j, &row, sizeof row, 600, &use) == CHILD_INTERRUPTED)
            return err_set(e, ERR_INTERRUPTED, "interrupted; what is done is kept in %s, and the same command goes on",
                           t->folder);
        out[i] = row;
    }
    return true;
}
