// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/obstacle/solid.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/words/likely_unit.h"
#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// A body given by a level set. The entry of a segment is found by bisection, which needs
// no formula for each shape and always finds one.
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
            const Vec3 at = outside + middle * (inside - outside);
            (body_.level(at) < 0 ? high : low) = middle;
        }
        return high;
    }

  private:
    LevelSet body_;
};

// A body that is repeated across periodic sides. An image is queried in the coordinates
// of the body itself.
class SolidWithImages final : public Solid {
  public:
    SolidWithImages(std::shared_ptr<const Solid> solid, const std::array<int, 3>& period)
        : solid_(std::move(solid)), period_(period), bounds_(solid_->bounds()) {}

    Bounds bounds() const override { return bounds_; }

    std::vector<Bounds> parts_in(const Bounds& box) const override {
        std::vector<Bounds> parts;
        each_image(box, [&](const Cell& by) {
            parts.push_back({moved(bounds_.low, by), moved(bounds_.high, by)});
        });
        return parts;
    }

    bool holds(const Vec3& point) const override {
        bool held = false;
        each_image({point, point}, [&](const Cell& by) {
            held = held || solid_->holds(moved_back(point, by));
        });
        return held;
    }

    void mark_row(double y, double z, int x_begin,
                  std::span<char> inside) const override {
        const double x_end = x_begin + static_cast<double>(inside.size());
        each_image({{static_cast<double>(x_begin), y, z}, {x_end, y, z}},
                   [&](const Cell& by) {
                       solid_->mark_row(y - by[1], z - by[2], x_begin - by[0], inside);
                   });
    }

    // Entry into the image that holds the point inside; if several overlap there, into
    // the one that is met first.
    double entry(const Vec3& outside, const Vec3& inside) const override {
        double first = 2;
        each_image({inside, inside}, [&](const Cell& by) {
            const Vec3 end = moved_back(inside, by);
            if (solid_->holds(end))
                first = std::min(first, solid_->entry(moved_back(outside, by), end));
        });
        return first <= 1 ? first : 0.5;
    }

  private:
    static Vec3 moved(Vec3 x, const Cell& by) {
        for (int a = 0; a < 3; ++a) x[a] += by[a];
        return x;
    }
    static Vec3 moved_back(Vec3 x, const Cell& by) {
        for (int a = 0; a < 3; ++a) x[a] -= by[a];
        return x;
    }
    // Calls use(shift) for the images that reach into a box.
    template <class Use>
    void each_image(const Bounds& box, const Use& use) const {
        Cell first{}, last{};
        for (int a = 0; a < 3; ++a) {
            if (period_[a] == 0) continue;
            const double period = period_[a];
            first[a] =
                static_cast<int>(std::ceil((box.low[a] - bounds_.high[a]) / period));
            last[a] =
                static_cast<int>(std::floor((box.high[a] - bounds_.low[a]) / period));
        }
        for (int z = first[2]; z <= last[2]; ++z) {
            for (int y = first[1]; y <= last[1]; ++y) {
                for (int x = first[0]; x <= last[0]; ++x)
                    use({x * period_[0], y * period_[1], z * period_[2]});
            }
        }
    }

    std::shared_ptr<const Solid> solid_;
    std::array<int, 3> period_;
    Bounds bounds_;
};

// Throws std::invalid_argument if a body lies outside the box; NaN is refused, too.
void check_place(const Bounds& bounds, const FluidConfig& config) {
    for (int a = 0; a < 3; ++a) {
        if (bounds.high[a] > 0 && bounds.low[a] < config.cells[a]) continue;
        refuse("reaches from ", bounds.low[a] * config.spacing_m, " to ",
               bounds.high[a] * config.spacing_m, " m along ", axis_name[a],
               "; it lies outside the box, which reaches from 0 to ",
               config.cells[a] * config.spacing_m, " m");
    }
}

// A size in cells as text in metres, "a x b x c m".
std::string in_words(const Vec3& cells, double spacing_m) {
    std::ostringstream text;
    text.precision(3);
    for (int a = 0; a < 3; ++a) text << (a > 0 ? " x " : "") << cells[a] * spacing_m;
    text << " m";
    return text.str();
}

// Throws std::invalid_argument if a body from a file is much larger than the box or
// smaller than a cell: the file is in another unit, and the message guesses which.
void check_size(const StlSurface& body, const Bounds& bounds, const FluidConfig& config) {
    constexpr double larger = 20;
    const Vec3 size = bounds.high - bounds.low;
    const double most = std::ranges::max(size);
    const double room = *std::ranges::max_element(config.cells);
    if (most <= larger * room && most >= 1) return;
    const Vec3 box{1.0 * config.cells[0], 1.0 * config.cells[1], 1.0 * config.cells[2]};
    refuse("is the STL file ", body.file, ", which spans ",
           in_words(size, config.spacing_m), " in a box of ",
           in_words(box, config.spacing_m), " with cells of ", config.spacing_m, " m: ",
           words::likely_unit(most * config.spacing_m, body.unit_m, 2 * config.spacing_m,
                              2 * room * config.spacing_m));
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

std::shared_ptr<const Solid> with_images(std::shared_ptr<const Solid> solid,
                                         const std::array<int, 3>& period) {
    if (period == std::array<int, 3>{}) return solid;
    return std::make_shared<SolidWithImages>(std::move(solid), period);
}

Solids make_solids(const FluidConfig& config) {
    Solids solids;
    std::array<int, 3> period = config.box_period;
    for (int a = 0; a < 3 && !config.is_patch; ++a)
        period[a] = periodic_axes(config)[a] ? config.cells[a] : 0;
    for (const Obstacle& obstacle : config.obstacles) {
        try {
            const auto solid = make_solid(obstacle.shape, config.spacing_m, config.cells);
            solids.push_back(with_images(solid, period));
            if (config.is_patch) continue;
            if (const auto* stl = std::get_if<StlSurface>(&obstacle.shape))
                check_size(*stl, solid->bounds(), config);
            check_place(solids.back()->bounds(), config);
        } catch (const std::invalid_argument& fault) {
            refuse("fluid obstacle \"", obstacle.name, "\" ", fault.what());
        }
    }
    return solids;
}

}  // namespace magfsi::fluid
