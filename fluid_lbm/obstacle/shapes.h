// SPDX-License-Identifier: GPL-2.0-or-later
// The shapes of obstacles as users choose them: SI, coordinates from the box's lowest
// corner. A new shape takes a struct here that gives its level set and moves it, its
// place in ObstacleShape, and its keys in adapters/scene/keys_fluid.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/vector/vec3.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

using magfsi::Vec3;

// Box around a body, in cells or in metres.
struct Bounds {
    Vec3 low{}, high{};
};

// A body as the region where a function is negative. Lengths in cells.
struct LevelSet {
    Bounds bounds;
    std::function<double(const Vec3&)> level;
};

// Throws std::invalid_argument unless a size of a shape is positive; NaN is refused, too.
inline void need(const char* what, double size_m) {
    if (!(size_m > 0)) refuse("has the ", what, " ", size_m, " m; it must be above 0");
}

// move() shifts a shape; level_set() describes it in cells and throws
// std::invalid_argument if a size is not positive.
struct Sphere {
    Vec3 centre_m{};
    double diameter_m = 0;

    void move(const Vec3& by_m) { centre_m += by_m; }
    LevelSet level_set(double spacing_m, const std::array<int, 3>& /*box_cells*/) const {
        need("diameter", diameter_m);
        const Vec3 centre = centre_m / spacing_m;
        const double radius = diameter_m / (2 * spacing_m);
        const Vec3 reach{radius, radius, radius};
        return {{centre - reach, centre + reach}, [centre, radius](const Vec3& x) {
                    return dot(x - centre, x - centre) - radius * radius;
                }};
    }
};

// A cylinder along the axis 0 x, 1 y or 2 z; the centre is the middle of its length.
struct Cylinder {
    Vec3 centre_m{};
    double diameter_m = 0;
    int axis = 2;
    std::optional<double> length_m;  // absent: through the whole box

    void move(const Vec3& by_m) { centre_m += by_m; }
    LevelSet level_set(double spacing_m, const std::array<int, 3>& box_cells) const {
        need("diameter", diameter_m);
        if (length_m) need("length", *length_m);
        Vec3 centre = centre_m / spacing_m;
        const double radius = diameter_m / (2 * spacing_m);
        // A cylinder through the box has a margin of cells, so that the cells beyond a
        // periodic side are inside it as well.
        double half_length = box_cells[axis] + 2.0;
        if (length_m) {
            half_length = *length_m / (2 * spacing_m);
        } else {
            centre[axis] = 0.5 * box_cells[axis];
        }
        Vec3 reach{radius, radius, radius};
        reach[axis] = half_length;
        return {{centre - reach, centre + reach},
                [centre, radius, half_length, along = axis](const Vec3& x) {
                    Vec3 across = x - centre;
                    const double height = std::abs(std::exchange(across[along], 0));
                    return std::max(dot(across, across) - radius * radius,
                                    height - half_length);
                }};
    }
};

// A box with edges along the axes.
struct Block {
    Vec3 low_m{}, high_m{};  // opposite corners

    void move(const Vec3& by_m) {
        low_m += by_m;
        high_m += by_m;
    }
    LevelSet level_set(double spacing_m, const std::array<int, 3>& /*box_cells*/) const {
        constexpr const char* lengths[3] = {"length along x", "length along y",
                                            "length along z"};
        for (int a = 0; a < 3; ++a) need(lengths[a], high_m[a] - low_m[a]);
        const Bounds bounds{low_m / spacing_m, high_m / spacing_m};
        return {bounds, [bounds](const Vec3& x) {
                    double level = bounds.low[0] - x[0];
                    for (int a = 0; a < 3; ++a) {
                        level = std::max(
                            {level, bounds.low[a] - x[a], x[a] - bounds.high[a]});
                    }
                    return level;
                }};
    }
};

// A closed triangulated surface from an STL file, ASCII or binary (stl_solid.cpp). A
// point x of the file moves to shift_m + unit_m * x.
struct StlSurface {
    std::string file;
    double unit_m = 1;  // length of the file's unit
    Vec3 shift_m{};

    void move(const Vec3& by_m) { shift_m += by_m; }
};

using ObstacleShape = std::variant<Sphere, Cylinder, Block, StlSurface>;

// The same shape in coordinates with another origin.
inline ObstacleShape seen_from(const Vec3& origin_m, ObstacleShape shape) {
    std::visit([&](auto& one) { one.move(-origin_m); }, shape);
    return shape;
}

}  // namespace magfsi::fluid
