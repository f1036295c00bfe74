// Closest points, rays and inside tests with CGAL's AABB tree.
#include "geometry/nearest.h"
#include "geometry/cgal/guard.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>
#include <vector>

namespace {
using kernel = CGAL::Simple_cartesian<double>;
using point = kernel::Point_3;
using triangle = kernel::Triangle_3;
using primitive = CGAL::AABB_triangle_primitive<kernel, std::vector<triangle>::const_iterator>;
using tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;
} // namespace

struct nearest {
    std::vector<triangle> triangles;
    tree boxes;
};

bool nearest_create(const surface *s, nearest **out, err *e)
{
    return guarded(e, "closest-point tree", [&] {
        if (!surface_check(s, e)) return false;
        auto n = std::make_unique<nearest>();
        n->triangles.reserve(static_cast<std::size_t>(s->triangle_count));
        auto at = [&](std::size_t i) {
            const double *p = s->xyz + 3 * static_cast<std::size_t>(s->tri[i]);
            return point(p[0], p[1], p[2]);
        };
        for (std::size_t t = 0; t < static_cast<std::size_t>(s->triangle_count); t++)
            n->triangles.emplace_back(at(3 * t), at(3 * t + 1), at(3 * t + 2));
        n->boxes.rebuild(n->triangles.cbegin(), n->triangles.cend());
        n->boxes.build();
        n->boxes.accelerate_distance_queries();
        *out = n.release();
        return true;
    });
}

void nearest_destroy(nearest **n)
{
    delete *n;
    *n = nullptr;
}

double nearest_point(const nearest *n, const double p[3], double at[3], int32_t *number)
{
    auto found = n->boxes.closest_point_and_primitive(point(p[0], p[1], p[2]));
    if (at)
        for (int c = 0; c < 3; c++) at[c] = found.first[c];
    if (number) *number = static_cast<int32_t>(found.second - n->triangles.cbegin());
    return std::sqrt(CGAL::squared_distance(found.first, point(p[0], p[1], p[2])));
}

double nearest_point_onward(const nearest *n, const double p[3], double at[3], int32_t *number)
{
    const point here(p[0], p[1], p[2]);
    auto found =
        n->boxes.closest_point_and_primitive(here, {point(at[0], at[1], at[2]), n->triangles.cbegin() + *number});
    for (int c = 0; c < 3; c++) at[c] = found.first[c];
    *number = static_cast<int32_t>(found.second - n->triangles.cbegin());
    return std::sqrt(CGAL::squared_distance(found.first, here));
}

bool nearest_ray(const nearest *n, const double from[3], const double direction[3], double hit[3], int32_t *number)
{
    kernel::Ray_3 ray(point(from[0], from[1], from[2]), kernel::Vector_3(direction[0], direction[1], direction[2]));
    if (ray.is_degenerate()) return false;
    auto found = n->boxes.first_intersection(ray);
    if (!found) return false;
    const point *p = boost::get<point>(&found->first);
    const kernel::Segment_3 *along = boost::get<kernel::Segment_3>(&found->first);
    if (!p && !along) return false;
    point at = p ? *p : along->source();
    for (int c = 0; c < 3; c++) hit[c] = at[c];
    if (number) *number = static_cast<int32_t>(found->second - n->triangles.cbegin());
    return true;
}

bool nearest_inside(const nearest *n, const double p[3])
{
    // Three rays in directions without symmetry; two must agree, so that one grazing an edge does no harm.
    static const double direction[3][3] = {
        {0.5377, 0.8339, -0.1246}, {-0.7071, 0.2113, 0.6748}, {0.1934, -0.6213, 0.7593}};
    int odd = 0;
    for (const double *d : direction) {
        kernel::Ray_3 ray(point(p[0], p[1], p[2]), kernel::Vector_3(d[0], d[1], d[2]));
        odd += static_cast<int>(n->boxes.number_of_intersected_primitives(ray) % 2);
    }
    return odd >= 2;
}
