// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of the magnetic field: its laws over time, sources and gradient.
#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace magfsi::scene {

namespace {

// Finds the place in the file of a key of one law.
using At = std::function<const Origin&(const char* key)>;

// Interpolation over time needs strictly ascending times.
void check_ascending(const std::vector<double>& time_s, const At& at) {
    for (std::size_t i = 1; i < time_s.size(); ++i)
        require(time_s[i] > time_s[i - 1], at("time"),
                fmt::format("the time {} after {}", seconds(time_s[i]),
                            seconds(time_s[i - 1])),
                "times that ascend");
}

// A single direction holds for all rows; repetition needs a period, that is two rows.
void check_law(const FieldTable& table, const At& at) {
    const std::size_t rows = table.time_s.size();
    check_ascending(table.time_s, at);
    require(table.magnitude_t.size() == rows, at("magnitude"),
            fmt::format("{} magnitudes for {} times", table.magnitude_t.size(), rows),
            "one magnitude per time");
    require(table.direction_rad.size() == 1 || table.direction_rad.size() == rows,
            at("direction"),
            fmt::format("{} directions for {} times", table.direction_rad.size(), rows),
            "one direction, or one per time");
    require(!table.repeat || rows >= 2, at("repeat"), "repeat with one row",
            "it with at least 2 rows");
}

// The table may come from a file, whose rows have been read before (read_field_files).
void check_law(const VectorTable& table, const At& at) {
    const std::size_t rows = table.time_s.size();
    require(rows > 0, at("time"), "a table without time", "time and vector, or file");
    check_ascending(table.time_s, at);
    require(table.vector_t.size() == rows, at("vector"),
            fmt::format("{} vectors for {} times", table.vector_t.size(), rows),
            "one vector per time");
    require(!table.repeat || rows >= 2, at("repeat"), "repeat with one row",
            "it with at least 2 rows");
}

// An axis of length 0 has no direction.
void check_law(const PrecessingField& field, const At& at) {
    require(norm(field.axis) > 0, at("axis"), "an axis of length 0",
            "any other vector such as [0, 0, 1]");
}

// Each component must have a value during the whole run.
void check_law(const FormulaField& field, const At& at, double end_s) {
    constexpr const char* names[] = {"x", "y", "z"};
    for (std::size_t d = 0; d < 3; ++d)
        largest_size(field.component_t[d], end_s, at(names[d]));
}

// Calls the check of the law's type; laws without a function check_law have nothing to
// check.
void check_any_law(const FieldLaw& law, const At& at, double end_s) {
    std::visit(
        [&]<class Law>(const Law& one) {
            if constexpr (requires { check_law(one, at); })
                check_law(one, at);
            else if constexpr (requires { check_law(one, at, end_s); })
                check_law(one, at, end_s);
        },
        law);
}

// A field needs a law or sources. Further laws in `plus` add to the first one, which must
// be there.
void check_laws(const MagneticField& field, double end_s, const Marks& marks) {
    const std::string law = field.uniform ? law_key(field.course) : "";
    require(field.uniform || (!field.sources.empty() && field.plus.empty()),
            marks.key({"magnetic_field"}), "a magnetic_field without a law",
            "one of constant, table, rotation, vector, vector_table, oscillation, "
            "precession, formula, or sources");
    if (field.uniform)
        check_any_law(
            field.course,
            [&](const char* key) -> const Origin& {
                return marks.value({"magnetic_field", law, key});
            },
            end_s);
    for (std::size_t i = 0; i < field.plus.size(); ++i) {
        check_any_law(
            field.plus[i].law,
            [&](const char* key) -> const Origin& {
                return marks.value({"magnetic_field", "plus", std::to_string(i),
                                    law_key(field.plus[i].law), key});
            },
            end_s);
    }
}

// Checks the formulas of a source: strength, motion, turning, currents.
void check_formulas(const FieldSource& source, double end_s, const Marks& marks) {
    constexpr const char* field = "magnetic_field";
    constexpr const char* all = "sources";
    const std::string& name = source.name;
    if (source.strength) {
        if (const auto* factor = std::get_if<Formula>(&*source.strength))
            largest_size(*factor, end_s,
                         marks.value({field, all, name, "strength", "formula"}));
    }
    if (source.motion) {
        if (const auto* way = std::get_if<FormulaMotion>(&*source.motion)) {
            for (std::size_t d = 0; d < 3; ++d)
                largest_size(way->component_m[d], end_s,
                             marks.value({field, all, name, "motion", "formula",
                                          std::string(axis_names[d])}));
        }
    }
    if (source.turning) {
        if (const auto* angle = std::get_if<Formula>(&source.turning->turns))
            largest_size(*angle, end_s,
                         marks.value({field, all, name, "turning", "angle"}));
    }
    const auto* system = std::get_if<CoilSystem>(&source.shape);
    for (std::size_t i = 0; system && i < system->coils.size(); ++i) {
        if (const auto& current = system->coils[i].current)
            largest_size(*current, end_s,
                         marks.value({field, all, name, "coil_system", "coils",
                                      std::to_string(i), "current"}));
    }
}

// Checks axes, and tables over time for equal numbers of rows.
void check_source(const FieldSource& source, const Marks& marks) {
    const std::string& name = source.name;
    const auto at = [&](Path path) -> const Origin& { return marks.value(path); };
    const auto axis = [&](const Vec3& v, const Origin& where) {
        require(norm(v) > 0, where, "an axis of length 0",
                "any other vector such as [0, 0, 1]");
    };
    const auto rows = [&](const std::vector<double>& time_s, std::size_t values,
                          bool repeat, std::initializer_list<std::string> where) {
        const Origin& place = marks.value(where);
        check_ascending(time_s, [&](const char*) -> const Origin& { return place; });
        require(values == time_s.size(), place,
                fmt::format("{} rows for {} times", values, time_s.size()),
                "one per time");
        require(!repeat || time_s.size() >= 2, place, "repeat with one row",
                "it with at least 2 rows");
    };
    if (source.rotation)
        axis(source.rotation->axis,
             at({"magnetic_field", "sources", name, "rotation", "axis"}));
    if (source.turning)
        axis(source.turning->axis,
             at({"magnetic_field", "sources", name, "turning", "axis"}));
    if (source.strength) {
        if (const auto* table = std::get_if<StrengthTable>(&*source.strength))
            rows(table->time_s, table->factor.size(), table->repeat,
                 {"magnetic_field", "sources", name, "strength", "table", "time"});
    }
    if (source.motion) {
        if (const auto* path = std::get_if<SourcePath>(&*source.motion))
            rows(path->time_s, path->displacement_m.size(), path->repeat,
                 {"magnetic_field", "sources", name, "motion", "path", "time"});
    }
    if (const auto* s = std::get_if<CylinderMagnet>(&source.shape))
        axis(s->axis, at({"magnetic_field", "sources", name, "cylinder", "axis"}));
    if (const auto* s = std::get_if<CircularCoil>(&source.shape))
        axis(s->axis, at({"magnetic_field", "sources", name, "coil", "axis"}));
    if (const auto* s = std::get_if<CoilPair>(&source.shape))
        axis(s->axis, at({"magnetic_field", "sources", name, "coil_pair", "axis"}));
    if (const auto* s = std::get_if<CoilSystem>(&source.shape)) {
        for (std::size_t i = 0; i < s->coils.size(); ++i) {
            const std::string number = std::to_string(i);
            axis(s->coils[i].axis, at({"magnetic_field", "sources", name, "coil_system",
                                       "coils", number, "axis"}));
            const std::size_t currents = s->coils[i].current_a.size();
            const bool formula = s->coils[i].current.has_value();
            const std::size_t times =
                formula ? 0 : std::max<std::size_t>(1, s->time_s.size());
            require(!formula || currents == 0,
                    at({"magnetic_field", "sources", name, "coil_system", "coils", number,
                        "current"}),
                    "current beside currents", "one of the two");
            require(currents == times,
                    at({"magnetic_field", "sources", name, "coil_system", "coils", number,
                        "currents"}),
                    fmt::format("{} currents for {} times", currents, s->time_s.size()),
                    "one current per time, or one without times");
        }
        if (!s->time_s.empty())
            rows(s->time_s, s->time_s.size(), s->repeat,
                 {"magnetic_field", "sources", name, "coil_system", "time"});
    }
}

// A gradient must have curl B = 0 and div B = 0 (symmetric and traceless matrix), since
// no current flows at the bodies.
void check_gradient(const GradientInput& gradient, const Marks& marks) {
    const auto& g = gradient.matrix_t_m;
    double largest = 0, fault = std::abs(g[0][0] + g[1][1] + g[2][2]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            largest = std::max(largest, std::abs(g[i][j]));
            fault = std::max(fault, std::abs(g[i][j] - g[j][i]));
        }
    }
    // The tolerance admits the rounding of numbers as people type them.
    require(
        fault <= 1e-9 * largest, marks.value({"magnetic_field", "gradient", "matrix"}),
        "a gradient that is not symmetric and traceless",
        "dB_i/dx_j = dB_j/dx_i with a sum of 0 on the diagonal (no current flows here)");
}

}  // namespace

// The peak is that of the samples, slightly below the true one.
double largest_size(const Formula& formula, double end_s, const Origin& where) {
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double t = end_s * i / 1000;
        const double value = structure::value_or_nan(formula.si, t);
        require(std::isfinite(value), where,
                fmt::format("{}, which is {} at t = {}", in_quotes(formula.written),
                            structure::fault_of(value), seconds(t)),
                "formulas with a value at all times of the run");
        largest = std::max(largest, std::abs(value));
    }
    return largest;
}

// Only magnetised bodies feel the field; a scene with a field and no such body is mostly
// a mistake.
void check_magnetic_field(const Scene& scene, const Marks& marks) {
    const MagneticField& field = *scene.magnetic_field;
    const auto magnetized = [](const Body& body) {
        return body.magnetization.has_value();
    };
    require(std::ranges::any_of(scene.bodies, magnetized), marks.key({"magnetic_field"}),
            "magnetic_field without a magnetized body",
            "it with at least one body that has a magnetization",
            "add a magnetization or remove this key");
    check_laws(field, scene.time.end_s, marks);
    for (const FieldSource& source : field.sources) {
        check_source(source, marks);
        check_formulas(source, scene.time.end_s, marks);
    }
    if (field.gradient) check_gradient(*field.gradient, marks);
}

}  // namespace magfsi::scene
