// Fig. 2: a plate of oblique domains. In a uniform field, forces act on domain borders
// and on the plate's outline, and nowhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "structure/magnetics/magnetization.h"
#include "structure/magnetics/magnetic_forces.h"
#include "structure/mesh/block_mesh.h"

namespace magfsi::structure {
namespace {

constexpr int cells = 4;
constexpr double magnetization_a_m = 81e3;
constexpr double angle_rad = std::numbers::pi / 3;

ObliquePlate plate(const std::array<int, 3>& elements_per_cell) {
    ObliquePlate out;
    out.cells = {cells, cells};
    out.length_a_m = out.length_b_m = 10e-3;
    out.angle_rad = angle_rad;
    out.thickness_m = 1e-3;
    out.elements_per_cell = elements_per_cell;
    return out;
}

// Across the oblique sides of each cell, in turn to the right and to the left.
std::vector<Vec3> origami(const Mesh& mesh) {
    std::map<std::string, Vec3> vectors;
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const double sense = column % 2 == 0 ? 1 : -1;
            const double lean = row % 2 == 0 ? 1 : -1;
            vectors["row " + std::to_string(row) + " column " + std::to_string(column)] =
                {sense * magnetization_a_m * std::sin(angle_rad),
                 -sense * lean * magnetization_a_m * std::cos(angle_rad), 0};
        }
    }
    return region_magnetization(mesh, vectors);
}

// Nodes that only elements of one region share, and not on the outline.
std::vector<bool> inside_a_cell(const Mesh& mesh) {
    std::vector<int> region(mesh.nodes.size(), -1);
    std::vector<bool> inside(mesh.nodes.size(), true);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int node : mesh.elements[e]) {
            const auto n = static_cast<std::size_t>(node);
            if (region[n] >= 0 && region[n] != mesh.region[e]) inside[n] = false;
            region[n] = mesh.region[e];
        }
    }
    for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) {
        for (int node : mesh.faces.at(name))
            inside[static_cast<std::size_t>(node)] = false;
    }
    return inside;
}

TEST(OrigamiCharges, VanishInsideTheCells) {
    for (const auto& elements : {std::array{4, 4, 1}, std::array{6, 5, 2}}) {
        const Mesh mesh = oblique_mesh(plate(elements));
        const auto charge = nodal_charges(mesh.nodes, mesh.elements, origami(mesh));
        const auto inside = inside_a_cell(mesh);
        double largest = 0, largest_inside = 0, sum = 0;
        int count = 0;
        for (std::size_t n = 0; n < charge.size(); ++n) {
            largest = std::max(largest, std::abs(charge[n]));
            sum += charge[n];
            if (!inside[n]) continue;
            ++count;
            largest_inside = std::max(largest_inside, std::abs(charge[n]));
        }
        std::printf("%d x %d x %d a cell: largest inside %.1e of the largest, sum %.1e\n",
                    elements[0], elements[1], elements[2], largest_inside / largest,
                    std::abs(sum) / largest);
        EXPECT_EQ(count, cells * cells * (elements[0] - 1) * (elements[1] - 1) *
                             (elements[2] + 1));
        // Rounding: up to eight terms, each as large as the largest.
        EXPECT_LT(largest_inside, 1e-14 * largest);
        EXPECT_LT(std::abs(sum), 1e-12 * largest);  // thousands of terms
    }
}

TEST(OrigamiCharges, AnObliqueBorderCarriesTwiceTheMagnetizationTimesItsArea) {
    const std::array elements{4, 4, 1};
    const Mesh mesh = oblique_mesh(plate(elements));
    const auto charge = nodal_charges(mesh.nodes, mesh.elements, origami(mesh));
    // Nodes strictly within the side between columns 0 and 1 of row 0, on both faces:
    // three quarters of its area. M is across the side, towards it from both cells.
    double sum = 0;
    for (std::size_t n = 0; n < charge.size(); ++n) {
        const auto& [x, y, z] = mesh.nodes[n];
        const double from_side = x - 10e-3 - y / std::tan(angle_rad);
        const bool within = y > 1e-6 && y < 10e-3 * std::sin(angle_rad) - 1e-6;
        if (within && std::abs(from_side) < 1e-9) sum += charge[n];
    }
    const double area_m2 = 0.75 * 10e-3 * 1e-3;
    EXPECT_NEAR(sum / (2 * magnetization_a_m * area_m2), 1, 1e-12);  // rounding
}

}  // namespace
}  // namespace magfsi::structure
