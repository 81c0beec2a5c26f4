// SPDX-License-Identifier: GPL-2.0-or-later
// Viscosity that depends on the rate of shear, sqrt(2 S:S).
#pragma once

#include <variant>
#include <vector>

namespace magfsi::fluid {

// Carreau and Yasuda (Bird, Armstrong, Hassager 1987), nu_0 the fluid's viscosity at
// rest:
//   nu = nu_inf + (nu_0 - nu_inf) (1 + (time rate)^a)^((n - 1) / a).
struct Carreau {
    double infinite_m2_s = 0;
    double time_s = 0;
    double exponent = 1;    // n
    double transition = 2;  // a; 2 is Carreau's
};

// Ostwald and de Waele: nu_0 (|rate| / reference)^(n - 1), within limits, without which a
// fluid at rest would have none or an infinite one.
struct PowerLaw {
    double exponent = 1;
    double rate_1_s = 0;  // at which the fluid's viscosity holds
    double least_m2_s = 0, most_m2_s = 0;
};

struct Rheology {
    std::variant<Carreau, PowerLaw> law;
};

// rate >= 0; viscosity: the fluid's own, of which the law is made.
double viscosity_m2_s(const Rheology& rheology, double viscosity_m2_s, double rate_1_s);

struct Units;

// For the collision (collision/shear_dependent.h): 1 / tau by the cell's own stress.
std::vector<double> rates_by_stress(const Rheology& rheology, double viscosity_m2_s,
                                    const Units& unit);

}  // namespace magfsi::fluid
