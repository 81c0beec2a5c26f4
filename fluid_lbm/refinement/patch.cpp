// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/patch.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Place [cells] where a side of the patch cuts an obstacle or the cells beside it; absent
// if none does. bounds: of the obstacle, in the patch's stored cells.
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
        if (covered.hi[d] - covered.lo[d] < least_cells) {
            covered.lo[d] -= low_ring ? 1 : 0;
            covered.hi[d] += high_ring ? 1 : 0;
        }
        place.inside.lo[d] = 2 * covered.lo[d];
        place.inside.hi[d] = 2 * covered.hi[d];
        place.stored.lo[d] = place.inside.lo[d] - (low_ring ? ring_cells : 0);
        place.stored.hi[d] = place.inside.hi[d] + (high_ring ? ring_cells : 0);
    }
    return place;
}

FluidConfig config_at(const FluidConfig& coarse, const LevelPlace& place, int level) {
    FluidConfig config = coarse;
    if (level == 0) return config;
    config.spacing_m = std::ldexp(coarse.spacing_m, -level);
    config.time_step_s = std::ldexp(coarse.time_step_s, -level);
    config.is_patch = true;
    config.measures_planes = false;  // planes are measured on the coarsest level
    Vec3 origin_m{};
    for (int d = 0; d < 3; ++d) {
        config.box_period[d] = periodic_axes(coarse)[d] ? place.domain[d] : 0;
        config.cells[d] = place.stored.hi[d] - place.stored.lo[d];
        origin_m[d] = place.stored.lo[d] * config.spacing_m;
        if (place.period[d] > 0) continue;
        for (int high = 0; high < 2; ++high) {
            const int side = 2 * d + high;
            Boundary& boundary = config.boundaries[side];
            // A side is the domain's if nothing is stored beyond the solved cells. This
            // holds on periodic axes, too: there every side has a ring.
            const bool at_domain = high == 1 ? place.stored.hi[d] == place.inside.hi[d]
                                             : place.stored.lo[d] == place.inside.lo[d];
            config.refilled[side] = !at_domain;
            if (!at_domain) boundary = Boundary{.kind = BoundaryKind::no_slip};
            if (boundary.kind == BoundaryKind::velocity_inlet ||
                boundary.kind == BoundaryKind::pressure_outlet) {
                refuse("the refined patch reaches the ", name_of(boundary.kind), " at ",
                       side_name[side],
                       "; keep the bodies and their margin, or fluid.refinement.box, ",
                       apart_cells * 2 * config.spacing_m,
                       " m from it, or make fluid.box larger");
            }
        }
    }
    const auto moved = [origin_m](const auto& of_point) {
        return [=](const Vec3& x) { return of_point(x + origin_m); };
    };
    for (Obstacle& obstacle : config.obstacles)
        obstacle.shape = seen_from(origin_m, obstacle.shape);
    if (coarse.initial_velocity) config.initial_velocity = moved(coarse.initial_velocity);
    if (coarse.initial_pressure) config.initial_pressure = moved(coarse.initial_pressure);
    return config;
}

void refuse_cut_obstacles(const FluidConfig& config, const Solids& solids,
                          const LevelPlace& place) {
    Bounds stored;
    for (int d = 0; d < 3; ++d) stored.high[d] = config.cells[d];
    for (std::size_t i = 0; i < solids.size(); ++i) {
        std::optional<Vec3> at;
        for (const Bounds& part : solids[i]->parts_in(stored))
            if (!at) at = cut_at(place, part);
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
