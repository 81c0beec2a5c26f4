// Every kernel of every instruction set that this machine has agrees with the plain
// formula of its collision, for row lengths with and without a tail, and conserves mass
// and gives momentum F.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_lbm/streaming/kernel_choice.h"
#include "tests/unit/fluid_lbm/kernel_row.h"

namespace magfsi::fluid {
namespace {

using reference::Cell;
using reference::Vec3;

struct Case {
    Collision collision;
    bool forced;
};

class Kernels : public testing::TestWithParam<Case> {
  protected:
    static constexpr double omega = 1 / 0.53;

    void make_cells(std::size_t length) {
        std::mt19937 random(static_cast<unsigned>(length));
        cells_.resize(length);
        force_.assign(length, Vec3{});
        for (Cell& cell : cells_) cell = reference::random_cell(random);
        if (!GetParam().forced) return;
        for (Vec3& f : force_) f = reference::random_force(random);
    }
    std::vector<Cell> run(const NamedKernels& set) const {
        const RowKernels kernels = row_kernels(set.kernels, GetParam().collision);
        return collide(GetParam().forced ? kernels.forced : kernels.plain, cells_, force_,
                       omega);
    }
    Cell expected(std::size_t x) const {
        return GetParam().collision == Collision::bgk
                   ? reference::bgk(cells_[x], force_[x], omega)
                   : reference::recursive_regularized(cells_[x], force_[x], omega);
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
    RecordProperty("worst", std::to_string(worst));
    std::printf("largest difference from the formula: %.2e\n", worst);
    // Populations are of order 0.1 and moments sum 19 of order 1: a few dozen roundings.
    EXPECT_LT(worst, 1e-14);
}

TEST_P(Kernels, ConserveMassAndGiveMomentum) {
    for (const NamedKernels& set : available_kernels()) {
        SCOPED_TRACE(set.name);
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
            // Sums of 19 terms below 0.1 with a rounding of 1e-17 each.
            EXPECT_NEAR(mass, 0, 1e-15);
            for (int a = 0; a < 3; ++a) EXPECT_NEAR(momentum[a], force_[x][a], 1e-15);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, Kernels,
    testing::Values(Case{Collision::bgk, false}, Case{Collision::bgk, true},
                    Case{Collision::recursive_regularized, false},
                    Case{Collision::recursive_regularized, true}),
    [](const auto& kernel_case) {
        return std::string(kernel_case.param.collision == Collision::bgk ? "Bgk"
                                                                         : "Recursive") +
               (kernel_case.param.forced ? "Forced" : "Plain");
    });

}  // namespace
}  // namespace magfsi::fluid
