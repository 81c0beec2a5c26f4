// A body of two materials: each element is of its own, and a node between them of both.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "structure/body.h"
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/plain_element.h"
#include "tests/unit/structure/two_materials.h"

namespace magfsi::structure {
namespace {

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

// The kernel's forces, energy and smallest J against the plain elements, one by one.
TEST(TwoMaterials, GiveForcesAndEnergyOfTheirOwn) {
    for (ElementVariant variant : test::all_variants) {
        Body body = test::soft_and_stiff_bar(variant);
        // Alternating along x too, so that every batch of eight holds both at first.
        for (std::size_t e = 0; e < body.element_material.size(); e += 3) {
            body.element_material[e] = 1 - body.element_material[e];
        }
        test::Random random(51);
        std::vector<double> x;
        for (const Vec3& node : body.mesh.nodes) {
            for (double c : node) x.push_back(c + 2e-5 * random.uniform());
        }
        std::vector<double> expected(x.size(), 0.0);
        double energy = 0;
        double smallest_j = INFINITY;
        int worst = -1;
        for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            const Hexahedron& nodes = body.mesh.elements[e];
            Positions8 here;
            for (int q = 0; q < 24; ++q) here(q / 3, q % 3) = x[3 * nodes[q / 3] + q % 3];
            const ElementState state = element_energy(
                element_reference(gather(body.mesh.nodes, nodes), variant, 0),
                material_of(body, e), here);
            energy += state.energy_j;
            if (state.volume_ratio < smallest_j) worst = static_cast<int>(e);
            smallest_j = std::min(smallest_j, state.volume_ratio);
            for (int q = 0; q < 24; ++q) {
                expected[3 * nodes[q / 3] + q % 3] += state.force_n(q / 3, q % 3);
            }
        }
        ElementKernel kernel;
        kernel.assign(build_lattice(body));
        EXPECT_EQ(kernel.size(), body.mesh.elements.size());
        std::vector<double> force(x.size(), 0.0);
        const KernelResult result = kernel.add_forces_and_energy(x.data(), force.data());
        // Another order of the same sums; energies cancel against G V at rest.
        EXPECT_NEAR(result.energy_j / energy, 1, 1e-10);
        EXPECT_NEAR(result.smallest_j, smallest_j, 1e-12);
        EXPECT_EQ(result.element, worst);
        double scale = 0;
        for (double f : expected) scale = std::max(scale, std::abs(f));
        for (std::size_t q = 0; q < x.size(); ++q) {
            ASSERT_NEAR(force[q], expected[q], 1e-11 * scale) << q;
        }
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

// Only the stiff half is viscous: all it takes out is that of its elements.
TEST(TwoMaterials, AreViscousEachByItself) {
    Body body = test::soft_and_stiff_bar();
    body.other_materials[0].viscosity_pa_s = 0.7;
    test::Random random(53);
    std::vector<double> x, v;
    for (const Vec3& node : body.mesh.nodes) {
        for (double c : node) {
            x.push_back(c);
            v.push_back(0.1 * random.uniform());
        }
    }
    double expected = 0;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const Hexahedron& nodes = body.mesh.elements[e];
        Positions8 moving;
        for (int q = 0; q < 24; ++q) moving(q / 3, q % 3) = v[3 * nodes[q / 3] + q % 3];
        const Positions8 here = gather(body.mesh.nodes, nodes);
        expected += viscous_element(element_reference(here, body.element, 0),
                                    material_of(body, e), here, moving)
                        .dissipation_w;
    }
    ViscousKernel kernel;
    kernel.assign(build_lattice(body));
    std::vector<double> force(x.size(), 0.0);
    // Another order of the same sums.
    EXPECT_NEAR(kernel.add_forces(x.data(), v.data(), force.data()) / expected, 1, 1e-12);
    for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
        if (body.mesh.nodes[n][0] < 3.9e-3) {
            ASSERT_EQ(force[3 * n], 0) << n;
        }
    }
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
