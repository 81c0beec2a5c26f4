// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/formula.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <unordered_map>

#include "structure/refuse.h"

namespace magfsi::structure {

namespace {

// The remainder of a / b with the sign of b, for periodic formulas; std::fmod has that of
// a.
double mod(double a, double b) {
    return a - b * std::floor(a / b);
}

// One compiled formula with its own variable t: muParser reads the variable by its
// address.
class Compiled {
  public:
    explicit Compiled(const std::string& si) {
        parser_.DefineVar("t", &t_);
        parser_.DefineConst("pi", std::numbers::pi);
        parser_.DefineFun("mod", mod);
        parser_.SetExpr(si);
        parser_.Eval();  // compiles
        if (parser_.GetNumResults() != 1)
            refuse("{} values, separated by commas, found; a formula has one",
                   parser_.GetNumResults());
    }
    double operator()(double t) {
        t_ = t;
        return parser_.Eval();
    }

  private:
    mu::Parser parser_;
    double t_ = 0;
};

// muParser takes t = 1 as an assignment to its variable, which would outlast the
// evaluation.
void refuse_assignment(const std::string& si) {
    for (std::size_t i = 0; i < si.size(); ++i) {
        if (si[i] != '=') continue;
        if (i + 1 < si.size() && si[i + 1] == '=')
            ++i;
        else if (i == 0 || std::string_view("<>!").find(si[i - 1]) == std::string::npos)
            refuse("a single \"=\" found; == compares");
    }
}

// The compiled formula, from this thread's store. The store is emptied at 100 formulas.
Compiled& compiled(const std::string& si) {
    static thread_local std::unordered_map<std::string, std::unique_ptr<Compiled>> kept;
    if (const auto found = kept.find(si); found != kept.end()) return *found->second;
    refuse_assignment(si);
    // A controller may send another formula at each call.
    if (kept.size() > 100) kept.clear();
    try {
        return *(kept[si] = std::make_unique<Compiled>(si));
    } catch (const mu::Parser::exception_type& fault) {
        refuse("{}", fault.GetMsg());
    }
}

// Central differences over five points, of fourth order: exact to 1e-6 for an oscillation
// of 1 kHz. The middle point is kept at least two spacings after time 0, as formulas need
// no value before it: derivatives at the start are those at 20 us.
constexpr double apart_s = 1e-5;

Vec3 difference(const std::array<Formula, 3>& place_m, double time_s,
                const std::array<double, 5>& weight, double scale) {
    Vec3 sum{};
    const double middle_s = std::max(time_s, 2 * apart_s);
    for (int i = -2; i <= 2; ++i) {
        sum += weight[i + 2] * value_at(place_m, middle_s + i * apart_s) / scale;
    }
    return sum;
}

}  // namespace

double value_or_nan(const std::string& si, double time_s) {
    return compiled(si)(time_s);
}

const char* fault_of(double value) {
    return std::isnan(value) ? "not a number" : "infinite";
}

double value_at(const std::string& si, double time_s) {
    const double value = value_or_nan(si, time_s);
    if (!std::isfinite(value))
        throw std::runtime_error(
            fmt::format("the formula {} is {} at t = {:.9g} s; give it a value at all "
                        "times of the run",
                        si, fault_of(value), time_s));
    return value;
}

Vec3 value_at(const std::array<Formula, 3>& component, double time_s) {
    const auto& [x, y, z] = component;
    return {value_at(x.si, time_s), value_at(y.si, time_s), value_at(z.si, time_s)};
}

Vec3 displacement(const std::array<Formula, 3>& place_m, double time_s) {
    return value_at(place_m, time_s) - value_at(place_m, 0);
}

Vec3 velocity(const std::array<Formula, 3>& place_m, double time_s) {
    return difference(place_m, time_s, {1, -8, 0, 8, -1}, 12 * apart_s);
}

Vec3 acceleration(const std::array<Formula, 3>& place_m, double time_s) {
    return difference(place_m, time_s, {-1, 16, -30, 16, -1}, 12 * apart_s * apart_s);
}

}  // namespace magfsi::structure
