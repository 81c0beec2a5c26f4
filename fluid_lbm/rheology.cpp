// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/rheology.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/collision/shear_dependent.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {
namespace {

double at(const Carreau& law, double at_rest, double rate) {
    const double a = law.transition;
    return law.infinite_m2_s +
           (at_rest - law.infinite_m2_s) *
               std::pow(1 + std::pow(law.time_s * rate, a), (law.exponent - 1) / a);
}

double at(const PowerLaw& law, double viscosity, double rate) {
    // At rest pow gives 0 or infinity; clamp makes these the limits.
    return std::clamp(viscosity * std::pow(rate / law.rate_1_s, law.exponent - 1),
                      law.least_m2_s, law.most_m2_s);
}

}  // namespace

double viscosity_m2_s(const Rheology& rheology, double viscosity, double rate_1_s) {
    return std::visit([&](const auto& law) { return at(law, viscosity, rate_1_s); },
                      rheology.law);
}

std::vector<double> rates_by_stress(const Rheology& rheology, double viscosity,
                                    const Units& unit) {
    const double nu_unit = unit.spacing_m * unit.spacing_m / unit.time_step_s;
    const auto tau = [&](double rate) {  // lattice units
        return 0.5 +
               3 * viscosity_m2_s(rheology, viscosity, rate / unit.time_step_s) / nu_unit;
    };
    std::vector<double> rates(rate_table_size);
    for (int entry = 0; entry < rate_table_size; ++entry) {
        // The rate solves rate tau(rate) = 3 |Pi| / (sqrt(2) rho). The left side rises
        // with the rate, so that bisection finds it.
        const double wanted = 3 / std::sqrt(2.0) * std::sqrt(stress_squared_of(entry));
        double low = 0, high = 2 * wanted;  // tau >= 1/2
        for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
            const double middle = 0.5 * (low + high);
            (middle * tau(middle) < wanted ? low : high) = middle;
        }
        rates[entry] = 1 / tau(high);
    }
    return rates;
}

}  // namespace magfsi::fluid
