// One element in the homogeneous states of homogeneous_states.csv, whose header derives
// them from eq. (1): nodal forces must add up to the nominal stress times the area,
// energies to U V0.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure {
namespace {

struct State {
    std::string name;
    double parameter, lateral, j, nominal, energy;
};

std::vector<State> read_states() {
    std::ifstream file(MAGFSI_HOMOGENEOUS_STATES);
    std::vector<State> out;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#' || line.starts_with("case")) continue;
        std::istringstream fields(line);
        std::vector<std::string> cell;
        for (std::string word; std::getline(fields, word, ',');) cell.push_back(word);
        out.push_back({cell.at(0), std::stod(cell.at(1)),
                       cell.at(2).empty() ? 0.0 : std::stod(cell.at(2)),
                       std::stod(cell.at(3)), std::stod(cell.at(4)),
                       std::stod(cell.at(6))});
    }
    return out;
}

// ln J = -(s^2 - 1) / (K/G) on a free lateral face; one Newton solve sharpens the table's
// nine digits to the last one.
double sharpen(double stretch, double other, int free_directions) {
    for (int i = 0; i < 5; ++i) {
        const double f = stretch * stretch - 1 +
                         20 * std::log(other * std::pow(stretch, free_directions));
        stretch -= f / (2 * stretch + 20 * free_directions / stretch);
    }
    return stretch;
}

Eigen::Matrix3d deformation(const State& state) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    const double p = state.parameter;
    if (state.name == "uniaxial") {
        const double s = sharpen(state.lateral, p, 2);
        f.diagonal() << p, s, s;
    } else if (state.name == "simple_shear") {
        f(0, 1) = p;
    } else if (state.name == "hydrostatic") {
        f.diagonal().setConstant(std::cbrt(p));
    } else if (state.name == "uniaxial_strain") {
        f(0, 0) = p;
    } else {
        f.diagonal() << p, sharpen(state.lateral, p, 1), 1;
    }
    return f;
}

TEST(HomogeneousStates, StressAndEnergyAreThoseOfEquationOne) {
    const Material material = test::soft_material();
    const double g = material.shear_modulus_pa;
    const auto states = read_states();
    ASSERT_GE(states.size(), 20U);
    test::Random random(11);
    const Positions8 x0 = test::distorted_element(random);
    for (ElementVariant variant : test::all_variants) {
        const ElementReference reference = element_reference(x0, variant, 0);
        for (const State& state : states) {
            const Eigen::Matrix3d f = deformation(state);
            const ElementState found =
                element_energy(reference, material, x0 * f.transpose());
            // f_a = -P b_a and sum_a b_a X_a^T = V0 I, so P = -sum f_a X_a^T / V0.
            const Eigen::Matrix3d p =
                -(found.force_n.transpose() * x0) / reference.volume / g;
            const double nominal = state.name == "simple_shear" ? p(0, 1) : p(0, 0);
            // The closed form at this F, to 1e-10; the table, to its own nine digits.
            const double log_j = std::log(f.determinant());
            const Eigen::Matrix3d exact = f + (20 * log_j - 1) * f.inverse().transpose();
            const double energy =
                0.5 * (f.squaredNorm() - 3) - log_j + 10 * log_j * log_j;
            EXPECT_LT((p - exact).norm(), 1e-10) << state.name << ' ' << state.parameter;
            EXPECT_NEAR(found.energy_j / reference.volume / g, energy, 1e-10)
                << state.name;
            EXPECT_NEAR(nominal, state.nominal, 2e-8 * (1 + std::abs(state.nominal)))
                << state.name << ' ' << state.parameter;
            EXPECT_NEAR(energy, state.energy, 2e-8 * (1 + state.energy)) << state.name;
            // Nine digits of a number above one: off by up to 5e-9.
            EXPECT_NEAR(found.volume_ratio, state.j, 5.1e-9) << state.name;
        }
    }
}

}  // namespace
}  // namespace magfsi::structure
