// SPDX-License-Identifier: GPL-2.0-or-later
// Generalised Newtonian fluids: viscosity that depends on the rate of shear, sqrt(2 S:S).
#pragma once

#include <variant>
#include <vector>

namespace magfsi::fluid {

// Law of Carreau (1972) and Yasuda (1981), with nu_0 the fluid's viscosity at rest:
//   nu = nu_inf + (nu_0 - nu_inf) (1 + (time rate)^a)^((n - 1) / a).
struct Carreau {
    double infinite_m2_s = 0;  // nu_inf, the viscosity at an infinite rate
    double time_s = 0;
    double exponent = 1;    // n
    double transition = 2;  // a; 2 in Carreau's law
};

// Power law of Ostwald and de Waele, nu = nu_0 (|rate| / rate_1_s)^(n - 1), clamped to
// [least_m2_s, most_m2_s]: at rest the pure law gives 0 or infinity.
struct PowerLaw {
    double exponent = 1;
    double rate_1_s = 0;  // rate at which the viscosity is nu_0
    double least_m2_s = 0, most_m2_s = 0;
};

// The law of a fluid's viscosity.
struct Rheology {
    std::variant<Carreau, PowerLaw> law;
};

// Kinematic viscosity [m2/s] at a rate of shear [1/s], rate_1_s >= 0. viscosity_m2_s: the
// viscosity nu_0 in the laws above.
double viscosity_m2_s(const Rheology& rheology, double viscosity_m2_s, double rate_1_s);

struct Units;

// Table of 1 / tau by the stress of a cell, for collision/shear_dependent.h: entry i is
// for the stress stress_squared_of(i), rate_table_size entries.
std::vector<double> rates_by_stress(const Rheology& rheology, double viscosity_m2_s,
                                    const Units& unit);

}  // namespace magfsi::fluid
