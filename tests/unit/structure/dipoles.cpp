// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies' own dipoles: the law of two, its derivatives, and the energy of a solid.
#include "structure/magnetics/dipoles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

constexpr double mu0 = 4e-7 * std::numbers::pi;

// Blocks of one mesh each, one after the other in x.
struct Magnets {
    std::vector<DipoleElement> element;
    std::vector<std::array<int, 8>> nodes;
    std::vector<std::size_t> first{0};  // dipole of each block, then the end
    std::vector<std::size_t> first_node{0};
    std::vector<double> x;

    void add(const Box& box, const Vec3& magnetization_a_m, const Vec3& corner_m) {
        const Mesh mesh = box_mesh(box);
        for (const DipoleElement& one :
             dipole_elements(mesh.nodes, mesh.elements,
                             uniform_magnetization(mesh, magnetization_a_m))) {
            element.push_back(one);
            nodes.push_back(mesh.elements[static_cast<std::size_t>(one.element)]);
            for (int& n : nodes.back()) n += static_cast<int>(first_node.back());
        }
        for (const Vec3& node : mesh.nodes) {
            for (std::size_t d = 0; d < 3; ++d) x.push_back(node[d] + corner_m[d]);
        }
        first.push_back(element.size());
        first_node.push_back(x.size() / 3);
    }

    struct Load {
        double energy_j = 0;
        std::vector<double> force_n;  // of each node

        Vector3d force(std::size_t from, std::size_t to) const {
            Vector3d sum = Vector3d::Zero();
            for (std::size_t n = from; n < to; ++n) sum += Vector3d(&force_n[3 * n]);
            return sum;
        }
        Vector3d torque(const std::vector<double>& at, std::size_t from,
                        std::size_t to) const {
            Vector3d sum = Vector3d::Zero();
            for (std::size_t n = from; n < to; ++n)
                sum += Vector3d(&at[3 * n]).cross(Vector3d(&force_n[3 * n]));
            return sum;
        }
    };
    Load load(bool within,
              InstructionSet set = available_instruction_sets().back()) const {
        Dipoles all(set);
        all.resize(element.size());
        std::vector<Dipole> dipole;
        for (std::size_t i = 0; i < element.size(); ++i) {
            dipole.push_back(dipole_of(element[i], nodes[i], x.data()));
            all.set(i, dipole.back());
            all.set_radius(i, element[i].radius_m);
        }
        Load out;
        out.force_n.resize(x.size());
        for (std::size_t b = 0; b + 1 < first.size(); ++b) {
            for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
                FieldSample sample;
                if (within) {
                    all.add_field(i, 0, all.size(), sample);
                    sample.field_t += own_field_t(element[i], dipole[i]);
                } else {
                    all.add_field(i, 0, first[b], sample);
                    all.add_field(i, first[b + 1], all.size(), sample);
                }
                out.energy_j += add_dipole_forces(element[i], nodes[i], dipole[i], sample,
                                                  out.force_n.data());
            }
        }
        return out;
    }
};

// Between two dipoles: Yung, Landecker, Villani, Magn. Electr. Sep. 9 (1998) 39.
Vector3d force_on_second(const Vector3d& m1, const Vector3d& m2, const Vector3d& from_1) {
    const double r = from_1.norm();
    const Vector3d n = from_1 / r;
    return 3 * mu0 / (4 * std::numbers::pi * std::pow(r, 4)) *
           (m1.dot(n) * m2 + m2.dot(n) * m1 + m1.dot(m2) * n -
            5 * m1.dot(n) * m2.dot(n) * n);
}

// Two blocks of 1 x 1 x 2 mm, each of elements of half a millimetre, their middles apart.
Magnets two_blocks(const Vector3d& apart_m, const Vec3& magnetization_a_m) {
    Magnets out;
    out.add({{1e-3, 1e-3, 2e-3}, {2, 2, 4}}, {0, 0, 60e3}, {});
    out.add({{1e-3, 1e-3, 2e-3}, {2, 2, 4}}, magnetization_a_m,
            {apart_m[0], apart_m[1], apart_m[2]});
    return out;
}

// Far apart they are two points: what is left falls with the square of the distance, and
// on one axis the force is 3 mu0 m^2 / (2 pi r^4).
TEST(Dipoles, FarApartAttractByTheirLaw) {
    const double moment = 60e3 * 2e-9;
    struct Case {
        Vector3d way;
        Vec3 magnetization_a_m;
    };
    for (const Case& c :
         {Case{{0, 0, 1}, {0, 0, 60e3}}, Case{{1, 0, 0}, {0, 0, 60e3}},
          Case{{0.6, 0, 0.8}, {0, 0, 60e3}}, Case{{0.48, -0.6, 0.64}, {36e3, 48e3, 0}}}) {
        std::vector<double> off;
        for (const double distance_m : {8e-3, 16e-3, 32e-3}) {
            const Vector3d apart_m = distance_m * c.way;
            const Magnets magnets = two_blocks(apart_m, c.magnetization_a_m);
            const auto load = magnets.load(false);
            const Vector3d other = 2e-9 * Vector3d(c.magnetization_a_m.data());
            const Vector3d right = force_on_second({0, 0, moment}, other, apart_m);
            const Vector3d found =
                load.force(magnets.first_node[1], magnets.first_node[2]);
            off.push_back((found - right).norm() / right.norm());
            const Vector3d turned =
                load.torque(magnets.x, magnets.first_node[1], magnets.first_node[2]) -
                (apart_m + Vector3d(0.5e-3, 0.5e-3, 1e-3)).cross(found);
            const Vector3d n = c.way;
            const Vector3d field = mu0 /
                                   (4 * std::numbers::pi * std::pow(distance_m, 3)) *
                                   (3 * moment * n[2] * n - Vector3d(0, 0, moment));
            // A block's octupole, beside the point: (2 mm / r)^2.
            EXPECT_LT((turned - other.cross(field)).norm(),
                      std::pow(2e-3 / distance_m, 2) * other.norm() * field.norm());
        }
        EXPECT_LT(off.back(), 0.02);
        EXPECT_NEAR(std::log2(off[1] / off[2]), 2, 0.1);
    }
    const auto magnets = two_blocks({0, 0, 64e-3}, {0, 0, 60e3});
    const Vector3d pull =
        magnets.load(false).force(magnets.first_node[1], magnets.first_node[2]);
    const double right =
        3 * mu0 * moment * moment / (2 * std::numbers::pi * std::pow(64e-3, 4));
    EXPECT_NEAR(pull[2] / -right, 1, 5e-3);  // 5 (2^2 - 1^2) / 64^2 or so
}

// Cubes have no octupole: the next correction falls with the fourth power.
TEST(Dipoles, OfCubesAreRightToTheFourthPower) {
    const double moment = 60e3 * 1e-9;
    std::vector<double> off;
    for (const double distance_m : {4e-3, 8e-3}) {
        Magnets magnets;
        for (const double z : {0.0, distance_m})
            magnets.add({{1e-3, 1e-3, 1e-3}, {2, 2, 2}}, {0, 0, 60e3}, {0, 0, z});
        const Vector3d pull =
            magnets.load(false).force(magnets.first_node[1], magnets.first_node[2]);
        const double right =
            3 * mu0 * moment * moment / (2 * std::numbers::pi * std::pow(distance_m, 4));
        off.push_back(std::abs(pull[2] / -right - 1));
    }
    EXPECT_LT(off[1], 1e-3);
    EXPECT_NEAR(std::log2(off[0] / off[1]), 4, 0.2);
}

// Two crooked blocks near each other, so that spheres overlap.
Magnets crooked() {
    Magnets magnets;
    magnets.add({{1e-3, 1e-3, 0.6e-3}, {2, 2, 1}}, {40e3, -20e3, 60e3}, {});
    magnets.add({{1e-3, 1e-3, 0.8e-3}, {2, 2, 1}}, {10e3, 50e3, -30e3},
                {0.1e-3, 0.2e-3, 0.3e-3});
    test::Random random(7);
    for (double& value : magnets.x) value += 5e-5 * random.uniform();
    return magnets;
}

TEST(Dipoles, ForcesAreDerivativesOfTheEnergy) {
    for (const bool within : {false, true}) {
        Magnets magnets = crooked();
        const auto load = magnets.load(within);
        double largest = 0, off = 0;
        for (std::size_t q = 0; q < magnets.x.size(); ++q) {
            const double here = magnets.x[q], step_m = 1e-8;
            magnets.x[q] = here + step_m;
            const double ahead = magnets.load(within).energy_j;
            magnets.x[q] = here - step_m;
            const double behind = magnets.load(within).energy_j;
            magnets.x[q] = here;
            largest = std::max(largest, std::abs(load.force_n[q]));
            off = std::max(off,
                           std::abs((behind - ahead) / (2 * step_m) - load.force_n[q]));
        }
        // (step / 0.5 mm)^2 and the rounding of the energy over it.
        EXPECT_LT(off, 1e-7 * largest) << within;
    }
}

TEST(Dipoles, ForcesAndTorquesBalance) {
    for (const bool within : {false, true}) {
        const Magnets magnets = crooked();
        const auto load = magnets.load(within);
        double sum = 0;
        for (const double f : load.force_n) sum += std::abs(f);
        const std::size_t nodes = magnets.x.size() / 3;
        // Rounding of sums of a hundred.
        EXPECT_LT(load.force(0, nodes).norm(), 1e-14 * sum);
        EXPECT_LT(load.torque(magnets.x, 0, nodes).norm(), 1e-14 * 1e-3 * sum);
        EXPECT_GT(load.force(0, magnets.first_node[1]).norm(), 1e-3 * sum);
    }
}

// Where spheres begin to overlap neither force nor energy jumps; at one place both end.
TEST(Dipoles, ComeNearWithoutAJump) {
    const auto pull = [](double distance_m) {
        Magnets magnets;
        for (const double z : {0.0, distance_m})
            magnets.add({{1e-3, 1e-3, 1e-3}, {1, 1, 1}}, {20e3, 0, 60e3}, {0, 0, z});
        const auto load = magnets.load(false);
        return std::pair(load.force(8, 16), load.energy_j);
    };
    const auto [before, energy_before] = pull(1e-3 * (1 + 1e-9));
    const auto [after, energy_after] = pull(1e-3 * (1 - 1e-9));
    EXPECT_LT((after - before).norm(), 1e-7 * before.norm());
    EXPECT_NEAR(energy_after / energy_before, 1, 1e-7);
    // Spheres of one middle and radius: mu0 / (4 pi) m^2 / a^3, twice the own energy.
    const double moment2 = std::pow(1e-9, 2) * (std::pow(20e3, 2) + std::pow(60e3, 2));
    EXPECT_NEAR(pull(1e-12).second / (1e-7 * moment2 / std::pow(0.5e-3, 3)), 1, 1e-6);
}

// Aharoni, J. Appl. Phys. 83 (1998) 3432: along c of a prism of the half edges a, b, c.
double demagnetizing_factor(double a, double b, double c) {
    const double abc = std::sqrt(a * a + b * b + c * c), ab = std::sqrt(a * a + b * b);
    const double bc = std::sqrt(b * b + c * c), ac = std::sqrt(a * a + c * c);
    const auto ratio = [](double root, double edge) {
        return std::log((root - edge) / (root + edge));
    };
    const double terms =
        (b * b - c * c) / (2 * b * c) * ratio(abc, a) +
        (a * a - c * c) / (2 * a * c) * ratio(abc, b) - b / (2 * c) * ratio(ab, a) -
        a / (2 * c) * ratio(ab, b) + c / (2 * a) * ratio(bc, b) +
        c / (2 * b) * ratio(ac, a) + 2 * std::atan(a * b / (c * abc)) +
        (a * a * a + b * b * b - 2 * c * c * c) / (3 * a * b * c) +
        (a * a + b * b - 2 * c * c) / (3 * a * b * c) * abc + c / (a * b) * (ac + bc) -
        (ab * ab * ab + bc * bc * bc + ac * ac * ac) / (3 * a * b * c);
    return terms / std::numbers::pi;
}

// A bar of 1 x 1 x 4: its energy 1/2 mu0 N M^2 V comes out of ever smaller cubes, along
// it and across. What is left is that of the cubes on its surface, a share 1 / n.
TEST(Dipoles, OfASolidHaveItsDemagnetizingFactor) {
    ASSERT_NEAR(demagnetizing_factor(1, 1, 1), 1.0 / 3, 1e-12);
    const double along = demagnetizing_factor(1, 1, 4);
    for (const bool across : {false, true}) {
        const double right = across ? 0.5 * (1 - along) : along;
        std::vector<double> off;
        for (const int n : {2, 4, 8}) {
            Magnets bar;
            const Vec3 magnetization_a_m = across ? Vec3{60e3, 0, 0} : Vec3{0, 0, 60e3};
            bar.add({{1e-3, 1e-3, 4e-3}, {n, n, 4 * n}}, magnetization_a_m, {});
            const double factor =
                bar.load(true).energy_j / (0.5 * mu0 * std::pow(60e3, 2) * 4e-9);
            off.push_back(std::abs(factor - right));
        }
        EXPECT_LT(off[2], 0.01) << across;
        EXPECT_GT(std::log2(off[1] / off[2]), 0.8) << across;
    }
}

TEST(Dipoles, OfAllInstructionSetsAgree) {
    const Magnets magnets = crooked();
    const auto plain = magnets.load(true, InstructionSet::sse2);
    double largest = 0;
    for (const double f : plain.force_n) largest = std::max(largest, std::abs(f));
    for (const InstructionSet set : available_instruction_sets()) {
        const auto other = magnets.load(true, set);
        EXPECT_NEAR(other.energy_j / plain.energy_j, 1, 1e-13) << name(set);
        for (std::size_t q = 0; q < plain.force_n.size(); ++q)
            EXPECT_NEAR(other.force_n[q], plain.force_n[q], 1e-13 * largest);
    }
}

}  // namespace
}  // namespace magfsi::structure
