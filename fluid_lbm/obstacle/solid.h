// The shape of an obstacle as the solver asks for it. Lengths in cells, from the box's
// lowest corner.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fluid_lbm/options.h"

namespace magfsi::fluid {

struct Bounds {
    Vec3 low{}, high{};
};

class Solid {
  public:
    virtual ~Solid() = default;

    virtual Bounds bounds() const = 0;

    // Sets inside[i] for the cell centres x_begin + i + 1/2 of the row at (y, z) that lie
    // in the body; leaves the rest.
    virtual void mark_row(double y, double z, int x_begin,
                          std::span<char> inside) const = 0;

    // Where the way from a point outside to one inside meets the surface, as a fraction
    // of it in (0, 1].
    virtual double entry(const Vec3& outside, const Vec3& inside) const = 0;
};

using Solids = std::vector<std::shared_ptr<const Solid>>;

// Throws std::invalid_argument if an STL file cannot be read or is not closed. Bodies
// without a length go through the box.
std::shared_ptr<const Solid> make_solid(const ObstacleShape& shape, double spacing_m,
                                        const std::array<int, 3>& box_cells);

}  // namespace magfsi::fluid
