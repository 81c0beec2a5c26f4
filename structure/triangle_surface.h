// SPDX-License-Identifier: GPL-2.0-or-later
// Signed distance to a closed triangle surface: nearest point, and inside or outside.
#pragma once

#include <string>
#include <vector>

#include "base/surface/triangles.h"
#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// A closed surface in a tree of bounding boxes, halved at the median triangle along the
// longest edge: a query takes some log N steps for N triangles.
class TriangleSurface {
  public:
    // Reads an STL file. Throws as surface::read_closed does.
    TriangleSurface(const std::string& file, double unit_m, const Vec3& shift_m);

    // True if the point is inside: the surface's winding number about it is not 0,
    // whatever the orientation of the file's triangles. The fluid's obstacles use the
    // same rule.
    bool holds(const Vec3& point_m) const;

    // Bounding box of the whole surface [m].
    Bounds bounds() const { return {boxes_[0].low_m, boxes_[0].high_m}; }

    struct Nearest {
        Vec3 at_m{};
        Vec3 normal{};  // outward unit normal of the triangle at the point
    };
    // Nearest point of the surface. Triangles inside another part of the surface do not
    // count.
    Nearest nearest(const Vec3& point_m) const;

  private:
    // A node of the tree, numbered in depth-first order.
    struct Box {
        Vec3 low_m{}, high_m{};
        int first = 0, count = 0;  // range in triangles_; count is 0 unless it is a leaf
        int right = 0;  // number of the second child; the first has the next number
    };
    explicit TriangleSurface(surface::Closed read);
    void find_hidden();
    int add_boxes(int first, int count);
    template <class Visit>
    void visit_leaf(const Box& box, const Visit& visit) const;

    std::vector<surface::Triangle> triangles_;  // in the order of the leaves
    std::vector<Box> boxes_;                    // the first holds all
    // True for triangles inside another part; empty if the surface has one part
    std::vector<bool> hidden_;
};

}  // namespace magfsi::structure
