// SPDX-License-Identifier: GPL-2.0-or-later
// Search for pairs of points that are near each other, by sorting them into cubic cells.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Lengths of the periods along each axis [m]; 0 along axes without one.
using Periods = Vec3;

// Distance at rest between a point a of a body and the image of its point b that is
// image_m away. It exists only where the body continues through the sides, being as long
// as the period. Otherwise the result is empty, and what the body meets there counts as
// another body. goes_on: axes along which the body continues.
inline std::optional<double> rest_distance_m(const Vec3& a, const Vec3& b,
                                             const Vec3& image_m,
                                             const std::array<bool, 3>& goes_on) {
    Vec3 there = b;
    for (std::size_t d = 0; d < 3; ++d) {
        if (image_m[d] != 0 && !goes_on[d]) return {};
        there[d] += image_m[d];
    }
    return distance_m(a, there);
}

// Axes along which a body at rest is as long as the period, and so continues through the
// sides.
inline std::array<bool, 3> goes_on_through_sides(std::span<const Vec3> nodes_m,
                                                 const Periods& period_m) {
    Bounds all;
    for (const Vec3& x : nodes_m) all.add(x);
    std::array<bool, 3> goes_on{};
    for (std::size_t d = 0; d < 3; ++d)
        goes_on[d] =
            period_m[d] > 0 && all.high_m[d] - all.low_m[d] > (1 - 1e-6) * period_m[d];
    return goes_on;
}

// Points in cells of the edge edge_m, with their periodic images near the first period.
class NearPairs {
  public:
    NearPairs(std::span<const Vec3> points_m, double edge_m,
              const Periods& period_m = {}) {
        Bounds all;
        for (std::size_t i = 0; i < points_m.size(); ++i)
            add(i, points_m[i], edge_m, period_m);
        for (const Entry& entry : entries_) all.add(entry.x_m);
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            Place place;
            for (std::size_t d = 0; d < 3; ++d)
                place[d] = 1 + static_cast<std::int64_t>(
                                   (entries_[i].x_m[d] - all.low_m[d]) / edge_m);
            cells_[key(place)].push_back(i);
        }
    }

    // Calls visit(a, b, image_m) for the pairs of points a < b in the same or in
    // neighbouring cells, once for each image x_b + image_m of b. All pairs closer than
    // edge_m are among them; others occur, too.
    template <class Visit>
    void visit(const Visit& visit) const {
        const auto look = [&](std::size_t i, std::size_t j) {
            const Entry &one = entries_[i], &other = entries_[j];
            const Entry &a = one.number < other.number ? one : other,
                        &b = one.number < other.number ? other : one;
            if (a.number == b.number || a.is_image) return;
            visit(a.number, b.number,
                  Vec3{b.by_m[0] - a.by_m[0], b.by_m[1] - a.by_m[1],
                       b.by_m[2] - a.by_m[2]});
        };
        for (const auto& [own_key, own] : cells_) {
            for (std::size_t i = 0; i < own.size(); ++i)
                for (std::size_t j = i + 1; j < own.size(); ++j) look(own[i], own[j]);
            const Place at = place(own_key);
            // Each pair of cells once: the 13 after the middle of 27
            for (int n = 14; n < 27; ++n) {
                const auto other = cells_.find(
                    key({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1}));
                if (other == cells_.end()) continue;
                for (const std::size_t i : own)
                    for (const std::size_t j : other->second) look(i, j);
            }
        }
    }

  private:
    // A point at its place in the first period, or an image of it.
    struct Entry {
        std::size_t number;
        Vec3 x_m, by_m;
        bool is_image;
    };
    void add(std::size_t number, const Vec3& x, double edge_m, const Periods& period_m) {
        // The first entry moves the point to the first period
        std::array<std::vector<double>, 3> by;
        for (std::size_t d = 0; d < 3; ++d) {
            const double length = period_m[d];
            const double home = length > 0 ? -length * std::floor(x[d] / length) : 0;
            by[d].push_back(home);
            for (int n = 1; length > 0 && n * length < length + edge_m; ++n) {
                for (const double there : {home - n * length, home + n * length})
                    if (x[d] + there > -edge_m && x[d] + there < length + edge_m)
                        by[d].push_back(there);
            }
        }
        for (const double z : by[2]) {
            for (const double y : by[1]) {
                for (const double x_by : by[0])
                    entries_.push_back(
                        {number,
                         {x[0] + x_by, x[1] + y, x[2] + z},
                         {x_by, y, z},
                         x_by != by[0][0] || y != by[1][0] || z != by[2][0]});
            }
        }
    }

    using Place = std::array<std::int64_t, 3>;
    static constexpr int bits = 21;  // for each axis
    // Number of a cell, with the three indices packed into 64 bits.
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

    std::vector<Entry> entries_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace magfsi::structure
