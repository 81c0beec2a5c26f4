// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/app/explain_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/lattice/maxwell.h"
#include "structure/lattice/stiffening.h"

namespace magfsi::launch {
namespace {

// I1 - 3 of an incompressible bar.
double of_bar(double stretch) {
    return stretch * stretch + 2 / stretch - 3;
}

// The stretch of such a bar, by bisection.
double bar_stretch(double s) {
    double low = 1, high = 2 + std::sqrt(s + 3);
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (of_bar(middle) < s ? low : high) = middle;
    }
    return low;
}

std::string explain_stiffening(const structure::Material& material) {
    const structure::StiffeningLaw law = structure::stiffening_law(material);
    std::string text = "    stiffening:";
    double most = 3;  // of the stretches that are told
    if (law.limit < 1e100) {
        most = bar_stretch(law.limit);
        text +=
            fmt::format(" a bar stretches up to {:.3g} times, runs end at {:.3g} times;",
                        most, bar_stretch(structure::largest_share_of_limit * law.limit));
    }
    text += " the shear modulus grows to";
    for (const double share : {0.3, 0.6, 0.9}) {
        const double stretch = 1 + share * (most - 1);
        text +=
            fmt::format("{} {:.3g} times at a stretch of {:.3g}", share > 0.3 ? "," : "",
                        structure::stiffening_at(law, of_bar(stretch)).factor, stretch);
    }
    return text + "\n";
}

// The table goes from a tenth of the slowest branch's frequency to ten times the fastest
// one's.
std::string explain_branches(const structure::Material& material) {
    const auto [fastest, slowest] =
        std::ranges::minmax(material.branches, {}, &structure::MaxwellBranch::time_s);
    const auto decade = [](double time_s) {
        return static_cast<int>(
            std::floor(std::log10(1 / (2 * std::numbers::pi * time_s))));
    };
    const int first = decade(slowest.time_s) - 1, last = decade(fastest.time_s) + 2;
    const int between = std::max(1, (last - first) / 6);
    std::string text = fmt::format(
        "    viscoelastic: {} branches, {:.4g} Pa at once, {:.4g} Pa in the end\n"
        "    frequency [Hz]  storage modulus [Pa]  loss modulus [Pa]\n",
        material.branches.size(),
        material.shear_modulus_pa + structure::branch_modulus_pa(material),
        material.shear_modulus_pa);
    for (int power = first; power <= last; power += between) {
        const double hz = std::pow(10.0, power);
        const auto modulus =
            structure::complex_modulus(material, 2 * std::numbers::pi * hz);
        text += fmt::format("    {:14.3g}  {:20.4g}  {:17.4g}\n", hz, modulus.storage_pa,
                            modulus.loss_pa);
    }
    return text;
}

}  // namespace

std::string explain_material(const structure::Material& material) {
    std::string text;
    if (structure::stiffens(material)) text += explain_stiffening(material);
    if (!material.branches.empty()) text += explain_branches(material);
    return text;
}

}  // namespace magfsi::launch
