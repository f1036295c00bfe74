// Repair of scanned surfaces. Order of work: soup -> manifold -> small shells out -> holes shut -> touching
// sheets apart -> self-intersections cut out and refilled -> shells nested and oriented. A wrap replaces the
// surface only when all of that leaves an intersection.
#include "geometry/repair.h"
#include "geometry/cgal/convert.hpp"
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/alpha_wrap_3.h>
#include <algorithm>
#include <map>
#include <set>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace np = CGAL::parameters;
using vertex = mesh::Vertex_index;
using halfedge = mesh::Halfedge_index;
using face = mesh::Face_index;
using face_pair = std::pair<face, face>;

namespace {

// Two sheets that meet in one point or edge are drawn apart by this share of the way to their own neighbours,
// at most this far: enough for exact predicates, far below the voxel.
constexpr double pinch_share = 0.1, pinch_limit_mm = 0.05;
constexpr double moved_mm = 0.1;
constexpr double wide_hole_mm = 5; // wider patches are refined, so that no long thin triangles span a hole

std::vector<face_pair> intersections(const mesh &m, unsigned limit = 0)
{
    std::vector<face_pair> pairs;
    if (limit)
        PMP::self_intersections(m, std::back_inserter(pairs), np::maximum_number(limit));
    else
        PMP::self_intersections(m, std::back_inserter(pairs));
    return pairs;
}

mesh manifold_mesh(const surface &in, repair_report &r)
{
    std::vector<point> points;
    std::vector<triangle> triangles;
    soup_from_surface(in, points, triangles);
    r.welded_vertices = static_cast<int32_t>(PMP::merge_duplicate_points_in_polygon_soup(points, triangles));
    auto flat = [&](const triangle &t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
    auto first = std::remove_if(triangles.begin(), triangles.end(), flat);
    r.degenerate_triangles = static_cast<int32_t>(triangles.end() - first);
    triangles.erase(first, triangles.end());
    // Two opposite copies of a triangle enclose nothing; both of any further copies are one too many.
    r.duplicate_triangles = static_cast<int32_t>(PMP::merge_duplicate_polygons_in_polygon_soup(points, triangles));
    PMP::remove_isolated_points_in_polygon_soup(points, triangles);
    PMP::orient_polygon_soup(points, triangles); // doubles the vertices of non-manifold edges
    mesh m;
    PMP::polygon_soup_to_polygon_mesh(points, triangles, m);
    PMP::duplicate_non_manifold_vertices(m);
    return m;
}

int32_t drop_flat_faces(mesh &m)
{
    std::vector<face> flat;
    PMP::degenerate_faces(m, std::back_inserter(flat));
    if (!flat.empty()) PMP::remove_degenerate_faces(flat, m);
    return static_cast<int32_t>(flat.size());
}

void drop_small_components(mesh &m, double min_share, repair_report &r)
{
    auto number = m.add_property_map<face, std::size_t>("f:shell", 0).first;
    std::size_t count = PMP::connected_components(m, number);
    std::vector<double> area(count, 0.0);
    for (auto f : m.faces()) area[number[f]] += PMP::face_area(f, m);
    if (!count) return;
    double largest = *std::max_element(area.begin(), area.end());
    std::vector<std::size_t> drop;
    r.components_found = static_cast<int32_t>(count);
    for (std::size_t i = 0; i < count; i++)
        if (area[i] < min_share * largest) {
            drop.push_back(i);
            r.dropped_area_mm2 += area[i];
        }
    r.components_dropped = static_cast<int32_t>(drop.size());
    if (!drop.empty()) PMP::remove_connected_components(m, drop, number);
    m.remove_property_map(number);
    m.collect_garbage();
}

double hole_width(const mesh &m, halfedge border)
{
    CGAL::Bbox_3 box;
    for (auto h : CGAL::halfedges_around_face(border, m)) box += m.point(m.target(h)).bbox();
    return std::sqrt(CGAL::square(box.xmax() - box.xmin()) + CGAL::square(box.ymax() - box.ymin()) +
                     CGAL::square(box.zmax() - box.zmin()));
}

// Shuts every hole; returns how many could not be.
int32_t fill_holes(mesh &m, repair_report *r)
{
    std::vector<halfedge> borders;
    PMP::extract_boundary_cycles(m, std::back_inserter(borders));
    int32_t open = 0;
    for (halfedge h : borders) {
        double width = hole_width(m, h);
        std::vector<face> patch;
        std::vector<vertex> inner;
        if (width > wide_hole_mm)
            PMP::triangulate_and_refine_hole(m, h, std::back_inserter(patch), std::back_inserter(inner));
        else
            PMP::triangulate_hole(m, h, std::back_inserter(patch));
        if (patch.empty()) { // the Delaunay search space can be too small for a crumpled border
            PMP::triangulate_hole(m, h, std::back_inserter(patch), np::use_delaunay_triangulation(false));
        }
        if (patch.empty())
            open++;
        else if (r)
            r->holes_filled++;
        if (r) r->widest_hole_mm = std::max(r->widest_hole_mm, width);
    }
    if (r) r->boundary_loops += static_cast<int32_t>(borders.size());
    return open;
}

// Vertices in exactly one place belong to sheets that touch.
void part_touching_sheets(mesh &m)
{
    std::map<std::array<double, 3>, std::vector<vertex>> places;
    for (auto v : m.vertices()) {
        const point &p = m.point(v);
        places[{p.x(), p.y(), p.z()}].push_back(v);
    }
    for (auto &place : places) {
        if (place.second.size() < 2) continue;
        std::vector<point> moved;
        for (vertex v : place.second) {
            kernel::Vector_3 mean(0, 0, 0);
            int count = 0;
            for (vertex w : CGAL::vertices_around_target(v, m)) {
                mean = mean + (m.point(w) - m.point(v));
                count++;
            }
            if (count) mean = mean * (pinch_share / count);
            double length = std::sqrt(mean.squared_length());
            if (length > pinch_limit_mm) mean = mean * (pinch_limit_mm / length);
            moved.push_back(m.point(v) + mean);
        }
        for (std::size_t i = 0; i < moved.size(); i++) m.point(place.second[i]) = moved[i];
    }
}

// Cuts out the faces that intersect and `rings` rings around them, and fills the holes anew.
void cut_out_and_refill(mesh &m, const std::vector<face_pair> &pairs, int rings)
{
    std::set<face> bad;
    for (auto &p : pairs) {
        bad.insert(p.first);
        bad.insert(p.second);
    }
    for (int k = 0; k < rings; k++) {
        std::vector<face> grown;
        for (face f : bad)
            for (vertex v : CGAL::vertices_around_face(m.halfedge(f), m))
                for (face g : CGAL::faces_around_target(m.halfedge(v), m))
                    if (g != mesh::null_face()) grown.push_back(g);
        bad.insert(grown.begin(), grown.end());
    }
    for (face f : bad) CGAL::Euler::remove_face(m.halfedge(f), m);
    PMP::remove_isolated_vertices(m);
    PMP::duplicate_non_manifold_vertices(m);
    fill_holes(m, nullptr);
    m.collect_garbage();
}

int32_t remove_intersections(mesh &m, repair_report &r)
{
    auto pairs = intersections(m);
    r.self_intersections_found = static_cast<int32_t>(pairs.size());
    if (pairs.empty()) return 0;
    part_touching_sheets(m);
    pairs = intersections(m);
    for (int rings = 0; rings < 4 && !pairs.empty(); rings++) {
        mesh copy = m;
        try {
            if (rings == 0)
                PMP::experimental::remove_self_intersections(m, np::preserve_genus(false));
            else
                cut_out_and_refill(m, pairs, rings);
        } catch (const CGAL::Failure_exception &) {
            m = copy; // a try that breaks a precondition leaves no trace; the next one is coarser
        }
        m.collect_garbage();
        if (!CGAL::is_closed(m)) fill_holes(m, nullptr);
        drop_flat_faces(m);
        if (!CGAL::is_closed(m)) m = copy;
        part_touching_sheets(m);
        pairs = intersections(m);
    }
    return static_cast<int32_t>(pairs.size());
}

void measure_deviation(const mesh &before, const mesh &after, repair_report &r)
{
    using primitive = CGAL::AABB_face_graph_triangle_primitive<mesh>;
    CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>> tree(faces(after).first, faces(after).second, after);
    tree.accelerate_distance_queries();
    for (auto v : before.vertices()) {
        double d = std::sqrt(tree.squared_distance(before.point(v)));
        r.max_deviation_mm = std::max(r.max_deviation_mm, d);
        r.vertices_moved += d > moved_mm;
    }
}

void need_triangles(const mesh &m, const char *after)
{
    if (CGAL::is_empty(m)) throw refusal(ERR_GEOMETRY, std::string("no triangle is left after ") + after);
}

bool encloses(const mesh &m) { return CGAL::is_closed(m) && PMP::does_bound_a_volume(m); }

mesh wrapped(const surface &in, double alpha_mm, double offset_mm)
{
    std::vector<point> points;
    std::vector<triangle> triangles;
    soup_from_surface(in, points, triangles);
    mesh m;
    CGAL::alpha_wrap_3(points, triangles, alpha_mm, offset_mm, m);
    if (!CGAL::is_closed(m)) throw refusal(ERR_GEOMETRY, "the alpha wrap came out open");
    return m;
}

} // namespace

extern "C" repair_params repair_params_default(void)
{
    return {.min_component_share = 1e-3, .wrap_alpha_mm = 1, .wrap_offset_mm = 0.05};
}

extern "C" bool repair_solid(const surface *in, const repair_params *p, surface *out, repair_report *report, err *e)
{
    return guarded(e, "repair", [&] {
        if (!surface_check(in, e)) return false;
        if (!(p->min_component_share >= 0 && p->min_component_share < 1) || !(p->wrap_alpha_mm > 0) ||
            !(p->wrap_offset_mm > 0))
            return err_set(e, ERR_INPUT, "repair: component share %g, wrap alpha %g mm, offset %g mm are not usable",
                           p->min_component_share, p->wrap_alpha_mm, p->wrap_offset_mm);
        repair_report r = {};
        mesh m = manifold_mesh(*in, r);
        PMP::stitch_borders(m);
        r.degenerate_triangles += drop_flat_faces(m);
        drop_small_components(m, p->min_component_share, r);
        need_triangles(m, "small pieces were dropped");
        mesh kept = m;
        int32_t open = fill_holes(m, &r);
        m.collect_garbage();
        if (open) throw refusal(ERR_GEOMETRY, std::to_string(open) + " holes cannot be filled");
        r.self_intersections_left = remove_intersections(m, r);
        need_triangles(m, "intersections were cut out");
        if (!r.self_intersections_left) {
            bool sound = PMP::is_outward_oriented(m);
            PMP::orient_to_bound_a_volume(m);
            r.flipped = !sound && PMP::is_outward_oriented(m);
        }
        if (r.self_intersections_left || !encloses(m)) {
            surface rest = surface_from_mesh(m);
            try {
                m = wrapped(rest, p->wrap_alpha_mm, p->wrap_offset_mm);
            } catch (...) {
                surface_free(&rest);
                throw;
            }
            surface_free(&rest);
            need_triangles(m, "the wrap");
            r.wrapped = true;
            if (!encloses(m)) throw refusal(ERR_GEOMETRY, "not even the wrap encloses a volume");
        }
        measure_deviation(kept, m, r);
        if (report) *report = r;
        *out = surface_from_mesh(m);
        return true;
    });
}

extern "C" bool repair_wrap(const surface *in, double alpha_mm, double offset_mm, surface *out, err *e)
{
    return guarded(e, "wrap", [&] {
        if (!surface_check(in, e)) return false;
        if (!(alpha_mm > 0) || !(offset_mm > 0))
            return err_set(e, ERR_INPUT, "wrap: alpha %g mm and offset %g mm must be above 0", alpha_mm, offset_mm);
        mesh m = wrapped(*in, alpha_mm, offset_mm);
        *out = surface_from_mesh(m);
        return true;
    });
}
