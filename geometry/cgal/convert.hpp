// convert: surface <-> CGAL. Private to geometry/cgal.
#pragma once
#include "geometry/cgal/guard.hpp"
#include "geometry/surface.h"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <array>
#include <string>
#include <vector>

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using point = kernel::Point_3;
using mesh = CGAL::Surface_mesh<point>;
using triangle = std::array<std::size_t, 3>;

inline point point_at(const surface &s, int32_t v)
{
    const double *x = s.xyz + 3 * static_cast<std::size_t>(v);
    return {x[0], x[1], x[2]};
}

inline void soup_from_surface(const surface &s, std::vector<point> &points, std::vector<triangle> &triangles)
{
    points.clear();
    triangles.clear();
    points.reserve(s.vertex_count);
    triangles.reserve(s.triangle_count);
    for (int32_t v = 0; v < s.vertex_count; v++) points.push_back(point_at(s, v));
    for (int32_t t = 0; t < s.triangle_count; t++) {
        const int32_t *v = s.tri + 3 * static_cast<std::size_t>(t);
        triangles.push_back({std::size_t(v[0]), std::size_t(v[1]), std::size_t(v[2])});
    }
}

// Vertex and face numbers are kept. Refuses an edge or a vertex that is not manifold or not consistently oriented.
inline mesh mesh_from_surface(const surface &s)
{
    mesh m;
    m.reserve(s.vertex_count, 3 * static_cast<mesh::size_type>(s.triangle_count) / 2, s.triangle_count);
    for (int32_t v = 0; v < s.vertex_count; v++) m.add_vertex(point_at(s, v));
    for (int32_t t = 0; t < s.triangle_count; t++) {
        const int32_t *v = s.tri + 3 * static_cast<std::size_t>(t);
        if (m.add_face(mesh::Vertex_index(v[0]), mesh::Vertex_index(v[1]), mesh::Vertex_index(v[2])) ==
            mesh::null_face())
            throw refusal(ERR_GEOMETRY, "triangle " + std::to_string(t) +
                                            " makes the surface non-manifold or inconsistently oriented");
    }
    return m;
}

// Collects garbage in m. Unused vertices are kept. The caller frees the surface.
inline surface surface_from_mesh(mesh &m)
{
    m.collect_garbage();
    surface s = surface_new(static_cast<int32_t>(m.number_of_vertices()), static_cast<int32_t>(m.number_of_faces()));
    for (auto v : m.vertices())
        for (int c = 0; c < 3; c++) s.xyz[3 * std::size_t(v) + c] = m.point(v)[c];
    for (auto f : m.faces()) {
        int k = 0;
        for (auto v : CGAL::vertices_around_face(m.halfedge(f), m))
            s.tri[3 * std::size_t(f) + k++] = static_cast<int32_t>(v);
    }
    return s;
}
