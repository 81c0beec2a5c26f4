#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

struct Named {
    std::string_view si;
    std::string_view name;
    std::string_view example;
};

// The dimensions that scenes use. One line here gives error messages and the reference
// page their words.
constexpr Named named[] = {
    {"", "a plain number", "0.5"},
    {"m", "a length", "0.2 mm"},
    {"s", "a time", "20 us"},
    {"kg", "a mass", "3 mg"},
    {"A", "an electric current", "1 A"},
    {"rad", "an angle", "45 deg"},
    {"m2", "an area", "1 mm2"},
    {"m3", "a volume", "1 mm3"},
    {"1/s", "a rate", "5 Hz"},
    {"rad/s", "an angular speed", "90 deg/s"},
    {"m/s", "a speed", "0.5 m/s"},
    {"m/s2", "an acceleration", "9.81 m/s2"},
    {"m2/s", "a kinematic viscosity", "1 mm2/s"},
    {"Pa s", "a dynamic viscosity", "1 mPa s"},
    {"kg/m3", "a density", "1000 kg/m3"},
    {"Pa", "a pressure", "33 kPa"},
    {"N", "a force", "1 mN"},
    {"N/m3", "a force density or pressure by length", "10 N/m3"},
    {"J", "an energy", "1 uJ"},
    {"W", "a power", "1 mW"},
    {"T", "a magnetic flux density", "17 mT"},
    {"T/m", "a field gradient", "0.5 T/m"},
    {"A/m", "a magnetization", "62 kA/m"},
};

const Named* find(const Dimension& dimension) {
    static const std::vector<Dimension> dimensions = [] {
        std::vector<Dimension> list;
        for (const Named& entry : named) list.push_back(parse_unit(entry.si).dimension);
        return list;
    }();
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
        if (dimensions[i] == dimension) return &named[i];
    }
    return nullptr;
}

}  // namespace

std::string dimension_name(const Dimension& dimension) {
    if (const Named* entry = find(dimension)) return std::string(entry->name);
    constexpr std::string_view base[] = {"kg", "m", "s", "A", "rad"};
    std::string product;
    for (std::size_t i = 0; i < dimension.size(); ++i) {
        if (dimension[i] != 0) product += fmt::format(" {}^{}", base[i], dimension[i]);
    }
    return "a quantity in" + product;
}

std::string dimension_example(const Dimension& dimension) {
    const Named* entry = find(dimension);
    return entry ? std::string(entry->example) : "";
}

std::string format_si(double value, std::string_view si_unit) {
    const bool takes_prefix = si_unit == "m" || si_unit == "s" || si_unit == "Pa" ||
                              si_unit == "T" || si_unit == "N" || si_unit == "A/m";
    if (!takes_prefix || value == 0)
        return fmt::format("{:.6g}{}{}", value, si_unit.empty() ? "" : " ", si_unit);
    constexpr std::string_view prefix[] = {"n", "u", "m", "", "k", "M", "G"};
    // The small shift keeps 0.001 m at 1 mm whichever way its logarithm rounds.
    const int thousands =
        static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-9));
    const int step = std::min(std::max(thousands, -3), 3);
    return fmt::format("{:.6g} {}{}", value / std::pow(10.0, 3 * step), prefix[step + 3],
                       si_unit);
}

}  // namespace magfsi::scene
