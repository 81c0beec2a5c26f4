// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/formula.h"

#include <muParser.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <unordered_map>

#include "structure/refuse.h"

namespace magfsi::structure {

namespace {

double mod(double a, double b) {
    return a - b * std::floor(a / b);
}

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

// muParser would store to its variable.
void refuse_assignment(const std::string& si) {
    for (std::size_t i = 0; i < si.size(); ++i) {
        if (si[i] != '=') continue;
        if (i + 1 < si.size() && si[i + 1] == '=')
            ++i;
        else if (i == 0 || std::string_view("<>!").find(si[i - 1]) == std::string::npos)
            refuse("a single \"=\" found; == compares");
    }
}

Compiled& compiled(const std::string& si) {
    static thread_local std::unordered_map<std::string, std::unique_ptr<Compiled>> kept;
    if (const auto found = kept.find(si); found != kept.end()) return *found->second;
    refuse_assignment(si);
    // A controller may send another one each time.
    if (kept.size() > 100) kept.clear();
    try {
        return *(kept[si] = std::make_unique<Compiled>(si));
    } catch (const mu::Parser::exception_type& fault) {
        refuse("{}", fault.GetMsg());
    }
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
        throw std::runtime_error(fmt::format("the formula {} is {} at t = {:.9g} s", si,
                                             fault_of(value), time_s));
    return value;
}

std::array<double, 3> value_at(const std::array<Formula, 3>& component, double time_s) {
    std::array<double, 3> out{};
    for (std::size_t d = 0; d < 3; ++d) out[d] = value_at(component[d].si, time_s);
    return out;
}

}  // namespace magfsi::structure
