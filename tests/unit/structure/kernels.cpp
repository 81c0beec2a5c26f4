// SPDX-License-Identifier: GPL-2.0-or-later
// The fast kernels against plain elements, one by one, in every instruction set of the
// machine; and the damping itself: it dissipates what its model says and never resists
// rigid motion.
#include "structure/lattice/element_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "structure/lattice/plain_element.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

struct Sums {
    std::vector<double> force;
    double energy = 0;  // or the dissipation
    double smallest_j = INFINITY;
    int element = -1;  // of smallest J

    double scale() const {
        double largest = 0;
        for (double f : force) largest = std::max(largest, std::abs(f));
        return largest;
    }
    void add(const Hexahedron& nodes, const Positions8& forces) {
        for (int q = 0; q < 24; ++q)
            force[3 * nodes[q / 3] + q % 3] += forces(q / 3, q % 3);
    }
};

Positions8 positions(const std::vector<double>& x, const Hexahedron& nodes) {
    Positions8 out;
    for (int q = 0; q < 24; ++q) out(q / 3, q % 3) = x[3 * nodes[q / 3] + q % 3];
    return out;
}

ElementReference reference(const Body& body, std::size_t e) {
    return element_reference(gather(body.mesh.nodes, body.mesh.elements[e]), body.element,
                             0);
}

Sums plain(const Body& body, const std::vector<double>& x) {
    Sums out;
    out.force.assign(x.size(), 0.0);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const Hexahedron& nodes = body.mesh.elements[e];
        const ElementState state =
            element_energy(reference(body, e), material_of(body, e), positions(x, nodes));
        out.energy += state.energy_j;
        if (state.volume_ratio < out.smallest_j) out.element = static_cast<int>(e);
        out.smallest_j = std::min(out.smallest_j, state.volume_ratio);
        out.add(nodes, state.force_n);
    }
    return out;
}

Sums plain_damping(const Body& body, const std::vector<double>& x,
                   const std::vector<double>& v) {
    Sums out;
    out.force.assign(x.size(), 0.0);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const Hexahedron& nodes = body.mesh.elements[e];
        const ViscousState state =
            viscous_element(reference(body, e), material_of(body, e), positions(x, nodes),
                            positions(v, nodes));
        out.energy += state.dissipation_w;
        out.add(nodes, state.force_n);
    }
    return out;
}

std::vector<double> moved(const Mesh& mesh, double amplitude_m, unsigned seed) {
    test::Random random(seed);
    std::vector<double> x;
    for (const Vec3& node : mesh.nodes) {
        for (double c : node) x.push_back(c + amplitude_m * random.uniform());
    }
    return x;
}

std::vector<double> random_speeds(const Mesh& mesh, unsigned seed) {
    test::Random random(seed);
    std::vector<double> v;
    for (std::size_t q = 0; q < 3 * mesh.nodes.size(); ++q)
        v.push_back(0.1 * random.uniform());
    return v;
}

// 45 elements: five batches and a part of one.
const Box box{{10e-4, 6e-4, 1.5e-4}, {5, 3, 3}};

Body block(const Mesh& mesh, ElementVariant variant) {
    Body body;
    body.mesh = mesh;
    body.material = test::soft_material();
    body.element = variant;
    return body;
}

class Kernel : public ::testing::TestWithParam<InstructionSet> {
  protected:
    // rounding: of coordinates, over those of the block.
    void expect_same(const Body& body, const std::vector<double>& x, bool bricks,
                     double rounding = 1) {
        const Lattice lattice = build_lattice(body);
        ASSERT_EQ(lattice.bricks, bricks);
        const Sums expected = plain(body, x);
        ElementKernel kernel(GetParam());
        kernel.assign(lattice);
        EXPECT_EQ(kernel.size(), body.mesh.elements.size());
        std::vector<double> force(x.size(), 0.0);
        const KernelResult result = kernel.add_forces(x.data(), force.data());
        // Other order of the same sums, logarithm to 2 ulp: a few roundings of K l^2
        // each.
        for (std::size_t q = 0; q < x.size(); ++q) {
            ASSERT_NEAR(force[q], expected.force[q], 1e-12 * rounding * expected.scale());
        }
        EXPECT_NEAR(result.smallest_j, expected.smallest_j, 1e-13 * rounding);
        EXPECT_EQ(result.element, expected.element);
        std::vector<double> again(x.size(), 0.0);
        const KernelResult with_energy =
            kernel.add_forces_and_energy(x.data(), again.data());
        EXPECT_NEAR(with_energy.energy_j / expected.energy, 1, 1e-12 * rounding);
        // Another compilation of the same sums: fused operations may round differently.
        for (std::size_t q = 0; q < x.size(); ++q) {
            ASSERT_NEAR(again[q], force[q], 1e-13 * rounding * expected.scale());
        }
    }

    // Returns the forces.
    std::vector<double> expect_same_damping(const Body& body,
                                            const std::vector<double>& x,
                                            const std::vector<double>& v, bool bricks) {
        const Lattice lattice = build_lattice(body);
        EXPECT_EQ(lattice.bricks, bricks);
        const Sums expected = plain_damping(body, x, v);
        ViscousKernel kernel(GetParam());
        kernel.assign(lattice);
        std::vector<double> force(x.size(), 0.0);
        EXPECT_NEAR(kernel.add_forces(x.data(), v.data(), force.data()) / expected.energy,
                    1, 1e-12);
        // Another order of the same sums.
        for (std::size_t q = 0; q < x.size(); ++q) {
            EXPECT_NEAR(force[q], expected.force[q], 1e-12 * expected.scale());
        }
        return force;
    }
};

TEST_P(Kernel, MatchesThePlainElement) {
    const Mesh bricks = box_mesh(box);
    const Mesh distorted = test::distorted_block(box, 3e-6, 14);
    for (ElementVariant variant : test::all_variants) {
        expect_same(block(bricks, variant), moved(bricks, 5e-6, 13), true);
        expect_same(block(distorted, variant), moved(distorted, 5e-6, 13), false);
    }
}

TEST_P(Kernel, GivesEachElementTheForcesOfItsMaterial) {
    for (ElementVariant variant : test::all_variants) {
        Body body = test::soft_and_stiff_bar(variant);
        // Alternating along x too, so that every batch of eight holds both at first.
        for (std::size_t e = 0; e < body.element_material.size(); e += 3) {
            body.element_material[e] = 1 - body.element_material[e];
        }
        expect_same(body, moved(body.mesh, 2e-5, 51), true, 10);
    }
}

TEST_P(Kernel, NamesTheElementThatIsInvertedOrNaN) {
    const Mesh mesh = box_mesh(box);
    const Lattice lattice = build_lattice(block(mesh, ElementVariant::full));
    ElementKernel kernel(GetParam());
    const std::vector<int> some{3, 40, 44};
    kernel.assign(lattice, some,
                  std::vector<std::array<int, 8>>{mesh.elements[3], mesh.elements[40],
                                                  mesh.elements[44]});
    std::vector<double> x = moved(mesh, 0, 1);
    std::vector<double> force(x.size(), 0.0);
    EXPECT_NEAR(kernel.add_forces(x.data(), force.data()).smallest_j, 1, 1e-14);
    // The last corner of the last element, drawn through the element; element 40 lacks
    // it.
    double* corner = &x[3 * static_cast<std::size_t>(mesh.elements[44][7])];
    corner[2] -= 30e-5;
    const KernelResult inverted = kernel.add_forces(x.data(), force.data());
    EXPECT_LT(inverted.smallest_j, 0);
    EXPECT_EQ(inverted.element, 44);
    corner[2] = std::nan("");
    const KernelResult lost = kernel.add_forces(x.data(), force.data());
    EXPECT_EQ(lost.smallest_j, -INFINITY);
    EXPECT_EQ(lost.element, 44);
}

TEST_P(Kernel, DampsAsThePlainElement) {
    for (const bool bricks : {true, false}) {
        Body body = block(bricks ? box_mesh(box) : test::distorted_block(box, 3e-6, 35),
                          ElementVariant::full);
        body.material.viscosity_pa_s = 0.7;
        expect_same_damping(body, moved(body.mesh, 5e-6, 34),
                            random_speeds(body.mesh, 36), bricks);
    }
}

// Only the stiff half is viscous: all it takes out is that of its elements.
TEST_P(Kernel, DampsViscousElementsOnly) {
    Body body = test::soft_and_stiff_bar();
    body.other_materials[0].viscosity_pa_s = 0.7;
    const auto force = expect_same_damping(body, moved(body.mesh, 0, 1),
                                           random_speeds(body.mesh, 53), true);
    for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
        if (body.mesh.nodes[n][0] < 3.9e-3) {
            ASSERT_EQ(force[3 * n], 0) << n;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, Kernel, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return name(set.param); });

TEST(KernelChoice, RefusesAnUnknownInstructionSet) {
    setenv("MAGFSI_ISA", "altivec", 1);
    EXPECT_THROW(ElementKernel(), std::invalid_argument);
    unsetenv("MAGFSI_ISA");
}

TEST(ViscousForces, RefuseANegativeViscosity) {
    Body body = block(box_mesh(box), ElementVariant::full);
    body.material.viscosity_pa_s = -1;
    const Lattice lattice = build_lattice(body);
    ViscousKernel kernel;
    EXPECT_THROW(kernel.assign(lattice), std::invalid_argument);
}

constexpr double eta = 0.7;  // Pa s

Material rubber() {
    Material material = test::soft_material();
    material.viscosity_pa_s = eta;
    return material;
}

struct Moving {
    ElementReference reference;
    Positions8 x, v;
};

Moving random_motion(test::Random& random) {
    const Positions8 x0 = test::distorted_element(random);
    return {element_reference(x0, ElementVariant::full, 0),
            random.moved(x0 * random.rotation().transpose(), 1.5e-5),
            random.moved(Positions8::Zero(), 0.3)};
}

TEST(ViscousForces, TakeOutExactlyWhatTheyDissipate) {
    test::Random random(31);
    for (int trial = 0; trial < 50; ++trial) {
        const Moving m = random_motion(random);
        const ViscousState state = viscous_element(m.reference, rubber(), m.x, m.v);
        EXPECT_GT(state.dissipation_w, 0);
        const double power = state.force_n.cwiseProduct(m.v).sum();
        EXPECT_NEAR(power / state.dissipation_w, -1, 1e-12);  // rounding of 24 products
    }
}

// In a homogeneous motion the dissipation is the integral of 2 eta Edot : Edot over the
// undeformed element, here by quadrature of Green's strain rate at 2x2x2 points.
TEST(ViscousForces, DissipateTheQuadratureOfGreensStrainRate) {
    test::Random random(32);
    for (int trial = 0; trial < 10; ++trial) {
        const Positions8 x0 = test::distorted_element(random);
        Eigen::Matrix3d f, rate;
        for (int d = 0; d < 9; ++d) {
            f(d) = (d % 4 == 0 ? 1 : 0) + 0.2 * random.uniform();
            rate(d) = 1e3 * random.uniform();
        }
        const Positions8 x = x0 * f.transpose();
        const Positions8 v = x0 * rate.transpose();
        double expected = 0;
        const double q = 1 / std::sqrt(3.0);
        for (int g = 0; g < 8; ++g) {
            const Positions8 local = shape_gradients(
                {q * node_sign(g, 0), q * node_sign(g, 1), q * node_sign(g, 2)});
            const Eigen::Matrix3d jacobian = x0.transpose() * local;
            const Positions8 gradient = local * jacobian.inverse();
            const Eigen::Matrix3d product =
                (x.transpose() * gradient).transpose() * (v.transpose() * gradient);
            const Eigen::Matrix3d strain_rate = 0.5 * (product + product.transpose());
            expected += 2 * eta * jacobian.determinant() * strain_rate.squaredNorm();
        }
        const ViscousState state = viscous_element(
            element_reference(x0, ElementVariant::full, 0), rubber(), x, v);
        // Hourglass vectors of a homogeneous motion vanish to rounding.
        EXPECT_NEAR(state.dissipation_w / expected, 1, 1e-12);
    }
}

// A plate of one layer that bends, twists, domes at unit rate: 2 eta of the strain rates
// of Kirchhoff's plate, whose thinning follows K / (K + 2 G).
TEST(ViscousForces, DampAPlateOfOneLayerAsItsKirchhoffStrainRates) {
    const Material material = rubber();
    const Positions8 x0 = [] {
        Positions8 x = test::brick({3e-4, 2e-4, 1e-4});
        return Positions8(x.rowwise() - x.colwise().mean());
    }();
    const ElementReference reference = element_reference(x0, ElementVariant::full, 0);
    const double thinning = 20.0 / 22.0;  // K = 20 G
    const struct {
        double xx, yy, xy;
    } rates[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}};
    for (const auto& k : rates) {
        Positions8 v;
        for (int a = 0; a < 8; ++a) {
            const Eigen::Vector3d p = x0.row(a);
            v.row(a) << -(k.xx * p.x() + k.xy * p.y()) * p.z(),
                -(k.xy * p.x() + k.yy * p.y()) * p.z(),
                0.5 * (k.xx * p.x() * p.x() + k.yy * p.y() * p.y()) +
                    k.xy * p.x() * p.y();
        }
        const double trace = thinning * (k.xx + k.yy);
        const double squares =
            k.xx * k.xx + k.yy * k.yy + 2 * k.xy * k.xy + trace * trace;
        const double expected = 2 * eta * squares * reference.volume * 1e-8 / 12;
        EXPECT_NEAR(viscous_element(reference, material, x0, v).dissipation_w / expected,
                    1,
                    1e-12);  // rounding
    }
}

TEST(ViscousForces, VanishInRigidMotionOfADeformedBody) {
    test::Random random(33);
    for (int trial = 0; trial < 20; ++trial) {
        const Moving m = random_motion(random);
        const Eigen::Vector3d spin(300 * random.uniform(), 300 * random.uniform(), 200);
        Positions8 v;
        for (int a = 0; a < 8; ++a) {
            const Eigen::Vector3d p = m.x.row(a).transpose();
            v.row(a) = (spin.cross(p) + Eigen::Vector3d(0.1, -0.2, 0.3)).transpose();
        }
        const ViscousState rigid = viscous_element(m.reference, rubber(), m.x, v);
        const ViscousState other = viscous_element(m.reference, rubber(), m.x, m.v);
        // Rounding, against a motion of like speed that does strain the element.
        EXPECT_LT(rigid.force_n.norm(), 1e-12 * other.force_n.norm());
    }
}

}  // namespace
}  // namespace magfsi::structure
