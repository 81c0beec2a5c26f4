// SPDX-License-Identifier: GPL-2.0-or-later
// Flux density of dipoles, magnets, coils and grids at points in space, and its gradient.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "structure/source_options.h"

namespace magfsi::structure {

// Field at a point; gradient(i, j) = dB_i / dx_j [T/m].
struct FieldSample {
    Eigen::Vector3d field_t = Eigen::Vector3d::Zero();
    Eigen::Matrix3d gradient_t_m = Eigen::Matrix3d::Zero();
};

// Sources of the field at the places and strengths of one time. Each object has all
// sources.
class SourceField {
  public:
    // Places the sources at time 0 and reads the files of grids. Throws
    // std::invalid_argument on a size or an axis of zero, a number of currents that is
    // not that of the times, or a file that is no grid.
    explicit SourceField(const std::vector<FieldSource>& sources);
    ~SourceField();
    SourceField(SourceField&&) noexcept;
    SourceField& operator=(SourceField&&) noexcept;

    // True if no source moves and no strength changes.
    bool at_rest() const;
    // Moves the sources to their places and strengths of a time. Formulas throw as
    // value_at does.
    void set_time(double time_s);
    // Field of all sources at a point. Throws std::runtime_error outside of a grid.
    FieldSample sample(const Vec3& point_m) const;
    // Derivative of the gradient along `way` [T/m2, times its length], by central
    // differences: accurate enough for the tangent of Newton's method.
    Eigen::Matrix3d gradient_along(const Vec3& point_m, const Eigen::Vector3d& way) const;

    struct Element;  // one coil, one magnet or one grid

  private:
    std::vector<FieldSource> sources_;
    std::vector<std::unique_ptr<Element>> elements_;
};

}  // namespace magfsi::structure
