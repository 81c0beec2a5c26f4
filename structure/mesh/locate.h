// SPDX-License-Identifier: GPL-2.0-or-later
// The element that holds a point, on any mesh of hexahedra.
#pragma once

#include <optional>
#include <vector>

#include "structure/lattice/hexahedron.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Local coordinates xi of a point: the root of sum N_a(xi) x_a = point by Newton's method
// with step halving, from the centre. Empty where it finds none, which for a valid
// element means that the point is outside. The root may lie outside [-1, 1]^3.
std::optional<Vec3> inverse_map(const Positions8& nodes_m, const Vec3& point_m);

// Keeps a reference to the mesh, which must outlive it and stay as it is.
class PointLocator {
  public:
    explicit PointLocator(const Mesh& mesh);

    // The element whose inside or border holds the point, and the weights of its nodes
    // there. On a border between elements the one with the highest number, as on blocks.
    // A point of no element goes to the border of the element it is nearest to in local
    // coordinates (2 across an element), where that is at most `tolerance` away. Empty
    // further outside.
    std::optional<MaterialPoint> find(const Vec3& point_m,
                                      double tolerance = 1e-10) const;

    // As find; points outside are drawn to the nearest point of the surface. Throws
    // std::invalid_argument for a mesh without elements and for points that are not
    // finite.
    MaterialPoint nearest(const Vec3& point_m) const;

    // The point of the surface nearest to a point inside or outside.
    MaterialPoint nearest_on_surface(const Vec3& point_m) const;

  private:
    std::array<int, 3> bin_of(const Vec3& point_m) const;
    std::size_t bin_number(const std::array<int, 3>& bin) const;

    const Mesh& mesh_;
    std::vector<SurfaceQuad> surface_;
    Vec3 low_m_{};
    Vec3 bin_size_m_{};
    double longest_diagonal_m_ = 0;  // of an element's bounding box
    std::array<int, 3> bins_{1, 1, 1};
    // Elements whose bounding box meets bin b: entries_[first_[b]] to [first_[b + 1]].
    std::vector<std::size_t> first_;
    std::vector<int> entries_;
};

// One look-up; use PointLocator for many. On a block the same as locate(Box, point).
MaterialPoint locate(const Mesh& mesh, const Vec3& point_m);

}  // namespace magfsi::structure
