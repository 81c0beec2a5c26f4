// SPDX-License-Identifier: GPL-2.0-or-later
// A flux density given on a regular grid: a CSV file with the columns x, y, z, Bx, By, Bz
// of every point, in any order, as Magpylib (pandas) and COMSOL export them.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "structure/magnetics/point_fields.h"
#include "structure/options.h"

namespace magfsi::structure {

// Between the points by cubics through the four nearest along each axis: the field's
// error falls with the fourth power of the spacing, the gradient's with the third. The
// gradient is that of the cubics, so that forces are those of an energy.
class GridValues {
  public:
    GridValues() = default;
    // axes: ascending, evenly spaced, two at least; values: x runs fastest.
    GridValues(std::array<std::vector<double>, 3> axes_m, std::vector<Vec3> values_t);

    // Throws std::runtime_error outside of the grid.
    point_fields::Field<point_fields::Gradient> at(
        const point_fields::Point<point_fields::Gradient>& x) const;

    const std::array<std::vector<double>, 3>& axes_m() const { return axes_m_; }
    const std::vector<Vec3>& values_t() const { return values_t_; }

  private:
    std::array<std::vector<double>, 3> axes_m_;
    std::vector<Vec3> values_t_;
};

// Throws std::invalid_argument, naming the file, where its points are no such grid.
GridValues read_grid(const std::filesystem::path& file);

}  // namespace magfsi::structure
