// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/locate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

Vector3d mapped(const Positions8& nodes_m, const Vec3& xi) {
    const auto shape = shape_values(xi);
    return nodes_m.transpose() * Eigen::Map<const Eigen::Vector<double, 8>>(shape.data());
}

// Numbers of bins: cubes of about one element's volume. The extent of flat bodies counts
// as at least a thousandth of the longest one.
std::array<int, 3> bin_counts(const Vec3& extent_m, std::size_t elements) {
    const double longest = *std::ranges::max_element(extent_m);
    double volume = 1;
    for (const double x : extent_m) volume *= std::max(x, 1e-3 * longest);
    const double edge = std::cbrt(volume / static_cast<double>(elements));
    std::array<int, 3> counts{};
    for (int d = 0; d < 3; ++d) {
        counts[d] = std::clamp(static_cast<int>(extent_m[d] / edge), 1, 1000);
    }
    return counts;
}

// Calls visit(bin) for each bin between two corners, both included.
template <typename Visit>
void for_bins(const std::array<int, 3>& from, const std::array<int, 3>& to,
              const Visit& visit) {
    for (int k = from[2]; k <= to[2]; ++k) {
        for (int j = from[1]; j <= to[1]; ++j) {
            for (int i = from[0]; i <= to[0]; ++i) visit({i, j, k});
        }
    }
}

// The point of an element at local coordinates, which are moved to [-1, 1]^3.
MaterialPoint material_point(const Mesh& mesh, int element, Vec3 xi) {
    for (double& x : xi) x = std::clamp(x, -1.0, 1.0);
    MaterialPoint out;
    out.node = mesh.elements[element];
    out.weight = shape_values(xi);
    out.element = element;
    return out;
}

// Margin on boxes for the rounding of points on the border, whose local coordinates may
// be slightly outside.
double margin_m(const Bounds& box) {
    return 1e-9 * box.diagonal_m();
}

}  // namespace

std::optional<Vec3> inverse_map(const Positions8& nodes_m, const Vec3& point_m) {
    const Vector3d target = Vector3d(point_m.data());
    // Distance below the rounding of coordinates of the element's size and position.
    const double done_m = 1e-15 * nodes_m.cwiseAbs().maxCoeff() +
                          1e-14 * (nodes_m.row(7) - nodes_m.row(0)).norm();
    Vec3 xi{};
    Vector3d gap = target - mapped(nodes_m, xi);
    for (int step = 0; step < 50 && gap.norm() > done_m; ++step) {
        const Eigen::Matrix3d jacobian = nodes_m.transpose() * shape_gradients(xi);
        const Vector3d change = jacobian.partialPivLu().solve(gap);
        if (!change.allFinite()) return std::nullopt;
        // Far outside the trilinear map may fold: a step is no longer than an element.
        double scale = std::min(1.0, 2 / change.cwiseAbs().maxCoeff());
        bool better = false;
        for (int halving = 0; halving < 8 && !better; ++halving, scale *= 0.5) {
            Vec3 trial = xi;
            for (int d = 0; d < 3; ++d) trial[d] += scale * change[d];
            const Vector3d left = target - mapped(nodes_m, trial);
            if (left.norm() >= gap.norm()) continue;
            xi = trial;
            gap = left;
            better = true;
        }
        if (!better) break;
    }
    // Rounding can end the iteration above `done_m`; 1e-12 of the element's size still
    // counts as found.
    if (gap.norm() > 1e-12 * (nodes_m.row(7) - nodes_m.row(0)).norm() + done_m) {
        return std::nullopt;
    }
    return xi;
}

PointLocator::PointLocator(const Mesh& mesh) : mesh_(mesh) {
    if (mesh.elements.empty()) {
        refuse("a mesh without elements found, which holds no point; one is needed");
    }
    surface_ = boundary_quads(mesh);
    for (const SurfaceQuad& quad : surface_) {
        surface_boxes_.push_back(bounds(mesh.nodes, quad.node));
    }
    Bounds all;
    for (const Hexahedron& element : mesh.elements) {
        for (const int node : element) all.add(mesh.nodes[node]);
        longest_diagonal_m_ =
            std::max(longest_diagonal_m_, bounds(mesh.nodes, element).diagonal_m());
    }
    low_m_ = all.low_m;
    const Vec3 extent = all.extent_m();
    bins_ = bin_counts(extent, mesh.elements.size());
    for (int d = 0; d < 3; ++d) bin_size_m_[d] = extent[d] / bins_[d];

    // Entries are counted first and then filled in, so that elements are ascending in
    // every bin.
    const std::size_t total = bin_number({0, 0, bins_[2]});
    first_.assign(total + 1, 0);
    const auto visit_elements = [&](const auto& visit) {
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            Bounds box = bounds(mesh.nodes, mesh.elements[e]);
            const double room = margin_m(box);
            for (double& x : box.low_m) x -= room;
            for (double& x : box.high_m) x += room;
            for_bins(bin_of(box.low_m), bin_of(box.high_m),
                     [&](const std::array<int, 3>& bin) {
                         visit(bin_number(bin), static_cast<int>(e));
                     });
        }
    };
    visit_elements([&](std::size_t bin, int) { ++first_[bin + 1]; });
    for (std::size_t b = 0; b < total; ++b) first_[b + 1] += first_[b];
    entries_.resize(first_[total]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    visit_elements([&](std::size_t bin, int e) { entries_[next[bin]++] = e; });
}

std::array<int, 3> PointLocator::bin_of(const Vec3& point_m) const {
    std::array<int, 3> bin{};
    for (int d = 0; d < 3; ++d) {
        const double s = (point_m[d] - low_m_[d]) / bin_size_m_[d];
        bin[d] = static_cast<int>(std::clamp(s, 0.0, bins_[d] - 1.0));
    }
    return bin;
}

std::size_t PointLocator::bin_number(const std::array<int, 3>& bin) const {
    const std::size_t row = static_cast<std::size_t>(bins_[1]) * bin[2] + bin[1];
    return row * bins_[0] + bin[0];
}

std::optional<MaterialPoint> PointLocator::find(const Vec3& point_m,
                                                double tolerance) const {
    // The bins hold elements without the tolerance, so that all bins within reach are
    // searched.
    const double reach_m = tolerance * longest_diagonal_m_;
    Vec3 low = point_m, high = point_m;
    for (double& x : low) x -= reach_m;
    for (double& x : high) x += reach_m;
    std::optional<MaterialPoint> best;
    double least = tolerance;
    for_bins(bin_of(low), bin_of(high), [&](const std::array<int, 3>& at) {
        const std::size_t bin = bin_number(at);
        for (std::size_t i = first_[bin]; i < first_[bin + 1]; ++i) {
            const int e = entries_[i];
            const Bounds box = bounds(mesh_.nodes, mesh_.elements[e]);
            if (!box.holds(point_m, margin_m(box) + reach_m)) continue;
            const auto xi = inverse_map(gather(mesh_.nodes, mesh_.elements[e]), point_m);
            if (!xi) continue;
            // Distance outside in local coordinates; 0 on the border, up to rounding.
            double out = 0;
            for (const double x : *xi) out = std::max(out, std::abs(x) - 1);
            if (out < 1e-10) out = 0;
            const bool better = !best || out < least || e > best->element;
            if (out > least || !better) continue;
            least = out;
            best = material_point(mesh_, e, *xi);
        }
    });
    return best;
}

MaterialPoint PointLocator::nearest_on_surface(const Vec3& point_m) const {
    // Corners give a first bound, with room for the rounding of a foot that is a corner.
    double least = INFINITY;
    for (const SurfaceQuad& quad : surface_) {
        least = std::min(least, distance_m(mesh_.nodes[quad.node[0]], point_m));
    }
    least += 1e-9 * (least + longest_diagonal_m_);
    MaterialPoint best;
    for (std::size_t q = 0; q < surface_.size(); ++q) {
        // Quads at the same distance are not skipped: on a border the last element wins,
        // as in find().
        if (surface_boxes_[q].distance_m(point_m) > least) continue;
        const SurfaceQuad& quad = surface_[q];
        const Corners4 x = corners(mesh_.nodes, quad.node);
        const auto [u, v] = nearest_on_quad(x, point_m);
        const auto shape = quad_shape(u, v);
        Vec3 foot{};
        MaterialPoint trial;
        trial.element = quad.element;
        trial.node = mesh_.elements[quad.element];
        const auto local = face_corners(quad.face);
        for (int a = 0; a < 4; ++a) {
            trial.weight[local[a]] = shape[a];
            foot += shape[a] * x[a];
        }
        const double away = distance_m(foot, point_m);
        if (away > least) continue;
        least = away;
        best = trial;
    }
    return best;
}

MaterialPoint PointLocator::nearest(const Vec3& point_m) const {
    for (const double x : point_m) {
        if (!std::isfinite(x)) {
            refuse(
                "point ({}, {}, {}) m to be located in a mesh found, its coordinates "
                "must be finite",
                point_m[0], point_m[1], point_m[2]);
        }
    }
    const auto found = find(point_m);
    return found ? *found : nearest_on_surface(point_m);
}

MaterialPoint locate(const Mesh& mesh, const Vec3& point_m) {
    return PointLocator(mesh).nearest(point_m);
}

}  // namespace magfsi::structure
