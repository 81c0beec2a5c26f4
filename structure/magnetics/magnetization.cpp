// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/magnetization.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/mesh/region.h"
#include "structure/refuse.h"
#include "structure/table_file.h"

namespace magfsi::structure {
namespace {

void check(const HarmonicMagnetization& profile) {
    const bool axes = profile.along >= 0 && profile.along <= 2 && profile.into >= 0 &&
                      profile.into <= 2 && profile.along != profile.into;
    if (!(profile.wavelength_m > 0) || !axes) {
        refuse(
            "harmonic magnetisation with wavelength {:g} m and axes {} and {} found; the "
            "wavelength must be positive and the axes two different ones of 0, 1, 2",
            profile.wavelength_m, profile.along, profile.into);
    }
}

constexpr std::array<ColumnKind, 6> table_columns{{{"x", units::length},
                                                   {"y", units::length},
                                                   {"z", units::length},
                                                   {"Mx", units::magnetization},
                                                   {"My", units::magnetization},
                                                   {"Mz", units::magnetization}}};

double squared_distance(const Vec3& a, const Vec3& b) {
    return dot(a - b, a - b);
}

// Nearest of many points. They are sorted by x; the search runs outwards from the given x
// and stops where the difference in x alone exceeds the best distance.
class NearestRow {
  public:
    explicit NearestRow(const std::vector<Vec3>& points_m) : points_m_(points_m) {
        for (std::size_t r = 0; r < points_m.size(); ++r) by_x_.push_back(r);
        std::ranges::stable_sort(by_x_, {}, [&](std::size_t r) { return x_of(r); });
    }

    std::size_t operator()(const Vec3& point) const {
        auto up = std::ranges::lower_bound(by_x_, point[0], {},
                                           [&](std::size_t r) { return x_of(r); });
        auto down = up;
        std::size_t best = by_x_.front();
        double least = INFINITY;
        const auto gap = [&](std::size_t r) {
            return (x_of(r) - point[0]) * (x_of(r) - point[0]);
        };
        const auto try_row = [&](std::size_t r) {
            const double away = squared_distance(points_m_[r], point);
            if (away < least || (away == least && r < best)) {
                least = away;
                best = r;
            }
        };
        for (; up != by_x_.end() && gap(*up) <= least; ++up) try_row(*up);
        while (down != by_x_.begin() && gap(*std::prev(down)) <= least) try_row(*--down);
        return best;
    }

  private:
    double x_of(std::size_t row) const { return points_m_[row][0]; }

    const std::vector<Vec3>& points_m_;
    std::vector<std::size_t> by_x_;
};

// The vector of the nearest row for each element.
std::vector<Vec3> nearest_vectors(const Mesh& mesh, const MagnetizationRows& rows,
                                  const std::filesystem::path& file) {
    const NearestRow nearest(rows.point_m);
    const double far_m = 0.5 * bounds(mesh.nodes).diagonal_m();
    std::vector<Vec3> out;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const Vec3 centre = element_centre(mesh, e);
        const std::size_t row = nearest(centre);
        const double away = std::sqrt(squared_distance(rows.point_m[row], centre));
        if (away > far_m) {
            refuse(
                "magnetisation table {}: its point nearest to element {} with the centre "
                "({:.6g}, {:.6g}, {:.6g}) m is {:.3g} m away, at most {:.3g} m, half the "
                "body's diagonal, is allowed; see that unit and frame are the body's",
                file.string(), e, centre[0], centre[1], centre[2], away, far_m);
        }
        out.push_back(rows.vector_a_m[row]);
    }
    return out;
}

}  // namespace

std::vector<Vec3> uniform_magnetization(const Mesh& mesh, const Vec3& vector_a_m) {
    return std::vector<Vec3>(mesh.elements.size(), vector_a_m);
}

std::vector<Vec3> harmonic_magnetization(const Mesh& mesh,
                                         const HarmonicMagnetization& profile) {
    check(profile);
    double left_end = INFINITY;
    for (const Vec3& node : mesh.nodes)
        left_end = std::min(left_end, node[profile.along]);
    std::vector<Vec3> out(mesh.elements.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        const double s = element_centre(mesh, e)[profile.along] - left_end;
        const double angle =
            2 * std::numbers::pi * s / profile.wavelength_m + profile.phase_rad;
        out[e][profile.along] = profile.amplitude_a_m * std::cos(angle);
        out[e][profile.into] = profile.amplitude_a_m * std::sin(angle);
    }
    return out;
}

namespace {

Eigen::Vector3d to_eigen(const Vec3& x) {
    return Eigen::Vector3d(x[0], x[1], x[2]);
}

// Curve through given points. The tangent at a point is the mean of those of the two
// pieces; at an open end it is extrapolated linearly from the last piece, which is exact
// for circles with evenly spaced points.
class Curve {
  public:
    explicit Curve(const std::vector<Vec3>& points_m) {
        for (const Vec3& x : points_m) points_.push_back(to_eigen(x));
        std::vector<Eigen::Vector3d> along;
        for (std::size_t i = 1; i < points_.size(); ++i) {
            const Eigen::Vector3d piece = points_[i] - points_[i - 1];
            if (!(piece.norm() > 0))
                refuse(
                    "points {} and {} of the curve coincide; each piece of it needs a "
                    "length",
                    i, i + 1);
            along.push_back(piece.normalized());
            lengths_m_.push_back(piece.norm());
        }
        const auto last = along.size() - 1;
        const bool closed =
            (points_.front() - points_.back()).norm() < 1e-9 * lengths_m_.front();
        tangents_.push_back(closed ? (along[last] + along[0]).normalized() : along[0]);
        for (std::size_t i = 1; i <= last; ++i)
            tangents_.push_back((along[i - 1] + along[i]).normalized());
        tangents_.push_back(closed ? tangents_[0] : along[last]);
        if (!closed && last > 0) {
            tangents_[0] = 2 * along[0] - tangents_[1];
            tangents_[last + 1] = 2 * along[last] - tangents_[last];
        }
    }

    // Arc length from the first point and unit tangent.
    struct Place {
        double s_m;
        Eigen::Vector3d tangent;
    };
    // The place on the polygon nearest to x.
    Place nearest(const Eigen::Vector3d& x) const {
        Place best{};
        double least = INFINITY, s_m = 0;
        for (std::size_t i = 0; i < lengths_m_.size(); ++i) {
            const Eigen::Vector3d piece = points_[i + 1] - points_[i];
            const double share =
                std::clamp((x - points_[i]).dot(piece) / piece.squaredNorm(), 0.0, 1.0);
            const double away = (points_[i] + share * piece - x).squaredNorm();
            if (away < least) {
                least = away;
                best = {
                    s_m + share * lengths_m_[i],
                    ((1 - share) * tangents_[i] + share * tangents_[i + 1]).normalized()};
            }
            s_m += lengths_m_[i];
        }
        return best;
    }

  private:
    std::vector<Eigen::Vector3d> points_, tangents_;  // tangents_: at the points
    std::vector<double> lengths_m_;                   // one per piece
};

}  // namespace

std::vector<Vec3> curve_magnetization(const Mesh& mesh,
                                      const CurveMagnetization& wanted) {
    std::vector<Vec3> points_m = wanted.points_m;
    if (points_m.empty())
        for (const MaterialPoint& p : mesh.centre_line)
            points_m.push_back(position(mesh, p));
    if (points_m.size() < 2)
        refuse(
            "magnetisation along the centre line of a mesh without one found; give "
            "points of the curve, or a centre line in the Gmsh file");
    const Curve curve(points_m);
    const std::size_t first = wanted.plane[0];
    const std::size_t second = wanted.plane[1];
    std::vector<Vec3> out;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const auto [s_m, tangent] = curve.nearest(to_eigen(element_centre(mesh, e)));
        const double wave = wanted.wavelength_m > 0
                                ? 2 * std::numbers::pi * s_m / wanted.wavelength_m
                                : 0;
        const double angle = wanted.phase_rad + wave;
        const double a = tangent[wanted.plane[0]], b = tangent[wanted.plane[1]];
        Vec3 m{tangent[0], tangent[1], tangent[2]};
        m[first] = a * std::cos(angle) - b * std::sin(angle);
        m[second] = a * std::sin(angle) + b * std::cos(angle);
        out.push_back(m * wanted.strength_a_m);
    }
    return out;
}

std::vector<Vec3> radial_magnetization(const Mesh& mesh,
                                       const RadialMagnetization& wanted) {
    Eigen::Vector3d axis = to_eigen(wanted.axis.value_or(Vec3{}));
    if (wanted.axis && !(axis.norm() > 0))
        refuse(
            "a radial magnetisation about an axis of length 0 found; any other is "
            "allowed");
    if (wanted.axis) axis.normalize();
    const double tiny_m = 1e-9 * bounds(mesh.nodes).diagonal_m();
    std::vector<Vec3> out;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        Eigen::Vector3d away =
            to_eigen(element_centre(mesh, e)) - to_eigen(wanted.centre_m);
        away -= away.dot(axis) * axis;
        if (!(away.norm() > tiny_m))
            refuse(
                "element {} has its middle on the centre of a radial magnetisation, "
                "where it has no direction; take an even number of elements across it, "
                "or move the centre",
                e);
        away *= wanted.strength_a_m / away.norm();
        out.push_back({away[0], away[1], away[2]});
    }
    return out;
}

std::vector<Vec3> domain_magnetization(const Mesh& mesh,
                                       std::span<const MagneticDomain> domains) {
    std::vector<Vec3> out(mesh.elements.size());
    std::vector<bool> used(domains.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        const Vec3 centre = element_centre(mesh, e);
        const auto owner = std::ranges::find_if(
            domains,
            [&](const MagneticDomain& domain) { return holds(domain.shape, centre); });
        if (owner == domains.end()) continue;
        out[e] = owner->vector_a_m;
        used[owner - domains.begin()] = true;
    }
    const auto empty = std::ranges::find(used, false);
    if (empty != used.end())
        refuse(
            "domains[{}] of the magnetisation found, which holds the centre of no "
            "element "
            "that no domain before it holds; shapes are in the body's own frame",
            empty - used.begin());
    return out;
}

std::vector<Vec3> region_magnetization(const Mesh& mesh,
                                       const std::map<std::string, Vec3>& vector_a_m) {
    if (mesh.region_names.empty()) {
        refuse(
            "a magnetisation by region found for a mesh without regions; name them by "
            "shapes (regions), or volumes in Gmsh (physical groups)");
    }
    const auto& names = mesh.region_names;
    for (const auto& [name, unused] : vector_a_m) {
        if (std::ranges::find(names, name) != names.end()) continue;
        refuse("magnetisation of the region \"{}\" found; the mesh has {}", name,
               fmt::join(names, ", "));
    }
    for (const std::string& name : names) {
        if (vector_a_m.contains(name)) continue;
        refuse("no magnetisation of the region \"{}\" found; each of {} needs one", name,
               fmt::join(names, ", "));
    }
    std::vector<Vec3> out(mesh.elements.size());
    for (std::size_t e = 0; e < out.size(); ++e) {
        out[e] = vector_a_m.at(names[mesh.region[e]]);
    }
    return out;
}

MagnetizationRows read_magnetization(const std::filesystem::path& file) {
    const auto values =
        read_table("magnetisation table", file, table_columns, {"Mx", "My", "Mz"});
    MagnetizationRows out;
    for (std::size_t r = 0; r < values[3].size(); ++r) {
        out.vector_a_m.push_back({values[3][r], values[4][r], values[5][r]});
        if (!values[0].empty())
            out.point_m.push_back({values[0][r], values[1][r], values[2][r]});
    }
    return out;
}

std::vector<Vec3> table_magnetization(const Mesh& mesh,
                                      const std::filesystem::path& file) {
    MagnetizationRows rows = read_magnetization(file);
    if (!rows.point_m.empty()) return nearest_vectors(mesh, rows, file);
    if (rows.vector_a_m.size() != mesh.elements.size()) {
        refuse(
            "magnetisation table {}: {} rows found for {} elements; without the columns "
            "x, y, z one row per element is needed",
            file.string(), rows.vector_a_m.size(), mesh.elements.size());
    }
    return std::move(rows.vector_a_m);
}

}  // namespace magfsi::structure
