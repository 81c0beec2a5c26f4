#include "fluid_lbm/obstacle/solid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// A body given by a function that is negative inside. Entries are found by bisection,
// which asks for no formula of its own and cannot miss.
class LevelSetSolid final : public Solid {
  public:
    LevelSetSolid(const Bounds& bounds, std::function<double(const Vec3&)> level)
        : bounds_(bounds), level_(std::move(level)) {}

    Bounds bounds() const override { return bounds_; }

    void mark_row(double y, double z, int x_begin,
                  std::span<char> inside) const override {
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const double x = x_begin + static_cast<double>(i) + 0.5;
            if (level_({x, y, z}) < 0) inside[i] = 1;
        }
    }

    double entry(const Vec3& outside, const Vec3& inside) const override {
        double low = 0, high = 1;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = 0.5 * (low + high);
            Vec3 at;
            for (int a = 0; a < 3; ++a) {
                at[a] = outside[a] + middle * (inside[a] - outside[a]);
            }
            (level_(at) < 0 ? high : low) = middle;
        }
        return high;
    }

  private:
    Bounds bounds_;
    std::function<double(const Vec3&)> level_;
};

// A size that a shape needs to be one. Written so that NaN is refused, too.
void need(const char* what, double size_m) {
    if (!(size_m > 0)) refuse("has the ", what, " ", size_m, " m; it must be above 0");
}

Vec3 in_cells(const Vec3& metres, double spacing_m) {
    return {metres[0] / spacing_m, metres[1] / spacing_m, metres[2] / spacing_m};
}

std::shared_ptr<const Solid> make(const Sphere& sphere, double dx,
                                  const std::array<int, 3>&) {
    need("diameter", sphere.diameter_m);
    const Vec3 centre = in_cells(sphere.centre_m, dx);
    const double radius = sphere.diameter_m / (2 * dx);
    Bounds bounds;
    for (int a = 0; a < 3; ++a) {
        bounds.low[a] = centre[a] - radius;
        bounds.high[a] = centre[a] + radius;
    }
    return std::make_shared<LevelSetSolid>(bounds, [centre, radius](const Vec3& x) {
        const double r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
        return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] - radius * radius;
    });
}

std::shared_ptr<const Solid> make(const Cylinder& cylinder, double dx,
                                  const std::array<int, 3>& box_cells) {
    need("diameter", cylinder.diameter_m);
    if (cylinder.length_m) need("length", *cylinder.length_m);
    const int axis = cylinder.axis;
    Vec3 centre = in_cells(cylinder.centre_m, dx);
    const double radius = cylinder.diameter_m / (2 * dx);
    // Through the box: a margin of cells, so that what lies beyond a periodic side is
    // inside as well.
    double half_length = box_cells[axis] + 2.0;
    if (cylinder.length_m) {
        half_length = *cylinder.length_m / (2 * dx);
    } else {
        centre[axis] = 0.5 * box_cells[axis];
    }
    Bounds bounds;
    for (int a = 0; a < 3; ++a) {
        const double reach = a == axis ? half_length : radius;
        bounds.low[a] = centre[a] - reach;
        bounds.high[a] = centre[a] + reach;
    }
    return std::make_shared<LevelSetSolid>(bounds, [=](const Vec3& x) {
        double across = 0;
        for (int a = 0; a < 3; ++a) {
            if (a != axis) across += (x[a] - centre[a]) * (x[a] - centre[a]);
        }
        return std::max(across - radius * radius,
                        std::abs(x[axis] - centre[axis]) - half_length);
    });
}

std::shared_ptr<const Solid> make(const Block& block, double dx,
                                  const std::array<int, 3>&) {
    constexpr const char* lengths[3] = {"length along x", "length along y",
                                        "length along z"};
    for (int a = 0; a < 3; ++a) need(lengths[a], block.high_m[a] - block.low_m[a]);
    const Bounds bounds{in_cells(block.low_m, dx), in_cells(block.high_m, dx)};
    return std::make_shared<LevelSetSolid>(bounds, [bounds](const Vec3& x) {
        double level = bounds.low[0] - x[0];
        for (int a = 0; a < 3; ++a) {
            level = std::max({level, bounds.low[a] - x[a], x[a] - bounds.high[a]});
        }
        return level;
    });
}

std::shared_ptr<const Solid> make(const StlSurface& surface, double dx,
                                  const std::array<int, 3>&) {
    need("scale", surface.unit_m);
    return make_stl_solid(surface, dx);
}

// Written so that a position that is not a number is refused, too.
void check_place(const Bounds& bounds, const FluidConfig& config) {
    for (int a = 0; a < 3; ++a) {
        if (bounds.high[a] > 0 && bounds.low[a] < config.cells[a]) continue;
        refuse("reaches from ", bounds.low[a] * config.spacing_m, " to ",
               bounds.high[a] * config.spacing_m, " m along ", axis_name[a],
               "; it lies outside the box, which reaches from 0 to ",
               config.cells[a] * config.spacing_m, " m");
    }
}

}  // namespace

std::shared_ptr<const Solid> make_solid(const ObstacleShape& shape, double spacing_m,
                                        const std::array<int, 3>& box_cells) {
    return std::visit([&](const auto& s) { return make(s, spacing_m, box_cells); },
                      shape);
}

Solids make_solids(const FluidConfig& config) {
    Solids solids;
    for (const Obstacle& obstacle : config.obstacles) {
        try {
            solids.push_back(make_solid(obstacle.shape, config.spacing_m, config.cells));
            check_place(solids.back()->bounds(), config);
        } catch (const std::invalid_argument& fault) {
            refuse("fluid obstacle \"", obstacle.name, "\" ", fault.what());
        }
    }
    return solids;
}

}  // namespace magfsi::fluid
