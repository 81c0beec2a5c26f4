#include "structure/magnetics/magnetic_forces.h"

#include <gtest/gtest.h>

#include <numbers>

#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

double largest(const std::vector<double>& values) {
    double out = 0;
    for (double value : values) out = std::max(out, std::abs(value));
    return out;
}

TEST(MagneticForces, SumToZeroOnADistortedBody) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {10, 6, 3}}, 8e-6, 16);
    const auto m = harmonic_magnetization(mesh, {62e3, 1e-3, 0.7, 0, 2});
    const auto q = nodal_charges(mesh.nodes, mesh.elements, m);
    double sum = 0;
    for (double charge : q) sum += charge;
    EXPECT_LT(std::abs(sum), 1e-13 * largest(q));  // rounding of 300 terms
}

TEST(MagneticForces, VanishInsideAUniformlyMagnetisedBox) {  // Fig. 1b
    const Box box{{5e-4, 4e-4, 3e-4}, {5, 4, 3}};
    const Mesh mesh = box_mesh(box);
    const Vec3 m{143e3, 0, 0};
    const auto q =
        nodal_charges(mesh.nodes, mesh.elements, uniform_magnetization(mesh, m));
    double left = 0;
    double right = 0;
    for (std::size_t a = 0; a < q.size(); ++a) {
        const double x = mesh.nodes[a][0];
        if (x > 1e-6 && x < 4.99e-4) {
            EXPECT_LT(std::abs(q[a]), 1e-13 * largest(q));  // rounding
        }
        (x < 2.5e-4 ? left : right) += q[a];
    }
    // The end faces carry -M A and M A.
    EXPECT_NEAR(left, -143e3 * 4e-4 * 3e-4, 1e-13);
    EXPECT_NEAR(right, 143e3 * 4e-4 * 3e-4, 1e-13);
}

TEST(MagneticForces, DipoleIsMagnetizationTimesVolume) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {5, 3, 3}}, 8e-6, 17);
    const Vec3 m{1e4, -2e4, 3e4};
    const auto q =
        nodal_charges(mesh.nodes, mesh.elements, uniform_magnetization(mesh, m));
    double volume = 0;
    for (const Hexahedron& element : mesh.elements) {
        volume += integrate_hexahedron(gather(mesh.nodes, element), 0).volume;
    }
    for (int d = 0; d < 3; ++d) {
        double dipole = 0;
        for (std::size_t a = 0; a < q.size(); ++a) dipole += q[a] * mesh.nodes[a][d];
        EXPECT_NEAR(dipole / (m[d] * volume), 1, 1e-12);  // charges of both signs cancel
    }
}

TEST(MagneticForces, RefuseAMagnetisationOfAnotherMesh) {
    const Mesh mesh = box_mesh({{1, 1, 1}, {2, 1, 1}});
    EXPECT_THROW(nodal_charges(mesh.nodes, mesh.elements, {Vec3{1, 0, 0}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
