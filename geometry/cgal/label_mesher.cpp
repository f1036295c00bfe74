// Conforming tetrahedra of a labelled domain: CGAL Mesh_3, Delaunay refinement after Boltcheva, Yvinec and
// Boissonnat, "Feature preserving Delaunay mesh generation from 3D multi-material images", CGF 2009.
#include "geometry/label_mesher.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "geometry/cgal/guard.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>
#include <CGAL/exude_mesh_3.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>
#include <vector>

namespace {
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using base_domain = CGAL::Labeled_mesh_domain_3<kernel>;

struct label_call {
    label_function *label;
    void *context;
    int at(double x, double y, double z) const
    {
        const double p[3] = {x, y, z};
        return label(p, context);
    }
    int operator()(const kernel::Point_3 &p) const { return at(p.x(), p.y(), p.z()); }
};

struct seed {
    kernel::Point_3 point;
    int low, high; // the two labels that meet here
};

// CGAL starts from random rays, which miss small parts and never end where there is nothing to hit. Here the start
// points come from a scan of the box: at most one for each 8 mm cell and pair of labels.
std::vector<seed> scan(const label_call &label, const label_mesher_params &p)
{
    const double step = 2, cell = 8;
    std::vector<seed> seeds;
    std::set<std::tuple<int, int, int, int, int>> taken;
    for (int axis = 0; axis < 3; axis++) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (double a = p.low[u] + 0.37 * step; a < p.high[u]; a += 2 * step)
            for (double b = p.low[v] + 0.41 * step; b < p.high[v]; b += 2 * step) {
                double x[3];
                x[u] = a;
                x[v] = b;
                x[axis] = p.low[axis];
                int before = label.at(x[0], x[1], x[2]);
                while (x[axis] < p.high[axis]) {
                    double from = x[axis], to = from + step;
                    x[axis] = to;
                    int after = label.at(x[0], x[1], x[2]);
                    if (after == before) continue;
                    auto key =
                        std::make_tuple(int(std::floor(x[0] / cell)), int(std::floor(x[1] / cell)),
                                        int(std::floor(x[2] / cell)), std::min(before, after), std::max(before, after));
                    if (taken.insert(key).second) {
                        double lo = from, hi = to, y[3] = {x[0], x[1], x[2]};
                        int far = after;
                        while (hi - lo > p.boundary_error_mm) {
                            y[axis] = (lo + hi) / 2;
                            int mid = label.at(y[0], y[1], y[2]);
                            if (mid == before)
                                lo = y[axis];
                            else {
                                hi = y[axis];
                                far = mid;
                            }
                        }
                        y[axis] = (lo + hi) / 2;
                        seeds.push_back(
                            {kernel::Point_3(y[0], y[1], y[2]), std::min(before, far), std::max(before, far)});
                    }
                    before = after;
                }
            }
    }
    return seeds;
}

class seeded_domain : public base_domain {
  public:
    seeded_domain(const label_call &label, const CGAL::Bbox_3 &box, double error, const std::vector<seed> &start)
        : base_domain(label, box, error), seeds(&start)
    {
    }
    struct Construct_initial_points {
        const seeded_domain *domain;
        template <class Out> Out operator()(Out out, const int = 0) const
        {
            for (const seed &s : *domain->seeds)
                *out++ =
                    std::make_pair(s.point, domain->index_from_surface_patch_index(Surface_patch_index(s.low, s.high)));
            return out;
        }
    };
    Construct_initial_points construct_initial_points_object() const { return {this}; }

  private:
    const std::vector<seed> *seeds;
};

using triangulation = CGAL::Mesh_triangulation_3<seeded_domain, CGAL::Default, CGAL::Sequential_tag>::type;
using complex_3 = CGAL::Mesh_complex_3_in_triangulation_3<triangulation>;
using criteria = CGAL::Mesh_criteria_3<triangulation>;

struct size_call {
    using FT = double;
    using Point_3 = kernel::Point_3;
    using Index = seeded_domain::Index;
    size_function *size;
    void *context;
    // Bounds on circumradii: a cell of radius r has edges of about 1.2 r on average.
    FT operator()(const Point_3 &q, int dimension, const Index &) const
    {
        const double p[3] = {q.x(), q.y(), q.z()};
        return 0.85 * size(p, dimension == 3 ? 1 : 0, context);
    }
};

void copy_out(const complex_3 &c, tetmesh *out)
{
    std::vector<triangulation::Vertex_handle> order;
    CGAL::Unique_hash_map<triangulation::Vertex_handle, int32_t> number(-1);
    int32_t cells = 0;
    for (auto it = c.cells_in_complex_begin(); it != c.cells_in_complex_end(); ++it) {
        cells++;
        for (int k = 0; k < 4; k++)
            if (number[it->vertex(k)] < 0) {
                number[it->vertex(k)] = static_cast<int32_t>(order.size());
                order.push_back(it->vertex(k));
            }
    }
    tetmesh m = tetmesh_new(static_cast<int32_t>(order.size()), cells);
    for (std::size_t v = 0; v < order.size(); v++)
        for (int k = 0; k < 3; k++) m.xyz[3 * v + static_cast<std::size_t>(k)] = order[v]->point()[k];
    std::size_t t = 0;
    for (auto it = c.cells_in_complex_begin(); it != c.cells_in_complex_end(); ++it, ++t) {
        for (std::size_t k = 0; k < 4; k++) m.tet[4 * t + k] = number[it->vertex(static_cast<int>(k))];
        m.region[t] = c.subdomain_index(it);
    }
    *out = m;
}

bool run(label_function *label, size_function *size, void *context, const label_mesher_params *p, tetmesh *out, err *e)
{
    double radius = 0;
    for (int k = 0; k < 3; k++) {
        if (!(p->high[k] - p->low[k] > 1)) return err_set(e, ERR_GEOMETRY, "the box to mesh is empty along axis %d", k);
        radius = std::hypot(radius, (p->high[k] - p->low[k]) / 2);
    }
    label_call call{label, context};
    std::vector<seed> seeds = scan(call, *p);
    if (seeds.size() < 4) return err_set(e, ERR_GEOMETRY, "there is nothing to mesh in the box");
    CGAL::Bbox_3 box(p->low[0], p->low[1], p->low[2], p->high[0], p->high[1], p->high[2]);
    seeded_domain domain(call, box, p->boundary_error_mm / radius, seeds);
    size_call wanted{size, context};
    namespace par = CGAL::parameters;
    complex_3 mesh;
    if (p->surface_only) {
        criteria c(par::facet_angle = p->facet_angle_deg, par::facet_size = wanted,
                   par::facet_distance = p->facet_distance_mm);
        mesh = CGAL::make_mesh_3<complex_3>(domain, c, par::no_perturb(), par::no_exude());
    } else {
        criteria c(par::facet_angle = p->facet_angle_deg, par::facet_size = wanted,
                   par::facet_distance = p->facet_distance_mm, par::cell_radius_edge_ratio = p->cell_radius_edge,
                   par::cell_size = wanted);
        mesh = CGAL::make_mesh_3<complex_3>(domain, c, par::no_perturb(), par::no_exude());
        if (p->optimise) {
            CGAL::perturb_mesh_3(mesh, domain, par::time_limit = p->time_limit_s, par::sliver_bound = 12);
            CGAL::exude_mesh_3(mesh, par::time_limit = p->time_limit_s, par::sliver_bound = 12);
        }
    }
    if (mesh.number_of_cells_in_complex() == 0)
        return err_set(e, ERR_GEOMETRY, "the mesh of the domain came out empty");
    copy_out(mesh, out);
    return true;
}
} // namespace

label_mesher_params label_mesher_params_default(void)
{
    label_mesher_params p = {};
    p.facet_angle_deg = 25;
    p.facet_distance_mm = 0.3;
    p.cell_radius_edge = 2.5;
    p.boundary_error_mm = 1e-4;
    p.optimise = true;
    return p;
}

bool label_mesher_run(label_function *label, size_function *size, void *context, const label_mesher_params *p,
                      tetmesh *out, err *e)
{
    return guarded(e, "mesher", [&] { return run(label, size, context, p, out, e); });
}

surface label_mesher_surface(const tetmesh *m, int label)
{
    int32_t *across = tetmesh_neighbours(m);
    int32_t *number = NEW_ARRAY(int32_t, m->vertex_count);
    int32_t vertices = 0, triangles = 0;
    auto on_boundary = [&](std::size_t i) {
        return m->region[i / 4] == label && (across[i] < 0 || m->region[across[i]] != label);
    };
    std::size_t count = 4 * static_cast<std::size_t>(m->tet_count);
    for (std::size_t i = 0; i < count; i++) {
        if (!on_boundary(i)) continue;
        triangles++;
        for (int k = 0; k < 3; k++) number[m->tet[4 * (i / 4) + static_cast<std::size_t>(tet_face[i % 4][k])]] = 1;
    }
    for (int32_t v = 0; v < m->vertex_count; v++) number[v] = number[v] ? vertices++ : -1;
    surface s = surface_new(vertices, triangles);
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (number[v] >= 0)
            vec_copy(m->xyz + 3 * static_cast<std::size_t>(v), s.xyz + 3 * static_cast<std::size_t>(number[v]));
    std::size_t t = 0;
    for (std::size_t i = 0; i < count; i++) {
        if (!on_boundary(i)) continue;
        for (std::size_t k = 0; k < 3; k++)
            s.tri[3 * t + k] = number[m->tet[4 * (i / 4) + static_cast<std::size_t>(tet_face[i % 4][k])]];
        t++;
    }
    free(across);
    free(number);
    return s;
}
