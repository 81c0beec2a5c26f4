// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/patch.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

int floor_half(int value) {
    return value >= 0 ? value / 2 : -((1 - value) / 2);
}

CellBox grown(CellBox box, int by) {
    for (int d = 0; d < 3; ++d) {
        box.lo[d] -= by;
        box.hi[d] += by;
    }
    return box;
}

// The bodies' cells on a grid.
CellBox cells_around(const std::array<Vec3, 2>& bodies_m, double spacing_m) {
    CellBox box;
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = static_cast<int>(std::floor(bodies_m[0][d] / spacing_m));
        box.hi[d] = static_cast<int>(std::floor(bodies_m[1][d] / spacing_m)) + 1;
    }
    return box;
}

// A box that leaves the bodies room to move. Its size stays as it was while it is large
// enough and not much too large: a patch that only moves keeps its memory.
CellBox roomy(const CellBox& least, int slack_cells, const CellBox* before) {
    CellBox box = grown(least, slack_cells);
    if (!before) return box;
    for (int d = 0; d < 3; ++d) {
        const int wanted = box.hi[d] - box.lo[d], was = before->hi[d] - before->lo[d];
        const int need = least.hi[d] - least.lo[d];
        const int size = was > need + 1 && was <= wanted + 2 * slack_cells ? was : wanted;
        box.lo[d] -= floor_half(size - wanted);
        box.hi[d] = box.lo[d] + size;
    }
    return box;
}

// With their middle in the box along periodic axes.
std::array<Vec3, 2> within_a_period(std::array<Vec3, 2> bodies_m,
                                    const FluidConfig& coarse) {
    const auto periodic = periodic_axes(coarse);
    for (int d = 0; d < 3; ++d) {
        if (!periodic[d]) continue;
        const double length_m = coarse.cells[d] * coarse.spacing_m;
        const double middle_m = (bodies_m[0][d] + bodies_m[1][d]) / 2;
        for (Vec3& corner : bodies_m)
            corner[d] -= length_m * std::floor(middle_m / length_m);
    }
    return bodies_m;
}

// needed: cells of the level below the finest. Beyond walls nothing is.
bool still_inside(const LevelPlace& finest, const std::array<bool, 3>& periodic,
                  CellBox needed) {
    std::array<int, 3> period{};
    const CellBox covered = finest.covered();
    for (int d = 0; d < 3; ++d) {
        const int cells = finest.domain[d] / 2;
        if (finest.period[d] > 0) {
            needed.lo[d] = covered.lo[d];
            needed.hi[d] = covered.hi[d];
        } else if (periodic[d]) {
            period[d] = cells;
        } else {
            needed.lo[d] = std::max(needed.lo[d], 0);
            needed.hi[d] = std::min(needed.hi[d], cells);
        }
    }
    bool inside = false;
    for_each_image(period, [&](const std::array<int, 3>& image) {
        inside = inside || contains(covered, shifted(needed, image));
    });
    return inside;
}

CellBox halved(const CellBox& box) {
    CellBox half;
    for (int d = 0; d < 3; ++d) {
        half.lo[d] = floor_half(box.lo[d]);
        half.hi[d] = floor_half(box.hi[d] + 1);
    }
    return half;
}

// Where a patch's side cuts an obstacle or the cells beside it [cells]; null where none
// does. bounds: in the patch's stored cells.
std::optional<Vec3> cut_at(const LevelPlace& place, const Bounds& bounds) {
    Vec3 at{};
    bool cut = false;
    for (int d = 0; d < 3; ++d) {
        const int lo = place.inside.lo[d], hi = place.inside.hi[d];
        const double low = bounds.low[d] + place.stored.lo[d] - 1;
        const double high = bounds.high[d] + place.stored.lo[d] + 1;
        if (low >= hi || high <= lo) return {};
        const bool below = low < lo && place.stored.lo[d] < lo;
        const bool above = high > hi && place.stored.hi[d] > hi;
        at[d] = below ? lo : above ? hi : std::clamp<double>((low + high) / 2, lo, hi);
        cut = cut || below || above;
    }
    return cut ? std::optional(at) : std::nullopt;
}

}  // namespace

CellBox LevelPlace::covered() const {
    return halved(inside);
}

LevelPlace coarsest_place(const std::array<int, 3>& cells,
                          const std::array<bool, 3>& periodic) {
    LevelPlace place{cells, {{0, 0, 0}, cells}, {{0, 0, 0}, cells}, {}};
    for (int d = 0; d < 3; ++d) place.period[d] = periodic[d] ? cells[d] : 0;
    return place;
}

LevelPlace finer_place(const LevelPlace& below, const std::array<bool, 3>& periodic,
                       CellBox covered) {
    LevelPlace place;
    for (int d = 0; d < 3; ++d) {
        const int n = below.domain[d];
        const int length = covered.hi[d] - covered.lo[d];
        place.domain[d] = 2 * n;
        bool low_ring = false, high_ring = false;
        if (periodic[d] && length + 2 * apart_cells > n) {
            covered.lo[d] = 0;
            covered.hi[d] = n;
            place.period[d] = 2 * n;
        } else if (periodic[d]) {
            low_ring = high_ring = true;
        } else {
            low_ring = covered.lo[d] >= apart_cells;
            high_ring = covered.hi[d] <= n - apart_cells;
            if (!low_ring) covered.lo[d] = 0;
            if (!high_ring) covered.hi[d] = n;
        }
        place.inside.lo[d] = 2 * covered.lo[d];
        place.inside.hi[d] = 2 * covered.hi[d];
        place.stored.lo[d] = place.inside.lo[d] - (low_ring ? ring_cells : 0);
        place.stored.hi[d] = place.inside.hi[d] + (high_ring ? ring_cells : 0);
    }
    return place;
}

std::optional<std::vector<LevelPlace>> place_levels(
    const FluidConfig& coarse, const PatchRule& rule, const std::array<Vec3, 2>& bodies_m,
    const std::vector<LevelPlace>* before) {
    const int levels = rule.levels;
    const auto periodic = periodic_axes(coarse);
    // From the finest outwards, each in cells of the level below it.
    std::vector<CellBox> boxes(static_cast<std::size_t>(levels));
    const double spacing_m = std::ldexp(coarse.spacing_m, -(levels - 1));
    const CellBox least = grown(
        cells_around(within_a_period(bodies_m, coarse), spacing_m), rule.margin_cells);
    if (before && still_inside(before->back(), periodic, least)) return {};
    for (int level = levels; level >= 1; --level) {
        const auto l = static_cast<std::size_t>(level - 1);
        const CellBox was = before ? (*before)[l].covered() : CellBox{};
        const CellBox inner =
            level == levels ? least : grown(halved(boxes[l + 1]), around_cells);
        boxes[l] = level == levels
                       ? roomy(inner, rule.slack_cells, before ? &was : nullptr)
                       : inner;
    }
    std::vector<LevelPlace> places;
    LevelPlace below = coarsest_place(coarse.cells, periodic);
    for (const CellBox& box : boxes) {
        below = finer_place(below, periodic, box);
        places.push_back(below);
    }
    return places;
}

FluidConfig config_at(const FluidConfig& coarse, const LevelPlace& place, int level) {
    FluidConfig config = coarse;
    if (level == 0) return config;
    config.spacing_m = std::ldexp(coarse.spacing_m, -level);
    config.time_step_s = std::ldexp(coarse.time_step_s, -level);
    config.is_patch = true;
    Vec3 origin_m{};
    for (int d = 0; d < 3; ++d) {
        config.cells[d] = place.stored.hi[d] - place.stored.lo[d];
        origin_m[d] = place.stored.lo[d] * config.spacing_m;
        if (place.period[d] > 0) continue;
        for (int high = 0; high < 2; ++high) {
            const int side = 2 * d + high;
            Boundary& boundary = config.boundaries[side];
            // (Beside a ring the two differ, wherever across a periodic side it lies.)
            const bool at_domain = high == 1 ? place.stored.hi[d] == place.inside.hi[d]
                                             : place.stored.lo[d] == place.inside.lo[d];
            if (!at_domain) boundary = Boundary{.kind = BoundaryKind::no_slip};
            if (boundary.kind == BoundaryKind::velocity_inlet ||
                boundary.kind == BoundaryKind::pressure_outlet) {
                refuse("the refined patch reaches the ", name_of(boundary.kind), " at ",
                       side_name[side],
                       "; keep the bodies further from it or make fluid.box larger");
            }
        }
    }
    const auto moved = [origin_m](const auto& of_point) {
        return [=](const Vec3& x) {
            return of_point({x[0] + origin_m[0], x[1] + origin_m[1], x[2] + origin_m[2]});
        };
    };
    for (Obstacle& obstacle : config.obstacles)
        obstacle.shape = seen_from(origin_m, obstacle.shape);
    if (coarse.initial_velocity) config.initial_velocity = moved(coarse.initial_velocity);
    if (coarse.initial_pressure) config.initial_pressure = moved(coarse.initial_pressure);
    return config;
}

void refuse_cut_obstacles(const FluidConfig& config, const Solids& solids,
                          const LevelPlace& place) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const auto at = cut_at(place, solids[i]->bounds());
        if (!at) continue;
        const double h_m = config.spacing_m;
        refuse(
            "the refined patch that follows the bodies cuts the obstacle \"",
            config.obstacles[i].name, "\" at (", h_m * (*at)[0], ", ", h_m * (*at)[1],
            ", ", h_m * (*at)[2],
            ") m, and the force on it would jump as the patch moves: leave "
            "obstacle_force out of probes.fluid, give the patch a fluid.refinement.box "
            "that stays, or keep the bodies further from it");
    }
}

}  // namespace magfsi::fluid
