// Every instruction set of the machine against the plain element.
#include <gtest/gtest.h>

#include <cstdlib>

#include "structure/lattice/element_kernel.h"
#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure {
namespace {

struct Sums {
    std::vector<double> force;
    double energy = 0;
    double smallest_j = 1e300;
};

std::vector<double> random_state(const Mesh& mesh) {
    test::Random random(13);
    std::vector<double> x;
    for (const Vec3& node : mesh.nodes) {
        for (double coordinate : node) x.push_back(coordinate + 5e-6 * random.uniform());
    }
    return x;
}

Sums plain(const Mesh& mesh, ElementVariant variant, const std::vector<double>& x) {
    Sums out;
    out.force.assign(x.size(), 0.0);
    for (const Hexahedron& element : mesh.elements) {
        Positions8 now;
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) now(a, d) = x[3 * element[a] + d];
        }
        const ElementState state =
            element_energy(element_reference(gather(mesh.nodes, element), variant, 0),
                           test::soft_material(), now);
        out.energy += state.energy_j;
        out.smallest_j = std::min(out.smallest_j, state.volume_ratio);
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d)
                out.force[3 * element[a] + d] += state.force_n(a, d);
        }
    }
    return out;
}

void expect_same(InstructionSet set, const Mesh& mesh, ElementVariant variant,
                 bool bricks) {
    const Lattice lattice =
        build_lattice(mesh.nodes, mesh.elements, {test::soft_material()}, {}, variant);
    ASSERT_EQ(lattice.bricks, bricks);
    const auto x = random_state(mesh);
    const Sums expected = plain(mesh, variant, x);
    double scale = 0;
    for (double f : expected.force) scale = std::max(scale, std::abs(f));
    ElementKernel kernel(set);
    kernel.assign(lattice);
    std::vector<double> force(x.size(), 0.0);
    const KernelResult result = kernel.add_forces(x.data(), force.data());
    // Other order of the same sums, logarithm to 2 ulp: a few roundings of K l^2 each.
    for (std::size_t q = 0; q < x.size(); ++q) {
        ASSERT_NEAR(force[q], expected.force[q], 1e-12 * scale);
    }
    EXPECT_NEAR(result.smallest_j, expected.smallest_j, 1e-13);
    std::vector<double> again(x.size(), 0.0);
    const KernelResult with_energy = kernel.add_forces_and_energy(x.data(), again.data());
    EXPECT_NEAR(with_energy.energy_j / expected.energy, 1, 1e-12);
    // Another compilation of the same sums: fused operations may round differently.
    for (std::size_t q = 0; q < x.size(); ++q) {
        ASSERT_NEAR(again[q], force[q], 1e-13 * scale);
    }
}

class Kernel : public ::testing::TestWithParam<InstructionSet> {};

// 45 elements: five batches and a part of one.
const Box box{{10e-4, 6e-4, 1.5e-4}, {5, 3, 3}};

TEST_P(Kernel, MatchesThePlainElementOnBricks) {
    for (ElementVariant variant : test::all_variants) {
        expect_same(GetParam(), box_mesh(box), variant, true);
    }
}

TEST_P(Kernel, MatchesThePlainElementOnDistortedElements) {
    const Mesh mesh = test::distorted_block(box, 3e-6, 14);
    for (ElementVariant variant : test::all_variants)
        expect_same(GetParam(), mesh, variant, false);
}

TEST_P(Kernel, NamesTheElementThatIsInvertedOrNotANumber) {
    const Mesh mesh = box_mesh(box);
    const Lattice lattice = build_lattice(
        mesh.nodes, mesh.elements, {test::soft_material()}, {}, ElementVariant::full);
    ElementKernel kernel(GetParam());
    const std::vector<int> some{3, 40, 44};
    kernel.assign(lattice, some,
                  std::vector<std::array<int, 8>>{mesh.elements[3], mesh.elements[40],
                                                  mesh.elements[44]});
    std::vector<double> x;
    for (const Vec3& node : mesh.nodes) x.insert(x.end(), node.begin(), node.end());
    std::vector<double> force(x.size(), 0.0);
    EXPECT_NEAR(kernel.add_forces(x.data(), force.data()).smallest_j, 1, 1e-14);
    // The last corner of the last element, drawn through the element; element 40 lacks
    // it.
    double* corner = &x[3 * static_cast<std::size_t>(mesh.elements[44][7])];
    const double height = corner[2];
    corner[2] -= 30e-5;
    const KernelResult inverted = kernel.add_forces(x.data(), force.data());
    EXPECT_LT(inverted.smallest_j, 0);
    EXPECT_EQ(inverted.element, 44);
    corner[2] = std::nan("");
    const KernelResult lost = kernel.add_forces(x.data(), force.data());
    EXPECT_EQ(lost.smallest_j, -INFINITY);
    EXPECT_EQ(lost.element, 44);
    corner[2] = height;
}

INSTANTIATE_TEST_SUITE_P(Isa, Kernel, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return name(set.param); });

TEST(KernelChoice, RefusesAnUnknownInstructionSet) {
    setenv("MAGFSI_ISA", "altivec", 1);
    EXPECT_THROW(ElementKernel(), std::invalid_argument);
    unsetenv("MAGFSI_ISA");
}

}  // namespace
}  // namespace magfsi::structure
