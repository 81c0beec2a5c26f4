// SPDX-License-Identifier: GPL-2.0-or-later
// Points sorted into cubic cells, to find those that are near each other.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

class NearPairs {
  public:
    NearPairs(std::span<const Vec3> points_m, double edge_m) {
        Bounds all;
        for (const Vec3& x : points_m) all.add(x);
        for (std::size_t i = 0; i < points_m.size(); ++i) {
            Place place;
            for (std::size_t d = 0; d < 3; ++d)
                place[d] = 1 + static_cast<std::int64_t>((points_m[i][d] - all.low_m[d]) /
                                                         edge_m);
            cells_[key(place)].push_back(i);
        }
    }

    // visit(a, b), a and b numbers of points: each pair of the same or of neighbouring
    // cells, once; all that are closer than an edge are among them.
    template <class Visit>
    void visit(const Visit& visit) const {
        for (const auto& [own_key, own] : cells_) {
            for (std::size_t i = 0; i < own.size(); ++i)
                for (std::size_t j = i + 1; j < own.size(); ++j) visit(own[i], own[j]);
            const Place at = place(own_key);
            for (int n = 14; n < 27; ++n) {  // of the 27 around, those behind the middle
                const auto other = cells_.find(
                    key({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1}));
                if (other == cells_.end()) continue;
                for (const std::size_t i : own)
                    for (const std::size_t j : other->second) visit(i, j);
            }
        }
    }

  private:
    using Place = std::array<std::int64_t, 3>;
    static constexpr int bits = 21;  // of each axis
    static std::uint64_t key(const Place& at) {
        std::uint64_t all = 0;
        for (const std::int64_t i : at)
            all = (all << bits) | static_cast<std::uint64_t>(i);
        return all;
    }
    static Place place(std::uint64_t key) {
        constexpr std::uint64_t mask = (1U << bits) - 1;
        return {static_cast<std::int64_t>(key >> (2 * bits)),
                static_cast<std::int64_t>((key >> bits) & mask),
                static_cast<std::int64_t>(key & mask)};
    }

    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace magfsi::structure
