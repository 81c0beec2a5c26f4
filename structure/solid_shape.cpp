// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid_shape.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/words/path_word.h"
#include "structure/mesh/mesh.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

SignedDistance of(const Ball& ball, const Vec3& point) {
    const Vec3 way = point - ball.centre_m;
    const double r = norm(way);
    if (r == 0) return {-ball.radius_m, {0, 0, 1}};
    return {r - ball.radius_m, way / r};
}

// Signed distance to the intersection of n perpendicular slabs, such as a box. out:
// distance of the point beyond each slab's faces, negative between them; outwards: the
// slab's unit normal on the point's side.
template <std::size_t n>
SignedDistance of_faces(const std::array<double, n>& out,
                        const std::array<Vec3, n>& outwards) {
    const std::size_t nearest = std::ranges::max_element(out) - out.begin();
    if (!(out[nearest] > 0)) return {out[nearest], outwards[nearest]};
    Vec3 way{};
    for (std::size_t i = 0; i < n; ++i) way += std::max(0.0, out[i]) * outwards[i];
    const double distance = norm(way);
    return {distance, way / distance};
}

Vec3 along(std::size_t axis, double side) {
    Vec3 unit{};
    unit[axis] = side < 0 ? -1 : 1;
    return unit;
}

SignedDistance of(const Rod& rod, const Vec3& point) {
    const std::size_t axis = rod.axis;
    Vec3 across = point - rod.centre_m;
    const double height = across[axis];
    across[axis] = 0;
    const double r = norm(across);
    const Vec3 radial = r > 0 ? across / r : along((axis + 1) % 3, 1);
    if (!rod.half_length_m) return {r - rod.radius_m, radial};
    return of_faces<2>({r - rod.radius_m, std::abs(height) - *rod.half_length_m},
                       {radial, along(axis, height)});
}

SignedDistance of(const Brick& brick, const Vec3& point) {
    Vec3 out{};
    std::array<Vec3, 3> outwards{};
    for (std::size_t d = 0; d < 3; ++d) {
        const double from_middle = point[d] - 0.5 * (brick.low_m[d] + brick.high_m[d]);
        out[d] = std::abs(from_middle) - 0.5 * (brick.high_m[d] - brick.low_m[d]);
        outwards[d] = along(d, from_middle);
    }
    return of_faces<3>(out, outwards);
}

// The side comes from the winding number, not from the normal of the nearest triangle,
// which is ambiguous at edges.
SignedDistance of(const Surface& surface, const Vec3& point) {
    const TriangleSurface::Nearest nearest = surface.triangles->nearest(point);
    const Vec3 way = point - nearest.at_m;
    const double distance = norm(way);
    if (distance == 0) return {0, nearest.normal};
    const double side = surface.triangles->holds(point) ? -1 : 1;
    return {side * distance, way / (side * distance)};
}

std::string words_for(const Ball& ball) {
    return fmt::format("ball {:.17g} {:.17g}", fmt::join(ball.centre_m, " "),
                       ball.radius_m);
}

std::string words_for(const Rod& rod) {
    return fmt::format("rod {:.17g} {:.17g} {} {:.17g}", fmt::join(rod.centre_m, " "),
                       rod.radius_m, "xyz"[rod.axis],
                       rod.half_length_m.value_or(INFINITY));
}

std::string words_for(const Brick& brick) {
    return fmt::format("brick {:.17g} {:.17g}", fmt::join(brick.low_m, " "),
                       fmt::join(brick.high_m, " "));
}

std::string words_for(const Surface& surface) {
    return fmt::format("surface {} {:.17g} {:.17g}", words::path_word(surface.file),
                       surface.unit_m, fmt::join(surface.shift_m, " "));
}

// The number in a word, "inf" included.
double length_from(const std::string& word) {
    std::size_t read = 0;
    double value = NAN;
    try {
        value = std::stod(word, &read);
    } catch (const std::exception&) {
        read = 0;
    }
    if (read != word.size() || std::isnan(value))
        refuse("\"{}\" found in a shape, a length in metres is needed", word);
    return value;
}

int axis_from(const std::string& word) {
    const std::string axes = "xyz";
    const auto axis = word.size() == 1 ? axes.find(word) : std::string::npos;
    if (axis == std::string::npos)
        refuse("\"{}\" found as the axis of a rod, x, y or z is allowed", word);
    return axis;
}

Bounds bounds_around(const Vec3& centre, const Vec3& half) {
    return {centre - half, centre + half};
}
// Bounding boxes, infinite along an endless rod.
Bounds bounds_of(const Ball& ball) {
    return bounds_around(ball.centre_m, {ball.radius_m, ball.radius_m, ball.radius_m});
}
Bounds bounds_of(const Rod& rod) {
    Vec3 half{rod.radius_m, rod.radius_m, rod.radius_m};
    half[rod.axis] = rod.half_length_m.value_or(INFINITY);
    return bounds_around(rod.centre_m, half);
}
Bounds bounds_of(const Brick& brick) {
    return {brick.low_m, brick.high_m};
}
Bounds bounds_of(const Surface& surface) {
    return surface.triangles->bounds();
}

}  // namespace

Surface read_surface(const std::string& file, double unit_m, const Vec3& shift_m) {
    return {file, unit_m, shift_m,
            std::make_shared<TriangleSurface>(file, unit_m, shift_m)};
}

SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m) {
    return std::visit([&](const auto& one) { return of(one, point_m); }, shape);
}

// Distance to the nearest of eight images: along each axis the one whose middle is
// nearest and the next one on the other side, as a shape without symmetry may come nearer
// there. Images whose bounding box is too far away are skipped.
SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m,
                               const Vec3& period_m) {
    if (period_m == Vec3{}) return signed_distance(shape, point_m);
    const Bounds around =
        std::visit([](const auto& one) { return bounds_of(one); }, shape);
    std::array<std::array<double, 2>, 3> at{};
    for (std::size_t d = 0; d < 3; ++d) {
        at[d] = {point_m[d], point_m[d]};
        const double middle = 0.5 * (around.low_m[d] + around.high_m[d]);
        if (period_m[d] == 0 || !std::isfinite(middle)) continue;
        const double away = point_m[d] - middle;
        const double nearest = away - period_m[d] * std::round(away / period_m[d]);
        at[d] = {middle + nearest,
                 middle + nearest - std::copysign(period_m[d], nearest)};
    }
    SignedDistance found{INFINITY, {}};
    for (unsigned i = 0; i < 8; ++i) {
        Vec3 x{};
        bool again = false;
        double outside_m2 = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t which = i >> d & 1U;
            again = again || (which == 1 && at[d][0] == at[d][1]);
            x[d] = at[d][which];
            const double outside =
                std::max({around.low_m[d] - x[d], x[d] - around.high_m[d], 0.0});
            outside_m2 += outside * outside;
        }
        if (again || std::sqrt(outside_m2) >= found.distance_m) continue;
        const SignedDistance to = signed_distance(shape, x);
        if (to.distance_m < found.distance_m) found = to;
    }
    return found;
}

std::string shape_words(const SolidShape& shape) {
    return std::visit([](const auto& one) { return words_for(one); }, shape);
}

int shape_word_count(const std::string& name) {
    return name == "ball"                     ? 5
           : name == "surface"                ? 6
           : name == "rod" || name == "brick" ? 7
                                              : 0;
}

SolidShape parse_shape(const std::vector<std::string>& words) {
    const std::string name = words.empty() ? "" : words[0];
    if (static_cast<int>(words.size()) != std::max(1, shape_word_count(name)))
        refuse(
            "a shape of {} words found; \"ball\" has 5, \"surface\" 6, \"rod\" and "
            "\"brick\" 7",
            words.size());
    const auto place = [&](std::size_t from) {
        return Vec3{length_from(words[from]), length_from(words[from + 1]),
                    length_from(words[from + 2])};
    };
    const auto size = [](double value, const char* what) {
        if (value > 0) return value;
        refuse("a shape with the {} {:g} m found, it must be above 0", what, value);
    };
    if (name == "ball") return Ball{place(1), size(length_from(words[4]), "radius")};
    if (name == "brick") {
        const Brick brick{place(1), place(4)};
        for (std::size_t d = 0; d < 3; ++d)
            size(brick.high_m[d] - brick.low_m[d], "edge");
        return brick;
    }
    if (name == "surface")
        return read_surface(words::path_of_word(words[1]),
                            size(length_from(words[2]), "unit"), place(3));
    if (name != "rod")
        refuse("\"{}\" found; shapes are ball, rod, brick and surface", name);
    Rod rod{place(1), size(length_from(words[4]), "radius"), axis_from(words[5]), {}};
    const double half = size(length_from(words[6]), "half length");
    if (std::isfinite(half)) rod.half_length_m = half;
    return rod;
}

}  // namespace magfsi::structure
