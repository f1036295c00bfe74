/* Contact: the distance, its derivatives, and bodies that press, slide, part and meet. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/newton.h"
#include "sim/src/contact_state.h"
#include "tests/physics/evidence.h"
#include "tests/physics/lips.h"
#include <string.h>

/* A square grid at height z about (cx, cy), facing +z or, with `down`, -z. */
static surface plane_surface(double cx, double cy, double z, double half, int cells, bool down)
{
    int side = cells + 1;
    surface s = surface_new(side * side, 2 * cells * cells);
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            double *x = s.xyz + 3 * (size_t)(j * side + i);
            x[0] = cx - half + 2 * half * i / cells;
            x[1] = cy - half + 2 * half * j / cells;
            x[2] = z;
        }
    int32_t *t = s.tri;
    for (int j = 0; j < cells; j++)
        for (int i = 0; i < cells; i++, t += 6) {
            int a = j * side + i;
            memcpy(t, (int32_t[]){a, a + 1, a + side + 1, a, a + side + 1, a + side}, 6 * sizeof *t);
        }
    if (down) surface_flip(&s);
    return s;
}

/* A sphere by subdividing the edges of an icosahedron in n; *edge: its longest edge. */
static surface sphere_surface(double radius, int n, double *edge)
{
    static const double g = 1.618033988749895;
    static const double corner[12][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                         {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                         {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    static const int32_t face[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    int per = (n + 1) * (n + 2) / 2;
    /* each face apart, then equal points are joined */
    surface s = surface_new(20 * per, 20 * n * n);
    int32_t t = 0, count = 0, *number = NEW_ARRAY(int32_t, per);
    for (int f = 0; f < 20; f++) {
        const double *a = corner[face[3 * f]], *b = corner[face[3 * f + 1]], *c = corner[face[3 * f + 2]];
        int at = 0;
        for (int i = 0; i <= n; i++)
            for (int j = 0; j <= n - i; j++, at++) {
                double p[3];
                for (int k = 0; k < 3; k++) p[k] = (a[k] * (n - i - j) + b[k] * i + c[k] * j) / n;
                vec_normalize(p);
                vec_scale(p, radius, p);
                for (number[at] = 0; number[at] < count; number[at]++)
                    if (vec_distance(p, s.xyz + 3 * (size_t)number[at]) < 1e-9) break;
                if (number[at] == count) vec_copy(p, s.xyz + 3 * (size_t)count++);
            }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n - i; j++) {
                int row = i * (n + 1) - i * (i - 1) / 2, next = row + n - i + 1;
                int32_t *q = s.tri + 3 * (size_t)t++;
                q[0] = number[row + j], q[1] = number[next + j], q[2] = number[row + j + 1];
                if (j == n - i - 1) continue;
                q = s.tri + 3 * (size_t)t++;
                q[0] = number[next + j], q[1] = number[next + j + 1], q[2] = number[row + j + 1];
            }
    }
    free(number);
    assert_int_equal(t, s.triangle_count);
    s.vertex_count = count;
    *edge = 0;
    for (int32_t i = 0; i < s.triangle_count; i++)
        for (int k = 0; k < 3; k++)
            *edge = fmax(*edge, vec_distance(s.xyz + 3 * (size_t)s.tri[3 * i + k],
                                             s.xyz + 3 * (size_t)s.tri[3 * i + (k + 1) % 3]));
    return s;
}

static void distance_to_a_plane_is_exact(void **state)
{
    (void)state;
    surface s = plane_surface(0, 0, 0, 10, 10, false);
    rigid turn = rigid_rotation((double[]){3, 1, -7}, (double[]){0.6, 0, 0.8}, 1.1);
    surface_transform(&s, &turn);
    imls_cloud cloud = imls_of_surface(&s, 1.75);
    uint64_t seed = 3;
    double normal[3];
    rigid_rotate(&turn, (double[]){0, 0, 1}, normal);
    for (int k = 0; k < 200; k++) {
        double p[3] = {9 * block_random(&seed), 9 * block_random(&seed), 4 * block_random(&seed)}, x[3];
        rigid_apply(&turn, p, x);
        imls_value v = imls_at(&cloud, NULL, cloud.count, 1, x, true, NULL);
        assert_near(v.d, p[2], 1e-12);
        for (int c = 0; c < 3; c++) assert_near(v.grad[c], normal[c], 1e-12);
        for (int c = 0; c < 9; c++) assert_near(v.hess[c], 0, 1e-11);
        if (fabs(p[0]) < 5 && fabs(p[1]) < 5 && fabs(p[2]) < 0.5) assert_near(v.S, 1, 0.15);
    }
    assert_true(imls_at(&cloud, NULL, cloud.count, 1, (double[]){400, 0, 0}, false, NULL).S == 0);
    imls_free(&cloud);
    surface_free(&s);
}

/* Against a table measured elsewhere on a sphere of 6 edges radius; the bias goes with the curvature. */
static void distance_to_a_sphere_is_inflated_by_the_support_as_measured(void **state)
{
    (void)state;
    static const double support[4] = {1, 1.5, 2, 3}, bias[4] = {-0.014, -0.031, -0.055, -0.124};
    double edge, radius = 10;
    surface s = sphere_surface(radius, 8, &edge);
    uint64_t seed = 5;
    for (int n = 0; n < 4; n++) {
        imls_cloud cloud = imls_of_surface(&s, 1);
        double mean = 0, low = HUGE_VAL, high = 0, want = bias[n] * 6 * edge / radius;
        for (int32_t i = 0; i < cloud.count; i++) cloud.h[i] = support[n] * edge;
        for (int k = 0; k < 2000; k++) {
            double x[3] = {block_random(&seed), block_random(&seed), block_random(&seed)};
            vec_normalize(x);
            vec_scale(x, radius, x);
            imls_value v = imls_at(&cloud, NULL, cloud.count, 1, x, false, NULL);
            mean += v.d / edge / 2000;
            low = fmin(low, vec_norm(v.grad));
            high = fmax(high, vec_norm(v.grad));
        }
        printf("support %.1f edges: bias %.4f edges (table %.4f), |grad d| %.3f to %.3f\n", support[n], mean,
               want, low, high);
        assert_near(mean, want, 0.15 * fabs(want) + 0.003);
        assert_true(low > 0.97 && high < 1.1);
        imls_free(&cloud);
    }
    surface_free(&s);
}

static void derivatives_of_the_distance_are_exact(void **state)
{
    (void)state;
    double edge, h = 1e-5;
    surface s = sphere_surface(8, 4, &edge);
    imls_cloud cloud = imls_of_surface(&s, 1.75);
    uint64_t seed = 8;
    for (int k = 0; k < 50; k++) {
        double x[3] = {block_random(&seed), block_random(&seed), block_random(&seed)};
        vec_normalize(x);
        vec_scale(x, 8 + 1.5 * block_random(&seed), x);
        imls_value v = imls_at(&cloud, NULL, cloud.count, 1, x, true, NULL);
        for (int c = 0; c < 3; c++) {
            double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
            up[c] += h;
            down[c] -= h;
            imls_value a = imls_at(&cloud, NULL, cloud.count, 1, up, false, NULL),
                       b = imls_at(&cloud, NULL, cloud.count, 1, down, false, NULL);
            assert_near((a.d - b.d) / (2 * h), v.grad[c], 1e-8);
            assert_near((a.S - b.S) / (2 * h), v.S_grad[c], 1e-8);
            for (int r = 0; r < 3; r++)
                assert_near((a.grad[r] - b.grad[r]) / (2 * h), v.hess[3 * r + c], 1e-7);
        }
    }
    imls_free(&cloud);
    surface_free(&s);
}

typedef struct scene {
    tetmesh mesh;
    attach_map attach;
    region_material table;
    surface bone;
    int32_t *upper, *lower;
    contact_setup setup;
    equilibrium_problem problem;
} scene;

static void wire(scene *s, double poisson)
{
    err e = {0};
    s->table = (region_material){.region = REGION_ANY};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &s->table.material, &e));
    s->setup.params = contact_params_default();
    s->problem = (equilibrium_problem){.mesh = &s->mesh,
                                       .attach = &s->attach,
                                       .materials = &s->table,
                                       .material_count = 1,
                                       .contact = &s->setup};
    rest_motions(s->problem.motion);
}

static void tear_down(scene *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
    surface_free(&s->bone);
    free(s->upper);
    free(s->lower);
}

/* A block tied to the maxilla at its top, lying on a plane of the distal segment. */
static void block_on_plane(scene *s, double poisson)
{
    block b = {5, 4, 4, {20, 16, 12}, 6, 0.15};
    *s = (scene){.mesh = block_mesh(&b), .bone = plane_surface(10, 8, 0, 24, 16, false)};
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        const double *x = s->mesh.xyz + 3 * (size_t)v;
        if (x[2] == 12) tie(&s->attach, v, SEGMENT_MAXILLA);
        if (x[2] != 0) continue;
        s->attach.kind[v] = NODE_SLIDING;
        s->attach.segment[v] = SEGMENT_DISTAL;
        s->attach.normal[3 * (size_t)v + 2] = 1;
    }
    wire(s, poisson);
    s->setup.bone[SEGMENT_DISTAL] = &s->bone;
}

/* Faces of the mesh's boundary all of whose nodes have `mark`. */
static int32_t *marked_faces(const tetmesh *m, const uint8_t *marks, uint8_t mark, int32_t *count)
{
    int32_t *face = NULL, all = tetmesh_boundary(m, &face, NULL);
    *count = 0;
    for (int32_t f = 0; f < all; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        if (marks[v[0]] == mark && marks[v[1]] == mark && marks[v[2]] == mark)
            memmove(face + 3 * (size_t)(*count)++, v, 3 * sizeof *v);
    }
    return face;
}

/* Two lips, the upper tied to the maxilla, the lower to the distal segment. */
static void two_lips(scene *s)
{
    block b = {5, 4, 6, {20, 16, 24}, 5, 0.2};
    *s = (scene){0};
    s->mesh = lips_mesh(&b, 3, false, &s->attach);
    uint8_t *mark = NEW_ARRAY(uint8_t, s->mesh.vertex_count);
    for (int32_t i = 0; i < 2 * s->attach.pair_count; i++) mark[s->attach.pair[i]] = i % 2 ? 2 : 1;
    wire(s, 0.47);
    s->setup.upper_lip = s->upper = marked_faces(&s->mesh, mark, 1, &s->setup.upper_count);
    s->setup.lower_lip = s->lower = marked_faces(&s->mesh, mark, 2, &s->setup.lower_count);
    assert_int_equal(s->setup.upper_count, 40);
    assert_int_equal(s->setup.lower_count, 40);
    free(mark);
}

static equilibrium solve(const scene *s)
{
    err e = {0};
    equilibrium q;
    solve_params params = solve_params_default();
    assert_ok(equilibrium_solve(&s->problem, &params, &q, &e));
    if (q.outcome != SOLVED) {
        print_error("%s, residual %g, tolerance %g\n", solve_outcome_text(q.outcome), q.residual_mn,
                    q.tolerance_mn);
        for (int32_t i = 0; i < q.record_count; i++) {
            const newton_record *r = &q.record[i];
            print_error("%d load %.3f it %d res %.3e E %.6e step %g kind %d\n", r->contact, r->load,
                        r->iteration, r->residual_mn, r->energy_uj, r->step, (int)r->hessian);
        }
    }
    assert_int_equal(q.outcome, SOLVED);
    return q;
}

static void tell(const char *name, const equilibrium *q)
{
    const contact_report *c = &q->contact;
    printf("%s: %d of %d nodes touch, depth %.4f mm, %.1f + %.1f mm2, %.2f kPa, %d + %d iterations, %d "
           "refreshes "
           "(last %.1e mm), %d stiffenings, %d uncoupled, %.3g of %.3g uJ\n",
           name, c->active_nodes, c->nodes, c->depth_mm, c->bone_area_mm2, c->lip_area_mm2, c->pressure_kpa,
           c->free_iterations, c->contact_iterations, c->refreshes, c->refresh_change_mm, c->stiffenings,
           c->uncoupled, c->energy_uj, q->energy_uj);
}

/* Energy, force and stiffness of contacts alone, at a random shape in deep contact. */
static void check_derivatives(scene *s, double lift_mm)
{
    err e = {0};
    solver *t = NULL;
    contact *c = NULL;
    assert_ok(contact_make(&s->mesh, &s->attach, &s->setup, 15, &c, &e));
    rigid guide = rigid_identity();
    contact_move(c, s->problem.motion, &guide, s->mesh.xyz);
    size_t n = 3 * (size_t)s->mesh.vertex_count;
    double *x = COPY_ARRAY(double, s->mesh.xyz, n), *w = NEW_ARRAY(double, n), *f = NEW_ARRAY(double, n);
    double *at = NEW_ARRAY(double, n), *up = NEW_ARRAY(double, n), *down = NEW_ARRAY(double, n), h = 1e-6;
    uint64_t seed = 12;
    for (size_t i = 0; i < n; i++) {
        x[i] += 0.15 * block_random(&seed);
        w[i] = block_random(&seed);
    }
    for (int32_t i = 0; i < s->attach.pair_count; i++) x[3 * (size_t)s->attach.pair[2 * i] + 2] += lift_mm;
    contact_refresh(c, x);
    for (size_t i = 0; i < n; i++) x[i] += 0.02 * block_random(&seed); /* not where it was refreshed */
    double energy = contact_energy(c, x, f), slope = 0, side[2];
    assert_true(energy > 0);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < n; i++) at[i] = x[i] + (k ? -h : h) * w[i];
        side[k] = contact_energy(c, at, k ? down : up);
    }
    double scale = 0, worst = 0, sum[3] = {0};
    for (size_t i = 0; i < n; i++) {
        slope += f[i] * w[i];
        sum[i % 3] += f[i];
    }
    assert_near((side[0] - side[1]) / (2 * h), slope, 1e-6 * fabs(slope));
    /* the stiffness, with the pattern of the whole problem */
    s->problem.contact = &s->setup;
    assert_ok(solver_create(&s->problem, 1, &t, &e));
    elements el;
    boundary b;
    assembly a;
    attach_map loose = contact_loosened(&s->attach, &s->setup);
    assert_ok(elements_make(&s->mesh, &s->table, 1, &el, &e));
    assert_ok(boundary_make(&s->mesh, &loose, &b, &e));
    assert_ok(assembly_make(&s->mesh, &el, &b, c->coupling, c->coupling_count, &a, &e));
    contact_stiffness(c, x, NULL, true, &a);
    assembly_multiply(&a, w, at);
    for (size_t i = 0; i < n; i++) scale = fmax(scale, fabs(at[i]));
    for (size_t i = 0; i < n; i++) worst = fmax(worst, fabs((up[i] - down[i]) / (2 * h) - at[i]));
    printf("stiffness off by %.1e of its largest\n", worst / scale);
    assert_true(worst < 1e-6 * scale);
    if (s->setup.upper_count) /* lip on lip: equal and opposite */
        for (int k = 0; k < 3; k++) assert_near(sum[k], 0, 1e-9 * scale);
    memset(a.edge_block, 0, 9 * (size_t)a.edge_count * sizeof *a.edge_block);
    contact_stiffness(c, x, NULL, false, &a);
    double quadratic = 0;
    assembly_multiply(&a, w, at);
    for (size_t i = 0; i < n; i++) quadratic += w[i] * at[i];
    assert_true(quadratic > 0);
    assembly_free(&a);
    boundary_free(&b);
    attach_map_free(&loose);
    contact_destroy(&c);
    solver_destroy(&t);
    free(x);
    free(w);
    free(f);
    free(at);
    free(up);
    free(down);
}

static void forces_and_stiffness_are_derivatives_of_the_energy(void **state)
{
    (void)state;
    scene s;
    two_lips(&s);
    check_derivatives(&s, -0.3);
    tear_down(&s);
    double edge;
    block_on_plane(&s, 0.45);
    surface_free(&s.bone);
    s.bone = sphere_surface(30, 8, &edge);
    for (int32_t i = 0; i < s.bone.vertex_count; i++)
        vec_add(s.bone.xyz + 3 * (size_t)i, (double[]){10, 8, -30}, s.bone.xyz + 3 * (size_t)i);
    s.problem.motion[SEGMENT_DISTAL] = rigid_rotation((double[]){10, 8, -30}, (double[]){0.8, 0, 0.6}, 0.4);
    s.problem.motion[SEGMENT_DISTAL].t[2] += 0.8;
    check_derivatives(&s, 0);
    tear_down(&s);
}

static void nothing_pushes_beyond_the_activation_distance(void **state)
{
    (void)state;
    scene s;
    err e = {0};
    contact *c = NULL;
    block_on_plane(&s, 0.45);
    for (int32_t i = 0; i < s.bone.vertex_count; i++) s.bone.xyz[3 * i + 2] = -1; /* 1 mm away at rest */
    assert_ok(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e));
    rigid guide = rigid_identity();
    for (int k = 0; k < 2; k++) {
        double rise = k ? 0.902 : 0.898; /* the activation distance is 0.1 mm */
        s.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, rise});
        contact_move(c, s.problem.motion, &guide, s.mesh.xyz);
        contact_refresh(c, s.mesh.xyz);
        double *force = NEW_ARRAY(double, 3 * (size_t)s.mesh.vertex_count);
        double energy = contact_energy(c, s.mesh.xyz, force);
        for (int32_t i = 0; !k && i < 3 * s.mesh.vertex_count; i++) assert_true(force[i] == 0);
        assert_true(k ? energy > 0 : energy == 0);
        free(force);
    }
    contact_destroy(&c);
    tear_down(&s);
}

static void a_pressed_block_carries_what_elasticity_says(void **state)
{
    (void)state;
    scene s;
    block_on_plane(&s, 0); /* no lateral strain: the stress is uniaxial and even */
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -0.6});
    equilibrium q = solve(&s);
    tell("pressed", &q);
    const double *f = q.segment_force_mn[SEGMENT_DISTAL];
    double depth = q.contact.depth_mm, stretch = (12 - 0.6 + depth) / 12;
    /* the same column alone: SNH with the logarithm at Poisson 0, force per area d psi / d stretch */
    double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, stretch}, P[9];
    material_stress(&s.table.material, F, P);
    assert_true(depth > 0 && depth < 0.1);
    assert_near(f[2], -P[8] * 20 * 16, 0.02 * fabs(f[2]));
    evidence("contact: a block pressed on a plane, force against the closed form, off by", fabs(f[2] / (-P[8] * 20 * 16) - 1),
             "-");
    assert_near(f[2] + q.segment_force_mn[SEGMENT_MAXILLA][2], 0, 1e-6 * f[2]);
    assert_near(q.contact.bone_area_mm2, 20 * 16, 1e-9);
    assert_near(q.contact.pressure_kpa, f[2] / (20 * 16), 0.02 * q.contact.pressure_kpa);
    assert_true(fabs(f[0]) < 1e-9 * f[2] && fabs(f[1]) < 1e-9 * f[2]); /* no friction */
    equilibrium_free(&q);
    tear_down(&s);
}

static void a_pressed_block_agrees_with_sliding_constraints(void **state)
{
    (void)state;
    scene s;
    block_on_plane(&s, 0.45);
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){5, 1, -2});
    equilibrium touch = solve(&s);
    tell("pressed and pushed aside", &touch);
    s.problem.contact = NULL;
    equilibrium slide = solve(&s);
    double worst = 0;
    for (int32_t i = 0; i < 3 * slide.node_count; i++) worst = fmax(worst, fabs(slide.xyz[i] - touch.xyz[i]));
    assert_true(touch.contact.depth_mm < 0.1);
    assert_true(worst < 0.15);
    evidence("contact: a block pressed 2 mm and dragged, beside sliding constraints: worst node", worst, "mm");
    double a = touch.segment_force_mn[SEGMENT_DISTAL][2], b = slide.segment_force_mn[SEGMENT_DISTAL][2];
    assert_near(a, b, 0.06 * b);
    for (int k = 0; k < 2; k++) assert_true(fabs(touch.segment_force_mn[SEGMENT_DISTAL][k]) < 1e-6 * a);
    equilibrium_free(&touch);
    equilibrium_free(&slide);
    tear_down(&s);
}

static void a_block_slides_and_lifts_off_without_force(void **state)
{
    (void)state;
    for (int lift = 0; lift < 2; lift++) {
        scene s;
        block_on_plane(&s, 0.45);
        double t[3] = {4, -1, lift ? 3 : 0};
        s.problem.motion[SEGMENT_MAXILLA] = rigid_translation(t);
        equilibrium q = solve(&s);
        for (int32_t v = 0; v < q.node_count; v++)
            for (int c = 0; c < 3; c++) assert_near(q.xyz[3 * v + c], s.mesh.xyz[3 * v + c] + t[c], 1e-9);
        assert_int_equal(q.contact.active_nodes, 0);
        assert_true(q.contact.depth_mm < 1e-9);
        equilibrium_free(&q);
        tear_down(&s);
    }
}

static void lips_press_each_other_and_part(void **state)
{
    (void)state;
    scene s;
    two_lips(&s);
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){3, 0, -2});
    equilibrium q = solve(&s);
    tell("lips pressed and shifted", &q);
    assert_true(q.contact.depth_mm > 0 && q.contact.depth_mm < 0.1);
    assert_near(q.segment_force_mn[SEGMENT_MAXILLA][2], -q.segment_force_mn[SEGMENT_DISTAL][2],
                1e-6 * fabs(q.segment_force_mn[SEGMENT_DISTAL][2]));
    assert_true(q.segment_force_mn[SEGMENT_MAXILLA][2] < -100);
    assert_true(q.contact.lip_area_mm2 > 0.6 * 20 * 16);
    double gap = 0;
    for (int32_t i = 0; i < s.attach.pair_count; i++)
        gap += (q.xyz[3 * s.attach.pair[2 * i] + 2] - q.xyz[3 * s.attach.pair[2 * i + 1] + 2]) /
               s.attach.pair_count;
    assert_true(fabs(gap) < 0.3);
    equilibrium_free(&q);
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){1, 0, 4});
    q = solve(&s);
    for (int32_t i = 0; i < s.attach.pair_count; i++)
        assert_near(q.xyz[3 * s.attach.pair[2 * i] + 2] - q.xyz[3 * s.attach.pair[2 * i + 1] + 2], 4, 1e-6);
    assert_int_equal(q.contact.active_nodes, 0);
    equilibrium_free(&q);
    tear_down(&s);
}

static void a_plan_that_moves_nothing_moves_nothing(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        scene s;
        if (n)
            two_lips(&s);
        else
            block_on_plane(&s, 0.45);
        equilibrium q = solve(&s);
        assert_int_equal(q.iterations, 0);
        assert_memory_equal(q.xyz, s.mesh.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
        assert_true(q.contact.energy_uj == 0);
        equilibrium_free(&q);
        tear_down(&s);
    }
}

static void a_rigid_motion_of_all_bones_moves_all_tissue_rigidly(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        scene s;
        if (n)
            two_lips(&s);
        else
            block_on_plane(&s, 0.45);
        rigid turn = rigid_rotation((double[]){100, -30, 60}, (double[]){0.36, 0.48, 0.8}, 2.1);
        for (int k = 0; k < SEGMENT_COUNT; k++) s.problem.motion[k] = turn;
        equilibrium q = solve(&s);
        for (int32_t v = 0; v < q.node_count; v++) {
            double want[3];
            rigid_apply(&turn, s.mesh.xyz + 3 * (size_t)v, want);
            assert_near(vec_distance(want, q.xyz + 3 * (size_t)v), 0, 1e-9);
        }
        equilibrium_free(&q);
        tear_down(&s);
    }
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    for (int n = 0; n < 2; n++) {
        scene s;
        if (n)
            two_lips(&s);
        else
            block_on_plane(&s, 0.45);
        s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){2, 1, -1});
        equilibrium first = {0};
        for (int threads = 1; threads <= 3; threads++) {
            parallel_set_threads(threads);
            equilibrium q = solve(&s);
            if (threads == 1) {
                first = q;
                continue;
            }
            assert_memory_equal(first.xyz, q.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
            assert_true(first.energy_uj == q.energy_uj && first.contact.depth_mm == q.contact.depth_mm);
            equilibrium_free(&q);
        }
        parallel_set_threads(0);
        equilibrium_free(&first);
        tear_down(&s);
    }
}

/* The plate rises 6 mm into the block; without contact it would stay there, beyond the support of the nodes.
 */
static void tissue_that_starts_behind_a_thick_plate_ends_in_front(void **state)
{
    (void)state;
    scene s;
    block_on_plane(&s, 0.45);
    surface front = plane_surface(10, 8, 0, 24, 32, false), back = plane_surface(10, 8, -5, 24, 32, true);
    surface_free(&s.bone);
    s.bone = surface_joined(&front, &back);
    surface_free(&front);
    surface_free(&back);
    s.problem.motion[SEGMENT_DISTAL] = rigid_translation((double[]){0, 0, 6});
    equilibrium q = solve(&s);
    tell("thick plate", &q);
    for (int32_t v = 0; v < q.node_count; v++)
        if (s.attach.kind[v] == NODE_SLIDING) assert_true(q.xyz[3 * v + 2] > 5.9);
    assert_true(q.contact.depth_mm < 0.1);
    equilibrium_free(&q);
    tear_down(&s);
}

static void contacts_too_deep_are_stiffened_or_not_accepted(void **state)
{
    (void)state;
    err e = {0};
    scene s;
    block_on_plane(&s, 0.45);
    s.setup.params.pressure_kpa = 0.5; /* far too soft a wall */
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -2});
    equilibrium q = solve(&s);
    tell("soft wall", &q);
    assert_true(q.contact.stiffenings > 0);
    assert_true(q.contact.depth_mm < 0.1);
    equilibrium_free(&q);
    s.setup.params.max_stiffenings = 0;
    solve_params params = solve_params_default();
    params.max_halvings = 0;
    assert_ok(equilibrium_solve(&s.problem, &params, &q, &e));
    assert_int_equal(q.outcome, STOPPED_PENETRATION);
    assert_true(q.contact.depth_mm > 0.1);
    equilibrium_free(&q);
    tear_down(&s);
}

static void a_node_beside_a_collider_is_not_dragged_to_its_front(void **state)
{
    (void)state;
    scene s;
    block_on_plane(&s, 0.45);
    surface_free(&s.bone);
    s.bone = plane_surface(10, 8, 0, 12, 8, false);
    surface plate =
        plane_surface(-5, 8, 3, 4, 4, false); /* beside the block's left end, 3 mm higher: x -9 to -1 */
    s.setup.bone[SEGMENT_CHIN] = &plate;
    s.problem.motion[SEGMENT_CHIN] = rigid_translation((double[]){0, 0, 1});
    equilibrium q = solve(&s);
    for (int32_t i = 0; i < 3 * q.node_count; i++) assert_near(q.xyz[i], s.mesh.xyz[i], 1.5);
    assert_true(q.contact.pressure_kpa < 1e3);
    equilibrium_free(&q);
    surface_free(&plate);
    tear_down(&s);
}

static void what_cannot_touch_is_refused(void **state)
{
    (void)state;
    scene s;
    err e = {0};
    contact *c = NULL;
    two_lips(&s);
    s.setup.upper_count--;
    s.setup.lower_count = 0;
    assert_refused(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e), ERR_INPUT);
    tear_down(&s);
    block_on_plane(&s, 0.45);
    s.setup.bone[SEGMENT_DISTAL] = NULL;
    assert_refused(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e), ERR_INPUT);
    s.setup.bone[SEGMENT_DISTAL] = &s.bone;
    s.setup.params.depth_mm = 0;
    assert_refused(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e), ERR_INPUT);
    s.setup.params = contact_params_default();
    s.setup.params.depth_limit_mm = 3; /* deeper than the support sees */
    assert_refused(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e), ERR_INPUT);
    s.setup.params = contact_params_default();
    s.setup.extra = (int32_t[]){s.mesh.vertex_count - 1}; /* tied */
    s.setup.extra_count = 1;
    assert_refused(contact_make(&s.mesh, &s.attach, &s.setup, 15, &c, &e), ERR_INPUT);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_to_a_plane_is_exact),
        cmocka_unit_test(distance_to_a_sphere_is_inflated_by_the_support_as_measured),
        cmocka_unit_test(derivatives_of_the_distance_are_exact),
        cmocka_unit_test(forces_and_stiffness_are_derivatives_of_the_energy),
        cmocka_unit_test(nothing_pushes_beyond_the_activation_distance),
        cmocka_unit_test(a_pressed_block_carries_what_elasticity_says),
        cmocka_unit_test(a_pressed_block_agrees_with_sliding_constraints),
        cmocka_unit_test(a_block_slides_and_lifts_off_without_force),
        cmocka_unit_test(lips_press_each_other_and_part),
        cmocka_unit_test(a_plan_that_moves_nothing_moves_nothing),
        cmocka_unit_test(a_rigid_motion_of_all_bones_moves_all_tissue_rigidly),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
        cmocka_unit_test(tissue_that_starts_behind_a_thick_plate_ends_in_front),
        cmocka_unit_test(contacts_too_deep_are_stiffened_or_not_accepted),
        cmocka_unit_test(a_node_beside_a_collider_is_not_dragged_to_its_front),
        cmocka_unit_test(what_cannot_touch_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
