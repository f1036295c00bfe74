#!/bin/sh
# CGAL numbers the vertices of a boolean result by where the heap happens to put its triangulations.
#
# Polygon_mesh_processing::corefine_and_compute_union of the same two closed meshes, called again and again in one
# process with some memory taken and given back in between, gives the same points and the same triangles, in the same
# order of triangles, but numbers the vertices differently: a file written from it differs from run to run (an STL does
# not, a PLY or OFF does). A face that is cut into many pieces is triangulated again by a 2-D constrained Delaunay
# triangulation, whose edges are walked with a comparison of face pointers (Triangulation_ds_iterators_2.h,
# associated_edge), so that the direction of new edges depends on addresses.
#
# Whoever promises equal bytes must number the vertices anew, for instance as the triangles name them.
# Fails if all runs agree, or if more than the numbers differs. Needs Debian 12's packages (apt-get download), g++.
set -eu
version=5.5.1-2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -q "libcgal-dev=$version" libgmp-dev libgmpxx4ldbl libgmp10 libmpfr-dev libmpfr6 libboost1.74-dev libboost-dev >apt.log 2>&1 ||
    { cat apt.log; echo "the packages cannot be had"; exit 1; }
mkdir root
for package in ./*.deb; do dpkg -x "$package" root; done
cat >again.cpp <<'CPP'
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/generators.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <vector>
typedef CGAL::Exact_predicates_inexact_constructions_kernel K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
int main()
{
    std::set<std::vector<double>> points, triangles, numbered;
    std::vector<void *> junk;
    for (int run = 0; run < 30; run++) {
        Mesh box, ball, both;
        CGAL::make_hexahedron(K::Point_3(0, 0, 0), K::Point_3(4, 0, 0), K::Point_3(4, 4, 0), K::Point_3(0, 4, 0),
                              K::Point_3(0, 4, 4), K::Point_3(0, 0, 4), K::Point_3(4, 0, 4), K::Point_3(4, 4, 4), box);
        CGAL::Polygon_mesh_processing::triangulate_faces(box);
        CGAL::make_icosahedron(ball, K::Point_3(2.1, 1.9, 4.05), 1.5);
        CGAL::Polygon_mesh_processing::orient_to_bound_a_volume(box);
        CGAL::Polygon_mesh_processing::orient_to_bound_a_volume(ball);
        for (int level = 0; level < 5; level++) { // each triangle becomes four, corners on the ball
            std::vector<Mesh::Edge_index> edges(ball.edges().begin(), ball.edges().end());
            Mesh fine;
            std::vector<Mesh::Vertex_index> corner(ball.number_of_vertices()), middle(ball.number_of_edges());
            for (auto v : ball.vertices()) corner[v] = fine.add_vertex(ball.point(v));
            for (auto e : edges) {
                K::Vector_3 d = CGAL::midpoint(ball.point(ball.vertex(e, 0)), ball.point(ball.vertex(e, 1))) - K::Point_3(2.1, 1.9, 4.05);
                middle[e] = fine.add_vertex(K::Point_3(2.1, 1.9, 4.05) + 1.5 / std::sqrt(d.squared_length()) * d);
            }
            for (auto f : ball.faces()) {
                auto h = ball.halfedge(f), i = ball.next(h), j = ball.next(i);
                auto a = corner[ball.target(h)], b = corner[ball.target(i)], c = corner[ball.target(j)];
                auto ab = middle[ball.edge(i)], bc = middle[ball.edge(j)], ca = middle[ball.edge(h)];
                fine.add_face(a, ab, ca); fine.add_face(ab, b, bc); fine.add_face(ca, bc, c); fine.add_face(ab, bc, ca);
            }
            ball = fine;
        }
        if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(box, ball, both)) return 2;
        std::vector<double> in_order, as_triangles;
        std::vector<std::vector<double>> sorted;
        for (auto v : both.vertices()) {
            const auto &p = both.point(v);
            in_order.insert(in_order.end(), {p.x(), p.y(), p.z()});
            sorted.push_back({p.x(), p.y(), p.z()});
        }
        for (auto f : both.faces()) { // from the smallest corner on
            std::vector<std::vector<double>> t;
            for (auto v : both.vertices_around_face(both.halfedge(f))) t.push_back({both.point(v).x(), both.point(v).y(), both.point(v).z()});
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            for (auto &p : t) as_triangles.insert(as_triangles.end(), p.begin(), p.end());
        }
        std::sort(sorted.begin(), sorted.end());
        std::vector<double> flat;
        for (auto &p : sorted) flat.insert(flat.end(), p.begin(), p.end());
        points.insert(flat); triangles.insert(as_triangles); numbered.insert(in_order);
        for (int k = 0; k < 40; k++) junk.push_back(std::malloc(std::size_t(1000 + 977 * ((run * 37 + k * 11) % 29))));
        for (std::size_t k = run % 3; k < junk.size(); k += 3) { std::free(junk[k]); junk[k] = nullptr; }
    }
    std::printf("30 unions: %zu sets of points, %zu lists of triangles, %zu numberings of the vertices\n", points.size(),
                triangles.size(), numbered.size());
    return points.size() == 1 && triangles.size() == 1 && numbered.size() > 1 ? 0 : 1;
}
CPP
lib=$work/root/usr/lib/x86_64-linux-gnu
g++ -std=c++17 -O1 -w -I root/usr/include -I root/usr/include/x86_64-linux-gnu again.cpp -o again -L "$lib" -lgmpxx -lmpfr -lgmp
LD_LIBRARY_PATH=$lib ./again && echo "CGAL $version: as described"
