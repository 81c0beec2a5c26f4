// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/inertia.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/fitted/constants.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {
namespace {

using Masses = std::vector<std::array<double, 8>>;
// Direction in which mass moves, for each element and local direction: 1 up, -1 down, 0
// in elements inside the body or with both faces on the surface.
using Inwards = std::vector<std::array<int, 3>>;

// Nodes of an element's lower or upper face along d, sorted.
std::array<int, 4> side(const Hexahedron& element, int d, int upper) {
    std::array<int, 4> out{};
    int count = 0;
    for (int a = 0; a < 8; ++a) {
        if (((a >> d) & 1) == upper) out[count++] = element[a];
    }
    std::ranges::sort(out);
    return out;
}

// A face that only one soft element has is on the surface: at a rigid part, too, whose
// solid is integrated by itself (rigid_mass.h), the sum over the nodes of the soft body
// ends and has the error of an end. Nothing moves in rigid elements.
Inwards inwards(const Body& body) {
    const Mesh& mesh = body.mesh;
    std::map<std::array<int, 4>, int> elements_at;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        if (!is_soft(body, e)) continue;
        for (int d = 0; d < 3; ++d) {
            for (int upper : {0, 1}) ++elements_at[side(mesh.elements[e], d, upper)];
        }
    }
    Inwards out;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const Hexahedron& element = mesh.elements[e];
        auto& signs = out.emplace_back();
        if (!is_soft(body, e)) continue;
        for (int d = 0; d < 3; ++d) {
            signs[d] = static_cast<int>(elements_at[side(element, d, 0)] == 1) -
                       static_cast<int>(elements_at[side(element, d, 1)] == 1);
        }
    }
    return out;
}

// Masses without correction.
Masses spread_kg(const Body& body) {
    Masses out;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        Positions8 x = gather(body.mesh.nodes, body.mesh.elements[e]);
        x.rowwise() -= x.row(0).eval();  // avoids a loss of digits far from the origin
        const auto volume = integrate_hexahedron(x, e).node_volume;
        auto& masses = out.emplace_back();
        for (std::size_t a = 0; a < 8; ++a)
            masses[a] = material_of(body, e).density_kg_m3 * volume[a];
    }
    return out;
}

// Moves the shares of the local directions inwards. The mass of each element is
// unchanged.
Masses moved(const Masses& spread, const Inwards& signs, const Vec3& share) {
    Masses out = spread;
    for (std::size_t e = 0; e < out.size(); ++e) {
        double before = 0, after = 0;
        for (int a = 0; a < 8; ++a) {
            auto& mass = out[e][a];
            before += mass;
            for (int d = 0; d < 3; ++d)
                mass *= 1 + 2 * share[d] * signs[e][d] * node_sign(a, d);
            after += mass;
        }
        for (double& mass : out[e]) mass *= before / after;
    }
    return out;
}

// Mass and its first and second moments along each axis.
struct Moments {
    double mass = 0;
    Vec3 first{}, second{};

    void add(double m, const Vec3& x) {
        mass += m;
        first += m * x;
        for (int d = 0; d < 3; ++d) second[d] += m * x[d] * x[d];
    }
    // Second moment about the centre of mass.
    double central(int d) const { return second[d] - first[d] * first[d] / mass; }
};

// The moments are those of the soft elements.
Moments of_nodes(const Body& body, const Masses& masses) {
    const Mesh& mesh = body.mesh;
    Moments out;
    for (std::size_t e = 0; e < masses.size(); ++e) {
        if (!is_soft(body, e)) continue;
        for (std::size_t a = 0; a < 8; ++a)
            out.add(masses[e][a], mesh.nodes[mesh.elements[e][a]]);
    }
    return out;
}

Moments of_continuum(const Body& body) {
    Moments out;
    const double q = 1 / std::sqrt(3.0);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        if (!is_soft(body, e)) continue;
        const Positions8 nodes = gather(body.mesh.nodes, body.mesh.elements[e]);
        for (int g = 0; g < 8; ++g) {
            const Vec3 xi{q * node_sign(g, 0), q * node_sign(g, 1), q * node_sign(g, 2)};
            const auto values = shape_values(xi);
            Vec3 x{};
            for (int a = 0; a < 8; ++a) {
                for (int d = 0; d < 3; ++d) x[d] += values[a] * nodes(a, d);
            }
            const double volume = (nodes.transpose() * shape_gradients(xi)).determinant();
            out.add(material_of(body, e).density_kg_m3 * volume, x);
        }
    }
    return out;
}

// Finds the three shares that give the moments of the continuum, by fixed-point
// iteration.
Masses corrected_kg(const Body& body) {
    const Masses spread = spread_kg(body);
    const Inwards signs = inwards(body);
    const Moments wanted = of_continuum(body);
    Vec3 share{1.0 / 12, 1.0 / 12, 1.0 / 12};
    // Each share acts almost in proportion, and almost only on its own axis.
    const Moments none = of_nodes(body, spread);
    for (int iteration = 0; iteration < 10; ++iteration) {
        const Moments now = of_nodes(body, moved(spread, signs, share));
        for (int d = 0; d < 3; ++d) {
            const double gained = none.central(d) - now.central(d);
            if (!(gained > 1e-9 * wanted.central(d))) continue;
            share[d] *= (none.central(d) - wanted.central(d)) / gained;
            share[d] = std::clamp(share[d], 1e-3, fitted::most_moved_mass);
        }
    }
    return moved(spread, signs, share);
}

}  // namespace

std::vector<std::array<double, 8>> element_masses_kg(const Body& body) {
    const bool correct = body.inertia == Inertia::corrected && !is_all_rigid(body);
    return correct ? corrected_kg(body) : spread_kg(body);
}

Vec3 inertia_error(const Body& body) {
    const Moments nodes = of_nodes(body, element_masses_kg(body));
    const Moments exact = of_continuum(body);
    Vec3 out{};
    for (int d = 0; d < 3; ++d) {
        const int p = (d + 1) % 3, q = (d + 2) % 3;
        out[d] = (nodes.central(p) + nodes.central(q)) /
                     (exact.central(p) + exact.central(q)) -
                 1;
    }
    return out;
}

}  // namespace magfsi::structure
