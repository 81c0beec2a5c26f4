#include "structure/lammps/field_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace magfsi::structure {
namespace {

double slope_between(std::span<const double> time_s, std::span<const double> value,
                     std::size_t i) {
    const double dt = time_s[i + 1] - time_s[i];
    return dt > 0 ? (value[i + 1] - value[i]) / dt : 0.0;
}

}  // namespace

std::string number(double value) {
    return fmt::format("{:.17g}", value);
}

void check_table(const FieldTable& table) {
    const std::size_t rows = table.time_s.size();
    const std::size_t directions = table.direction_rad.size();
    if (rows == 0 || table.magnitude_t.size() != rows ||
        (directions != 1 && directions != rows)) {
        throw std::invalid_argument(
            fmt::format("field table with {} times, {} magnitudes and {} directions "
                        "found; it needs one "
                        "magnitude a time and one direction, or one a time",
                        rows, table.magnitude_t.size(), directions));
    }
    if (!std::ranges::is_sorted(table.time_s)) {
        throw std::invalid_argument("the times of a field table must not fall");
    }
    if (table.repeat && !(table.time_s.back() > table.time_s.front())) {
        throw std::invalid_argument("a repeated field table needs a period above zero");
    }
}

double fold_time(const FieldTable& table, double time_s) {
    if (!table.repeat) return time_s;
    const double start = table.time_s.front();
    const double period = table.time_s.back() - start;
    return time_s - period * std::floor((time_s - start) / period);
}

std::string fold_formula(const FieldTable& table) {
    if (!table.repeat) return "step*dt";
    const double start = table.time_s.front();
    const double period = table.time_s.back() - start;
    return fmt::format("step*dt-{}*floor((step*dt-({}))/{})", number(period),
                       number(start), number(period));
}

double interpolate(std::span<const double> time_s, std::span<const double> value,
                   double t) {
    const auto after = std::ranges::upper_bound(time_s, t) - time_s.begin();
    if (after == 0) return value.front();
    const auto i = static_cast<std::size_t>(after - 1);
    if (i + 1 == time_s.size()) return value.back();
    return value[i] + slope_between(time_s, value, i) * (t - time_s[i]);
}

std::string table_formula(std::span<const double> time_s, std::span<const double> value) {
    std::string terms;
    double constant = value.front();
    double before = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        const bool jump = i > 0 && time_s[i] == time_s[i - 1] && value[i] != value[i - 1];
        if (jump) {
            terms += fmt::format("{:+.17g}*(v_t>={})", value[i] - value[i - 1],
                                 number(time_s[i]));
        }
        const bool last = i + 1 == time_s.size();
        const double after = last ? 0.0 : slope_between(time_s, value, i);
        const double half = 0.5 * (after - before);
        before = after;
        if (half == 0) continue;
        terms += fmt::format("{:+.17g}*abs(v_t-({}))", half, number(time_s[i]));
        constant -= half * time_s[i];
    }
    return number(constant) + terms;
}

}  // namespace magfsi::structure
