// SPDX-License-Identifier: GPL-2.0-or-later
// The bodies of the static references, the tables of these, and the shapes found.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "structure/equilibrium/newton.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"

namespace magfsi::structure::test {

inline constexpr double degree = std::numbers::pi / 180;

// Rows of a reference file: comma-separated, lines of # above, one line of column names.
using ReferenceRow = std::map<std::string, std::string>;

inline std::vector<std::string> split_at_commas(const std::string& line) {
    std::vector<std::string> out;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
    return out;
}

inline std::vector<ReferenceRow> reference_table(const std::string& file) {
    std::ifstream stream(std::string(MAGFSI_REFERENCE_FOLDER) + "/" + file);
    if (!stream) throw std::runtime_error("cannot read " + file);
    std::vector<std::string> names;
    std::vector<ReferenceRow> out;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line[0] == '#') continue;
        const auto cells = split_at_commas(line);
        if (names.empty()) {
            names = cells;
            continue;
        }
        ReferenceRow row;
        for (std::size_t i = 0; i < cells.size(); ++i) row[names.at(i)] = cells[i];
        out.push_back(row);
    }
    return out;
}

inline double number(const ReferenceRow& row, const std::string& column) {
    return std::stod(row.at(column));
}

inline Vec3 at(const MaterialPoint& point, const std::vector<Vec3>& nodes) {
    Vec3 out{};
    for (int a = 0; a < 8; ++a) out += point.weight[a] * nodes[point.node[a]];
    return out;
}

// Clamped at x = 0, Br along x, K = 20 G; M = G / (1 T), so that gamma = M B / G is the
// field along z in tesla.
inline Body cantilever(const Box& box, ElementVariant variant) {
    Body body;
    body.name = "beam";
    body.mesh = box_mesh(box);
    body.material = {330e3, 20 * 330e3, 1000};
    body.element = variant;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {330e3, 0, 0});
    return body;
}

inline std::vector<StaticLoads> rising_gamma(const std::vector<double>& gammas) {
    std::vector<StaticLoads> out;
    for (double gamma : gammas) out.push_back({{0, 0, gamma}, {}});
    return out;
}

// Displacement of the centre of the free end over the length.
inline Vec3 tip_displacement(const Body& body, const std::vector<Vec3>& nodes) {
    const MaterialPoint& tip = body.mesh.centre_line.back();
    const Vec3 before = at(tip, body.mesh.nodes);
    const Vec3 after = at(tip, nodes);
    const double length = before[0];
    return {(after[0] - before[0]) / length, (after[1] - before[1]) / length,
            (after[2] - before[2]) / length};
}

// 3.7 x 1.5 x 0.185 mm, G 33 kPa, 62 kA/m, one wavelength of phase 45 degrees.
inline constexpr double strip_length_m = 3.7e-3;
inline Body harmonic_strip(const std::array<int, 3>& elements, ElementVariant variant) {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{strip_length_m, 1.5e-3, 0.185e-3}, elements});
    body.material = {33e3, 20 * 33e3, 1860};
    body.element = variant;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, strip_length_m, 45 * degree, 0, 2});
    return body;
}

inline StaticLoads field_xz(double magnitude_t, double direction_deg) {
    return {{magnitude_t * std::cos(direction_deg * degree), 0,
             magnitude_t * std::sin(direction_deg * degree)},
            {}};
}

// Measures of the centre line of a body that bends in the x-z plane. The number of
// elements along it must be even.
struct StripShape {
    double end_to_end = 0;      // over the length
    double mid_rise = 0;        // middle over the mean of the ends, along the normal
    double total_bend_deg = 0;  // turn of the end section against the first one
    double mid_angle_deg = 0;   // of the line between 0.45 and 0.55 of the length
};

inline double slope_between(const Vec3& a, const Vec3& b) {
    return std::atan2(b[2] - a[2], b[0] - a[0]);
}

// Angle of the line at its first point, from the first three by the parabola through
// them: 3/2 of the first chord's angle less half the second's.
inline double end_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double first = slope_between(a, b);
    return first - 0.5 * std::remainder(slope_between(b, c) - first, 360 * degree);
}

inline StripShape strip_shape(const Body& body, const std::vector<Vec3>& nodes) {
    std::vector<Vec3> line;
    for (const MaterialPoint& point : body.mesh.centre_line) {
        line.push_back(at(point, nodes));
    }
    const std::size_t n = line.size() - 1;
    const Vec3& left = line.front();
    const Vec3& right = line.back();
    const double angle = slope_between(line[n / 2 - 1], line[n / 2 + 1]);
    const std::size_t part = std::max<std::size_t>(1, n / 20);
    const double rise_x = line[n / 2][0] - 0.5 * (left[0] + right[0]);
    const double rise_z = line[n / 2][2] - 0.5 * (left[2] + right[2]);
    StripShape out;
    out.end_to_end = std::hypot(right[0] - left[0], right[2] - left[2]) / strip_length_m;
    out.mid_rise =
        (-std::sin(angle) * rise_x + std::cos(angle) * rise_z) / strip_length_m;
    out.mid_angle_deg = slope_between(line[n / 2 - part], line[n / 2 + part]) / degree;
    // Summed chord by chord, so that a turn of more than 180 degrees counts in full.
    double bend = 0;
    for (std::size_t i = 2; i <= n; ++i) {
        bend += std::remainder(
            slope_between(line[i - 1], line[i]) - slope_between(line[i - 2], line[i - 1]),
            360 * degree);
    }
    bend += std::remainder(
        slope_between(line[0], line[1]) - end_angle(line[0], line[1], line[2]),
        360 * degree);
    bend += std::remainder(end_angle(line[n], line[n - 1], line[n - 2]) -
                               slope_between(line[n], line[n - 1]),
                           360 * degree);
    out.total_bend_deg = bend / degree;
    return out;
}

}  // namespace magfsi::structure::test
