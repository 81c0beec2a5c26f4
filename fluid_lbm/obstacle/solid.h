// SPDX-License-Identifier: GPL-2.0-or-later
// The shape of an obstacle as the solver sees it. Lengths in cells, from the box's lowest
// corner.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

// A body and its images across periodic sides.
class Solid {
  public:
    virtual ~Solid() = default;

    virtual Bounds bounds() const = 0;  // bounds of one image
    // Bounds of each image that reaches into a box of cells.
    virtual std::vector<Bounds> parts_in(const Bounds& /*box*/) const {
        return {bounds()};
    }

    // True if a point lies in the body.
    virtual bool holds(const Vec3& point) const = 0;

    // Sets inside[i] for the cell centres x_begin + i + 1/2 of the row at (y, z) that lie
    // in the body, and leaves the other entries as they are.
    virtual void mark_row(double y, double z, int x_begin,
                          std::span<char> inside) const = 0;

    // Place where the segment from a point outside to a point inside meets the surface,
    // as a fraction of the segment in (0, 1].
    virtual double entry(const Vec3& outside, const Vec3& inside) const = 0;
};

using Solids = std::vector<std::shared_ptr<const Solid>>;

// Makes the body of a shape. A cylinder without a length goes through the box. Throws
// std::invalid_argument if a size is not positive, or as make_stl_solid.
std::shared_ptr<const Solid> make_solid(const ObstacleShape& shape, double spacing_m,
                                        const std::array<int, 3>& box_cells);
// Reads the body of an STL file. box [cells]: later queries concern points in it or at
// most its length beside it. Throws std::invalid_argument with the file's name if the
// file cannot be read, is cut short, has no triangle or is not closed.
std::shared_ptr<const Solid> make_stl_solid(const StlSurface& surface, double spacing_m,
                                            const Bounds& box);

// Extent of the closed surface in a file. Throws as make_stl_solid.
struct StlExtent {
    Bounds bounds_m;
    double volume_m3 = 0;  // volume inside the surface
    int parts = 1;         // surfaces that share no edge
    std::size_t triangles = 0;
};
StlExtent stl_extent(const StlSurface& surface);

// The body with images, `period` cells apart along each axis that has one, else 0.
std::shared_ptr<const Solid> with_images(std::shared_ptr<const Solid> solid,
                                         const std::array<int, 3>& period);

// The bodies of all obstacles, in the order of the configuration, with images across
// periodic sides. Throws std::invalid_argument with a sentence on the first obstacle that
// cannot be made or lies outside the box.
Solids make_solids(const FluidConfig& config);

}  // namespace magfsi::fluid
