// The free magnetised strip in V (field at 45 degrees) and C (225) against finite
// elements (strip_harmonic.csv, Q2, 40 x 4 x 2 cells on half the width).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/validation/structure/reference_table.h"
#include "tests/validation/structure/static_bodies.h"

namespace magfsi::structure {
namespace {

// Largest relative error of end_to_end, mid_rise and total_bend.
double error_against(const test::ReferenceRow& row, const test::StripShape& found) {
    const auto relative = [&](double value, const char* column) {
        return std::abs(value / test::number(row, column) - 1);
    };
    return std::max({relative(found.end_to_end, "end_to_end/L"),
                     relative(found.mid_rise, "mid_rise/L"),
                     relative(found.total_bend_deg, "total_bend_deg")});
}

void expect_shapes(const std::array<int, 3>& elements, ElementVariant variant,
                   double strongest_t, double tolerance) {
    const Body body = test::harmonic_strip(elements, variant);
    NewtonSolver solver(body);
    for (const char* direction : {"45", "225"}) {
        std::vector<Vec3> nodes = body.mesh.nodes;
        StaticLoads from;
        for (const auto& row : test::reference_table("strip_harmonic.csv")) {
            const double field_t = 1e-3 * test::number(row, "B_mT");
            if (row.at("theta_B_deg") != direction || field_t > strongest_t ||
                row.at("source") != "fem3D 40x4x2") {
                continue;
            }
            const StaticLoads to = test::field_xz(field_t, std::stod(direction));
            const Equilibrium found = solver.follow(nodes, from, {&to, 1}).front();
            nodes = found.nodes_m;
            from = to;
            const test::StripShape shape = test::strip_shape(body, nodes);
            const double error = error_against(row, shape);
            std::printf(
                "%-14s %dx%dx%d theta %3s %2s mT: end_to_end %.5f (%s) mid_rise %.5f "
                "(%s) bend %.3f (%s) tilt %.2f (%s): %.2f %%, %d iterations, %.2f s\n",
                test::name_of(variant), elements[0], elements[1], elements[2], direction,
                row.at("B_mT").c_str(), shape.end_to_end, row.at("end_to_end/L").c_str(),
                shape.mid_rise, row.at("mid_rise/L").c_str(), shape.total_bend_deg,
                row.at("total_bend_deg").c_str(), shape.mid_angle_deg,
                row.at("mid_angle_deg").c_str(), 100 * error, found.iterations,
                found.seconds);
            EXPECT_LT(error, tolerance);
            EXPECT_EQ(found.negative_eigenvalues, 0);
            EXPECT_EQ(found.releases, 0);
        }
    }
}

// The reference itself moves by up to 0.1 % from 40 x 4 x 2 to 56 x 4 x 3 cells; 2 % is
// what two linear layers are expected to reach.
TEST(StripShape, TwoLayersOfAssumedStrainAreWithinTwoPercent) {
    expect_shapes({40, 8, 2}, ElementVariant::assumed_strain, 20e-3, 0.02);
}

// The V at 20 mT is close to losing its symmetry and tilts by 26 degrees under the small
// push that comes from the strain across the thickness, which one layer does not have:
// there its rise is 4 % off.
TEST(StripShape, OneLayerOfAssumedStrainIsWithinTwoPercentUpTo5mT) {
    expect_shapes({20, 4, 1}, ElementVariant::assumed_strain, 5e-3, 0.02);
}

// Three per cent: at 1 mT the linear bending of mean_f with two layers is that far off.
TEST(StripShape, TwoLayersOfMeanFAreWithinFourPercent) {
    expect_shapes({20, 8, 2}, ElementVariant::mean_f, 20e-3, 0.04);
}

}  // namespace
}  // namespace magfsi::structure
