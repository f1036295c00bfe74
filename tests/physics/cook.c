/* Cook's membrane, nearly incompressible, in plane strain: one layer of cells between sliding planes. A panel
 * (0,0) (48,44) (48,60) (0,44) mm held at its left side, a shear of 1 mN per mm of thickness spread over the
 * right one. G = 0.375, lambda = 7500 kPa (nu 0.499975). The tip (48, 52) rises by 16.4326 mm in linear
 * elasticity: Krysl, FAESOR, Cook_3D_strain, by Richardson's extrapolation of nodally integrated quadratic
 * triangles. */
#include "tests/physics/evidence.h"
#include "tests/physics/loaded.h"

static const double shear_kpa = 0.375, lame_kpa = 7500, reference_mm = 16.432584;

typedef struct panel {
    tetmesh mesh;
    attach_map attach;
    double *load;
    int32_t tip;
} panel;

static panel make_panel(int cells, int tets)
{
    block b = {cells, cells, 1, {48, 44, 48.0 / cells}, tets, 0};
    panel p = {.mesh = block_mesh(&b), .tip = block_node(&b, cells, cells / 2, 0)};
    int32_t nodes = p.mesh.vertex_count, *face, count = tetmesh_boundary(&p.mesh, &face, NULL);
    p.attach = attach_map_new(nodes, 0);
    p.load = NEW_ARRAY(double, 3 * (size_t)nodes);
    for (int32_t v = 0; v < nodes; v++) {
        double *x = p.mesh.xyz + 3 * (size_t)v;
        x[1] += x[0] / 48 * (44 - x[1] / 44 * 28);
        if (x[0] == 0) {
            tie(&p.attach, v, SEGMENT_CRANIUM);
            continue;
        }
        p.attach.kind[v] = NODE_SLIDING;
        p.attach.segment[v] = SEGMENT_CRANIUM;
        p.attach.normal[3 * (size_t)v + 2] = x[2] > 0 ? 1 : -1;
    }
    for (int32_t f = 0; f < count; f++) {
        const double *x[3];
        bool right = true;
        for (int k = 0; k < 3; k++) {
            x[k] = p.mesh.xyz + 3 * (size_t)face[3 * f + k];
            right = right && x[k][0] == 48;
        }
        double area[3], u[3], w[3];
        vec_sub(x[1], x[0], u);
        vec_sub(x[2], x[0], w);
        vec_cross(u, w, area);
        for (int k = 0; right && k < 3; k++) p.load[3 * (size_t)face[3 * f + k] + 1] += vec_norm(area) / 6 / 16;
    }
    free(face);
    return p;
}

static void free_panel(panel *p)
{
    tetmesh_free(&p->mesh);
    attach_map_free(&p->attach);
    free(p->load);
}

static double tip_rise(int cells, int tets, element_kind kind)
{
    err e = {0};
    panel p = make_panel(cells, tets);
    double young = shear_kpa * (3 * lame_kpa + 2 * shear_kpa) / (lame_kpa + shear_kpa),
           *x = NEW_ARRAY(double, 3 * (size_t)p.mesh.vertex_count);
    region_material table = {.region = REGION_ANY};
    assert_ok(material_make(MATERIAL_SNH_LOG, young, lame_kpa / (2 * (lame_kpa + shear_kpa)), &table.material, &e));
    assert_ok(element_choose(&table.material, kind, &e));
    equilibrium_problem problem = {.mesh = &p.mesh, .attach = &p.attach, .materials = &table, .material_count = 1};
    solver *t = NULL;
    assert_ok(solver_create(&problem, 1, &t, &e));
    loaded_solve(t, p.load, 0, x);
    double rise = x[3 * (size_t)p.tip + 1] - p.mesh.xyz[3 * (size_t)p.tip + 1];
    solver_destroy(&t);
    free_panel(&p);
    free(x);
    return rise;
}

static void averages_find_the_rise_of_the_tip(void **state)
{
    (void)state;
    for (int tets = 5; tets <= 6; tets++) {
        double off[2][4]; /* linear, averaged; part of the reference that is missing */
        for (int k = 0; k < 4; k++) {
            for (int average = 0; average < 2; average++)
                off[average][k] =
                    1 - tip_rise(4 << k, tets, average ? ELEMENT_AVERAGED : ELEMENT_LINEAR) / reference_mm;
            print_message("%2d cells of %d tets: missing of the reference: linear %.1f %%, averaged %.1f %%\n", 4 << k,
                          tets, 100 * off[0][k], 100 * off[1][k]);
        }
        for (int k = 1; k < 4; k++) assert_true(off[1][k] > 0 && off[1][k] < 0.75 * off[1][k - 1]);
        assert_true(off[1][3] < 0.08 && off[1][2] < off[0][3]);
        if (tets == 5) continue;
        assert_true(off[0][3] > 0.7 && off[0][0] - off[0][3] < 0.02); /* locked whatever the cells */
        evidence("Cook's membrane, Poisson 0.499975: linear tets miss of the rise", 100 * off[0][3], "%");
        evidence("Cook's membrane, Poisson 0.499975: averaged volumes miss of it", 100 * off[1][3], "%");
    }
}

/* Large deformation: the right side held too, and moved up by a quarter of the length; energy per mm of
 * thickness. */
static double bent_energy(int cells, int tets, element_kind kind)
{
    err e = {0};
    panel p = make_panel(cells, tets);
    region_material table = {.region = REGION_ANY};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, 0.4999, &table.material, &e));
    assert_ok(element_choose(&table.material, kind, &e));
    for (int32_t v = 0; v < p.mesh.vertex_count; v++)
        if (p.mesh.xyz[3 * (size_t)v] == 48) tie(&p.attach, v, SEGMENT_MAXILLA);
    equilibrium_problem problem = {.mesh = &p.mesh, .attach = &p.attach, .materials = &table, .material_count = 1};
    rest_motions(problem.motion);
    problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 12, 0});
    solve_params params = solve_params_default();
    equilibrium q;
    assert_ok(equilibrium_solve(&problem, &params, &q, &e));
    assert_int_equal(q.outcome, SOLVED);
    double energy = q.energy_uj * cells / 48;
    equilibrium_free(&q);
    free_panel(&p);
    return energy;
}

/* Extrapolated from 32 and 64 cells both meshes of averages end at 191.4 uJ/mm. */
static void averages_bend_as_far_as_they_should(void **state)
{
    (void)state;
    for (int tets = 5; tets <= 6; tets++) {
        double over[2][3];
        for (int k = 0; k < 3; k++) {
            for (int average = 0; average < 2; average++)
                over[average][k] = bent_energy(8 << k, tets, average ? ELEMENT_AVERAGED : ELEMENT_LINEAR) / 191.4 - 1;
            print_message("%2d cells of %d tets: energy too high: linear %.2f %%, averaged %.2f %%\n", 8 << k, tets,
                          100 * over[0][k], 100 * over[1][k]);
        }
        for (int k = 1; k < 3; k++) assert_true(over[1][k] > 0 && over[1][k] < 0.55 * over[1][k - 1]);
        assert_true(over[1][2] < 0.01 && over[1][2] < 0.5 * over[0][2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(averages_find_the_rise_of_the_tip),
        cmocka_unit_test(averages_bend_as_far_as_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
