#include "sim/element.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

const int element_pair[ELEMENT_PAIRS][2] = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1},
                                            {1, 2}, {1, 3}, {2, 2}, {2, 3}, {3, 3}};

const double element_average_from = 0.48, element_keeps = 0.4;

bool element_choose(material *m, element_kind kind, err *e)
{
    bool able = m->model == MATERIAL_SNH_LOG || m->model == MATERIAL_SNH;
    assert(kind == ELEMENT_AUTO || kind == ELEMENT_LINEAR || kind == ELEMENT_AVERAGED);
    if (kind == ELEMENT_AVERAGED && !able)
        return err_set(e, ERR_INPUT, "averaged volume changes need snhlog or snh, got %s",
                       material_model_name(m->model));
    bool average = kind == ELEMENT_AVERAGED || (kind == ELEMENT_AUTO && able && m->poisson >= element_average_from);
    double twice_mu = m->young_kpa / (1 + m->poisson), own = m->poisson / (1 - 2 * m->poisson),
           kept = element_keeps / (1 - 2 * element_keeps);
    m->averaged_kpa = average ? twice_mu * fmax(0, own - kept) : 0;
    return true;
}

static int32_t find_region(const region_material *table, int32_t count, int32_t region)
{
    int32_t any = -1;
    for (int32_t i = 0; i < count; i++) {
        if (table[i].region == region) return i;
        if (table[i].region == REGION_ANY) any = i;
    }
    return any;
}

bool elements_make(const tetmesh *m, const region_material *table, int32_t table_count, elements *out, err *e)
{
    if (!tetmesh_check(m, e)) return false;
    for (int32_t i = 0; i < table_count; i++)
        for (int32_t j = 0; j < i; j++)
            if (table[i].region == table[j].region)
                return err_set(e, ERR_INPUT, "region %d has two materials", table[i].region);
    for (int32_t t = 0; t < m->tet_count; t++)
        if (find_region(table, table_count, m->region[t]) < 0)
            return err_set(e, ERR_INPUT, "tet %d is of region %d, which has no material", t, m->region[t]);
    elements el = {.count = m->tet_count,
                   .gradient = NEW_ARRAY(double, 12 * (size_t)m->tet_count),
                   .volume = NEW_ARRAY(double, m->tet_count),
                   .material = NEW_ARRAY(int32_t, m->tet_count),
                   .material_count = table_count,
                   .materials = NEW_ARRAY(struct material, table_count)};
    for (int32_t i = 0; i < table_count; i++) el.materials[i] = table[i].material;
    for (int32_t t = 0; t < m->tet_count; t++) {
        const double *x[4];
        for (int a = 0; a < 4; a++) x[a] = m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + a];
        double d[3][3], *g = el.gradient + 12 * (size_t)t;
        for (int a = 0; a < 3; a++) vec_sub(x[a + 1], x[0], d[a]);
        vec_cross(d[1], d[2], g + 3);
        vec_cross(d[2], d[0], g + 6);
        vec_cross(d[0], d[1], g + 9);
        double six_volume = vec_dot(d[0], g + 3);
        el.volume[t] = six_volume / 6;
        el.material[t] = find_region(table, table_count, m->region[t]);
        for (int c = 0; c < 3; c++) {
            for (int a = 1; a < 4; a++) g[3 * a + c] /= six_volume;
            g[c] = -(g[3 + c] + g[6 + c] + g[9 + c]);
        }
    }
    *out = el;
    return true;
}

void elements_free(elements *el)
{
    free(el->gradient);
    free(el->volume);
    free(el->material);
    free(el->materials);
    *el = (elements){0};
}

void element_gradient_F(const double gradient[12], const double x_e[12], double F[9])
{
    double d[3][3];
    for (int a = 0; a < 3; a++) vec_sub(x_e + 3 * (a + 1), x_e, d[a]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            F[3 * i + j] = d[0][i] * gradient[3 + j] + d[1][i] * gradient[6 + j] + d[2][i] * gradient[9 + j];
}

double element_energy(const material *m, const double gradient[12], double volume, const double x_e[12], double *force)
{
    double F[9];
    element_gradient_F(gradient, x_e, F);
    double C[9], P[9], psi;
    if (m->model >= MATERIAL_IJ_COUNT) {
        psi = material_energy(m, F);
        if (!force) return volume * psi;
        material_stress(m, F, P);
        for (int i = 0; i < 9; i++) P[i] *= volume;
    } else {
        material_terms t = material_terms_at(m, F);
        psi = t.psi;
        if (!force) return volume * psi;
        material_cofactor(F, C);
        for (int i = 0; i < 9; i++) P[i] = volume * (2 * t.psi_i * F[i] + t.psi_j * C[i]);
    }
    for (int a = 1; a < 4; a++) mat_apply(P, gradient + 3 * a, force + 3 * a);
    for (int c = 0; c < 3; c++) force[c] = -(force[3 + c] + force[6 + c] + force[9 + c]);
    return volume * psi;
}

/* Any Hessian: V g_a . H . g_b. */
static void full_stiffness(const material *m, const double gradient[12], double volume, const double F[9],
                           projection how, double block[9 * ELEMENT_PAIRS])
{
    double H[81], Hg[4][27]; /* [b]: rows of H times g_b */
    material_hessian_projected(m, F, how, H);
    for (int b = 0; b < 4; b++)
        for (int r = 0; r < 9; r++) mat_apply(H + 9 * r, gradient + 3 * b, Hg[b] + 3 * r);
    for (int p = 0; p < ELEMENT_PAIRS; p++) {
        const double *g = gradient + 3 * element_pair[p][0], *h = Hg[element_pair[p][1]];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double sum = 0;
                for (int r = 0; r < 3; r++) sum += g[r] * h[3 * (3 * i + r) + j];
                block[9 * p + 3 * i + j] = volume * sum;
            }
    }
}

void element_stiffness(const material *m, const double gradient[12], double volume, const double x_e[12],
                       projection how, double block[9 * ELEMENT_PAIRS])
{
    double F[9], C[9], Fg[4][3], Cg[4][3];
    element_gradient_F(gradient, x_e, F);
    if (m->model >= MATERIAL_IJ_COUNT) {
        full_stiffness(m, gradient, volume, F, how, block);
        return;
    }
    material_terms t = material_terms_at(m, F);
    material_cofactor(F, C);
    for (int a = 0; a < 4; a++) {
        mat_apply(F, gradient + 3 * a, Fg[a]);
        mat_apply(C, gradient + 3 * a, Cg[a]);
    }
    double identity = 2 * t.psi_i * volume, ff = 4 * t.psi_ii * volume, cc = t.psi_jj * volume;
    double fc = 2 * t.psi_ij * volume, jj = t.psi_j * volume;
    for (int p = 0; p < ELEMENT_PAIRS; p++) {
        int a = element_pair[p][0], b = element_pair[p][1];
        double *k = block + 9 * p, diagonal = identity * vec_dot(gradient + 3 * a, gradient + 3 * b);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                k[3 * i + j] = ff * Fg[a][i] * Fg[b][j] + cc * Cg[a][i] * Cg[b][j] +
                               fc * (Fg[a][i] * Cg[b][j] + Cg[a][i] * Fg[b][j]);
        k[0] += diagonal;
        k[4] += diagonal;
        k[8] += diagonal;
        if (a == b) continue;
        /* g_a . d2J . g_b = eps_ikm (F (g_a x g_b))_m */
        double cross[3], w[3];
        vec_cross(gradient + 3 * a, gradient + 3 * b, cross);
        mat_apply(F, cross, w);
        k[1] += jj * w[2];
        k[2] -= jj * w[1];
        k[3] -= jj * w[2];
        k[5] += jj * w[0];
        k[6] += jj * w[1];
        k[7] -= jj * w[0];
    }
    if (how == PROJECTION_NONE) return;
    double value[9], mode[9][9];
    int count = material_negative_modes(&t, F, value, mode);
    for (int n = 0; n < count; n++) {
        double w[4][3], lift = (how == PROJECTION_ABS ? -2 : -1) * value[n] * volume;
        for (int a = 0; a < 4; a++) mat_apply(mode[n], gradient + 3 * a, w[a]);
        for (int p = 0; p < ELEMENT_PAIRS; p++)
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    block[9 * p + 3 * i + j] += lift * w[element_pair[p][0]][i] * w[element_pair[p][1]][j];
    }
}
