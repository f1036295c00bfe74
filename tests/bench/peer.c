/* Contact side by side with CalculiX (program ccx): a block of 40 x 40 x 20 mm with a round underside (R 60 mm) is
 * pressed 4 mm onto a rigid plane. Same mesh and energy (nhiso, nu 0.45), frictionless, both from nothing, on one
 * thread. Prints CSV.
 *   peer FOLDER [MM N...]
 * FOLDER keeps CalculiX's files; "-": gnathos alone. MM: depth that a pressure of Young's modulus makes in gnathos'
 * contact (default 0.003; predict has 0.05), which begins so far before the plane. CalculiX: node to surface, linear
 * penalty, as stiff at that pressure. N: cells through the thickness (default 5 and 8: 726 and 2601 nodes; 16 and 20:
 * 52 and 101 thousand unknowns). cpu_ratio: to one linear solve of the same tissue (yardstick.h). */
#include "geometry/parallel.h"
#include "tests/bench/ccx.h"
#include "tests/physics/block.h"
#include <string.h>

static const double round_mm = 60, press_mm = 4, side_mm = 40, high_mm = 20;

typedef struct body {
    tetmesh mesh;
    attach_map attach;
    int32_t under_count, *under; /* nodes of the underside */
    int32_t top;                 /* first node of the top, which goes on to the last */
} body;

static body body_make(int cells)
{
    block grid = {2 * cells, 2 * cells, cells, {side_mm, side_mm, high_mm}, 6, 0};
    body b = {.mesh = block_mesh(&grid), .under_count = (2 * cells + 1) * (2 * cells + 1)};
    b.attach = attach_map_new(b.mesh.vertex_count, 0);
    b.under = NEW_ARRAY(int32_t, b.under_count);
    b.top = b.mesh.vertex_count - b.under_count;
    for (int32_t v = 0; v < b.mesh.vertex_count; v++) {
        double *x = b.mesh.xyz + 3 * (size_t)v;
        double u = x[0] - side_mm / 2, w = x[1] - side_mm / 2;
        double low = round_mm - sqrt(round_mm * round_mm - u * u - w * w);
        x[2] = low + x[2] * (1 - low / high_mm);
        if (v >= b.top) tie(&b.attach, v, SEGMENT_MAXILLA);
        if (v < b.under_count) b.under[v] = v;
    }
    return b;
}

static void body_free(body *b)
{
    tetmesh_free(&b->mesh);
    attach_map_free(&b->attach);
    free(b->under);
}

static double above_plane(const void *context, const double x[3], double grad[3], double *hess)
{
    (void)context;
    vec_copy((const double[]){0, 0, 1}, grad);
    if (hess) memset(hess, 0, 9 * sizeof *hess);
    return x[2];
}

static bool leave_plane(const void *context, const double x[3], const double direction[3], double reach_mm,
                        double hit[3], double normal[3])
{
    (void)context;
    if (!(x[2] < 0 && direction[2] > 0 && -x[2] <= reach_mm * direction[2])) return false;
    vec_axpy(x, -x[2] / direction[2], direction, hit);
    vec_copy((const double[]){0, 0, 1}, normal);
    return true;
}

/* The tissue, and the plane as the top of one fixed brick. */
static void write_deck(const ccx_job *job, const body *b, const material *law, double stiffness)
{
    static const int corner[8][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
    FILE *f = ccx_begin(job, &b->mesh, law);
    int32_t n = b->mesh.vertex_count;
    fprintf(f, "*NODE,NSET=BRICK\n");
    for (int k = 0; k < 8; k++)
        fprintf(f, "%d,%g,%g,%g\n", n + k + 1, 120. * corner[k][0] - 40, 120. * corner[k][1] - 40, k < 4 ? -20. : 0.);
    fprintf(f, "*ELEMENT,TYPE=C3D8,ELSET=EBRICK\n%d", b->mesh.tet_count + 1);
    for (int k = 0; k < 8; k++) fprintf(f, ",%d", n + k + 1);
    fprintf(f,
            "\n*SOLID SECTION,ELSET=EBRICK,MATERIAL=TISSUE\n*SURFACE,NAME=PLANE\n%d,S2\n"
            "*SURFACE,NAME=UNDER,TYPE=NODE\n",
            b->mesh.tet_count + 1);
    for (int32_t i = 0; i < b->under_count; i++) fprintf(f, "%d\n", b->under[i] + 1);
    fprintf(f,
            "*SURFACE INTERACTION,NAME=TOUCH\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n%.9g,%.9g\n"
            "*CONTACT PAIR,INTERACTION=TOUCH,TYPE=NODE TO SURFACE\nUNDER,PLANE\n*NSET,NSET=TOP\n",
            stiffness, 1e-6 * law->mu_kpa);
    for (int32_t v = b->top; v < n; v++) fprintf(f, "%d\n", v + 1);
    ccx_step(f);
    fprintf(f, "*BOUNDARY\nTOP,1,2\nTOP,3,3,%.12g\nBRICK,1,3\n", -press_mm);
    ccx_end(f, "TOP");
}

static void tell_ours(const body *b, double depth_mm, const equilibrium *q, spent took, spent one)
{
    printf("%d,%lld,gnathos,%g,%s,%d,%d,%d,%.2f,%.2f,%.2f,%.2f,%.3f,%.4f", b->mesh.vertex_count,
           (long long)q->unknown_count, depth_mm, solve_outcome_text(q->outcome), q->iterations, q->factorisations,
           q->contact.active_nodes, took.wall_s, took.cpu_s, one.cpu_s, took.cpu_s / one.cpu_s,
           q->segment_force_mn[SEGMENT_MAXILLA][2], q->contact.depth_mm);
}

static void run(const char *folder, double depth_mm, int cells)
{
    err e = {0};
    body b = body_make(cells);
    region_material table = {REGION_ANY, {0}};
    if (!material_make(MATERIAL_NH_ISO, 15, 0.45, &table.material, &e)) give_up(&e);
    bone_shape plane = {NULL, above_plane, leave_plane};
    contact_setup touch = {
        .params = contact_params_default(), .held = true, .extra_count = b.under_count, .extra = b.under};
    touch.params.activation_mm = touch.params.depth_mm = depth_mm; /* a thicker layer is another problem */
    touch.shape[SEGMENT_CRANIUM] = &plane;
    equilibrium_problem p = {.mesh = &b.mesh, .attach = &b.attach, .materials = &table, .material_count = 1};
    rest_motions(p.motion);
    p.motion[SEGMENT_MAXILLA] = rigid_translation((const double[]){0, 0, -press_mm});
    equilibrium_problem free_of_contact = p;
    spent one = one_linear_solve(&free_of_contact, 1), theirs = {0};
    p.contact = &touch;
    const ccx_job job = {folder, "block"};
    double force[3] = {0};
    bool peer = strcmp(folder, "-") != 0, ended = false;
    if (peer) {
        write_deck(&job, &b, &table.material, 15 / depth_mm);
        ended = ccx_run(&job, 1, &theirs) && ccx_total_force(&job, force);
    }
    solve_params params = solve_params_default();
    equilibrium q;
    spent begin = time_now();
    if (!equilibrium_solve(&p, &params, &q, &e)) give_up(&e);
    tell_ours(&b, depth_mm, &q, time_since(begin), one);
    if (ended)
        printf(",%.2g\n", ccx_difference(&job, &b.mesh, q.xyz));
    else
        puts(",");
    equilibrium_free(&q);
    if (peer)
        printf("%d,,CalculiX,,%s,%d,,,%.2f,%.2f,%.2f,%.2f,%.3f,,\n", b.mesh.vertex_count, ended ? "solved" : "stopped",
               ended ? ccx_iterations(&job) : 0, theirs.wall_s, theirs.cpu_s, one.cpu_s, theirs.cpu_s / one.cpu_s,
               force[2]);
    fflush(stdout);
    body_free(&b);
}

int main(int argc, char **argv)
{
    double depth_mm = argc > 2 ? atof(argv[2]) : 0.003;
    if (argc < 2 || argc == 3 || !(depth_mm > 0)) {
        fprintf(stderr, "usage: %s FOLDER [MM N...]\n", argv[0]);
        return 2;
    }
    parallel_set_threads(1);
    puts("nodes,unknowns,program,depth_mm,outcome,iterations,factorisations,touching,wall_s,cpu_s,linear_cpu_s,"
         "cpu_ratio,force_mn,deepest_mm,largest_difference_mm");
    if (argc == 2) {
        run(argv[1], depth_mm, 5);
        run(argv[1], depth_mm, 8);
    }
    for (int k = 3; k < argc; k++) {
        int cells = atoi(argv[k]);
        if (cells < 1) return 2;
        run(argv[1], depth_mm, cells);
    }
    return 0;
}
