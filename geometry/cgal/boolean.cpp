// Corefinement in double precision; on failure the same again with the second body shifted by a
// ten-thousandth of a millimetre, then with exact intersection points. Each result is measured before it is
// believed: CGAL's return value alone says nothing about rounding.
#include "geometry/boolean.h"
#include "geometry/cgal/convert.hpp"
#include "geometry/mem.h"
#include "geometry/repair.h"
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <algorithm>
#include <cmath>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace np = CGAL::parameters;
using exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using exact_mesh = CGAL::Surface_mesh<exact_kernel::Point_3>;

namespace {

constexpr int shifts = 5;
constexpr double shift_step_mm = 1e-4;
constexpr double volume_tolerance = 1e-6;

double volume(const mesh &m) { return m.number_of_faces() ? PMP::volume(m) : 0; }

// The wanted result and its complement; together they must account for both volumes.
template <class Mesh> bool corefine(Mesh &a, Mesh &b, boolean_op op, Mesh &result, Mesh &other)
{
    std::array<boost::optional<Mesh *>, 4> out;
    auto slot = [](boolean_op o) {
        return o == BOOLEAN_UNION          ? PMP::Corefinement::UNION
               : o == BOOLEAN_INTERSECTION ? PMP::Corefinement::INTERSECTION
                                           : PMP::Corefinement::TM1_MINUS_TM2;
    };
    boolean_op check = op == BOOLEAN_INTERSECTION ? BOOLEAN_DIFFERENCE : BOOLEAN_INTERSECTION;
    out[slot(op)] = &result;
    out[slot(check)] = &other;
    auto all = std::make_tuple(np::default_values(), np::default_values(), np::default_values(), np::default_values());
    std::array<bool, 4> done = PMP::corefine_and_compute_boolean_operations(
        a, b, out, np::throw_on_self_intersection(true), np::default_values(), all);
    return done[slot(op)] && done[slot(check)];
}

exact_mesh to_exact(const mesh &m)
{
    exact_mesh x;
    CGAL::copy_face_graph(m, x);
    return x;
}

mesh to_double(const exact_mesh &x)
{
    for (auto v : x.vertices()) CGAL::exact(x.point(v));
    mesh m;
    CGAL::copy_face_graph(x, m);
    return m;
}

// Corefinement numbers halfedges by the addresses of the faces of its triangulations, and copies vertices in the
// order of halfedges: their numbers, never the triangles, would differ from run to run. Here the vertices of m are
// numbered as its triangles name them. False if m is not manifold.
bool number_vertices(mesh &m)
{
    m.collect_garbage();
    mesh ordered;
    ordered.reserve(m.number_of_vertices(), m.number_of_edges(), m.number_of_faces());
    std::vector<mesh::Vertex_index> number(m.number_of_vertices(), mesh::null_vertex());
    for (auto f : m.faces()) {
        std::array<mesh::Vertex_index, 3> corner;
        int k = 0;
        for (auto v : CGAL::vertices_around_face(m.halfedge(f), m)) {
            if (number[v] == mesh::null_vertex()) number[v] = ordered.add_vertex(m.point(v));
            corner[k++] = number[v];
        }
        if (ordered.add_face(corner[0], corner[1], corner[2]) == mesh::null_face()) return false;
    }
    m = std::move(ordered);
    return true;
}

double balance(boolean_op op, double a, double b, double result, double other)
{
    double left = op == BOOLEAN_UNION ? a + b - result - other : a - result - other;
    return std::fabs(left) / std::max(a, b);
}

bool closed_and_simple(const mesh &m)
{
    return !m.number_of_faces() || (CGAL::is_closed(m) && !PMP::does_self_intersect(m));
}

// m with folds of rounding removed; false if that fails.
bool repaired(mesh &m)
{
    surface folded = surface_from_mesh(m), flat = {};
    err e = {};
    repair_params p = repair_params_default();
    repair_report r;
    p.min_component_share = 0;
    bool good = repair_solid(&folded, &p, &flat, &r, &e) && !r.wrapped;
    if (good) m = mesh_from_surface(flat);
    surface_free(&folded);
    surface_free(&flat);
    return good;
}

struct attempt {
    mesh result;
    boolean_report report = {};
    bool balanced = false, sound = false;
};

attempt try_once(const mesh &a, const mesh &b, boolean_op op, double va, double vb, int shift, bool exact)
{
    attempt t;
    mesh x = a, y = b, other;
    t.report.shift_mm = shift_step_mm * shift;
    t.report.exact = exact;
    const kernel::Vector_3 way(0.36 * t.report.shift_mm, -0.48 * t.report.shift_mm, 0.8 * t.report.shift_mm);
    for (auto v : y.vertices()) y.point(v) = y.point(v) + way;
    try {
        bool done;
        if (exact) {
            exact_mesh ex = to_exact(x), ey = to_exact(y), result, rest;
            done = corefine(ex, ey, op, result, rest);
            t.result = to_double(result);
            other = to_double(rest);
        } else {
            done = corefine(x, y, op, t.result, other);
        }
        if (!done || !number_vertices(t.result)) return t;
        t.report.volume_error = balance(op, va, vb, volume(t.result), volume(other));
        t.balanced = t.report.volume_error <= volume_tolerance;
        t.sound = t.balanced && closed_and_simple(t.result);
    } catch (const CGAL::Failure_exception &) {
        // left as not done: the next rung of the ladder may do it
    } catch (const PMP::Corefinement::Self_intersection_exception &) {
    }
    return t;
}

mesh sound_mesh(const surface &s, const char *name)
{
    const std::string text = name;
    mesh m = mesh_from_surface(s);
    if (!CGAL::is_closed(m)) throw refusal(ERR_GEOMETRY, text + " is not closed");
    if (!(volume(m) > 0)) throw refusal(ERR_GEOMETRY, text + " is inside out");
    if (PMP::does_self_intersect(m)) throw refusal(ERR_GEOMETRY, text + " intersects itself");
    return m;
}

mesh combine(const mesh &a, const mesh &b, boolean_op op, boolean_report *report)
{
    double va = volume(a), vb = volume(b);
    attempt folded; // balanced, but with folds
    int attempts = 0;
    for (int k = 0; k <= shifts + 1; k++) {
        bool exact = k > shifts;
        attempt t = try_once(a, b, op, va, vb, exact ? 0 : k, exact);
        t.report.attempts = ++attempts;
        if (t.sound) {
            if (report) *report = t.report;
            return std::move(t.result);
        }
        if (t.balanced && !folded.balanced) folded = std::move(t);
        if (k == 2 && folded.balanced) break; // further shifts fold as well
    }
    if (folded.balanced) {
        double before = volume(folded.result);
        if (repaired(folded.result) &&
            std::fabs(volume(folded.result) - before) <= volume_tolerance * std::max(va, vb)) {
            folded.report.repaired = true;
            folded.report.attempts = attempts;
            if (report) *report = folded.report;
            return std::move(folded.result);
        }
    }
    throw refusal(ERR_GEOMETRY, "neither shifting nor exact points gave a closed result");
}

} // namespace

extern "C" bool boolean_apply(const surface *a, const surface *b, boolean_op op, surface *out, boolean_report *report,
                              err *e)
{
    return guarded(e, "boolean", [&] {
        if (!surface_check(a, e)) return err_prefix(e, "first body");
        if (!surface_check(b, e)) return err_prefix(e, "second body");
        mesh m = combine(sound_mesh(*a, "the first body"), sound_mesh(*b, "the second body"), op, report);
        *out = surface_from_mesh(m);
        return true;
    });
}

extern "C" bool boolean_unite(const surface *part, int count, surface *out, err *e)
{
    return guarded(e, "union", [&] {
        if (count < 1) return err_set(e, ERR_INPUT, "union of no bodies");
        std::vector<mesh> level;
        for (int i = 0; i < count; i++) {
            if (!surface_check(part + i, e)) return err_prefix(e, "body %d", i);
            level.push_back(sound_mesh(part[i], ("body " + std::to_string(i)).c_str()));
        }
        while (level.size() > 1) {
            std::vector<mesh> next;
            for (std::size_t i = 0; i + 1 < level.size(); i += 2)
                next.push_back(combine(level[i], level[i + 1], BOOLEAN_UNION, nullptr));
            if (level.size() % 2) next.push_back(std::move(level.back()));
            level = std::move(next);
        }
        *out = surface_from_mesh(level[0]);
        return true;
    });
}
