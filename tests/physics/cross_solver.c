/* The slab of the cross_solver data, solved by FEBio, dolfinx, Vega and CalculiX with the same energies. */
#include "tests/check.h"
#include "sim/equilibrium.h"
#include "tests/physics/block.h"
#include "tests/physics/evidence.h"
#include <string.h>

static double *read_columns(const char *file, int columns, int32_t *rows)
{
    char path[4096];
    const char *root = getenv("GNATHOS_DATA");
    snprintf(path, sizeof path, "%s/cross_solver/slab_4k/%s", root ? root : "../shared/data", file);
    FILE *f = fopen(path, "r");
    if (!f) return NULL;
    int64_t count = 0, room = 1024;
    double *value = NEW_ARRAY(double, room), x;
    while (fscanf(f, "%lf", &x) == 1) {
        if (count == room) value = GROW_ARRAY(double, value, room *= 2);
        value[count++] = x;
    }
    fclose(f);
    assert_int_equal(count % columns, 0);
    *rows = (int32_t)(count / columns);
    return value;
}

typedef struct slab {
    tetmesh mesh;
    attach_map attach;
    rigid motion[SEGMENT_COUNT];
} slab;

static bool read_slab(slab *s)
{
    int32_t nodes, tets, fixed, moved;
    double *xyz = read_columns("nodes.txt", 3, &nodes);
    if (!xyz) return false;
    double *tet = read_columns("tets.txt", 4, &tets), *hold = read_columns("fixed.txt", 1, &fixed);
    double *move = read_columns("moved.txt", 4, &moved);
    assert_true(tet && hold && move);
    s->mesh = tetmesh_new(nodes, tets);
    s->attach = attach_map_new(nodes, 0);
    memcpy(s->mesh.xyz, xyz, 3 * (size_t)nodes * sizeof *xyz);
    for (int32_t i = 0; i < 4 * tets; i++) s->mesh.tet[i] = (int32_t)tet[i];
    for (int32_t i = 0; i < fixed; i++) tie(&s->attach, (int32_t)hold[i], SEGMENT_CRANIUM);
    for (int32_t i = 0; i < moved; i++) tie(&s->attach, (int32_t)move[4 * i], SEGMENT_MAXILLA);
    rest_motions(s->motion);
    s->motion[SEGMENT_MAXILLA] = rigid_translation(move + 1);
    free(xyz);
    free(tet);
    free(hold);
    free(move);
    return true;
}

/* Returns the largest difference. */
static double compare(const slab *s, material_model model, double poisson, const char *file, double tol)
{
    err e = {0};
    region_material table = {REGION_ANY, {0}};
    assert_ok(material_make(model, 15, poisson, &table.material, &e));
    equilibrium_problem problem = {.mesh = &s->mesh, .attach = &s->attach, .materials = &table, .material_count = 1};
    memcpy(problem.motion, s->motion, sizeof problem.motion);
    int32_t rows;
    double *want = read_columns(file, 3, &rows), worst = 0, all = 0;
    assert_non_null(want);
    assert_int_equal(rows, s->mesh.vertex_count);
    static const char *const way_name[] = {"Newton", "reused factors", "gradients"};
    for (int way = 0; way < 3; way++) {
        equilibrium q;
        solve_params params = solve_params_default();
        params.reuse_factor = way > 0;
        params.linear = way == 2 ? LINEAR_GRADIENTS : LINEAR_FACTOR;
        if (model > MATERIAL_SNH) params.rel_tol = 1e-10; /* their own residual is small: 1e-8 leaves 2e-6 mm */
        assert_ok(equilibrium_solve(&problem, &params, &q, &e));
        assert_int_equal(q.outcome, SOLVED);
        worst = 0;
        for (int32_t i = 0; i < 3 * rows; i++) worst = fmax(worst, fabs(q.xyz[i] - s->mesh.xyz[i] - want[i]));
        print_message("%s nu %.2f %s: %d iterations, %d factorisations, %.2f s, min J %.4f, largest "
                      "difference %.2g mm\n",
                      material_model_name(model), poisson, way_name[way], q.iterations, q.factorisations, q.total_s,
                      q.extremes.min_j, worst);
        assert_true(keep_worst(&all, worst) < tol);
        equilibrium_free(&q);
    }
    free(want);
    return all;
}

static void the_slab_of_other_solvers_is_met(void **state)
{
    (void)state;
    slab s;
    if (!read_slab(&s)) {
        print_message("no cross_solver data here: skipped\n");
        skip();
    }
    double worst = 0;
    static const char *const name[] = {"snhlog", "snh", "nhln", "nhiso"};
    for (int model = 0; model < MATERIAL_IJ_COUNT; model++)
        for (int n = 0; n < 2; n++) {
            char file[64];
            snprintf(file, sizeof file, "u_%s_nu0%d.txt", name[model], n ? 49 : 45);
            keep_worst(&worst, compare(&s, (material_model)model, n ? 0.49 : 0.45, file, 1e-6));
        }
    evidence("slab of 4k nodes, four energies, beside FEBio, dolfinx, Vega and CalculiX: worst node", worst, "mm");
    tetmesh_free(&s.mesh);
    attach_map_free(&s.attach);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_slab_of_other_solvers_is_met)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
