// SPDX-License-Identifier: GPL-2.0-or-later
// The shape of an obstacle as the solver asks for it. Lengths in cells, from the box's
// lowest corner.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

class Solid {
  public:
    virtual ~Solid() = default;

    virtual Bounds bounds() const = 0;  // of one of its images
    // Of each image that reaches into a box of cells.
    virtual std::vector<Bounds> parts_in(const Bounds& /*box*/) const {
        return {bounds()};
    }

    virtual bool holds(const Vec3& point) const = 0;

    // Sets inside[i] for the cell centres x_begin + i + 1/2 of the row at (y, z) that lie
    // in the body; leaves the rest.
    virtual void mark_row(double y, double z, int x_begin,
                          std::span<char> inside) const = 0;

    // Where the way from a point outside to one inside meets the surface, as a fraction
    // of it in (0, 1].
    virtual double entry(const Vec3& outside, const Vec3& inside) const = 0;
};

using Solids = std::vector<std::shared_ptr<const Solid>>;

// Throws std::invalid_argument if the shape has no size. Bodies without a length go
// through the box.
std::shared_ptr<const Solid> make_solid(const ObstacleShape& shape, double spacing_m,
                                        const std::array<int, 3>& box_cells);
// Throws std::invalid_argument with the file's name if it cannot be read, is cut short,
// has no triangle or is not closed. box [cells]: what is asked for lies in it or beside
// it.
std::shared_ptr<const Solid> make_stl_solid(const StlSurface& surface, double spacing_m,
                                            const Bounds& box);

// Of the closed surface in a file: what it reaches and what it holds. Throws as
// make_stl_solid.
struct StlExtent {
    Bounds bounds_m;
    double volume_m3 = 0;
    int parts = 1;
    std::size_t triangles = 0;
};
StlExtent stl_extent(const StlSurface& surface);

// The same and its images, a period of cells apart along each axis that has one, else 0.
std::shared_ptr<const Solid> with_images(std::shared_ptr<const Solid> solid,
                                         const std::array<int, 3>& period);

// In the order of the configuration, with images across periodic sides. Throws
// std::invalid_argument with a sentence on the first obstacle that cannot be.
Solids make_solids(const FluidConfig& config);

}  // namespace magfsi::fluid
