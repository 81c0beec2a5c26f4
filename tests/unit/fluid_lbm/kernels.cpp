// Every kernel of every instruction set that this machine has agrees with formulas that
// are written straight from the literature, one cell at a time; what the formulas must
// have themselves: moments of the lattice, of the force and of the eddy viscosity.
#include <cmath>
#include <random>

#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

// f holds populations minus weights.
namespace magfsi::fluid::reference {

using namespace d3q19;
using Cell = std::array<double, directions>;

struct Flow {
    double density = 1;
    Vec3 u{};
};

Flow flow(const Cell& f, const Vec3& force) {
    Flow flow;
    Vec3 j{};
    for (int q = 0; q < directions; ++q) {
        flow.density += f[q];
        for (int a = 0; a < 3; ++a) j[a] += c[q][a] * f[q];
    }
    for (int a = 0; a < 3; ++a) flow.u[a] = (j[a] + 0.5 * force[a]) / flow.density;
    return flow;
}

double dot(const int (&velocity)[3], const Vec3& a) {
    return velocity[0] * a[0] + velocity[1] * a[1] + velocity[2] * a[2];
}

double guo(int q, const Vec3& u, const Vec3& force) {
    double cuf = 0;
    for (int a = 0; a < 3; ++a) cuf += (c[q][a] - u[a]) * force[a];
    return weight(q) * (3 * cuf + 9 * dot(c[q], u) * dot(c[q], force));
}

Cell bgk(const Cell& f, const Vec3& force, double omega) {
    const Flow s = flow(f, force);
    const double uu = s.u[0] * s.u[0] + s.u[1] * s.u[1] + s.u[2] * s.u[2];
    Cell out;
    for (int q = 0; q < directions; ++q) {
        const double cu = dot(c[q], s.u);
        const double equilibrium =
            weight(q) * s.density * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * uu) - weight(q);
        out[q] =
            f[q] + omega * (equilibrium - f[q]) + (1 - 0.5 * omega) * guo(q, s.u, force);
    }
    return out;
}

Cell trt(const Cell& f, const Vec3& force, double omega, double magic) {
    const double odd_rate = 1 / (0.5 + magic / (1 / omega - 0.5));
    const Cell target = bgk(f, force, 1);  // equilibrium and half of the source
    const Flow s = flow(f, force);
    Cell out;
    for (int q = 0; q < directions; ++q) {
        const int r = opposite(q);
        const double source = guo(q, s.u, force), source_r = guo(r, s.u, force);
        const double eq = target[q] - 0.5 * source, eq_r = target[r] - 0.5 * source_r;
        const double even = (f[q] + f[r] - eq - eq_r) / 2;
        const double odd = (f[q] - f[r] - eq + eq_r) / 2;
        out[q] = f[q] - omega * even - odd_rate * odd +
                 (1 - 0.5 * omega) * (source + source_r) / 2 +
                 (1 - 0.5 * odd_rate) * (source - source_r) / 2;
    }
    return out;
}

using Tensor = std::array<Vec3, 3>;

// Non-equilibrium stress with half of the force's.
Tensor viscous_stress(const Cell& f, const Vec3& force) {
    const Flow s = flow(f, force);
    Tensor n{};
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int q = 0; q < directions; ++q) {
                n[a][b] += c[q][a] * c[q][b] * (f[q] + weight(q));
            }
            n[a][b] -= s.density * (s.u[a] * s.u[b] + (a == b ? cs2 : 0));
            n[a][b] += 0.5 * (s.u[a] * force[b] + s.u[b] * force[a]);
        }
    }
    return n;
}

// 1 / tau of the relaxation time with Smagorinsky's eddy viscosity (Hou et al. 1996).
double eddy_rate(const Cell& f, const Vec3& force, double omega, double constant) {
    const Tensor n = viscous_stress(f, force);
    double norm = 0;
    for (const Vec3& row : n) {
        for (const double entry : row) norm += entry * entry;
    }
    const double tau = 1 / omega;
    const double eddies = 18 * std::sqrt(2.0) * constant * constant * std::sqrt(norm);
    return 2 / (tau + std::sqrt(tau * tau + eddies / flow(f, force).density));
}

// Sum over Hermite polynomials of order 3 that D3Q19 supports, coefficients rho u u u
// plus what the recursion gives for the non-equilibrium stress n.
double third_order(int q, const Flow& s, const Tensor& n) {
    const auto coefficient = [&](int a, int b) {  // of H_aab
        return s.density * s.u[a] * s.u[a] * s.u[b] + 2 * s.u[a] * n[a][b] +
               s.u[b] * n[a][a];
    };
    const auto hermite = [&](int a, int b) {
        return (c[q][a] * c[q][a] - cs2) * c[q][b];
    };
    const auto pair = [&](int a, int b, int d, int e) {
        return 3 * (hermite(a, b) + hermite(d, e)) *
                   (coefficient(a, b) + coefficient(d, e)) +
               (hermite(a, b) - hermite(d, e)) * (coefficient(a, b) - coefficient(d, e));
    };
    const double sum = pair(0, 1, 2, 1) + pair(2, 0, 1, 0) + pair(1, 2, 0, 2);
    return sum / (6 * cs2 * cs2 * cs2);
}

Cell recursive_regularized(const Cell& f, const Vec3& force, double omega) {
    const Flow s = flow(f, force);
    Tensor n = viscous_stress(f, force), second{};
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double uf = s.u[a] * force[b] + s.u[b] * force[a];
            n[a][b] *= 1 - omega;
            second[a][b] = s.density * s.u[a] * s.u[b] + n[a][b] + 0.5 * uf;
        }
    }
    Cell out;
    for (int q = 0; q < directions; ++q) {
        double value = s.density - 1;
        for (int a = 0; a < 3; ++a) {
            value += c[q][a] / cs2 * (s.density * s.u[a] + 0.5 * force[a]);
            for (int b = 0; b < 3; ++b) {
                const double hermite = c[q][a] * c[q][b] - (a == b ? cs2 : 0);
                value += hermite * second[a][b] / (2 * cs2 * cs2);
            }
        }
        out[q] = weight(q) * (value + third_order(q, s, n));
    }
    return out;
}

// What f has beyond the Hermite polynomials up to second order: its even part are the
// three modes of fourth order, its odd part the six of third order.
Cell ghosts(const Cell& f) {
    double excess = 0;
    Vec3 momentum{};
    Tensor second{};
    for (int q = 0; q < directions; ++q) {
        excess += f[q];
        for (int a = 0; a < 3; ++a) {
            momentum[a] += c[q][a] * f[q];
            for (int b = 0; b < 3; ++b)
                second[a][b] += (c[q][a] * c[q][b] - (a == b ? cs2 : 0)) * f[q];
        }
    }
    Cell rest;
    for (int q = 0; q < directions; ++q) {
        double value = excess;
        for (int a = 0; a < 3; ++a) {
            value += c[q][a] * momentum[a] / cs2;
            for (int b = 0; b < 3; ++b) {
                const double hermite = c[q][a] * c[q][b] - (a == b ? cs2 : 0);
                value += hermite * second[a][b] / (2 * cs2 * cs2);
            }
        }
        rest[q] = f[q] - weight(q) * value;
    }
    return rest;
}

// Regularised collision and what is kept of the ghost modes: odd ones relax towards the
// recursion with the magic number's rate, even ones with tau4 - 1/2 = 10 (tau - 1/2).
Cell recursive_mrt(const Cell& f, const Vec3& force, double omega, double magic) {
    const double slack = 1 / omega - 0.5;
    const double odd_rate = 1 / (0.5 + magic / slack);
    const double fourth_rate = 1 / (0.5 + 10 * slack);
    const Flow s = flow(f, force);
    const Tensor n = viscous_stress(f, force);
    const Cell ghost = ghosts(f);
    Cell out = recursive_regularized(f, force, omega);
    for (int q = 0; q < directions; ++q) {
        const int r = opposite(q);
        const double even = (ghost[q] + ghost[r]) / 2;
        const double odd = (ghost[q] - ghost[r]) / 2 - weight(q) * third_order(q, s, n);
        out[q] += (1 - odd_rate) * odd + (1 - fourth_rate) * even;
    }
    return out;
}

// Populations of a flow at lattice speeds around 0.1, far from equilibrium.
Cell random_cell(std::mt19937& random) {
    std::uniform_real_distribution<double> deviation(-0.3, 0.3);
    Cell f;
    for (int q = 0; q < directions; ++q) f[q] = weight(q) * deviation(random);
    return f;
}

Vec3 random_force(std::mt19937& random) {
    std::uniform_real_distribution<double> component(-1e-2, 1e-2);
    return {component(random), component(random), component(random)};
}

}  // namespace magfsi::fluid::reference

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
            choose_kernels(set, Precision::double_, GetParam(), false));
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
            choose_kernels(set, precision, collision, eddies));
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
