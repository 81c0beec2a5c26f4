// SPDX-License-Identifier: GPL-2.0-or-later
// Helices of round wire, with or without a head.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/round_grid.h"
#include "structure/mesh/round_mesh.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

// The middle line of a wire, with its direction, its radius and the unit vector towards
// the first side of its sections.
struct WirePlace {
    Vector3d middle, tangent, side;
    double radius_m = 0;
};

// Smooth step from 0 to 1 with its slope 0 at both ends.
double eased(double share) {
    return 0.5 * (1 - std::cos(std::numbers::pi * std::clamp(share, 0.0, 1.0)));
}

// The middle line by an angle: wound up to wound_, in the next turn coming to the axis,
// then straight. The wire grows to the head in the last quarter of that turn and the half
// that follows, where the line is hardly bent.
class WireLine {
  public:
    explicit WireLine(const WireMesh& wire)
        : wire_(wire),
          climb_m_(wire.pitch_m / (2 * std::numbers::pi)),
          wound_(2 * std::numbers::pi * wire.turns),
          end_(wound_ +
               (wire.head ? 3 * std::numbers::pi + wire.head->length_m / climb_m_ : 0)) {}

    double end() const { return end_; }
    // Volume of the wire: its sections have their centres on the line.
    double volume_m3() const {
        constexpr int parts = 20000;
        double sum = 0;
        for (int i = 0; i < parts; ++i) {
            const double r = radius_m(end_ * (i + 0.5) / parts);
            sum += std::numbers::pi * r * r *
                   (at(end_ * (i + 1) / parts) - at(end_ * i / parts)).norm();
        }
        return sum;
    }
    double radius_m(double t) const {
        const double thin = 0.5 * wire_.diameter_m;
        if (!wire_.head) return thin;
        const double grown =
            eased((t - wound_ - 1.5 * std::numbers::pi) / (1.5 * std::numbers::pi));
        return thin + (0.5 * wire_.head->diameter_m - thin) * grown;
    }
    Vector3d at(double t) const {
        const double inwards =
            wire_.head ? eased((t - wound_) / (2 * std::numbers::pi)) : 0;
        const double r = wire_.radius_m * (1 - inwards);
        const double hand = wire_.left_handed ? -1 : 1;
        return {climb_m_ * t, r * std::cos(t), hand * r * std::sin(t)};
    }
    Vector3d tangent(double t) const {
        const double h = 1e-5;
        return (at(t + h) - at(t - h)).normalized();
    }

  private:
    const WireMesh& wire_;
    double climb_m_, wound_, end_;
};

// Sections along the line at equal arc lengths, turned from one to the next without twist
// about the line (the double reflection of Wang et al. 2008).
std::vector<WirePlace> sections(const WireLine& line, int along) {
    constexpr int fine = 64;  // parts of an element for the arc length
    const int parts = fine * along;
    std::vector<double> length{0};
    for (int i = 0; i < parts; ++i)
        length.push_back(length.back() + (line.at(line.end() * (i + 1) / parts) -
                                          line.at(line.end() * i / parts))
                                             .norm());
    std::vector<WirePlace> out;
    std::size_t i = 0;
    for (int s = 0; s <= along; ++s) {
        const double wanted = length.back() * s / along;
        while (i + 2 < length.size() && length[i + 1] < wanted) ++i;
        const double part = (wanted - length[i]) / (length[i + 1] - length[i]);
        const double t = line.end() * (static_cast<double>(i) + part) / parts;
        WirePlace place{line.at(t), line.tangent(t), {}, line.radius_m(t)};
        if (out.empty()) {
            place.side = Vector3d::UnitX().cross(place.tangent).normalized();
        } else {
            const WirePlace& before = out.back();
            const Vector3d v = place.middle - before.middle;
            const auto reflect = [](const Vector3d& x, const Vector3d& n) {
                return Vector3d(x - 2 * n.dot(x) / n.squaredNorm() * n);
            };
            const Vector3d side = reflect(before.side, v);
            const Vector3d tangent = reflect(before.tangent, v);
            const Vector3d w = place.tangent - tangent;
            place.side = w.norm() > 1e-12 ? reflect(side, w) : side;
        }
        out.push_back(place);
    }
    return out;
}

// Fewer elements a turn would be far from the curve.
constexpr double least_wire_elements = 8;

// Refuses a wire that is too thick for its curve or whose turns touch.
void check_wire(const WireMesh& wire) {
    check_round("a helix of wire",
                {wire.radius_m, wire.pitch_m, wire.turns, wire.diameter_m},
                {wire.elements[0], wire.elements[1], wire.elements[2]});
    if (wire.head)
        check_round("the head of a helix", {wire.head->diameter_m, wire.head->length_m},
                    {});
    const double c = wire.pitch_m / (2 * std::numbers::pi), r = wire.radius_m;
    const double turns = wire.turns + (wire.head ? 1.5 : 0);
    if (wire.elements[2] < least_wire_elements * turns * (1 - 1e-9))
        refuse(
            "a helix of wire of {:.4g} turns in {} elements found; at least {:.0f} are "
            "needed, {:.0f} a turn",
            turns, wire.elements[2], std::ceil(least_wire_elements * turns),
            least_wire_elements);
    if (!(0.5 * wire.diameter_m < (r * r + c * c) / r))
        refuse(
            "a helix of wire {:g} m thick found, whose curve has a radius of {:g} m; "
            "less than twice that radius is allowed",
            wire.diameter_m, (r * r + c * c) / r);
    const double apart_m = wire.pitch_m * r / std::hypot(r, c);
    if (wire.turns > 1 && !(wire.diameter_m < apart_m))
        refuse(
            "a helix of wire {:g} m thick found, whose turns are {:g} m apart; less is "
            "allowed, or they pass through each other",
            wire.diameter_m, apart_m);
}

}  // namespace

Mesh wire_mesh(const WireMesh& wire) {
    check_wire(wire);
    const auto [across, layers, along] = wire.elements;
    const WireLine line(wire);
    const std::vector<WirePlace> at_section = sections(line, along);
    double factor = 1;
    const auto make = [&] {
        return grid_of(
            {{along, across, across}, layers, false}, [&](const GridPlace& at) {
                const WirePlace& place = at_section[at.core[0]];
                const Vector3d u(0, centred(at.core[1], across),
                                 centred(at.core[2], across));
                const Vector3d x = factor * place.radius_m * in_unit_ball(u, at.out);
                const Vector3d p = place.middle + x[1] * place.side +
                                   x[2] * place.tangent.cross(place.side);
                return Vec3{p[0], p[1], p[2]};
            });
    };
    factor = std::sqrt(line.volume_m3() / volume_m3(make()));
    Mesh mesh = make();
    const PointLocator locator(mesh);
    for (const WirePlace& place : at_section) {
        const Vector3d& x = place.middle;
        mesh.centre_line.push_back(locator.nearest({x[0], x[1], x[2]}));
    }
    return mesh;
}

}  // namespace magfsi::structure
