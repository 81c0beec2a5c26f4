// SPDX-License-Identifier: GPL-2.0-or-later
// Every collision written out from its formula, one population at a time: what the
// kernels are compared with. f holds populations minus weights.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "fluid_lbm/lattice/d3q19.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid::reference {

using namespace d3q19;
using Cell = std::array<double, directions>;

struct Flow {
    double density = 1;
    Vec3 u{};
};

inline Flow flow(const Cell& f, const Vec3& force) {
    Flow flow;
    Vec3 j{};
    for (int q = 0; q < directions; ++q) {
        flow.density += f[q];
        for (int a = 0; a < 3; ++a) j[a] += c[q][a] * f[q];
    }
    for (int a = 0; a < 3; ++a) flow.u[a] = (j[a] + 0.5 * force[a]) / flow.density;
    return flow;
}

inline double dot(const int (&velocity)[3], const Vec3& a) {
    return velocity[0] * a[0] + velocity[1] * a[1] + velocity[2] * a[2];
}

inline double guo(int q, const Vec3& u, const Vec3& force) {
    double cuf = 0;
    for (int a = 0; a < 3; ++a) cuf += (c[q][a] - u[a]) * force[a];
    return weight(q) * (3 * cuf + 9 * dot(c[q], u) * dot(c[q], force));
}

inline Cell bgk(const Cell& f, const Vec3& force, double omega) {
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

inline Cell trt(const Cell& f, const Vec3& force, double omega, double magic) {
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
inline Tensor viscous_stress(const Cell& f, const Vec3& force) {
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
inline double eddy_rate(const Cell& f, const Vec3& force, double omega, double constant) {
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
inline double third_order(int q, const Flow& s, const Tensor& n) {
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

inline Cell recursive_regularized(const Cell& f, const Vec3& force, double omega) {
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
inline Cell ghosts(const Cell& f) {
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
inline Cell recursive_mrt(const Cell& f, const Vec3& force, double omega, double magic) {
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
inline Cell random_cell(std::mt19937& random) {
    std::uniform_real_distribution<double> deviation(-0.3, 0.3);
    Cell f;
    for (int q = 0; q < directions; ++q) f[q] = weight(q) * deviation(random);
    return f;
}

inline Vec3 random_force(std::mt19937& random) {
    std::uniform_real_distribution<double> component(-1e-2, 1e-2);
    return {component(random), component(random), component(random)};
}

}  // namespace magfsi::fluid::reference
