// SPDX-License-Identifier: GPL-2.0-or-later
// Field tables from CSV files: once read they are part of the scene, and of its hash.
#include <fmt/format.h>

#include <utility>

#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "structure/table_file.h"

namespace magfsi::scene {

namespace {

using structure::ColumnKind;
namespace units = structure::units;

constexpr ColumnKind columns[] = {{"t", units::time},
                                  {"Bx", units::flux_density},
                                  {"By", units::flux_density},
                                  {"Bz", units::flux_density}};

void read_rows(VectorTable& table, const Origin& where) {
    std::vector<std::vector<double>> values;
    try {
        values = structure::read_table("field table", table.file, columns,
                                       {"t", "Bx", "By", "Bz"});
    } catch (const std::invalid_argument& fault) {
        refuse(where, fmt::format("a fault in the {}", fault.what()),
               "a header with t, Bx, By, Bz and rows of finite numbers");
    }
    table.time_s = values[0];
    for (std::size_t row = 0; row < values[0].size(); ++row)
        table.vector_t.push_back({values[1][row], values[2][row], values[3][row]});
}

void read_law(FieldLaw& law, const std::filesystem::path& folder, const Origin& where) {
    auto* table = std::get_if<VectorTable>(&law);
    if (!table || table->file.empty()) return;
    require(table->time_s.empty() && table->vector_t.empty(), where,
            "file beside time or vector", "either a file or rows in the scene");
    table->file = (folder / table->file).string();
    require_regular_file(table->file, where);
    read_rows(*table, where);
    table->source = std::exchange(table->file, {});
}

}  // namespace

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

}  // namespace magfsi::scene
