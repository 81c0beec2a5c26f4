// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/thinned_markers.h"

#include <algorithm>
#include <cmath>

#include "adapters/solvers/bodies/marker_surface.h"
#include "adapters/solvers/bodies/symmetry_of_points.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {
namespace {

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

    // Picked points by their numbers, each with all its images.
    struct Picked {
        std::vector<std::size_t> points;
        std::vector<PointsNear> taken;  // by layer
    };

    Picked none() const {
        return {{}, std::vector<PointsNear>(layers_.size(), PointsNear(apart_m_))};
    }
    std::size_t size() const { return points_.size(); }

    // Picks in turn those of `count` points from the number `first` on that are apart_m
    // from all picked before. It begins with the one that has the number `begin`.
    void pick(Picked& picked, std::size_t first, std::size_t count,
              std::size_t begin) const {
        for (std::size_t n = 0; n < count; ++n) {
            const std::size_t number = first + (begin - first + n) % count;
            if (!free(picked, number)) continue;
            take(picked, number);
            picked.points.push_back(number);
        }
    }

    // The same with the beginning that leaves the smallest gaps: a row of picked points
    // closes differently when it begins elsewhere. Up to 16 are tried, fewer in large
    // bodies, where a row has many points.
    Picked picked_evenly(const Picked& before, std::size_t first,
                         std::size_t count) const {
        if (count == 0) return before;
        const std::size_t beginnings = std::clamp<std::size_t>(
            most_tried / count, 1, std::min<std::size_t>(16, count));
        Picked best = before;
        double least_m2 = INFINITY;
        for (std::size_t i = 0; i < beginnings; ++i) {
            Picked picked = before;
            pick(picked, first, count, first + i * count / beginnings);
            const double gaps = gaps_m2(picked, first, count);
            if (gaps >= least_m2) continue;
            least_m2 = gaps;
            best = std::move(picked);
        }
        return best;
    }

    // Moves all picked points, a few times and as far as they stay apart_m from each
    // other, to the middle of those of the first `count` points that are nearest to them
    // (Lloyd's algorithm).
    void even_out(Picked& picked, std::size_t count) const {
        constexpr int turns = 20;
        std::vector<Vec3> at;
        for (const Point& point : std::span(points_).first(count))
            at.push_back(point.images[0].at);
        for (int turn = 0; turn < turns; ++turn) {
            const auto cells = cells_of(picked, at);
            bool moved = false;
            for (std::size_t i = 0; i < picked.points.size(); ++i) {
                const std::size_t to =
                    moved_to_middle(picked, picked.points[i], cells[i], at);
                moved = moved || to != picked.points[i];
                picked.points[i] = to;
            }
            if (!moved) return;
        }
    }

    // Markers at these places, by layer, with their share of the layer's volume.
    std::vector<PlacedMarker> markers(const Picked& picked) const {
        const structure::PointLocator locator(mesh_);
        std::vector<PlacedMarker> all;
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            std::vector<PlacedMarker> kept;
            for (const std::size_t number : picked.points)
                for (const Symmetry::Image& image : points_[number].images) {
                    if (image.layer != i) continue;
                    kept.push_back(
                        layers_[points_[number].layer][points_[number].number]);
                    kept.back().point = locator.nearest(image.at);
                }
            share_volume(kept, mesh_, layers_[i], apart_m_);
            all.insert(all.end(), kept.begin(), kept.end());
        }
        return all;
    }

  private:
    // Points that are looked at for the best of several beginnings.
    static constexpr std::size_t most_tried = 400000;

    // Mean square of the distance of these points to the nearest picked one.
    double gaps_m2(const Picked& picked, std::size_t first, std::size_t count) const {
        double sum_m2 = 0;
        for (const Point& point : std::span(points_).subspan(first, count)) {
            const PointsNear& taken = picked.taken[point.layer];
            const Vec3& at = point.images[0].at;
            double gap_m = taken.nearest_m(at, apart_m_);
            if (!(gap_m < apart_m_)) gap_m = taken.nearest_m(at, 2 * apart_m_);
            sum_m2 += gap_m * gap_m;
        }
        return sum_m2 / static_cast<double>(count);
    }

    // By picked point: the numbers of the places that are nearest to it, and to how many
    // others alike.
    struct Near {
        std::size_t number, alike;
    };
    std::vector<std::vector<Near>> cells_of(const Picked& picked,
                                            std::span<const Vec3> at) const {
        const structure::PointLocator locator(mesh_);
        std::vector<PlacedMarker> markers;
        std::vector<std::size_t> owner;  // picked.points.size() of an image
        for (std::size_t i = 0; i < picked.points.size(); ++i)
            for (const Symmetry::Image& image : points_[picked.points[i]].images) {
                const bool itself = &image == points_[picked.points[i]].images.data();
                owner.push_back(itself ? i : picked.points.size());
                markers.push_back({locator.nearest(image.at), 0});
            }
        std::vector<std::vector<Near>> cells(picked.points.size() + 1);
        const auto nearest = nearest_markers(markers, mesh_, at, apart_m_);
        for (std::size_t n = 0; n < at.size(); ++n)
            for (const std::size_t marker : nearest[n])
                cells[owner[marker]].push_back({n, nearest[n].size()});
        return cells;
    }

    // The place of its cell that is nearest to the middle of the cell and free, with as
    // many images; takes it instead of the one before.
    std::size_t moved_to_middle(Picked& picked, std::size_t number,
                                std::span<const Near> cell,
                                std::span<const Vec3> at) const {
        Vec3 sum{};
        double weight = 0;
        for (const auto& [n, alike] : cell) {
            sum += (1.0 / alike) * at[n];
            weight += 1.0 / alike;
        }
        if (weight == 0) return number;
        const Vec3 middle = sum / weight;
        for (const Symmetry::Image& image : points_[number].images)
            picked.taken[image.layer].remove(image.at);
        std::size_t best = number;
        double nearest_m = structure::distance_m(points_[number].images[0].at, middle);
        for (const auto& [n, alike] : cell) {
            const double distance_m = structure::distance_m(at[n], middle);
            if (distance_m >= nearest_m - 1e-9 * apart_m_ ||
                points_[n].images.size() != points_[number].images.size() ||
                !free(picked, n))
                continue;
            best = n;
            nearest_m = distance_m;
        }
        take(picked, best);
        return best;
    }

    struct Point {
        std::size_t layer, number;
        std::vector<Symmetry::Image> images;  // the point itself first
    };
    // Points of a regular mesh are often apart_m from each other but for rounding.
    double least_m() const { return (1 - 1e-9) * apart_m_; }

    bool free(const Picked& picked, std::size_t number) const {
        const Point& point = points_[number];
        return apart(point.images) &&
               !picked.taken[point.layer].any(point.images[0].at, least_m());
    }
    void take(Picked& picked, std::size_t number) const {
        for (const Symmetry::Image& image : points_[number].images)
            picked.taken[image.layer].add(image.at);
    }

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
    auto of_shell = points.picked_evenly(points.none(), 0, shell.size());
    points.even_out(of_shell, shell.size());
    return points.markers(points.picked_evenly(of_shell, shell.size(), inside.size()));
}

}  // namespace magfsi::bodies
