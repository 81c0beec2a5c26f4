// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/thinned_markers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>

#include "adapters/solvers/bodies/marker_surface.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {
namespace {

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
};

// The 48 operations of a cube; the first leaves everything as it is.
std::vector<Operation> of_cube() {
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
        // Of all operations of a cube those about z are enough: with 48 images of a point
        // the markers of a ball six cells across are two or three points, whose places in
        // the grid change its drag by 3 %.
        if (kept_.size() == 48)
            std::erase_if(kept_,
                          [](const Kept& kept) { return kept.operation.axis[2] != 2; });
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

// Dense points that are to be thinned out, with their images.
class ThinnedPoints {
  public:
    ThinnedPoints(std::span<const std::vector<PlacedMarker>> layers,
                  const structure::Mesh& mesh, double apart_m, double fine_m)
        : layers_(layers), mesh_(mesh), apart_m_(apart_m) {
        Layers places(layers.size());
        for (std::size_t i = 0; i < layers.size(); ++i)
            for (const PlacedMarker& p : layers[i])
                places[i].push_back(structure::position(mesh, p.point));
        const Symmetry symmetry(places, fine_m);
        for (std::size_t i = 0; i < layers.size(); ++i)
            for (std::size_t p = 0; p < layers[i].size(); ++p)
                points_.push_back(
                    {i, p, symmetry.images(symmetry.fixed(places[i][p]), i)});
    }

    // A picked point, or an image of one.
    struct Pick {
        std::size_t layer, point;  // the dense point, by its number in its layer
        Symmetry::Image image;
    };
    struct Picked {
        std::vector<Pick> all;
        std::vector<PointsNear> taken;  // by layer
    };

    Picked none() const {
        return {{}, std::vector<PointsNear>(layers_.size(), PointsNear(apart_m_))};
    }
    std::size_t size() const { return points_.size(); }

    // Picks in turn those of `count` points from the number `first` on that are apart_m
    // from all picked before; the first to come is the one with the number `begin`.
    void pick(Picked& picked, std::size_t first, std::size_t count,
              std::size_t begin) const {
        for (std::size_t n = 0; n < count; ++n) {
            const Point& point = points_[first + (begin - first + n) % count];
            const Vec3& at = point.images[0].at;
            if (!apart(point.images) || picked.taken[point.layer].any(at, least_m()))
                continue;
            for (const Symmetry::Image& image : point.images) {
                picked.taken[image.layer].add(image.at);
                picked.all.push_back({point.layer, point.number, image});
            }
        }
    }

    // The same with the beginning that leaves the smallest gaps, of 16: a row of picked
    // points closes differently when it begins elsewhere.
    Picked picked_evenly(const Picked& before, std::size_t first,
                         std::size_t count) const {
        constexpr std::size_t beginnings = 16;
        Picked best = before;
        double least_m2 = INFINITY;
        for (std::size_t i = 0; i < std::min(beginnings, count); ++i) {
            Picked picked = before;
            pick(picked, first, count, first + i * count / beginnings);
            const double gaps = gaps_m2(picked, first, count);
            if (gaps >= least_m2) continue;
            least_m2 = gaps;
            best = std::move(picked);
        }
        return best;
    }

    // Markers at these places, by layer, with their share of the layer's volume.
    std::vector<PlacedMarker> markers(const Picked& picked) const {
        const structure::PointLocator locator(mesh_);
        std::vector<PlacedMarker> all;
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            std::vector<PlacedMarker> kept;
            for (const Pick& p : picked.all) {
                if (p.image.layer != i) continue;
                kept.push_back(layers_[p.layer][p.point]);
                kept.back().point = locator.nearest(p.image.at);
            }
            share_volume(kept, mesh_, layers_[i], apart_m_);
            all.insert(all.end(), kept.begin(), kept.end());
        }
        return all;
    }

  private:
    // Mean square of the distance of these points to the nearest picked one.
    double gaps_m2(const Picked& picked, std::size_t first, std::size_t count) const {
        double sum_m2 = 0;
        for (const Point& point : std::span(points_).subspan(first, count))
            sum_m2 += std::pow(
                picked.taken[point.layer].nearest_m(point.images[0].at, 2 * apart_m_), 2);
        return sum_m2 / static_cast<double>(count);
    }

    struct Point {
        std::size_t layer, number;
        std::vector<Symmetry::Image> images;  // the point itself first
    };
    // Points of a regular mesh are often apart_m from each other but for rounding.
    double least_m() const { return (1 - 1e-9) * apart_m_; }

    bool apart(std::span<const Symmetry::Image> images) const {
        return std::ranges::all_of(images.subspan(1), [&](const Symmetry::Image& image) {
            return image.layer != images[0].layer ||
                   structure::distance_m(image.at, images[0].at) >= least_m();
        });
    }

    std::span<const std::vector<PlacedMarker>> layers_;
    const structure::Mesh& mesh_;
    double apart_m_;
    std::vector<Point> points_;
};

}  // namespace

void share_volume(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                  std::span<const PlacedMarker> points, double apart_m) {
    std::vector<Vec3> at;
    for (const PlacedMarker& p : points) at.push_back(structure::position(mesh, p.point));
    const auto nearest = nearest_markers(markers, mesh, at, apart_m);
    for (PlacedMarker& marker : markers) marker.volume_m3 = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const std::size_t marker : nearest[i])
            markers[marker].volume_m3 += points[i].volume_m3 / nearest[i].size();
}

void begin_along(std::vector<PlacedMarker>& points, const structure::Mesh& mesh,
                 std::span<const structure::SurfaceQuad> surface, double depth_m,
                 double fine_m) {
    std::vector<structure::MaterialPoint> at;
    for (const PlacedMarker& p : points) at.push_back(p.point);
    const auto depth = structure::depths(mesh, surface, at, 0.5 * fine_m, 2 * depth_m);
    std::vector<PlacedMarker> row, inside;
    for (std::size_t i = 0; i < points.size(); ++i)
        (depth[i] < depth_m ? row : inside).push_back(points[i]);
    for (std::size_t i = 1; i < row.size(); ++i) {
        const Vec3 last = structure::position(mesh, row[i - 1].point);
        const auto from_last = [&](const PlacedMarker& p) {
            return structure::distance_m(structure::position(mesh, p.point), last);
        };
        const auto next = row.begin() + static_cast<std::ptrdiff_t>(i);
        std::iter_swap(next, std::ranges::min_element(next, row.end(), {}, from_last));
    }
    row.insert(row.end(), inside.begin(), inside.end());
    points = std::move(row);
}

std::vector<PlacedMarker> thinned(std::span<const std::vector<PlacedMarker>> layers,
                                  const structure::Mesh& mesh, double apart_m,
                                  double fine_m) {
    const ThinnedPoints points(layers, mesh, apart_m, fine_m);
    auto picked = points.none();
    points.pick(picked, 0, points.size(), 0);
    return points.markers(picked);
}

std::vector<PlacedMarker> thinned_shell(const std::vector<PlacedMarker>& shell,
                                        const std::vector<PlacedMarker>& inside,
                                        const structure::Mesh& mesh, double apart_m,
                                        double fine_m) {
    std::vector<std::vector<PlacedMarker>> all{shell};
    all[0].insert(all[0].end(), inside.begin(), inside.end());
    const ThinnedPoints points(all, mesh, apart_m, fine_m);
    const auto of_shell = points.picked_evenly(points.none(), 0, shell.size());
    return points.markers(points.picked_evenly(of_shell, shell.size(), inside.size()));
}

}  // namespace magfsi::bodies
