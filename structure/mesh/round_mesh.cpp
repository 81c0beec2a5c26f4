// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/round_mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

// Half the edge of the core over the radius, and how far its faces bulge towards a ball
// (0: plane): with these no corner of an element is sharper than 45 degrees.
constexpr double core_share = 0.5, bulge = 0.5;

// A point of the grid: indices in the core, or of a point of its surface, and how far it
// is from there to the outer surface, 0 to 1.
struct GridPlace {
    std::array<int, 3> core{};
    double out = 0;
};

// Core of core[0] x core[1] x core[2] cells, with layers on its faces along y and z, and
// along x if `ends`.
struct RoundGrid {
    std::array<int, 3> core{};
    int layers = 1;
    bool ends = false;
};

// Numbers the nodes of a grid as elements ask for them. Layers of neighbouring faces
// share the nodes over their common edge.
class GridNodes {
  public:
    GridNodes(Mesh& mesh, const RoundGrid& grid,
              std::function<Vec3(const GridPlace&)> position)
        : mesh_(mesh), grid_(grid), position_(std::move(position)) {}

    int number(const std::array<int, 3>& core, int layer) {
        const auto [at, made] =
            known_.try_emplace({core, layer}, static_cast<int>(mesh_.nodes.size()));
        if (!made) return at->second;
        mesh_.nodes.push_back(position_({core, 1.0 * layer / grid_.layers}));
        if (!grid_.ends && core[0] == 0) mesh_.faces["x_min"].push_back(at->second);
        if (!grid_.ends && core[0] == grid_.core[0])
            mesh_.faces["x_max"].push_back(at->second);
        return at->second;
    }

  private:
    Mesh& mesh_;
    const RoundGrid& grid_;
    std::function<Vec3(const GridPlace&)> position_;
    std::map<std::pair<std::array<int, 3>, int>, int> known_;
};

// Adds the layers over one face of the core; the last layer's outer nodes are a face of
// the mesh.
void add_layers(Mesh& mesh, GridNodes& nodes, const RoundGrid& grid, int d, int side) {
    const int p = (d + 1) % 3, q = (d + 2) % 3;
    std::vector<int>& face =
        mesh.faces[std::string(1, "xyz"[d]) + (side == 0 ? "_min" : "_max")];
    for (int i = 0; i < grid.core[p]; ++i) {
        for (int j = 0; j < grid.core[q]; ++j) {
            for (int l = 0; l < grid.layers; ++l) {
                Hexahedron element{};
                for (int a = 0; a < 8; ++a) {
                    std::array<int, 3> at{};
                    at[d] = side == 0 ? 0 : grid.core[d];
                    at[p] = i + (a & 1);
                    at[q] = j + ((a >> 1) & 1);
                    element[a] = nodes.number(at, l + (a >> 2));
                    if (l + (a >> 2) == grid.layers) face.push_back(element[a]);
                }
                mesh.elements.push_back(oriented(mesh.nodes, element));
            }
        }
    }
}

void sort_faces(Mesh& mesh) {
    for (auto& [name, nodes] : mesh.faces) {
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
}

Mesh grid_of(const RoundGrid& grid, std::function<Vec3(const GridPlace&)> position) {
    Mesh mesh;
    GridNodes nodes(mesh, grid, std::move(position));
    const auto [nx, ny, nz] = grid.core;
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                Hexahedron element{};
                for (int a = 0; a < 8; ++a)
                    element[a] =
                        nodes.number({i + (a & 1), j + ((a >> 1) & 1), k + (a >> 2)}, 0);
                mesh.elements.push_back(oriented(mesh.nodes, element));
            }
        }
    }
    for (int d = grid.ends ? 0 : 1; d < 3; ++d) {
        for (const int side : {0, 1}) add_layers(mesh, nodes, grid, d, side);
    }
    sort_faces(mesh);
    return mesh;
}

// Place in a ball or, with u[0] = 0, in a disc of radius 1: u from -1 to 1 along each
// axis of the core, `out` from the core to the surface. Points of the surface are at
// equal angles.
Vector3d in_unit_ball(const Vector3d& u, double out) {
    const double largest = u.cwiseAbs().maxCoeff();
    if (largest == 0) return Vector3d::Zero();
    const double shrink = (1 - bulge) + bulge * 1.25 * largest / u.norm();
    const Vector3d inner = core_share * shrink * u;
    if (out == 0) return inner;
    const Vector3d ray = (0.25 * pi * u.array()).tan().matrix().normalized();
    return (1 - out) * inner + out * ray;
}

// Place of a core index from -1 to 1.
double centred(int i, int cells) {
    return 2.0 * i / cells - 1;
}

// Refuses sizes and numbers that are not positive.
void check(const char* what, std::initializer_list<double> sizes_m,
           std::initializer_list<int> counts) {
    for (const double size : sizes_m)
        if (!(size > 0))
            refuse("{} with a size of {:g} m found, it must be positive", what, size);
    for (const int count : counts)
        if (count < 1)
            refuse("{} in {} elements found, at least 1 is needed", what, count);
}

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
    check("a ball", {ball.diameter_m}, {across, layers});
    const double r = 0.5 * ball.diameter_m;
    Mesh mesh =
        grid_of({{across, across, across}, layers, true}, [&](const GridPlace& at) {
            const Vector3d x = r * in_unit_ball({centred(at.core[0], across),
                                                 centred(at.core[1], across),
                                                 centred(at.core[2], across)},
                                                at.out);
            return Vec3{x[0], x[1], x[2]};
        });
    const double factor = std::cbrt(4.0 / 3 * pi * r * r * r / volume_m3(mesh));
    for (Vec3& x : mesh.nodes) x *= factor;
    return mesh;
}

Mesh cylinder_mesh(const CylinderMesh& cylinder) {
    check("a cylinder", {cylinder.diameter_m, cylinder.length_m},
          {cylinder.elements[0], cylinder.elements[1], cylinder.elements[2]});
    const double r = 0.5 * cylinder.diameter_m;
    Mesh mesh = turned(cylinder.length_m, cylinder.elements, [&](double) { return r; });
    scale_sections(mesh, pi * r * r * cylinder.length_m);
    add_centre_line(mesh, evenly(-0.5 * cylinder.length_m, 0.5 * cylinder.length_m,
                                 cylinder.elements[2]));
    return mesh;
}

Mesh cone_mesh(const ConeMesh& cone) {
    check("a cone", {cone.diameters_m[0], cone.diameters_m[1], cone.length_m},
          {cone.elements[0], cone.elements[1], cone.elements[2]});
    const double a = 0.5 * cone.diameters_m[0], b = 0.5 * cone.diameters_m[1];
    Mesh mesh = turned(cone.length_m, cone.elements,
                       [&](double share) { return a + (b - a) * share; });
    scale_sections(mesh, pi / 3 * (a * a + a * b + b * b) * cone.length_m);
    add_centre_line(mesh,
                    evenly(-0.5 * cone.length_m, 0.5 * cone.length_m, cone.elements[2]));
    return mesh;
}

// The grid of a ball, with the cells of the straight part between its two halves.
Mesh capsule_mesh(const CapsuleMesh& capsule) {
    const auto [across, layers, along] = capsule.elements;
    check("a capsule", {capsule.diameter_m, capsule.length_m}, {across, layers, along});
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
    scale_sections(mesh, pi * r * r * (straight_m + 4.0 / 3 * r));
    add_centre_line(
        mesh, evenly(-0.5 * capsule.length_m, 0.5 * capsule.length_m, along + across));
    return mesh;
}

namespace {

// The middle line of a wire, with its direction, its radius and the unit vector towards
// the first side of its sections.
struct WirePlace {
    Vector3d middle, tangent, side;
    double radius_m = 0;
};

// Smooth step from 0 to 1 with its slope 0 at both ends.
double eased(double share) {
    return 0.5 * (1 - std::cos(pi * std::clamp(share, 0.0, 1.0)));
}

// The middle line by an angle: wound up to wound_, in the next turn coming to the axis,
// then straight. The wire grows to the head in the last quarter of that turn and the half
// that follows, where the line is hardly bent.
class WireLine {
  public:
    explicit WireLine(const WireMesh& wire)
        : wire_(wire),
          climb_m_(wire.pitch_m / (2 * pi)),
          wound_(2 * pi * wire.turns),
          end_(wound_ + (wire.head ? 3 * pi + wire.head->length_m / climb_m_ : 0)) {}

    double end() const { return end_; }
    // Volume of the wire: its sections have their centres on the line.
    double volume_m3() const {
        constexpr int parts = 20000;
        double sum = 0;
        for (int i = 0; i < parts; ++i) {
            const double r = radius_m(end_ * (i + 0.5) / parts);
            sum +=
                pi * r * r * (at(end_ * (i + 1) / parts) - at(end_ * i / parts)).norm();
        }
        return sum;
    }
    double radius_m(double t) const {
        const double thin = 0.5 * wire_.diameter_m;
        if (!wire_.head) return thin;
        const double grown = eased((t - wound_ - 1.5 * pi) / (1.5 * pi));
        return thin + (0.5 * wire_.head->diameter_m - thin) * grown;
    }
    Vector3d at(double t) const {
        const double inwards = wire_.head ? eased((t - wound_) / (2 * pi)) : 0;
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

// Refuses a wire that is too thick for its curve or whose turns touch.
void check_wire(const WireMesh& wire) {
    check("a helix of wire", {wire.radius_m, wire.pitch_m, wire.turns, wire.diameter_m},
          {wire.elements[0], wire.elements[1], wire.elements[2]});
    if (wire.head)
        check("the head of a helix", {wire.head->diameter_m, wire.head->length_m}, {});
    const double c = wire.pitch_m / (2 * pi), r = wire.radius_m;
    constexpr double least_a_turn = 8;
    const double turns = wire.turns + (wire.head ? 1.5 : 0);
    if (wire.elements[2] < least_a_turn * turns * (1 - 1e-9))
        refuse(
            "a helix of wire of {:.4g} turns in {} elements found; at least {:.0f} are "
            "needed, {:.0f} a turn",
            turns, wire.elements[2], std::ceil(least_a_turn * turns), least_a_turn);
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
