// SPDX-License-Identifier: GPL-2.0-or-later
// Flux density on a regular grid from a CSV file with the columns x, y, z, Bx, By, Bz and
// one row per point, in any order, as Magpylib (pandas) and COMSOL export them.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "structure/magnetics/point_fields.h"
#include "structure/options.h"

namespace magfsi::structure {

// Interpolation of a grid by cubics through the four nearest points along each axis: the
// field's error falls with the fourth power of the spacing, the gradient's with the
// third. The gradient is the exact one of the cubics, so that forces derive from an
// energy.
class GridValues {
  public:
    GridValues() = default;
    // axes: ascending, evenly spaced, at least two points each; values: one per point, x
    // runs fastest.
    GridValues(std::array<std::vector<double>, 3> axes_m, std::vector<Vec3> values_t);

    // Field [T] and gradient [T/m] at a point. Throws std::runtime_error outside of the
    // grid.
    point_fields::Field<point_fields::Gradient> at(
        const point_fields::Point<point_fields::Gradient>& x) const;

    const std::array<std::vector<double>, 3>& axes_m() const { return axes_m_; }
    const std::vector<Vec3>& values_t() const { return values_t_; }

  private:
    std::array<std::vector<double>, 3> axes_m_;
    std::vector<Vec3> values_t_;
};

// Reads a grid. Throws std::invalid_argument, with the file, if it is no table
// (table_file.h) or its points are no regular grid.
GridValues read_grid(const std::filesystem::path& file);

}  // namespace magfsi::structure
