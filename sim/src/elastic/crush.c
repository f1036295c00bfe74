#include "sim/src/elastic/crush.h"
#include "geometry/mem.h"
#include "sim/src/elastic/assemble_parts.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

static const double first_moduli = 5; /* of the tissue: the first pressure */
static const double stiffening_step = 4;

void crush_free(crush *c)
{
    free(c->tet);
    *c = (crush){0};
}

void crush_begin(crush *c, double least_j)
{
    assert(least_j >= 0 && least_j <= 0.5);
    c->least_j = least_j;
    c->count = 0;
}

static double find_j(const assembly *a, int32_t t, const double *x, double F[9])
{
    double x_e[12];
    element_nodes(a->tet, t, x, x_e);
    element_gradient_F(a->el.gradient + 12 * (size_t)t, x_e, F);
    return mat_det(F);
}

static int32_t find(const crush *c, int32_t t)
{
    int32_t i = 0;
    while (i < c->count && c->tet[i].tet != t) i++;
    return i;
}

static void add(crush *c, int32_t t)
{
    double young = c->a->el.materials[c->a->el.material[t]].young_kpa;
    if ((c->count & (c->count - 1)) == 0) /* room is the next power of two */
        c->tet = GROW_ARRAY(crushed_tet, c->tet, c->count ? 2 * (size_t)c->count : 1);
    c->tet[c->count++] = (crushed_tet){t, first_moduli * young};
}

bool crush_stiffen(crush *c, const uint8_t *fixed, bool again, const double *x)
{
    bool any = false;
    for (int32_t t = 0; c->least_j > 0 && t < c->a->tet_count; t++) {
        double F[9];
        const int32_t *v = c->a->tet + 4 * (size_t)t;
        if (!(find_j(c->a, t, x, F) < c->least_j) || (fixed[v[0]] && fixed[v[1]] && fixed[v[2]] && fixed[v[3]]))
            continue;
        int32_t i = find(c, t);
        if (i == c->count)
            add(c, t);
        else if (again)
            c->tet[i].pressure_kpa *= stiffening_step;
        else
            continue;
        any = true;
    }
    return any;
}

typedef struct guarded {
    double energy_uj, by_j, by_jj; /* and its derivatives by J */
    double F[9], slope[12];        /* dJ/dx */
} guarded;

/* False: it has volume enough. */
static bool evaluate(const crush *c, const crushed_tet *of, const double *x, guarded *out)
{
    double all = 2 * c->least_j, u = 1 - find_j(c->a, of->tet, x, out->F) / all, cofactor[9];
    if (!(u > 0)) return false;
    double p = c->a->el.volume[of->tet] * of->pressure_kpa, over = log(fmax(u, 1));
    out->energy_uj = p * all * (u <= 1 ? u * u * u / 3 : 4.0 / 3 + u * (2 * over - 1));
    out->by_j = -p * (u <= 1 ? u * u : 1 + 2 * over);
    out->by_jj = p / all * (u <= 1 ? 2 * u : 2 / u);
    for (int r = 0; r < 3; r++) vec_cross(out->F + 3 * ((r + 1) % 3), out->F + 3 * ((r + 2) % 3), cofactor + 3 * r);
    for (int k = 0; k < 4; k++)
        mat_apply(cofactor, c->a->el.gradient + 12 * (size_t)of->tet + 3 * k, out->slope + 3 * k);
    return true;
}

static double energy(void *self, const double *x, double *force)
{
    const crush *c = self;
    double sum = 0;
    for (int32_t i = 0; i < c->count; i++) {
        guarded g;
        if (!evaluate(c, &c->tet[i], x, &g)) continue;
        sum += g.energy_uj;
        for (size_t k = 0; force && k < 4; k++) {
            double *f = force + 3 * (size_t)c->a->tet[4 * (size_t)c->tet[i].tet + k];
            vec_axpy(f, g.by_j, g.slope + 3 * k, f);
        }
    }
    return sum;
}

/* Adds d2J / dx_i dx_j times w: the cross product with F (gradient_i x gradient_j). */
static void add_bend(const double F[9], const double *gradient_i, const double *gradient_j, double w, double block[9])
{
    double cross[3], b[3];
    vec_cross(gradient_i, gradient_j, cross);
    mat_apply(F, cross, b);
    for (int r = 0; r < 3; r++) {
        block[3 * r + (r + 1) % 3] += w * b[(r + 2) % 3];
        block[3 * r + (r + 2) % 3] -= w * b[(r + 1) % 3];
    }
}

static void stiffness(void *self, const double *x, const double *force, projection how, assembly *a)
{
    const crush *c = self;
    (void)force;
    assert(c->a == a);
    for (int32_t i = 0; i < c->count; i++) {
        guarded g;
        const int32_t *v = a->tet + 4 * (size_t)c->tet[i].tet;
        const double *gradient = a->el.gradient + 12 * (size_t)c->tet[i].tet;
        if (!evaluate(c, &c->tet[i], x, &g)) continue;
        for (int p = 0; p < 4; p++)
            for (int q = 0; q < 4; q++) {
                if (v[p] > v[q]) continue;
                double *block = assembly_block(a, v[p], v[q]);
                for (int k = 0; k < 9; k++) block[k] += g.by_jj * g.slope[3 * p + k / 3] * g.slope[3 * q + k % 3];
                if (how == PROJECTION_NONE) add_bend(g.F, gradient + 3 * p, gradient + 3 * q, g.by_j, block);
            }
    }
}

term crush_term(crush *c) { return (term){.self = c, .energy = energy, .stiffness = stiffness}; }
