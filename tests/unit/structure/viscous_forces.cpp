// Kelvin-Voigt damping: it dissipates what its model says, never resists rigid motion,
// and the fast kernel does the same as the plain element.
#include <gtest/gtest.h>

#include <cstdlib>

#include "structure/lattice/element.h"
#include "structure/lattice/element_advice.h"
#include "structure/lattice/element_kernel.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

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

class ViscousIsa : public ::testing::TestWithParam<InstructionSet> {};

void expect_same(InstructionSet set, const Mesh& mesh, bool bricks) {
    const Material material = rubber();
    const Lattice lattice =
        build_lattice(mesh.nodes, mesh.elements, {material}, {}, ElementVariant::full);
    ASSERT_EQ(lattice.bricks, bricks);
    test::Random random(34);
    std::vector<double> x, v;
    for (const Vec3& node : mesh.nodes) {
        for (double coordinate : node) {
            x.push_back(coordinate + 5e-6 * random.uniform());
            v.push_back(0.1 * random.uniform());
        }
    }
    std::vector<double> expected(x.size(), 0.0);
    double dissipation = 0;
    for (const Hexahedron& element : mesh.elements) {
        Positions8 here, moving;
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) {
                here(a, d) = x[3 * element[a] + d];
                moving(a, d) = v[3 * element[a] + d];
            }
        }
        const ViscousState state = viscous_element(
            element_reference(gather(mesh.nodes, element), ElementVariant::full, 0),
            material, here, moving);
        dissipation += state.dissipation_w;
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) {
                expected[3 * element[a] + d] += state.force_n(a, d);
            }
        }
    }
    double scale = 0;
    for (double f : expected) scale = std::max(scale, std::abs(f));
    ViscousKernel kernel(set);
    kernel.assign(lattice);
    std::vector<double> force(x.size(), 0.0);
    EXPECT_NEAR(kernel.add_forces(x.data(), v.data(), force.data()) / dissipation, 1,
                1e-12);
    // Another order of the same sums.
    for (std::size_t q = 0; q < x.size(); ++q) {
        ASSERT_NEAR(force[q], expected[q], 1e-12 * scale);
    }
}

// 45 elements: five batches and a part of one.
const Box box{{10e-4, 6e-4, 1.5e-4}, {5, 3, 3}};

TEST_P(ViscousIsa, MatchesThePlainElement) {
    expect_same(GetParam(), box_mesh(box), true);
    expect_same(GetParam(), test::distorted_block(box, 3e-6, 35), false);
}

INSTANTIATE_TEST_SUITE_P(Isa, ViscousIsa,
                         ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return name(set.param); });

TEST(ViscousForces, RefuseANegativeViscosity) {
    const Mesh mesh = box_mesh(box);
    Material material = rubber();
    material.viscosity_pa_s = -1;
    const Lattice lattice =
        build_lattice(mesh.nodes, mesh.elements, {material}, {}, ElementVariant::full);
    ViscousKernel kernel;
    EXPECT_THROW(kernel.assign(lattice), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
