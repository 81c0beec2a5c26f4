// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/nests.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// The cells of a grid that bodies touch. A corner on the border of two cells counts for
// the inner one of them, so that rounding gives the same for a body and its mirror image.
CellBox cells_around(const BodyBox& bodies_m, double spacing_m) {
    constexpr double rounding = 1e-9;  // cells
    CellBox box;
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = static_cast<int>(std::floor(bodies_m[0][d] / spacing_m + rounding));
        box.hi[d] = static_cast<int>(std::ceil(bodies_m[1][d] / spacing_m - rounding));
        // A flat body in the border of two cells takes the cells on both sides.
        if (box.hi[d] > box.lo[d]) continue;
        --box.lo[d];
        ++box.hi[d];
    }
    return box;
}

// The box moved by whole periods along periodic axes, so that its middle comes within
// half a period of a place.
BodyBox brought_near(BodyBox box, const Vec3& place_m, const FluidConfig& coarse) {
    const auto periodic = periodic_axes(coarse);
    for (int d = 0; d < 3; ++d) {
        if (!periodic[d]) continue;
        const double length_m = coarse.cells[d] * coarse.spacing_m;
        const double away_m = (box[0][d] + box[1][d]) / 2 - place_m[d];
        for (Vec3& corner : box)
            corner[d] -= length_m * std::floor(away_m / length_m + 0.5);
    }
    return box;
}

// Middle of the whole box.
Vec3 middle_of(const FluidConfig& coarse) {
    Vec3 middle_m;
    for (std::size_t d = 0; d < 3; ++d)
        middle_m[d] = coarse.cells[d] * coarse.spacing_m / 2;
    return middle_m;
}

// True if a nest still holds `needed`, cells of the level below the finest. Cells beyond
// walls are not asked for.
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

// Bodies and the nest around them.
struct Group {
    std::vector<std::size_t> bodies;
    NestPlaces places;
};

// One decision on the nests of all bodies.
class Placement {
  public:
    Placement(const FluidConfig& coarse, const PatchRule& rule,
              const std::vector<BodyBox>& bodies_m, const std::vector<NestPlaces>* before)
        : coarse_(coarse),
          rule_(rule),
          periodic_(periodic_axes(coarse)),
          bodies_m_(bodies_m) {
        if (before) before_ = *before;
        members_.resize(before_.size());
        for (std::size_t b = 0; b < bodies_m.size(); ++b) {
            home_.push_back(home_of(b));
            if (home_[b] < before_.size()) members_[home_[b]].push_back(b);
        }
    }

    // True if every body has a nest that holds it with its margin.
    bool all_stay() const {
        for (std::size_t b = 0; b < home_.size(); ++b)
            if (home_[b] >= before_.size() || !holds(home_[b], b)) return false;
        return true;
    }

    // The new nests: those that can stay, one more for each other body, and shared ones
    // in place of those that are near each other.
    std::vector<NestPlaces> places() const {
        std::vector<Group> groups;
        for (std::size_t b = 0; b < home_.size(); ++b) {
            if (!stays(home_[b])) {
                groups.push_back({{b}, nest_around({b})});
            } else if (members_[home_[b]].front() == b) {
                groups.push_back({members_[home_[b]], before_[home_[b]]});
            }
        }
        while (merge_two(groups)) {
        }
        std::vector<NestPlaces> all;
        for (Group& group : groups) all.push_back(std::move(group.places));
        return all;
    }

  private:
    // Spacing [m] of the level below the finest.
    double finest_but_one_m() const {
        return std::ldexp(coarse_.spacing_m, -(rule_.levels - 1));
    }
    // Box around bodies, across periodic sides where they are nearest to each other.
    BodyBox around(const std::vector<std::size_t>& bodies) const {
        BodyBox all =
            brought_near(bodies_m_[bodies.front()], middle_of(coarse_), coarse_);
        for (const std::size_t b : bodies) {
            const auto [low, high] =
                brought_near(bodies_m_[b], (all[0] + all[1]) / 2, coarse_);
            all = {lower(all[0], low), higher(all[1], high)};
        }
        return brought_near(all, middle_of(coarse_), coarse_);
    }
    // Cells that a nest of these bodies must cover at least.
    CellBox least_box(const std::vector<std::size_t>& bodies) const {
        return grown(cells_around(around(bodies), finest_but_one_m()),
                     rule_.margin_cells);
    }
    bool holds(std::size_t nest, std::size_t body) const {
        return still_inside(before_[nest].back(), periodic_, least_box({body}));
    }
    // Number of the nest that a body is in, even if it has come near the nest's sides;
    // before_.size() if it is in none.
    std::size_t home_of(std::size_t body) const {
        const CellBox least = least_box({body});
        for (std::size_t nest = 0; nest < before_.size(); ++nest) {
            const LevelPlace& finest = before_[nest].back();
            std::array<int, 3> period{};
            for (std::size_t d = 0; d < 3; ++d)
                period[d] = periodic_[d] ? finest.domain[d] / 2 : 0;
            bool in = false;
            for_each_image(period, [&](const std::array<int, 3>& image) {
                in = in || !is_empty(shared(finest.covered(), shifted(least, image)));
            });
            if (in) return nest;
        }
        return before_.size();
    }
    bool stays(std::size_t nest) const {
        return nest < before_.size() && std::ranges::all_of(members_[nest], [&](auto b) {
                   return holds(nest, b);
               });
    }

    // A nest around bodies, built from the finest level outwards; each box is in cells of
    // the level below it.
    NestPlaces nest_around(const std::vector<std::size_t>& bodies) const {
        const std::size_t levels = rule_.levels;
        std::vector<CellBox> boxes(levels);
        boxes[levels - 1] = grown(least_box(bodies), rule_.slack_cells);
        for (std::size_t l = levels - 1; l > 0; --l)
            boxes[l - 1] = grown(halved(boxes[l]), around_cells);
        NestPlaces places;
        LevelPlace below = coarsest_place(coarse_.cells, periodic_);
        for (const CellBox& box : boxes) {
            below = finer_place(below, periodic_, box);
            places.push_back(below);
        }
        return places;
    }

    // True if two nests are closer than between_nests_cells.
    bool are_near(const NestPlaces& a, const NestPlaces& b) const {
        const CellBox reach = grown(a.front().covered(), between_nests_cells);
        const auto period = coarsest_place(coarse_.cells, periodic_).period;
        bool near = false;
        for_each_image(period, [&](const std::array<int, 3>& image) {
            near = near || !is_empty(shared(reach, shifted(b.front().covered(), image)));
        });
        return near;
    }

    // Replaces the first two groups that are near each other by one; false if there are
    // none.
    bool merge_two(std::vector<Group>& groups) const {
        for (std::size_t i = 0; i < groups.size(); ++i) {
            for (std::size_t j = i + 1; j < groups.size(); ++j) {
                if (!are_near(groups[i].places, groups[j].places)) continue;
                auto& bodies = groups[i].bodies;
                bodies.insert(bodies.end(), groups[j].bodies.begin(),
                              groups[j].bodies.end());
                std::ranges::sort(bodies);
                groups[i].places = nest_around(bodies);
                groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(j));
                return true;
            }
        }
        return false;
    }

    const FluidConfig& coarse_;
    const PatchRule& rule_;
    std::array<bool, 3> periodic_;
    const std::vector<BodyBox>& bodies_m_;
    std::vector<NestPlaces> before_;
    std::vector<std::size_t> home_;                  // nest of each body
    std::vector<std::vector<std::size_t>> members_;  // bodies of each nest
};

}  // namespace

std::optional<std::vector<NestPlaces>> place_nests(
    const FluidConfig& coarse, const PatchRule& rule,
    const std::vector<BodyBox>& bodies_m, const std::vector<NestPlaces>* before) {
    const Placement placement(coarse, rule, bodies_m, before);
    if (before && placement.all_stay()) return {};
    return placement.places();
}

void refuse_bodies_at_sides(const FluidConfig& coarse, PatchRule rule,
                            int least_margin_cells, const std::vector<BodyBox>& bodies_m,
                            const std::vector<NestPlaces>& places) {
    rule.margin_cells = least_margin_cells;
    if (place_nests(coarse, rule, bodies_m, &places))
        refuse(
            "a body has come to the sides of the refined patch, which stays where it "
            "is: take a larger fluid.refinement.box, or leave it out for a patch "
            "that follows");
}

}  // namespace magfsi::fluid
