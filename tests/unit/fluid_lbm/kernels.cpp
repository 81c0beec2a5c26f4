// SPDX-License-Identifier: GPL-2.0-or-later
// Every kernel of every instruction set that this machine has agrees with formulas that
// are written straight from the literature, one cell at a time; what the formulas must
// have themselves: moments of the lattice, of the force and of the eddy viscosity.
#include <cmath>
#include <random>

#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "tests/unit/fluid_lbm/collision_reference.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

using reference::Cell;

constexpr double rounding_of_moments = 1e-15;  // sums of 19 terms below 1/3

// Populations after collision, each under its own direction.
template <class Real>
std::vector<reference::Cell> collide(RowKernel<Real> kernel,
                                     const std::vector<reference::Cell>& cells,
                                     const std::vector<Vec3>& force,
                                     const CollisionParameters& parameters) {
    using namespace d3q19;
    const std::size_t n = cells.size();
    std::vector<Real> rows[directions], force_rows[3];
    Real* at[directions];
    const Real* force_at[3];
    for (int q = 0; q < directions; ++q) {
        rows[q].resize(n);
        for (std::size_t x = 0; x < n; ++x) rows[q][x] = static_cast<Real>(cells[x][q]);
        at[q] = rows[q].data();
    }
    for (int a = 0; a < 3; ++a) {
        force_rows[a].resize(n);
        for (std::size_t x = 0; x < n; ++x)
            force_rows[a][x] = static_cast<Real>(force[x][a]);
        force_at[a] = force_rows[a].data();
    }
    kernel(at, force_at, static_cast<std::ptrdiff_t>(n), parameters);
    std::vector<reference::Cell> out(n);
    for (int q = 0; q < directions; ++q) {
        for (std::size_t x = 0; x < n; ++x) out[x][q] = rows[opposite(q)][x];
    }
    return out;
}

// ---- Moments of the weights that D3Q19 must have for Navier-Stokes.

using namespace d3q19;

double delta(int a, int b) {
    return a == b ? 1 : 0;
}

TEST(LatticeIdentities, OppositeReversesVelocity) {
    for (int q = 0; q < directions; ++q) {
        EXPECT_EQ(opposite(opposite(q)), q);
        for (int a = 0; a < 3; ++a) EXPECT_EQ(c[opposite(q)][a], -c[q][a]);
    }
}

TEST(LatticeIdentities, MomentsToThirdOrder) {
    double zeroth = 0;
    for (int q = 0; q < directions; ++q) zeroth += weight(q);
    EXPECT_NEAR(zeroth, 1, rounding_of_moments);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int d = 0; d < 3; ++d) {
                double first = 0, second = 0, third = 0;
                for (int q = 0; q < directions; ++q) {
                    first += weight(q) * c[q][a];
                    second += weight(q) * c[q][a] * c[q][b];
                    third += weight(q) * c[q][a] * c[q][b] * c[q][d];
                }
                EXPECT_NEAR(first, 0, rounding_of_moments);
                EXPECT_NEAR(second, cs2 * delta(a, b), rounding_of_moments);
                EXPECT_NEAR(third, 0, rounding_of_moments);
            }
        }
    }
}

TEST(LatticeIdentities, FourthMomentIsIsotropic) {
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int d = 0; d < 3; ++d) {
                for (int e = 0; e < 3; ++e) {
                    double fourth = 0;
                    for (int q = 0; q < directions; ++q) {
                        fourth += weight(q) * c[q][a] * c[q][b] * c[q][d] * c[q][e];
                    }
                    const double isotropic = delta(a, b) * delta(d, e) +
                                             delta(a, d) * delta(b, e) +
                                             delta(a, e) * delta(b, d);
                    EXPECT_NEAR(fourth, cs2 * cs2 * isotropic, rounding_of_moments);
                }
            }
        }
    }
}

// ---- Guo's source has the moments 0, F and u F + F u. With omega = 0 a forced collision
// adds exactly the source.

void expect_moments(const Cell& before, const Cell& after, const Vec3& force) {
    using namespace d3q19;
    const Vec3 u = reference::flow(before, force).u;
    double mass = 0;
    for (int q = 0; q < directions; ++q) mass += after[q] - before[q];
    EXPECT_NEAR(mass, 0, rounding_of_moments);
    for (int a = 0; a < 3; ++a) {
        double momentum = 0;
        for (int q = 0; q < directions; ++q) momentum += c[q][a] * (after[q] - before[q]);
        EXPECT_NEAR(momentum, force[a], rounding_of_moments);
        for (int b = 0; b < 3; ++b) {
            double stress = 0;
            for (int q = 0; q < directions; ++q) {
                stress += c[q][a] * c[q][b] * (after[q] - before[q]);
            }
            EXPECT_NEAR(stress, u[a] * force[b] + u[b] * force[a], rounding_of_moments);
        }
    }
}

// A rate of 0 of the even moments; the magic number that gives 0 for the odd ones.
const CollisionParameters no_relaxation{0, 1e300, 0};

class ForcingMoments : public testing::TestWithParam<Collision> {};

TEST_P(ForcingMoments, OfEveryInstructionSet) {
    std::mt19937 random(1);
    std::vector<Cell> cells(13);
    std::vector<Vec3> force(cells.size());
    for (Cell& cell : cells) cell = reference::random_cell(random);
    for (Vec3& f : force) f = reference::random_force(random);
    for (const InstructionSet set : available_instruction_sets()) {
        SCOPED_TRACE(magfsi::name(set));
        const auto kernels = std::get<RowKernels<double>>(
            choose_kernels(set, Precision::double_, GetParam(), LocalViscosity::none));
        const auto out = collide(kernels.forced, cells, force, no_relaxation);
        for (std::size_t x = 0; x < cells.size(); ++x) {
            expect_moments(cells[x], out[x], force[x]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ForcingMoments, every_collision);

// ---- In every precision, for row lengths with and without a tail; mass is conserved and
// the momentum gains F.

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
    std::vector<Cell> run(InstructionSet set) const {
        return std::visit(
            [&](const auto& kernels) {
                const auto row = forced ? kernels.forced : kernels.plain;
                return collide(row, cells_, force_, {1 / tau, magic, eddy_constant});
            },
            choose_kernels(set, precision, collision,
                           eddies ? LocalViscosity::eddies : LocalViscosity::none));
    }
    Cell expected(std::size_t x) const {
        const Cell& f = cells_[x];
        const Vec3& force = force_[x];
        const double omega =
            eddies ? reference::eddy_rate(f, force, 1 / tau, eddy_constant) : 1 / tau;
        if (collision == Collision::bgk) return reference::bgk(f, force, omega);
        if (collision == Collision::trt) return reference::trt(f, force, omega, magic);
        if (collision == Collision::recursive_mrt)
            return reference::recursive_mrt(f, force, omega, magic);
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

TEST_P(Kernels, AgreeWithTheFormulaConserveMassAndGiveMomentum) {
    double worst = 0, worst_sum = 0;
    for (const InstructionSet set : available_instruction_sets()) {
        for (std::size_t length : {1, 5, 8, 13, 33}) {
            make_cells(length);
            const auto out = run(set);
            for (std::size_t x = 0; x < length; ++x) {
                const Cell wanted = expected(x);
                double mass = 0;
                Vec3 momentum{};
                for (int q = 0; q < d3q19::directions; ++q) {
                    worst = std::max(worst, std::abs(out[x][q] - wanted[q]));
                    const double change = out[x][q] - cells_[x][q];
                    mass += change;
                    for (int a = 0; a < 3; ++a) momentum[a] += d3q19::c[q][a] * change;
                }
                worst_sum = std::max(worst_sum, std::abs(mass));
                for (int a = 0; a < 3; ++a)
                    worst_sum = std::max(worst_sum, std::abs(momentum[a] - force_[x][a]));
            }
        }
    }
    std::printf("largest difference from the formula %.2e, of a sum %.2e\n", worst,
                worst_sum);
    EXPECT_LT(worst, rounding());
    EXPECT_LT(worst_sum, rounding());
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    const auto& [collision, precision, forced, eddies] = info.param;
    return std::string(name_of(collision)) + "_" + std::string(name_of(precision)) +
           (forced ? "_forced" : "") + (eddies ? "_eddies" : "");
}

INSTANTIATE_TEST_SUITE_P(All, Kernels,
                         testing::Combine(every_collision, every_precision,
                                          testing::Bool(), testing::Bool()),
                         case_name);

// ---- With a rate of its own, the trace n of the stress leaves the cell before the
// collision, which then has the stress without it, and comes back times 1 - rate, both by
// its Hermite polynomial w 3/2 (c^2 - 1).

class OwnTrace : public Kernels {
  protected:
    static void add_trace(Cell& f, double much) {
        for (int q = 0; q < directions; ++q) {
            const double c2 = c[q][0] * c[q][0] + c[q][1] * c[q][1] + c[q][2] * c[q][2];
            f[q] += weight(q) * 1.5 * (c2 - 1) * much;
        }
    }
};

TEST_P(OwnTrace, RelaxesByItself) {
    constexpr double bulk = 0.07;
    double worst = 0;
    for (const InstructionSet set : available_instruction_sets()) {
        make_cells(13);
        const auto out = std::visit(
            [&](const auto& kernels) {
                return collide(forced ? kernels.forced : kernels.plain, cells_, force_,
                               {1 / tau, magic, eddy_constant, nullptr, bulk});
            },
            choose_kernels(set, precision, collision,
                           eddies ? LocalViscosity::eddies : LocalViscosity::none,
                           TraceRate::own));
        for (std::size_t x = 0; x < cells_.size(); ++x) {
            const auto n = reference::viscous_stress(cells_[x], force_[x]);
            const double trace = n[0][0] + n[1][1] + n[2][2];
            add_trace(cells_[x], -trace);
            Cell wanted = expected(x);
            add_trace(wanted, (1 - bulk) * trace);
            for (int q = 0; q < directions; ++q)
                worst = std::max(worst, std::abs(out[x][q] - wanted[q]));
        }
    }
    EXPECT_LT(worst, rounding());
}

INSTANTIATE_TEST_SUITE_P(
    All, OwnTrace,
    testing::Combine(testing::Values(Collision::trt, Collision::recursive_regularized,
                                     Collision::recursive_mrt),
                     every_precision, testing::Bool(), testing::Bool()),
    case_name);

TEST(BulkViscosity, IsRefusedByACollisionWithOneRate) {
    EXPECT_THROW(choose_kernels(InstructionSet::sse2, Precision::double_, Collision::bgk,
                                LocalViscosity::none, TraceRate::own),
                 std::invalid_argument);
}

// ---- Smagorinsky's relation: populations that carry the viscous stress of a known
// velocity gradient at the whole relaxation time give that time back,
//   tau = tau_0 + 3 C^2 |S|,  |S| = sqrt(2 S : S).

TEST(EddyViscosity, FollowsTheRateOfStrain) {
    constexpr double tau_0 = 0.503, constant = 0.17;
    LocalFlow flow;
    flow.density_excess = 0.01;
    flow.velocity = {0.05, -0.02, 0.03};
    // Free of divergence, as the relation's stress has no bulk part.
    flow.gradient = {{{0.02, 0.05, -0.01}, {0.01, -0.03, 0.04}, {-0.06, 0.02, 0.01}}};
    double squared = 0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double s = 0.5 * (flow.gradient[a][b] + flow.gradient[b][a]);
            squared += 2 * s * s;
        }
    }
    const double tau_eddy = tau_0 + 3 * constant * constant * std::sqrt(squared);
    reference::Cell f;
    for (int q = 0; q < d3q19::directions; ++q) f[q] = flow_population(q, flow, tau_eddy);
    const double found = 1 / reference::eddy_rate(f, {}, 1 / tau_0, constant);
    EXPECT_NEAR(found, tau_eddy, 1e-14);  // a few roundings; tau - tau_0 is 0.007
    EXPECT_GT(tau_eddy - tau_0, 1e-3);
}

}  // namespace
}  // namespace magfsi::fluid
