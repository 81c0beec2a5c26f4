// SPDX-License-Identifier: GPL-2.0-or-later
// Reader of CSV files of numbers, as people and programs write them. A header names the
// columns with their units, such as x[mm],Mx[kA/m] or "t (s)";"Bx (mT)"; each further
// line is a row. Values are separated by semicolons, tabs, commas or blanks (the first of
// these that the line has, or what a first line "sep=;" says) and may be quoted. Empty
// lines and lines that begin with # or % are skipped, except that a comment before the
// rows may be the header (numpy, COMSOL). Units may stand in a line of their own below
// the names.
#pragma once

#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace magfsi::structure {

// A unit: SI value = number * times / over. Both are whole powers of ten where possible,
// so that 50 ms gives exactly 0.05 s.
struct ColumnUnit {
    std::string_view text;
    double times = 1, over = 1;
};
// A column that a table may have, with the units that are accepted; the first one is SI.
struct ColumnKind {
    std::string_view name;
    std::span<const ColumnUnit> units;
};

namespace units {
inline constexpr ColumnUnit length[] = {
    {"m"}, {"mm", 1, 1e3}, {"um", 1, 1e6}, {"cm", 1, 1e2}, {"nm", 1, 1e9}};
inline constexpr ColumnUnit time[] = {{"s"}, {"ms", 1, 1e3}, {"us", 1, 1e6}};
// Units of magnetisation. T and mT are those of the remanence mu0 M.
inline constexpr ColumnUnit magnetization[] = {{"A/m"},
                                               {"kA/m", 1e3},
                                               {"T", 1e7, 4 * std::numbers::pi},
                                               {"mT", 1e4, 4 * std::numbers::pi}};
inline constexpr ColumnUnit flux_density[] = {
    {"T"}, {"mT", 1, 1e3}, {"uT", 1, 1e6}, {"G", 1, 1e4}};
}  // namespace units

// Strictness of the header.
// strict: each column is known and has its unit.
// exported: for files of programs that write no units. Columns without a unit are in SI,
// lengths in the unit of a line "% Length unit: mm"; any other line about units is
// refused. Unknown columns (an index, a norm, an expression such as 0.5*mf.Bz) are
// skipped.
enum class TableStyle { strict, exported };

// Reads the columns of a file, converted to SI: one vector per entry of `known`, in that
// order, empty if the file lacks it. All columns in `needed` must be there; of the others
// either all or none. what: name of the table in messages, "magnetisation table". Throws
// std::invalid_argument, with file and line, if there is no header or no row, a column is
// unknown or repeated, a unit is not listed, a row has another number of values, or a
// value is not finite.
std::vector<std::vector<double>> read_table(std::string_view what,
                                            const std::filesystem::path& file,
                                            std::span<const ColumnKind> known,
                                            const std::vector<std::string_view>& needed,
                                            TableStyle style = TableStyle::strict);

}  // namespace magfsi::structure
