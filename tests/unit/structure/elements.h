// SPDX-License-Identifier: GPL-2.0-or-later
// Elements and states that the tests of the lattice share.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"
#include "tests/support/checks.h"

namespace magfsi::structure::test {

using namespace magfsi::test;

inline constexpr std::array all_variants{ElementVariant::full,
                                         ElementVariant::assumed_strain};

// The paper's G and K = 20 G, in Pa.
inline Material soft_material() {
    return {33e3, 660e3, 1860};
}

inline Positions8 brick(const Vec3& edges_m) {
    Positions8 x;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) x(a, d) = 0.5 * edges_m[d] * (1 + node_sign(a, d));
    }
    return x;
}

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double uniform() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
    double within(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    // Every coordinate moved by up to `amplitude_m`.
    Positions8 moved(Positions8 x, double amplitude_m) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) x(a, d) += amplitude_m * uniform();
        }
        return x;
    }
    Eigen::Matrix3d rotation() {
        Eigen::Quaterniond q(uniform(), uniform(), uniform(), uniform());
        return q.normalized().toRotationMatrix();
    }

  private:
    std::mt19937 engine_;
};

// A flat element of about 200 x 200 x 100 um whose corners are off by up to 10 um.
inline Positions8 distorted_element(Random& random) {
    return random.moved(brick({2e-4, 2e-4, 1e-4}), 1e-5);
}

// A block whose inner nodes, or all, are moved by up to `amplitude_m`.
inline Mesh distorted_block(const Box& box, double amplitude_m, unsigned seed) {
    Mesh mesh = box_mesh(box);
    Random random(seed);
    for (Vec3& node : mesh.nodes) {
        for (double& coordinate : node) coordinate += amplitude_m * random.uniform();
    }
    return mesh;
}

inline double distance(const Vec3& a, const Vec3& b) {
    return norm(a - b);
}

// A bar along x, its halves (or layers) of two materials.
inline constexpr Vec3 bar_size_m{8e-3, 1e-3, 0.5e-3};

// Four times as stiff and half as heavy as soft_material, of the same K / G.
inline Material stiff_material() {
    return {132e3, 2640e3, 930};
}

// soft_material below x = half the length, stiff_material beyond.
inline Body soft_and_stiff_bar(ElementVariant variant = ElementVariant::assumed_strain) {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({bar_size_m, {16, 2, 2}});
    body.material = soft_material();
    body.other_materials = {stiff_material()};
    body.element = variant;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const bool soft = element_centre(body.mesh, e)[0] < 0.5 * bar_size_m[0];
        body.element_material.push_back(soft ? 0 : 1);
    }
    return body;
}

// 45 elements, five batches and a part of one, of the soft material and the others in
// turn.
inline Body mixed_block(bool bricks, ElementVariant variant,
                        std::vector<Material> other_materials) {
    const Box box{{10e-4, 6e-4, 1.5e-4}, {5, 3, 3}};
    Body body;
    body.name = "mixed";
    body.mesh = bricks ? box_mesh(box) : distorted_block(box, 3e-6, 14);
    body.material = soft_material();
    body.other_materials = std::move(other_materials);
    body.element = variant;
    const std::size_t materials = 1 + body.other_materials.size();
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
        body.element_material.push_back(static_cast<int>(e % materials));
    return body;
}

}  // namespace magfsi::structure::test
