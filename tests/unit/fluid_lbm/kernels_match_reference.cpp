// Every kernel of every instruction set that this machine has, in every precision, agrees
// with the plain formula of its collision, for row lengths with and without a tail, and
// conserves mass and gives momentum F.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_lbm/streaming/kernel_choice.h"
#include "tests/unit/fluid_lbm/kernel_row.h"

namespace magfsi::fluid {
namespace {

using reference::Cell;
using reference::Vec3;

constexpr double tau = 0.53, magic = 0.2, eddy_constant = 0.17;

using Case = std::tuple<Collision, Precision, bool, bool>;  // forced, eddy viscosity

class Kernels : public testing::TestWithParam<Case> {
  protected:
    const Collision collision = std::get<0>(GetParam());
    const Precision precision = std::get<1>(GetParam());
    const bool forced = std::get<2>(GetParam()), eddies = std::get<3>(GetParam());

    // Values that float holds, so that the formula starts from the kernel's own input.
    void make_cells(std::size_t length) {
        std::mt19937 random(static_cast<unsigned>(length));
        cells_.resize(length);
        force_.assign(length, Vec3{});
        for (Cell& cell : cells_) {
            cell = reference::random_cell(random);
            for (double& f : cell) f = static_cast<float>(f);
        }
        if (!forced) return;
        for (Vec3& f : force_) {
            f = reference::random_force(random);
            for (double& component : f) component = static_cast<float>(component);
        }
    }
    std::vector<Cell> run(const NamedKernels& set) const {
        return std::visit(
            [&](const auto& kernels) {
                const auto row = forced ? kernels.rows.forced : kernels.rows.plain;
                return collide(row, cells_, force_, {1 / tau, magic, eddy_constant});
            },
            run_kernels(set.kernels, precision, collision, eddies));
    }
    Cell expected(std::size_t x) const {
        const Cell& f = cells_[x];
        const Vec3& force = force_[x];
        const double omega =
            eddies ? reference::eddy_rate(f, force, 1 / tau, eddy_constant) : 1 / tau;
        if (collision == Collision::bgk) return reference::bgk(f, force, omega);
        if (collision == Collision::trt) return reference::trt(f, force, omega, magic);
        return reference::recursive_regularized(f, force, omega);
    }
    // Populations are of order 0.1 and moments sum 19 of order 1: a few dozen roundings
    // of what is computed with, or one of what is stored.
    double rounding() const {
        if (precision == Precision::double_) return 2e-15;
        return precision == Precision::float_ ? 1e-7 : 1e-8;
    }

    std::vector<Cell> cells_;
    std::vector<Vec3> force_;
};

TEST_P(Kernels, AgreeWithTheFormula) {
    double worst = 0;
    for (const NamedKernels& set : available_kernels()) {
        for (std::size_t length : {1, 5, 8, 13, 33}) {
            make_cells(length);
            const auto out = run(set);
            for (std::size_t x = 0; x < length; ++x) {
                const Cell wanted = expected(x);
                for (int q = 0; q < d3q19::directions; ++q) {
                    worst = std::max(worst, std::abs(out[x][q] - wanted[q]));
                }
            }
        }
    }
    std::printf("largest difference from the formula: %.2e\n", worst);
    EXPECT_LT(worst, rounding());
}

TEST_P(Kernels, ConserveMassAndGiveMomentum) {
    double worst = 0;
    for (const NamedKernels& set : available_kernels()) {
        make_cells(33);
        const auto out = run(set);
        for (std::size_t x = 0; x < cells_.size(); ++x) {
            double mass = 0;
            Vec3 momentum{};
            for (int q = 0; q < d3q19::directions; ++q) {
                const double change = out[x][q] - cells_[x][q];
                mass += change;
                for (int a = 0; a < 3; ++a) momentum[a] += d3q19::c[q][a] * change;
            }
            worst = std::max(worst, std::abs(mass));
            for (int a = 0; a < 3; ++a) {
                worst = std::max(worst, std::abs(momentum[a] - force_[x][a]));
            }
        }
    }
    std::printf("largest error of mass or momentum: %.2e\n", worst);
    EXPECT_LT(worst, rounding());
}

std::string name(const testing::TestParamInfo<Case>& info) {
    const auto& [collision, precision, forced, eddies] = info.param;
    return std::string(name_of(collision)) + "_" + std::string(name_of(precision)) +
           (forced ? "_forced" : "") + (eddies ? "_eddies" : "");
}

INSTANTIATE_TEST_SUITE_P(
    All, Kernels,
    testing::Combine(
        testing::Values(Collision::bgk, Collision::trt, Collision::recursive_regularized),
        testing::Values(Precision::double_, Precision::float_, Precision::float_double),
        testing::Bool(), testing::Bool()),
    name);

}  // namespace
}  // namespace magfsi::fluid
