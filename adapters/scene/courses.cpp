// SPDX-License-Identifier: GPL-2.0-or-later
// Courses over time. Rows of CSV files become part of the scene and its hash; courses of
// inlets are checked and turned into functions that the fluid calls.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "structure/formula.h"
#include "structure/table_file.h"
#include "structure/table_rows.h"

namespace magfsi::scene {

namespace {

using structure::ColumnKind;
namespace units = structure::units;

// Columns of the CSV files, with the units that their headers may have.
constexpr ColumnKind field_columns[] = {{"t", units::time},
                                        {"Bx", units::flux_density},
                                        {"By", units::flux_density},
                                        {"Bz", units::flux_density}};
constexpr structure::ColumnUnit plain[] = {{""}, {"1"}};
constexpr ColumnKind inlet_columns[] = {{"t", units::time}, {"factor", plain}};

// Reads the columns of a table's file, all of which must be there. Clears table.file and
// sets table.source to the full path.
std::vector<std::vector<double>> read_columns(auto& table, const char* what,
                                              std::span<const ColumnKind> columns,
                                              const std::filesystem::path& folder,
                                              const Origin& where) {
    table.file = (folder / table.file).string();
    require_regular_file(table.file, where);
    std::vector<std::string_view> names;
    for (const ColumnKind& column : columns) names.push_back(column.name);
    try {
        auto values = structure::read_table(what, table.file, columns, names);
        table.source = std::exchange(table.file, {});
        return values;
    } catch (const std::invalid_argument& fault) {
        refuse(where, fmt::format("a fault in the {}", fault.what()),
               fmt::format("a header with {} and rows of finite numbers",
                           fmt::join(names, ", ")));
    }
}

// Only vector tables can be in a file. A table has either a file or rows.
void read_law(FieldLaw& law, const std::filesystem::path& folder, const Origin& where) {
    auto* table = std::get_if<VectorTable>(&law);
    if (!table || table->file.empty()) return;
    require(table->time_s.empty() && table->vector_t.empty(), where,
            "file beside time or vector", "either a file or rows in the scene");
    const auto values = read_columns(*table, "field table", field_columns, folder, where);
    table->time_s = values[0];
    for (std::size_t row = 0; row < values[0].size(); ++row)
        table->vector_t.push_back({values[1][row], values[2][row], values[3][row]});
}

// Columns t and factor of an inlet's table.
void read_rows(InletTable& table, const std::filesystem::path& folder,
               const Origin& where) {
    require(table.time_s.empty() && table.factor.empty(), where,
            "file beside time or factor", "either a file or rows in the scene");
    auto values = read_columns(table, "course of an inlet", inlet_columns, folder, where);
    table.time_s = std::move(values[0]);
    table.factor = std::move(values[1]);
}

// Times must ascend strictly; repetition needs at least two rows.
void check(const InletTable& table, const Origin& where) {
    const std::size_t rows = table.time_s.size();
    require(rows > 0, where, "a table without time", "time and factor, or file");
    require(std::ranges::adjacent_find(table.time_s, std::greater_equal{}) ==
                table.time_s.end(),
            where, "times that do not ascend", "times that ascend");
    require(table.factor.size() == rows, where,
            fmt::format("{} factors for {} times", table.factor.size(), rows),
            "one factor per time");
    require(!table.repeat || rows >= 2, where, "repeat with one row",
            "it with at least 2 rows");
}

// Makes the function of time [s] for each type of course. It keeps a copy of the course,
// so that it may outlive the scene.
struct Factor {
    std::function<double(double)> operator()(const InletWave& wave) const {
        return [wave](double t) {
            return wave.mean + wave.amplitude *
                                   std::sin(2 * std::numbers::pi * wave.frequency_hz * t +
                                            wave.phase_rad);
        };
    }
    std::function<double(double)> operator()(const InletTable& table) const {
        return [table](double t) {
            return structure::rows_at(table.time_s, table.repeat, t).of(table.factor);
        };
    }
    std::function<double(double)> operator()(const InletFormula& formula) const {
        return [formula](double t) { return structure::value_at(formula.si, t); };
    }
};

// Largest magnitude of a course: exact for a wave; from the rows of a table; sampled for
// a formula.
// Between rows a table is linear, so that its rows have the peak.
double peak(const InletCourse& course, double end_s, const Origin& where) {
    if (const auto* wave = std::get_if<InletWave>(&course))
        return std::abs(wave->mean) + std::abs(wave->amplitude);
    if (const auto* formula = std::get_if<InletFormula>(&course))
        return largest_size({formula->written, formula->si}, end_s, where);
    double largest = 0;
    for (double factor : std::get<InletTable>(course).factor)
        largest = std::max(largest, std::abs(factor));
    return largest;
}

}  // namespace

// The first law and those in `plus` may be tables.
void read_field_files(Scene& scene, const Marks& marks) {
    if (!scene.magnetic_field) return;
    MagneticField& field = *scene.magnetic_field;
    if (field.uniform)
        read_law(field.course, scene.folder,
                 marks.value({"magnetic_field", "vector_table", "file"}));
    for (std::size_t i = 0; i < field.plus.size(); ++i)
        read_law(field.plus[i].law, scene.folder,
                 marks.value({"magnetic_field", "plus", std::to_string(i), "vector_table",
                              "file"}));
}

// The peak factor bounds the velocity, which check_step compares with the lattice's
// limit.
void complete_inlets(Scene& scene, const Marks& marks) {
    if (!scene.fluid) return;
    for (std::size_t face = 0; face < 6; ++face) {
        Inlet& inlet = scene.fluid->boundaries[face].inlet;
        if (!inlet.course) continue;
        const std::string name(names<Face>[face]);
        const auto at = [&](const char* key) -> const Origin& {
            return marks.value(
                {"fluid", "boundaries", name, "velocity_inlet", "course", key});
        };
        if (auto* table = std::get_if<InletTable>(&*inlet.course)) {
            if (!table->file.empty()) read_rows(*table, scene.folder, at("table"));
            check(*table, at("table"));
        }
        inlet.factor = std::visit(Factor{}, *inlet.course);
        inlet.peak_factor = peak(*inlet.course, scene.time.end_s, at("formula"));
    }
}

}  // namespace magfsi::scene
