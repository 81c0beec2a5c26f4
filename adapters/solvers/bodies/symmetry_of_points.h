// SPDX-License-Identifier: GPL-2.0-or-later
// Mirrors and quarter turns of the axes that leave sets of points as they are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ranges>
#include <vector>

#include "base/vector/vec3.h"
#include "structure/mesh/mesh.h"

namespace magfsi::bodies {

// Points sorted into cubic bins, for searches within a distance of at most one bin.
class PointsNear {
  public:
    explicit PointsNear(double size_m) : size_m_(size_m) {}

    void add(const Vec3& x) { bins_[bin(x, 0)].push_back(x); }

    // Distance of the nearest point; within_m if none is nearer.
    double nearest_m(const Vec3& x, double within_m) const {
        // Only bins that the box of this half width meets: one for a small distance.
        const Bin low = bin(x, -within_m), high = bin(x, within_m);
        for (long i = low[0]; i <= high[0]; ++i)
            for (long j = low[1]; j <= high[1]; ++j)
                for (long k = low[2]; k <= high[2]; ++k) {
                    const auto found = bins_.find({i, j, k});
                    if (found == bins_.end()) continue;
                    for (const Vec3& other : found->second)
                        within_m = std::min(within_m, structure::distance_m(other, x));
                }
        return within_m;
    }
    bool any(const Vec3& x, double within_m) const {
        return nearest_m(x, within_m) < within_m;
    }
    void remove(const Vec3& x) { std::erase(bins_[bin(x, 0)], x); }

  private:
    using Bin = std::array<long, 3>;
    Bin bin(const Vec3& x, double moved_m) const {
        Bin b;
        for (std::size_t d = 0; d < 3; ++d)
            b[d] = static_cast<long>(std::floor((x[d] + moved_m) / size_m_));
        return b;
    }
    double size_m_;
    std::map<Bin, std::vector<Vec3>> bins_;
};

// A mirror or quarter turn of the axes, or several in turn, about a centre.
struct Operation {
    std::array<std::size_t, 3> axis;  // axis whose coordinate becomes the first, ...
    Vec3 sign;

    Vec3 operator()(const Vec3& x, const Vec3& centre) const {
        Vec3 image;
        for (std::size_t d = 0; d < 3; ++d)
            image[d] = centre[d] + sign[d] * (x[axis[d]] - centre[axis[d]]);
        return image;
    }
    // This operation after another.
    Operation after(const Operation& first) const {
        Operation both;
        for (std::size_t d = 0; d < 3; ++d) {
            both.axis[d] = first.axis[axis[d]];
            both.sign[d] = sign[d] * first.sign[axis[d]];
        }
        return both;
    }
    bool operator==(const Operation&) const = default;
};

// The 48 operations of a cube; the first leaves everything as it is.
inline std::vector<Operation> of_cube() {
    std::vector<Operation> all;
    std::array<std::size_t, 3> axis{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs)
            all.push_back({axis,
                           {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0,
                            signs & 4 ? -1.0 : 1.0}});
    } while (std::ranges::next_permutation(axis).found);
    return all;
}

// Places of the dense points, by layer.
using Layers = std::vector<std::vector<Vec3>>;

// The operations about the middle of all points that leave the set of them as it is.
class Symmetry {
  public:
    Symmetry(const Layers& layers, double fine_m) : fine_m_(fine_m) {
        const auto places = std::views::join(layers);
        Vec3 low = *places.begin(), high = low;
        for (const Vec3& x : places) {
            low = lower(low, x);
            high = higher(high, x);
        }
        centre_ = 0.5 * (low + high);
        std::vector<PointsNear> sets;
        for (const auto& layer : layers) {
            sets.emplace_back(fine_m);
            for (const Vec3& x : layer) sets.back().add(x);
        }
        // Meshes are files of decimal numbers, some with seven digits.
        const double same_m = 1e-6 * norm(high - low);
        for (const Operation& operation : of_cube()) add(operation, layers, sets, same_m);
    }

    // The point itself; its image if it is so near to a mirror or an axis that no other
    // point lies between.
    Vec3 fixed(Vec3 x) const {
        for (int turn = 0; turn < most_turns; ++turn) {
            Vec3 sum{};
            int count = 0;
            for (const auto& [operation, to] : kept_) {
                const Vec3 image = operation(x, centre_);
                if (!(structure::distance_m(image, x) < 1.5 * fine_m_)) continue;
                sum += image;
                ++count;
            }
            const Vec3 mean = sum / static_cast<double>(count);
            if (structure::distance_m(mean, x) < same * fine_m_) return mean;
            x = mean;
        }
        return x;
    }

    struct Image {
        Vec3 at;
        std::size_t layer;
    };
    // The different images of a point of a layer, itself first.
    std::vector<Image> images(const Vec3& x, std::size_t layer) const {
        std::vector<Image> all;
        for (const auto& [operation, to] : kept_) {
            const Vec3 at = operation(x, centre_);
            if (std::ranges::none_of(all, [&](const Image& other) {
                    return structure::distance_m(other.at, at) < same * fine_m_;
                }))
                all.push_back({at, to[layer]});
        }
        return all;
    }

  private:
    void add(const Operation& operation, const Layers& layers,
             const std::vector<PointsNear>& sets, double same_m) {
        // Two operations in turn leave the points as they are if each does.
        for (const Kept& first : kept_)
            for (const Kept& second : kept_) {
                if (second.operation.after(first.operation) != operation) continue;
                std::vector<std::size_t> to;
                for (const std::size_t layer : first.to) to.push_back(second.to[layer]);
                kept_.push_back({operation, std::move(to)});
                return;
            }
        std::vector<std::size_t> to(layers.size(), 0);
        for (std::size_t from = 0; from < layers.size(); ++from) {
            const auto lands_in = [&](const PointsNear& set) {
                return std::ranges::all_of(layers[from], [&](const Vec3& x) {
                    return set.any(operation(x, centre_), same_m);
                });
            };
            const auto found = std::ranges::find_if(sets, lands_in);
            if (found == sets.end()) return;
            to[from] = found - sets.begin();
        }
        kept_.push_back({operation, std::move(to)});
    }

    static constexpr int most_turns = 100;
    static constexpr double same = 1e-9;
    struct Kept {
        Operation operation;
        std::vector<std::size_t> to;  // layer onto which each layer falls
    };
    double fine_m_;
    Vec3 centre_;
    std::vector<Kept> kept_;  // the identity first
};

}  // namespace magfsi::bodies
