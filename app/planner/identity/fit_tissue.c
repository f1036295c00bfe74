#include "app/planner/identity/fit_state.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/tet_volume.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double anchor_area_mm2 = 3;

static bool is_stopped(void *watch) { return task_interrupted(watch); }

/* Of points on or near a surface: carried by its triangles, with what they are off it along the normal. */
static void place_on(const surface *as, const surface *now, const distance_tree *tree, const double p[3], double out[3])
{
    distance_hit hit;
    double d = distance_tree_to(tree, p, &hit), side = 0, e1[3], e2[3], n[3], off[3], w[3];
    const int32_t *v = as->tri + 3 * (size_t)hit.triangle;
    const double *a = as->xyz + 3 * (size_t)v[0];
    vec_sub(as->xyz + 3 * (size_t)v[1], a, e1);
    vec_sub(as->xyz + 3 * (size_t)v[2], a, e2);
    vec_cross(e1, e2, n);
    vec_sub(p, hit.at, off);
    side = vec_dot(off, n) < 0 ? -d : d;
    double nn = vec_dot(n, n), q[3], c[3];
    vec_sub(hit.at, a, q);
    vec_cross(q, e2, c);
    w[1] = nn > 0 ? vec_dot(c, n) / nn : 0;
    vec_cross(e1, q, c);
    w[2] = nn > 0 ? vec_dot(c, n) / nn : 0;
    w[0] = 1 - w[1] - w[2];
    a = now->xyz + 3 * (size_t)v[0];
    vec_sub(now->xyz + 3 * (size_t)v[1], a, e1);
    vec_sub(now->xyz + 3 * (size_t)v[2], a, e2);
    vec_cross(e1, e2, n);
    vec_normalize(n);
    vec_scale(n, side, out);
    for (int k = 0; k < 3; k++) vec_axpy(out, w[k], now->xyz + 3 * (size_t)v[k], out);
}

/* The bone, as it was placed, that a node tied to a segment lies on. */
static case_surface nearest_bone(distance_tree *const tree[], const double p[3])
{
    case_surface best = CASE_SKULL;
    double least = HUGE_VAL;
    for (int s = CASE_SKULL; s < CASE_SURFACE_COUNT; s++) {
        double d = distance_tree_between(tree[s], p, 0, least, NULL);
        if (d < least) {
            least = d;
            best = (case_surface)s;
        }
    }
    return best;
}

/* Skin whose places are known. */
static void add_skin(const fit_state *f, embedding *in, double *place)
{
    const embedding *skin = &f->t->skin_on_tissue;
    for (size_t v = 0; v < (size_t)skin->point_count; v++) {
        if (skin->tet[v] < 0) continue;
        size_t k = (size_t)in->point_count++;
        in->tet[k] = skin->tet[v];
        memcpy(in->weight + 4 * k, skin->weight + 4 * v, 4 * sizeof(double));
        vec_copy(f->at[CASE_SKIN].xyz + 3 * v, place + 3 * k);
    }
}

/* Tied nodes and their places on the bones, node as a point of one of its tets, and the skin where it is known. */
static registration_anchors tie(const fit_state *f, embedding *in, double **place)
{
    const tetmesh *m = &f->t->tissue.mesh;
    distance_tree *tree[CASE_SURFACE_COUNT] = {0};
    int32_t *tet_of = NEW_ARRAY(int32_t, m->vertex_count), *corner = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t t = m->tet_count - 1; t >= 0; t--)
        for (int k = 0; k < 4; k++) {
            tet_of[m->tet[4 * (size_t)t + (size_t)k]] = t;
            corner[m->tet[4 * (size_t)t + (size_t)k]] = k;
        }
    for (int s = CASE_SKULL; s < CASE_SURFACE_COUNT; s++) tree[s] = distance_tree_make(&f->placed[s]);
    size_t most = (size_t)m->vertex_count + (size_t)f->t->skin_on_tissue.point_count;
    *in = (embedding){.tet = NEW_ARRAY(int32_t, most), .weight = NEW_ARRAY(double, 4 * most)};
    *place = NEW_ARRAY(double, 3 * most);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (f->t->tissue.attach.kind[v] != NODE_TIED || f->t->tissue.side[v] != SIDE_BONE) continue;
        const double *p = f->placed_nodes + 3 * (size_t)v;
        case_surface s = nearest_bone(tree, p);
        size_t k = (size_t)in->point_count++;
        in->tet[k] = tet_of[v];
        in->weight[4 * k + (size_t)corner[v]] = 1;
        place_on(&f->placed[s], &f->at[s], tree[s], p, *place + 3 * k);
    }
    if (f->known) add_skin(f, in, *place);
    for (int s = CASE_SKULL; s < CASE_SURFACE_COUNT; s++) distance_tree_free(&tree[s]);
    free(tet_of);
    free(corner);
    return (registration_anchors){in, *place, anchor_area_mm2};
}

bool fit_tissue(fit_state *f, err *e)
{
    tetmesh body = tetmesh_copy(&f->t->tissue.mesh);
    size_t n = 3 * (size_t)body.vertex_count;
    memcpy(body.xyz, f->placed_nodes, n * sizeof *body.xyz);
    double *place;
    embedding in;
    registration r;
    registration_anchors anchors = tie(f, &in, &place);
    const target_surface *drawn_to = f->known ? NULL : f->target[CASE_SKIN];
    registration_part skin = {&f->placed[CASE_SKIN], &f->t->skin_on_tissue, drawn_to, NULL, 1};
    registration_problem problem = {
        .body = &body, .start_xyz = f->nodes, .part_count = 1, .part = &skin, .anchors = &anchors};
    registration_params how = registration_params_default();
    how.poisson = 0.3;
    how.stages = f->known ? 1 : 4; /* nothing is found anew */
    how.rounds = 3;
    how.soft_mm = 20;
    how.stiff_mm = f->known ? 0.5 : 1;
    how.reach_first_mm = 20;
    how.reach_mm = 10;
    how.facing_cos = 0.3;
    how.interrupted = is_stopped;
    how.context = (void *)f->watch;
    bool ok = registration_run(&problem, &how, &r, e);
    if (ok) {
        memcpy(f->nodes, r.xyz, n * sizeof *f->nodes);
        f->cost.rounds += r.rounds;
        f->cost.iterations += r.iterations;
        f->cost.factorisations += r.factorisations;
        registration_free(&r);
    }
    embedding_free(&in);
    free(place);
    tetmesh_free(&body);
    return ok;
}

bool fit_skin(fit_state *f, err *e)
{
    surface *skin = &f->at[CASE_SKIN];
    const embedding *on = &f->t->skin_on_tissue;
    size_t n = 3 * (size_t)f->t->tissue.mesh.vertex_count, count = 3 * (size_t)skin->vertex_count;
    double *u = NEW_ARRAY(double, n), *known = NEW_ARRAY(double, count);
    for (size_t i = 0; i < n; i++) u[i] = f->nodes[i] - f->placed_nodes[i];
    embedding_apply(on, &f->t->tissue.mesh, u, f->placed[CASE_SKIN].xyz, known);
    for (size_t i = 0; i < count; i++)
        if (on->tet[i / 3] < 0) known[i] = (double)NAN;
    fit_lattice l = {.edge_mm = 7,
                     .how = registration_params_default(),
                     .part_count = 1,
                     .moved = {skin},
                     .target = {f->target[CASE_SKIN]},
                     .weight = {1},
                     .fixed = known};
    l.how.stages = 4;
    l.how.rounds = 3;
    l.how.soft_mm = 30;
    l.how.stiff_mm = 1;
    l.how.reach_first_mm = 12;
    l.how.reach_mm = 5;
    bool ok = fit_lattice_draw(&l, &f->cost, e);
    for (size_t i = 0; ok && i < count; i++)
        if (on->tet[i / 3] >= 0) skin->xyz[i] = known[i];
    free(u);
    free(known);
    return ok;
}

/* Adds volume times the deformation gradient from placed to present nodes to each node of a tet. */
static void add_gradient(const double *const X[4], const double *const x[4], double *const sum[4])
{
    double D[3][3], d[3][3], c[3][3], volume = vec_six_volume(X[0], X[1], X[2], X[3]);
    for (int k = 0; k < 3; k++) {
        vec_sub(X[k + 1], X[0], D[k]);
        vec_sub(x[k + 1], x[0], d[k]);
    }
    for (int k = 0; k < 3; k++) vec_cross(D[(k + 1) % 3], D[(k + 2) % 3], c[k]); /* volume times the inverse's rows */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double g = d[0][i] * c[0][j] + d[1][i] * c[1][j] + d[2][i] * c[2][j];
            for (int a = 0; a < 4; a++) sum[a][3 * i + j] += g;
        }
    for (int a = 0; a < 4; a++) sum[a][9] += volume;
}

/* Nodes of tets that are inside out at rest go half as far, until there are none. */
static void soften_rest(const tetmesh *m, const double *nodes, double *rest)
{
    uint8_t *half = NEW_ARRAY(uint8_t, m->vertex_count);
    for (int k = 0, some = 1; some && k < 10; k++) {
        some = 0;
        memset(half, 0, (size_t)m->vertex_count);
        for (size_t i = 0; i < (size_t)m->tet_count; i++) {
            if (tet_six_volume(rest, m->tet + 4 * i) > 0) continue;
            for (size_t c = 0; c < 4; c++) half[m->tet[4 * i + c]] = 1;
            some = 1;
        }
        for (size_t i = 0; i < 3 * (size_t)m->vertex_count; i++)
            if (half[i / 3]) rest[i] = 0.5 * (rest[i] + nodes[i]);
    }
    free(half);
}

void fit_rest(const head_template *t, const double *nodes, double *rest)
{
    const tetmesh *m = &t->tissue.mesh;
    double *sum = NEW_ARRAY(double, 10 * (size_t)m->vertex_count);
    for (size_t i = 0; i < (size_t)m->tet_count; i++) {
        const double *X[4], *x[4];
        double *at[4];
        for (size_t k = 0; k < 4; k++) {
            size_t v = (size_t)m->tet[4 * i + k];
            X[k] = m->xyz + 3 * v;
            x[k] = nodes + 3 * v;
            at[k] = sum + 10 * v;
        }
        add_gradient(X, x, at);
    }
    for (size_t v = 0; v < (size_t)m->vertex_count; v++) {
        double u[3], moved[3];
        vec_sub(t->rest + 3 * v, m->xyz + 3 * v, u);
        mat_apply(sum + 10 * v, u, moved);
        vec_axpy(nodes + 3 * v, 1 / sum[10 * v + 9], moved, rest + 3 * v);
    }
    free(sum);
    soften_rest(m, nodes, rest);
}
