// SPDX-License-Identifier: GPL-2.0-or-later
// The flux density of dipoles, magnets, coils and grids at points in space, and its
// gradient.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "structure/source_options.h"

namespace magfsi::structure {

// At a point: gradient(i, j) = dB_i / dx_j [T/m].
struct FieldSample {
    Eigen::Vector3d field_t = Eigen::Vector3d::Zero();
    Eigen::Matrix3d gradient_t_m = Eigen::Matrix3d::Zero();
};

class SourceField {
  public:
    // Reads the files of grids. Throws std::invalid_argument on what is no source: a size
    // or an axis of zero, other numbers of currents than times, a file that is no grid.
    explicit SourceField(const std::vector<FieldSource>& sources);
    ~SourceField();
    SourceField(SourceField&&) noexcept;
    SourceField& operator=(SourceField&&) noexcept;

    // Whether nothing moves and no strength changes.
    bool at_rest() const;
    // Places the sources and sets their strengths; before any sample.
    void set_time(double time_s);
    // Throws std::runtime_error on a point outside a grid.
    FieldSample sample(const Vec3& point_m) const;
    // Derivative of the gradient along a direction [T/m2 times its length], by central
    // differences: for Newton's tangent.
    Eigen::Matrix3d gradient_along(const Vec3& point_m, const Eigen::Vector3d& way) const;

    struct Element;  // one coil, one magnet

  private:
    std::vector<FieldSource> sources_;
    std::vector<std::unique_ptr<Element>> elements_;
};

}  // namespace magfsi::structure
