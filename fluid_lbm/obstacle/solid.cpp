// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/obstacle/solid.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Entries are found by bisection, which asks for no formula of its own and cannot miss.
class LevelSetSolid final : public Solid {
  public:
    explicit LevelSetSolid(LevelSet body) : body_(std::move(body)) {}

    Bounds bounds() const override { return body_.bounds; }

    bool holds(const Vec3& point) const override { return body_.level(point) < 0; }

    void mark_row(double y, double z, int x_begin,
                  std::span<char> inside) const override {
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const double x = x_begin + static_cast<double>(i) + 0.5;
            if (holds({x, y, z})) inside[i] = 1;
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
            (body_.level(at) < 0 ? high : low) = middle;
        }
        return high;
    }

  private:
    LevelSet body_;
};

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

std::string in_words(const Vec3& cells, double spacing_m) {
    std::ostringstream text;
    text.precision(3);
    for (int a = 0; a < 3; ++a) text << (a > 0 ? " x " : "") << cells[a] * spacing_m;
    text << " m";
    return text.str();
}

// Much larger than the box, or smaller than a cell: a file in another unit.
void check_size(const StlSurface& body, const Bounds& bounds, const FluidConfig& config) {
    constexpr double larger = 20;
    Vec3 size;
    for (int a = 0; a < 3; ++a) size[a] = bounds.high[a] - bounds.low[a];
    const double most = *std::ranges::max_element(size);
    const double room = *std::ranges::max_element(config.cells);
    if (most <= larger * room && most >= 1) return;
    std::string guess = "see that its unit is the file's";
    for (const auto& [name, unit_m] :
         {std::pair("1 m", 1.0), std::pair("1 cm", 1e-2), std::pair("1 mm", 1e-3),
          std::pair("1 um", 1e-6)}) {
        const double then = most * unit_m / body.unit_m;
        if (then > 2 * room || then < 2) continue;
        guess = std::string("unit: ") + name + "?";
        break;
    }
    const Vec3 box{1.0 * config.cells[0], 1.0 * config.cells[1], 1.0 * config.cells[2]};
    refuse("is the STL file ", body.file, ", which spans ",
           in_words(size, config.spacing_m), " in a box of ",
           in_words(box, config.spacing_m), " with cells of ", config.spacing_m,
           " m: ", guess);
}

}  // namespace

std::shared_ptr<const Solid> make_solid(const ObstacleShape& shape, double spacing_m,
                                        const std::array<int, 3>& box_cells) {
    return std::visit(
        [&]<class Shape>(const Shape& s) -> std::shared_ptr<const Solid> {
            if constexpr (std::is_same_v<Shape, StlSurface>)
                return make_stl_solid(
                    s, spacing_m,
                    {{}, {1.0 * box_cells[0], 1.0 * box_cells[1], 1.0 * box_cells[2]}});
            else
                return std::make_shared<LevelSetSolid>(s.level_set(spacing_m, box_cells));
        },
        shape);
}

Solids make_solids(const FluidConfig& config) {
    Solids solids;
    for (const Obstacle& obstacle : config.obstacles) {
        try {
            solids.push_back(make_solid(obstacle.shape, config.spacing_m, config.cells));
            if (config.is_patch) continue;
            if (const auto* stl = std::get_if<StlSurface>(&obstacle.shape))
                check_size(*stl, solids.back()->bounds(), config);
            check_place(solids.back()->bounds(), config);
        } catch (const std::invalid_argument& fault) {
            refuse("fluid obstacle \"", obstacle.name, "\" ", fault.what());
        }
    }
    return solids;
}

}  // namespace magfsi::fluid
