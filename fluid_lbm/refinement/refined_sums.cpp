// SPDX-License-Identifier: GPL-2.0-or-later
// Results of a refined grid as a whole: sums over the box, forces on obstacles, and the
// cell that has diverged.
#include <cmath>

#include "fluid_lbm/refinement/finer_levels.h"

namespace magfsi::fluid {

std::vector<CellBox> RefinedFluid::covered(int number, int nest) const {
    const LevelPlace& here = place(number, nest);
    std::vector<CellBox> boxes;
    const auto add = [&](const LevelPlace& finer) {
        for_each_image(here.period, [&](const std::array<int, 3>& image) {
            const CellBox box = shared(shifted(finer.covered(), image), here.inside);
            if (!is_empty(box)) boxes.push_back(box);
        });
    };
    if (number + 1 == levels()) return boxes;
    if (number > 0) {
        add(place(number + 1, nest));
        return boxes;
    }
    for (int n = 0; n < nests(); ++n) add(place(1, n));
    return boxes;
}

std::vector<CellBox> RefinedFluid::counted_of(int number, int nest) const {
    const Level& level = levels_->at(number, nest);
    std::vector<CellBox> parts{level.place.inside};
    for (const CellBox& box : covered(number, nest)) parts = without(parts, box);
    for (CellBox& part : parts) {
        for (int d = 0; d < 3; ++d) {
            part.lo[d] -= level.place.stored.lo[d];
            part.hi[d] -= level.place.stored.lo[d];
        }
    }
    return parts;
}

Totals RefinedFluid::totals() const {
    Totals all;
    for_each_patch([&](int l, int nest) {
        const Totals part = level(l, nest).totals(counted_of(l, nest));
        all.mass_kg += part.mass_kg;
        all.momentum_kg_m_s += part.momentum_kg_m_s;
        all.kinetic_energy_j += part.kinetic_energy_j;
        all.sound_energy_j += part.sound_energy_j;
        all.max_speed_m_s = std::max(all.max_speed_m_s, part.max_speed_m_s);
    });
    return all;
}

double RefinedFluid::enstrophy_1_s2() {
    fill_rings();  // derivatives at the sides of a patch read its ring
    Enstrophy all;
    for_each_patch([&](int l, int nest) {
        const Enstrophy part = level(l, nest).enstrophy(counted_of(l, nest));
        all.integral_m3_s2 += part.integral_m3_s2;
        all.volume_m3 += part.volume_m3;
    });
    return all.integral_m3_s2 / all.volume_m3;
}

double RefinedFluid::waited_for_neighbours_s() const {
    double all = 0;
    for_each_patch(
        [&](int l, int nest) { all += level(l, nest).waited_for_neighbours_s(); });
    return all;
}

// Links to obstacles count in the forces only where their level is the finest.
void RefinedFluid::count_links_once() {
    pushed_n_.resize(levels_->coarsest.solids.size());
    if (pushed_n_.empty()) return;
    for_each_patch([&](int l, int nest) {
        Level& level = levels_->at(l, nest);
        std::vector<CellBox> parts = counted_of(l, nest);
        const auto& low = level.state().owned().lo;
        level.fluid.state().obstacles->count_only([&, low](const Cell& local) {
            return std::ranges::any_of(parts, [&](const CellBox& part) {
                bool inside = true;
                for (int d = 0; d < 3; ++d) {
                    const int at = local[d] + low[d];
                    inside = inside && at >= part.lo[d] && at < part.hi[d];
                }
                return inside;
            });
        });
    });
}

// Adds a patch's impulses of its last step to the mean over a step of level 0: a step of
// level l counts by 2^-l.
void RefinedFluid::add_pushes(int number, int nest, double sign) {
    const Fluid::State& s = level(number, nest).state();
    const double dx = s.config.spacing_m;
    const double unit = sign * s.unit.force_n_m3() * dx * dx * dx / (1 << number);
    for (std::size_t i = 0; i < pushed_n_.size(); ++i) {
        pushed_n_[i] += unit * s.obstacles->impulses()[i];
    }
}

std::vector<CellRow> RefinedFluid::solid_rows() const {
    std::vector<CellRow> rows;
    if (levels_->coarsest.solids.empty()) return rows;
    FluidConfig whole = config_.coarse;
    whole.cells = place(levels() - 1).domain;
    whole.spacing_m = level(levels() - 1).config().spacing_m;
    const Solids solids = make_solids(whole);
    const SolidMap map(whole, solids, {{0, 0, 0}, whole.cells});
    for_each_row({{0, 0, 0}, whole.cells}, [&](CellRow row) {
        const int end = row.x_end;
        for (int x = 0; x < end;) {
            row.x_begin = x;
            while (x < end && map.solid({x, row.y, row.z})) ++x;
            row.x_end = x++;
            if (row.size() > 0) rows.push_back(row);
        }
    });
    return rows;
}

std::vector<Vec3> RefinedFluid::obstacle_forces() const {
    std::vector<Vec3> forces = pushed_n_;
    for (Vec3& force : forces) {
        for (double& component : force) component = summed(comm_, component);
    }
    return forces;
}

std::optional<Divergence> RefinedFluid::diverged() const {
    std::optional<Divergence> first;
    for_each_patch([&](int l, int nest) {
        if (first && first->level >= l) return;
        std::optional<Divergence> found = level(l, nest).diverged();
        if (!found) return;
        const double h_m = level(l, nest).config().spacing_m;
        for (std::size_t d = 0; d < 3; ++d) {
            found->cell[d] += place(l, nest).stored.lo[d];
            found->position_m[d] = (found->cell[d] + 0.5) * h_m;
        }
        found->level = l;
        first = found;
    });
    return first;
}

}  // namespace magfsi::fluid
