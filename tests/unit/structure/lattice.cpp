#include "structure/lattice/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/two_materials.h"

namespace magfsi::structure {
namespace {

std::string message(const Mesh& mesh, ElementVariant variant) {
    try {
        build_lattice(mesh.nodes, mesh.elements, {test::soft_material()}, {}, variant);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(BadElements, AnInvertedElementIsNamed) {
    Mesh mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
    std::swap(mesh.elements[5][0], mesh.elements[5][1]);
    EXPECT_NE(
        message(mesh, ElementVariant::full).find("element 5 of the mesh is inverted"),
        std::string::npos);
}

TEST(BadElements, AFoldedCornerIsFoundThoughTheVolumeIsPositive) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    for (double& coordinate : mesh.nodes[7]) coordinate -= 0.75e-4;
    EXPECT_NE(message(mesh, ElementVariant::full).find("at its corner 7"),
              std::string::npos);
}

TEST(BadElements, ANodeThatTheMeshLacksIsNamed) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    mesh.elements[0][3] = 8;
    EXPECT_EQ(message(mesh, ElementVariant::full),
              "element 0 names node 8, but the mesh has nodes 0 to 7");
}

TEST(BadElements, MeanFWithAShortInPlaneEdgeIsRefusedWithAdvice) {
    const Mesh mesh = box_mesh({{8e-4, 2e-4, 1e-4}, {16, 2, 1}});
    EXPECT_NE(message(mesh, ElementVariant::mean_f).find("use element assumed_strain"),
              std::string::npos);
    EXPECT_EQ(message(mesh, ElementVariant::full), "nothing thrown");
    EXPECT_EQ(message(mesh, ElementVariant::assumed_strain), "nothing thrown");
}

TEST(BadElements, MeanFTakesFlatElementsInAnyDirection) {
    for (const Box& box :
         {Box{{8e-4, 4e-4, 1e-4}, {4, 2, 1}}, Box{{1e-4, 8e-4, 4e-4}, {1, 4, 2}},
          Box{{8e-4, 2e-4, 2e-4}, {4, 2, 2}}}) {
        EXPECT_EQ(message(box_mesh(box), ElementVariant::mean_f), "nothing thrown");
    }
}

TEST(TwoMaterials, GiveANodeBetweenThemTheMassOfBoth) {
    const Body body = test::soft_and_stiff_bar();
    const Lattice lattice = build_lattice(body);
    const auto mass = lattice.node_mass_kg;
    const double volume = 8e-3 * 1e-3 * 0.5e-3;
    // Sums of some hundred numbers: rounding.
    EXPECT_NEAR(
        std::accumulate(mass.begin(), mass.end(), 0.0) / (0.5 * volume * (1860 + 930)), 1,
        1e-13);
    for (std::size_t n = 0; n < mass.size(); ++n) {
        const double x = body.mesh.nodes[n][0];
        const double density = std::abs(x - 4e-3) < 1e-9 ? 0.5 * (1860 + 930)
                               : x < 4e-3                ? 1860
                                                         : 930;
        EXPECT_NEAR(mass[n] / (density * lattice.node_volume_m3[n]), 1, 1e-13) << n;
    }
}

TEST(TwoMaterials, AreBitwiseOneWhereTheyAreTheSame) {
    Body one = test::soft_and_stiff_bar();
    one.other_materials.clear();
    one.element_material.clear();
    Body named = one;
    named.other_materials = {test::stiff_material()};
    named.element_material.assign(one.mesh.elements.size(), 0);
    EXPECT_EQ(build_lattice(one).node_mass_kg, build_lattice(named).node_mass_kg);
    std::vector<double> x;
    test::Random random(52);
    for (const Vec3& node : one.mesh.nodes) {
        for (double c : node) x.push_back(c + 2e-5 * random.uniform());
    }
    std::vector<double> a(x.size(), 0.0);
    std::vector<double> b(x.size(), 0.0);
    ElementKernel kernel;
    kernel.assign(build_lattice(one));
    kernel.add_forces(x.data(), a.data());
    kernel.assign(build_lattice(named));
    kernel.add_forces(x.data(), b.data());
    EXPECT_EQ(a, b);
}

// The bound of the elements: that of the material with the faster waves alone.
TEST(TwoMaterials, TakeTheStableStepOfTheFaster) {
    const Body both = test::soft_and_stiff_bar();
    Body soft = both;
    soft.other_materials.clear();
    soft.element_material.clear();
    Body stiff = soft;
    stiff.material = test::stiff_material();
    EXPECT_LT(stable_step_s(stiff), stable_step_s(soft));
    // The same brick elsewhere: rounded coordinates.
    EXPECT_NEAR(stable_step_s(both) / stable_step_s(stiff), 1, 1e-12);
}

TEST(TwoMaterials, AreRefusedWithoutANumberForEachElement) {
    Body body = test::soft_and_stiff_bar();
    body.element_material.back() = 2;
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
    EXPECT_THROW(stable_step_s(body), std::invalid_argument);
    body.element_material.pop_back();
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
    body.element_material.clear();
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
