// Counts on the bare triangles, so that surfaces with crowded edges and turned triangles, which no halfedge
// structure holds, can be reported on too. The cases by shared vertices follow CGAL's Strict_intersect_faces.
#include "geometry/cgal/convert.hpp"
#include "geometry/repair.h"
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>

namespace {
using box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, int32_t, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

struct limit_reached {};

struct pair_test {
    const surface *s;

    point at(int32_t v) const { return point_at(*s, v); }

    bool operator()(int32_t t, int32_t u) const
    {
        const int32_t *a = s->tri + 3 * static_cast<std::size_t>(t), *b = s->tri + 3 * static_cast<std::size_t>(u);
        int shared = 0, i = 0, j = 0; // i, j: corners of the last shared vertex
        bool in_a[3] = {}, in_b[3] = {};
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                if (a[k] == b[l]) {
                    shared++;
                    i = k;
                    j = l;
                    in_a[k] = in_b[l] = true;
                }
        if (shared == 3) return true;
        if (shared == 2) { // folded onto each other
            int k = static_cast<int>(std::find(in_a, in_a + 3, false) - in_a);
            int l = static_cast<int>(std::find(in_b, in_b + 3, false) - in_b);
            point p = at(a[(k + 1) % 3]), q = at(a[(k + 2) % 3]), r = at(a[k]), o = at(b[l]);
            return CGAL::coplanar(p, q, r, o) && CGAL::coplanar_orientation(p, q, r, o) == CGAL::POSITIVE;
        }
        const kernel::Triangle_3 first(at(a[0]), at(a[1]), at(a[2])), second(at(b[0]), at(b[1]), at(b[2]));
        if (shared == 0) return CGAL::do_intersect(first, second);
        const kernel::Segment_3 far_a(at(a[(i + 1) % 3]), at(a[(i + 2) % 3]));
        const kernel::Segment_3 far_b(at(b[(j + 1) % 3]), at(b[(j + 2) % 3]));
        return CGAL::do_intersect(second, far_a) || CGAL::do_intersect(first, far_b);
    }
};
} // namespace

extern "C" bool repair_count_self_intersections(const surface *s, int32_t limit, int32_t *count, err *e)
{
    return guarded(e, "self-intersections", [&] {
        if (!surface_check(s, e)) return false;
        const int32_t most = std::max<int32_t>(1, limit);
        const pair_test test{s};
        std::vector<box> boxes;
        boxes.reserve(static_cast<std::size_t>(s->triangle_count));
        int32_t found = 0;
        for (int32_t t = 0; t < s->triangle_count && found < most; t++) {
            const int32_t *v = s->tri + 3 * static_cast<std::size_t>(t);
            const point p = test.at(v[0]), q = test.at(v[1]), r = test.at(v[2]);
            if (CGAL::collinear(p, q, r))
                found++; // a needle is its own intersection
            else
                boxes.emplace_back(p.bbox() + q.bbox() + r.bbox(), t);
        }
        try {
            std::vector<const box *> order; // boxes are told apart by their address, so they must stay in place
            for (const box &b : boxes) order.push_back(&b);
            if (found < most)
                CGAL::box_self_intersection_d(order.begin(), order.end(), [&](const box *a, const box *b) {
                    if (test(a->info(), b->info()) && ++found >= most) throw limit_reached();
                });
        } catch (const limit_reached &) {
        }
        *count = found;
        return true;
    });
}
