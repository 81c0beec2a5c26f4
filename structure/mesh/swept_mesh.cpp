// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/swept_mesh.h"

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "structure/mesh/block_mesh.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

constexpr double turn = 2 * std::numbers::pi;
constexpr double least_a_turn = 8;  // fewer elements would be far from the curve

// Point of the curve, with the unit vectors along the curve and along the thickness.
struct Place {
    Vector3d middle, tangent, up;
};

// Bends a block. place(share): the curve at this share of its length, 0 to 1.
Mesh swept(const Box& block, const std::function<Place(double)>& place) {
    Mesh mesh = box_mesh(block);
    for (Vec3& x : mesh.nodes) {
        const auto [middle, tangent, up] = place(x[0] / block.size_m[0]);
        const Vector3d at = middle + (x[1] - 0.5 * block.size_m[1]) * up.cross(tangent) +
                            (x[2] - 0.5 * block.size_m[2]) * up;
        x = {at[0], at[1], at[2]};
    }
    return mesh;
}

// Throws if the elements are too long for the curve or the section is too thick for it.
void check(const char* what, double turns, int elements, double thickness_m,
           double curvature_radius_m) {
    if (elements < least_a_turn * turns * (1 - 1e-9))
        refuse(
            "{} of {:.4g} turns in {} elements found; at least {:.0f} are needed, "
            "{:.0f} a turn",
            what, turns, elements, std::ceil(least_a_turn * turns), least_a_turn);
    if (!(0.5 * thickness_m < curvature_radius_m))
        refuse(
            "{} {:g} m thick found, whose curve has a radius of {:g} m; at most twice "
            "that radius is allowed, or elements are turned inside out",
            what, thickness_m, curvature_radius_m);
}

// Joins the last nodes along the block to the first ones.
void close_ring(Mesh& mesh, const std::array<int, 3>& elements) {
    const int row = elements[0] + 1;
    const auto joined = [&](int node) {
        const int i = node % row;
        return node / row * (row - 1) + (i == row - 1 ? 0 : i);
    };
    std::erase_if(mesh.nodes,
                  [&, n = 0](const Vec3&) mutable { return n++ % row == row - 1; });
    for (Hexahedron& element : mesh.elements)
        for (int& node : element) node = joined(node);
    for (MaterialPoint& point : mesh.centre_line)
        for (int& node : point.node) node = joined(node);
    mesh.faces.erase("x_min");
    mesh.faces.erase("x_max");
    for (auto& [name, nodes] : mesh.faces) {
        std::erase_if(nodes, [&](int node) { return node % row == row - 1; });
        for (int& node : nodes) node = joined(node);
    }
}

}  // namespace

Box straightened(const Arc& arc) {
    return {{arc.radius_m * arc.angle_rad, arc.section_m[0], arc.section_m[1]},
            arc.elements};
}

Box straightened(const Helix& helix) {
    const double a_turn_m = std::hypot(turn * helix.radius_m, helix.pitch_m);
    return {{helix.turns * a_turn_m, helix.section_m[0], helix.section_m[1]},
            helix.elements};
}

Mesh arc_mesh(const Arc& arc) {
    check("an arc", arc.angle_rad / turn, arc.elements[0], arc.section_m[1],
          arc.radius_m);
    Mesh mesh = swept(straightened(arc), [&](double share) {
        const double angle = (share - 0.5) * arc.angle_rad;
        const Vector3d up(-std::sin(angle), 0, std::cos(angle));
        return Place{-arc.radius_m * up, {std::cos(angle), 0, std::sin(angle)}, up};
    });
    if (is_ring(arc)) close_ring(mesh, arc.elements);
    return mesh;
}

Mesh helix_mesh(const Helix& helix) {
    const double c = helix.pitch_m / turn, r = helix.radius_m;
    if (!(r > 0))
        refuse("a helix with a radius of {:g} m found; it must be above 0 m", r);
    check("a helix", helix.turns, helix.elements[0], helix.section_m[1],
          (r * r + c * c) / r);
    // Distance between turns along the width.
    const double apart_m = helix.pitch_m * r / std::hypot(r, c);
    if (helix.turns > 1 && !(helix.section_m[0] < apart_m))
        refuse(
            "a helix {:g} m wide found, whose turns are {:g} m apart; less is allowed, "
            "or they pass through each other",
            helix.section_m[0], apart_m);
    const double hand = helix.left_handed ? -1 : 1;
    return swept(straightened(helix), [&](double share) {
        const double t = turn * helix.turns * share;
        const Vector3d up(0, std::cos(t), hand * std::sin(t));
        const Vector3d along(c, -r * std::sin(t), hand * r * std::cos(t));
        return Place{Vector3d(c * t, 0, 0) + r * up, along.normalized(), up};
    });
}

}  // namespace magfsi::structure
