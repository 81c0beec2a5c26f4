// SPDX-License-Identifier: GPL-2.0-or-later
// How far a point is from a closed surface of triangles, and on which side of it.
#pragma once

#include <string>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/options.h"
#include "surface/triangles.h"

namespace magfsi::structure {

// The triangles lie in a tree of boxes, halved at the middle one along the longest edge:
// a query looks at some log N of them.
class TriangleSurface {
  public:
    // As surface::read_closed.
    TriangleSurface(const std::string& file, double unit_m, const Vec3& shift_m);

    // Whether the surface winds round the point, as the fluid's obstacles have it:
    // whichever way round the file's triangles are.
    bool holds(const Vec3& point_m) const;

    Bounds bounds() const { return {boxes_[0].low_m, boxes_[0].high_m}; }

    struct Nearest {
        Vec3 at_m{};
        Vec3 normal{};  // of its triangle, of unit length, outwards
    };
    // But for triangles that lie inside of another part.
    Nearest nearest(const Vec3& point_m) const;

  private:
    struct Box {
        Vec3 low_m{}, high_m{};
        int first = 0, count = 0;  // of triangles; of a leaf
        int right = 0;             // number of the second child; the first comes next
    };
    explicit TriangleSurface(surface::Closed read);
    void find_hidden();
    int add_boxes(int first, int count);
    template <class Visit>
    void visit_leaf(const Box& box, const Visit& visit) const;

    std::vector<surface::Triangle> triangles_;  // in the order of the leaves
    std::vector<Box> boxes_;                    // the first holds all
    std::vector<bool> hidden_;  // of each triangle; none where there is one part
};

}  // namespace magfsi::structure
