// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/grid_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structure/refuse.h"
#include "structure/table_file.h"

namespace magfsi::structure {
namespace {

using point_fields::Gradient;

constexpr ColumnKind columns[] = {
    {"x", units::length},        {"y", units::length},
    {"z", units::length},        {"Bx", units::flux_density},
    {"By", units::flux_density}, {"Bz", units::flux_density}};

// Coordinates are the same if they differ by less than this share of the extent; files
// round.
constexpr double same = 1e-6;

// The different coordinates, ascending.
std::vector<double> places(std::vector<double> all) {
    std::ranges::sort(all);
    const double extent = all.back() - all.front();
    std::vector<double> out;
    for (const double x : all) {
        if (out.empty() || x - out.back() > same * extent) out.push_back(x);
    }
    return out;
}

double spacing(const std::vector<double>& axis) {
    return (axis.back() - axis.front()) / static_cast<double>(axis.size() - 1);
}

std::size_t place_of(double x, const std::vector<double>& axis) {
    return std::llround((x - axis.front()) / spacing(axis));
}

// Interpolation along one axis: Lagrange's polynomials through the four points from
// `first` on, or through all points of a shorter axis.
struct Stencil {
    std::size_t first = 0, count = 0;
    // Weight of each point, and its derivative by the coordinate
    std::array<double, 4> weight{}, slope{};
};

Stencil stencil(double x, const std::vector<double>& axis) {
    const double h = spacing(axis);
    const double place = (x - axis.front()) / h;
    const double last = axis.size() - 1;
    Stencil out;
    out.count = std::min<std::size_t>(4, axis.size());
    const double most = last - static_cast<double>(out.count - 1);
    const double first =
        std::clamp(std::floor(place) - static_cast<double>(out.count / 2 - 1), 0.0, most);
    out.first = first;
    const double s = place - first;
    for (std::size_t i = 0; i < out.count; ++i) {
        double weight = 1, slope = 0;
        for (std::size_t j = 0; j < out.count; ++j) {
            if (j == i) continue;
            const double way = static_cast<double>(i) - static_cast<double>(j);
            slope = (slope * (s - static_cast<double>(j)) + weight) / way;
            weight *= (s - static_cast<double>(j)) / way;
        }
        out.weight[i] = weight;
        out.slope[i] = slope / h;
    }
    return out;
}

void check_axis(const std::vector<double>& axis, char name,
                const std::filesystem::path& file) {
    if (axis.size() < 2) {
        refuse("field grid {}: one place along {} found, two or more are needed",
               file.string(), name);
    }
    const double h = spacing(axis);
    for (std::size_t i = 0; i < axis.size(); ++i) {
        if (std::abs(axis[i] - axis.front() - h * static_cast<double>(i)) <= 1e-3 * h)
            continue;
        refuse(
            "field grid {}: {} places along {} from {:g} to {:g} m found that are not "
            "evenly spaced ({:g} m is none of an even row); export a regular grid",
            file.string(), axis.size(), name, axis.front(), axis.back(), axis[i]);
    }
}

}  // namespace

GridValues::GridValues(std::array<std::vector<double>, 3> axes_m,
                       std::vector<Vec3> values_t)
    : axes_m_(std::move(axes_m)), values_t_(std::move(values_t)) {}

point_fields::Field<Gradient> GridValues::at(
    const point_fields::Point<Gradient>& x) const {
    std::array<Stencil, 3> along;
    for (std::size_t d = 0; d < 3; ++d) {
        const auto& axis = axes_m_[d];
        const double slack = 1e-9 * (axis.back() - axis.front());
        if (x[d].value < axis.front() - slack || x[d].value > axis.back() + slack) {
            throw std::runtime_error(fmt::format(
                "a body has left the grid of the field: it is at {} = {:.6g} m of the "
                "grid, which reaches from {:g} to {:g} m; take a larger grid, hold the "
                "body inside, or see that the grid's lengths are in the right unit",
                "xyz"[d], x[d].value, axis.front(), axis.back()));
        }
        along[d] = stencil(x[d].value, axis);
    }
    point_fields::Field<Gradient> out{};
    const auto& [sx, sy, sz] = along;
    for (std::size_t k = 0; k < sz.count; ++k) {
        for (std::size_t j = 0; j < sy.count; ++j) {
            const std::size_t row =
                axes_m_[0].size() * (sy.first + j + axes_m_[1].size() * (sz.first + k));
            for (std::size_t i = 0; i < sx.count; ++i) {
                const Vec3& value = values_t_[row + sx.first + i];
                const double weight = sx.weight[i] * sy.weight[j] * sz.weight[k];
                const Vec3 slope{sx.slope[i] * sy.weight[j] * sz.weight[k],
                                 sx.weight[i] * sy.slope[j] * sz.weight[k],
                                 sx.weight[i] * sy.weight[j] * sz.slope[k]};
                for (std::size_t c = 0; c < 3; ++c) {
                    out[c].value += weight * value[c];
                    out[c].d += slope * value[c];
                }
            }
        }
    }
    return out;
}

GridValues read_grid(const std::filesystem::path& file) {
    const auto values =
        read_table("field grid", file, columns, {"x", "y", "z", "Bx", "By", "Bz"},
                   TableStyle::exported);
    std::array<std::vector<double>, 3> axes;
    for (std::size_t d = 0; d < 3; ++d) {
        axes[d] = places(values[d]);
        check_axis(axes[d], "xyz"[d], file);
    }
    const std::size_t points = axes[0].size() * axes[1].size() * axes[2].size();
    if (values[0].size() != points) {
        refuse(
            "field grid {}: {} rows found for a grid of {} x {} x {} points; it needs "
            "one row for each point",
            file.string(), values[0].size(), axes[0].size(), axes[1].size(),
            axes[2].size());
    }
    std::vector<Vec3> field(points);
    std::vector<bool> there(points);
    for (std::size_t r = 0; r < points; ++r) {
        const std::size_t at =
            place_of(values[0][r], axes[0]) +
            axes[0].size() * (place_of(values[1][r], axes[1]) +
                              axes[1].size() * place_of(values[2][r], axes[2]));
        if (there[at]) {
            refuse(
                "field grid {}: the point ({:g}, {:g}, {:g}) m found twice, each is "
                "needed once",
                file.string(), values[0][r], values[1][r], values[2][r]);
        }
        there[at] = true;
        field[at] = {values[3][r], values[4][r], values[5][r]};
    }
    return {std::move(axes), std::move(field)};
}

}  // namespace magfsi::structure
