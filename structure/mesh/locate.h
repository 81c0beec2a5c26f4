// SPDX-License-Identifier: GPL-2.0-or-later
// Search for the element that contains a point, on any mesh of hexahedra.
#pragma once

#include <optional>
#include <vector>

#include "structure/lattice/hexahedron.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Local coordinates xi of a point, which solve sum N_a(xi) x_a = point, by Newton's
// method with step halving from the element's centre. Empty if it does not converge,
// which for a valid element means that the point is outside. The root may lie outside
// [-1, 1]^3.
std::optional<Vec3> inverse_map(const Positions8& nodes_m, const Vec3& point_m);

// Search structure for one mesh, undeformed or with moved nodes. It keeps a reference to
// the mesh, which must outlive it and must not change.
class PointLocator {
  public:
    // Throws std::invalid_argument on a mesh without elements.
    explicit PointLocator(const Mesh& mesh);

    // The element that contains the point, its border included, and the weights of the
    // element's nodes there. On a border between elements it is the one with the highest
    // number, as on blocks. A point outside of all elements goes to the border of the
    // element that is nearest in local coordinates (2 across an element) if it is at most
    // `tolerance` away; farther outside the result is empty.
    std::optional<MaterialPoint> find(const Vec3& point_m,
                                      double tolerance = 1e-10) const;

    // The same as find(), but points outside are moved to the nearest point of the
    // surface. Throws std::invalid_argument on points that are not finite.
    MaterialPoint nearest(const Vec3& point_m) const;

    // Point of the surface nearest to a point inside or outside.
    MaterialPoint nearest_on_surface(const Vec3& point_m) const;

  private:
    // Bin of a point; points outside go to the nearest bin.
    std::array<int, 3> bin_of(const Vec3& point_m) const;
    std::size_t bin_number(const std::array<int, 3>& bin) const;

    const Mesh& mesh_;
    std::vector<SurfaceQuad> surface_;
    std::vector<Bounds> surface_boxes_;  // one for each quad of surface_
    Vec3 low_m_{};
    Vec3 bin_size_m_{};
    double longest_diagonal_m_ = 0;  // largest of all elements' bounding boxes
    std::array<int, 3> bins_{1, 1, 1};
    // Elements whose bounding box meets bin b: entries_[first_[b]] up to
    // entries_[first_[b + 1]], the latter not included.
    std::vector<std::size_t> first_;
    std::vector<int> entries_;
};

// Result of PointLocator::nearest for one point; use the class for many. On a block it is
// the same as locate(Box, point). Throws as the class does.
MaterialPoint locate(const Mesh& mesh, const Vec3& point_m);

}  // namespace magfsi::structure
