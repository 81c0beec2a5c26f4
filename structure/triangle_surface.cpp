// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/triangle_surface.h"

#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

using surface::Triangle;

constexpr int most_in_a_leaf = 4;

double squared(const Vec3& v) {
    return dot(v, v);
}

// Nearest point of a triangle, by the region of the triangle's plane that the point
// projects to: a corner's, an edge's or the inside's (Ericson, Real-Time Collision
// Detection (2005), section 5.1.5).
Vec3 nearest_on(const Triangle& t, const Vec3& x) {
    const Vec3 ab = t[1] - t[0], ac = t[2] - t[0];
    const Vec3 ax = x - t[0], bx = x - t[1], cx = x - t[2];
    const double a1 = dot(ab, ax), a2 = dot(ac, ax);
    if (a1 <= 0 && a2 <= 0) return t[0];
    const double b1 = dot(ab, bx), b2 = dot(ac, bx);
    if (b1 >= 0 && b2 <= b1) return t[1];
    const double on_ab = a1 * b2 - b1 * a2;
    if (on_ab <= 0 && a1 >= 0 && b1 <= 0) return t[0] + a1 / (a1 - b1) * ab;
    const double c1 = dot(ab, cx), c2 = dot(ac, cx);
    if (c2 >= 0 && c1 <= c2) return t[2];
    const double on_ac = c1 * a2 - a1 * c2;
    if (on_ac <= 0 && a2 >= 0 && c2 <= 0) return t[0] + a2 / (a2 - c2) * ac;
    const double on_bc = b1 * c2 - c1 * b2, to_b = b2 - b1, to_c = c1 - c2;
    if (on_bc <= 0 && to_b >= 0 && to_c >= 0)
        return t[1] + to_b / (to_b + to_c) * (t[2] - t[1]);
    const double whole = on_ab + on_ac + on_bc;
    return t[0] + on_ac / whole * ab + on_ab / whole * ac;
}

}  // namespace

TriangleSurface::TriangleSurface(const std::string& file, double unit_m,
                                 const Vec3& shift_m)
    : TriangleSurface(surface::read_closed(file, unit_m, shift_m)) {}

TriangleSurface::TriangleSurface(surface::Closed read)
    : triangles_(std::move(read.triangles)) {
    // A triangle without area has no normal; its neighbours share its edges.
    std::erase_if(triangles_,
                  [](const Triangle& t) { return squared(surface::normal(t)) == 0; });
    add_boxes(0, static_cast<int>(triangles_.size()));
    if (read.parts > 1) find_hidden();
}

// Marks the triangles inside another part of the surface: probe points just off both
// sides, over the centroid and near the three corners, are all inside.
void TriangleSurface::find_hidden() {
    const Vec3 size = boxes_.front().high_m - boxes_.front().low_m;
    const double off = 1e-6 * std::sqrt(squared(size));
    hidden_.resize(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Triangle& t = triangles_[i];
        const Vec3 n = surface::normal(t);
        const double length = std::sqrt(squared(n));
        Vec3 middle{};
        for (const Vec3& corner : t) middle += 1.0 / 3 * corner;
        bool hidden = true;
        for (const double share : {0.0, 0.98}) {
            for (const Vec3& corner : t) {
                const Vec3 at = middle + share * (corner - middle);
                hidden = hidden && holds(at + off / length * n) &&
                         holds(at - off / length * n);
            }
        }
        hidden_[i] = hidden;
    }
}

// Builds the subtree of triangles_[first, first + count), reorders these, and returns the
// number of its root.
int TriangleSurface::add_boxes(int first, int count) {
    const auto number = boxes_.size();
    boxes_.emplace_back();
    Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const auto begin = triangles_.begin() + first;
    for (auto t = begin; t != begin + count; ++t) {
        for (const Vec3& corner : *t) {
            box.low_m = lower(box.low_m, corner);
            box.high_m = higher(box.high_m, corner);
        }
    }
    if (count <= most_in_a_leaf) {
        box.first = first;
        box.count = count;
    } else {
        const Vec3 edges = box.high_m - box.low_m;
        const std::size_t d = std::ranges::max_element(edges) - edges.begin();
        const auto middle = [d](const Triangle& t) {
            return t[0][d] + t[1][d] + t[2][d];
        };
        const int half = count / 2;
        std::nth_element(
            begin, begin + half, begin + count,
            [&](const Triangle& a, const Triangle& b) { return middle(a) < middle(b); });
        add_boxes(first, half);
        box.right = add_boxes(first + half, count - half);
    }
    boxes_[number] = box;
    return number;
}

template <class Visit>
void TriangleSurface::visit_leaf(const Box& box, const Visit& visit) const {
    for (int i = box.first; i < box.first + box.count; ++i)
        visit(static_cast<std::size_t>(i));
}

// Counts the signed crossings of the ray from x along +x with the triangles.
bool TriangleSurface::holds(const Vec3& x) const {
    int winding = 0;
    const auto look = [&](const auto& self, int number) -> void {
        const Box& box = boxes_[number];
        if (x[0] > box.high_m[0] || x[1] < box.low_m[1] || x[1] > box.high_m[1] ||
            x[2] < box.low_m[2] || x[2] > box.high_m[2])
            return;
        visit_leaf(box, [&](std::size_t i) {
            const auto at = surface::crossing(triangles_[i], x[1], x[2]);
            if (at && at->x > x[0]) winding += at->out;
        });
        if (box.count > 0) return;
        self(self, number + 1);
        self(self, box.right);
    };
    look(look, 0);
    return winding != 0;
}

// Branch-and-bound search: the nearer child first, and none that is farther than the
// best.
TriangleSurface::Nearest TriangleSurface::nearest(const Vec3& x) const {
    const auto squared_to = [&](int number) {
        const Box& box = boxes_[number];
        Vec3 way{};
        for (std::size_t d = 0; d < 3; ++d)
            way[d] = x[d] - std::clamp(x[d], box.low_m[d], box.high_m[d]);
        return squared(way);
    };
    double least = INFINITY;
    const Triangle* of = nullptr;
    Nearest found;
    const auto look = [&](const auto& self, int number) -> void {
        const Box& box = boxes_[number];
        visit_leaf(box, [&](std::size_t i) {
            if (!hidden_.empty() && hidden_[i]) return;
            const Triangle& t = triangles_[i];
            const Vec3 at = nearest_on(t, x);
            const double to = squared(x - at);
            if (!(to < least)) return;
            least = to;
            found.at_m = at;
            of = &t;
        });
        if (box.count > 0) return;
        int near = number + 1, far = box.right;
        double to_near = squared_to(near), to_far = squared_to(far);
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        if (to_near < least) self(self, near);
        if (to_far < least) self(self, far);
    };
    look(look, 0);
    const Vec3 n = surface::normal(*of);
    const double length = std::sqrt(squared(n));
    found.normal = n / length;
    return found;
}

}  // namespace magfsi::structure
