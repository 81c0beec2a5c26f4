// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/round_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/round_grid.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

// Scales the distances of all nodes from the axis x, so that the mesh has this volume.
void scale_sections(Mesh& mesh, double wanted_m3) {
    const double factor = std::sqrt(wanted_m3 / volume_m3(mesh));
    for (Vec3& x : mesh.nodes) {
        x[1] *= factor;
        x[2] *= factor;
    }
}

// The points of the axis x at these places.
void add_centre_line(Mesh& mesh, const std::vector<double>& along_m) {
    const PointLocator locator(mesh);
    for (const double x : along_m) mesh.centre_line.push_back(locator.nearest({x, 0, 0}));
}

// `count` cells between two places.
std::vector<double> evenly(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i <= count; ++i) out.push_back(from + (to - from) * i / count);
    return out;
}

// A straight body along x whose radius is a function of the share of its length.
Mesh turned(double length_m, const std::array<int, 3>& elements,
            const std::function<double(double)>& radius_m) {
    const auto [across, layers, along] = elements;
    return grid_of({{along, across, across}, layers, false}, [&](const GridPlace& at) {
        const double share = 1.0 * at.core[0] / along;
        const Vector3d u(0, centred(at.core[1], across), centred(at.core[2], across));
        const Vector3d x = radius_m(share) * in_unit_ball(u, at.out);
        return Vec3{length_m * (share - 0.5), x[1], x[2]};
    });
}

}  // namespace

Mesh ball_mesh(const BallMesh& ball) {
    const auto [across, layers] = ball.elements;
    check_round("a ball", {ball.diameter_m}, {across, layers});
    const double r = 0.5 * ball.diameter_m;
    Mesh mesh =
        grid_of({{across, across, across}, layers, true}, [&](const GridPlace& at) {
            const Vector3d x = r * in_unit_ball({centred(at.core[0], across),
                                                 centred(at.core[1], across),
                                                 centred(at.core[2], across)},
                                                at.out);
            return Vec3{x[0], x[1], x[2]};
        });
    const double factor =
        std::cbrt(4.0 / 3 * std::numbers::pi * r * r * r / volume_m3(mesh));
    for (Vec3& x : mesh.nodes) x *= factor;
    return mesh;
}

Mesh cylinder_mesh(const CylinderMesh& cylinder) {
    check_round("a cylinder", {cylinder.diameter_m, cylinder.length_m},
                {cylinder.elements[0], cylinder.elements[1], cylinder.elements[2]});
    const double r = 0.5 * cylinder.diameter_m;
    Mesh mesh = turned(cylinder.length_m, cylinder.elements, [&](double) { return r; });
    scale_sections(mesh, std::numbers::pi * r * r * cylinder.length_m);
    add_centre_line(mesh, evenly(-0.5 * cylinder.length_m, 0.5 * cylinder.length_m,
                                 cylinder.elements[2]));
    return mesh;
}

Mesh cone_mesh(const ConeMesh& cone) {
    check_round("a cone", {cone.diameters_m[0], cone.diameters_m[1], cone.length_m},
                {cone.elements[0], cone.elements[1], cone.elements[2]});
    const double a = 0.5 * cone.diameters_m[0], b = 0.5 * cone.diameters_m[1];
    Mesh mesh = turned(cone.length_m, cone.elements,
                       [&](double share) { return a + (b - a) * share; });
    scale_sections(mesh, std::numbers::pi / 3 * (a * a + a * b + b * b) * cone.length_m);
    add_centre_line(mesh,
                    evenly(-0.5 * cone.length_m, 0.5 * cone.length_m, cone.elements[2]));
    return mesh;
}

// The grid of a ball, with the cells of the straight part between its two halves.
Mesh capsule_mesh(const CapsuleMesh& capsule) {
    const auto [across, layers, along] = capsule.elements;
    check_round("a capsule", {capsule.diameter_m, capsule.length_m},
                {across, layers, along});
    const double r = 0.5 * capsule.diameter_m;
    const double straight_m = capsule.length_m - capsule.diameter_m;
    if (!(straight_m > 0))
        refuse(
            "a capsule {:g} m long and {:g} m thick found; it must be longer than "
            "thick, or take a ball",
            capsule.length_m, capsule.diameter_m);
    if (across % 2 != 0)
        refuse(
            "a capsule with {} elements across its core found; an even number is "
            "needed, half of them in each end",
            across);
    const int half = across / 2;
    Mesh mesh = grid_of(
        {{across + along, across, across}, layers, true}, [&](const GridPlace& at) {
            const int into = std::clamp(at.core[0] - half, 0, along);  // straight cells
            const Vector3d x = r * in_unit_ball({centred(at.core[0] - into, across),
                                                 centred(at.core[1], across),
                                                 centred(at.core[2], across)},
                                                at.out);
            return Vec3{x[0] + straight_m * (1.0 * into / along - 0.5), x[1], x[2]};
        });
    scale_sections(mesh, std::numbers::pi * r * r * (straight_m + 4.0 / 3 * r));
    add_centre_line(
        mesh, evenly(-0.5 * capsule.length_m, 0.5 * capsule.length_m, along + across));
    return mesh;
}

}  // namespace magfsi::structure
