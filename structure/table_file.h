// SPDX-License-Identifier: GPL-2.0-or-later
// CSV files of numbers, as people and programs write them: a header of columns with their
// units, such as x[mm],Mx[kA/m] or "t (s)";"Bx (mT)", then a row a line. Values stand
// between commas, semicolons, tabs or blanks (whichever a line has, or as a first line
// "sep=;" says), in quotes or not. Empty lines and lines that begin with # or % are left
// out, but the last of them in front of the rows may be the header (numpy, COMSOL). Units
// may stand in a line of their own below the names.
#pragma once

#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace magfsi::structure {

// SI value = number * times / over: whole powers of ten, so that 50 ms is 0.05 s.
struct ColumnUnit {
    std::string_view text;
    double times = 1, over = 1;
};
// A column that a table may have, and the units it is read in.
struct ColumnKind {
    std::string_view name;
    std::span<const ColumnUnit> units;
};

namespace units {
inline constexpr ColumnUnit length[] = {
    {"m"}, {"mm", 1, 1e3}, {"um", 1, 1e6}, {"cm", 1, 1e2}, {"nm", 1, 1e9}};
inline constexpr ColumnUnit time[] = {{"s"}, {"ms", 1, 1e3}, {"us", 1, 1e6}};
// A remanence over mu0, too.
inline constexpr ColumnUnit magnetization[] = {{"A/m"},
                                               {"kA/m", 1e3},
                                               {"T", 1e7, 4 * std::numbers::pi},
                                               {"mT", 1e4, 4 * std::numbers::pi}};
inline constexpr ColumnUnit flux_density[] = {
    {"T"}, {"mT", 1, 1e3}, {"uT", 1, 1e6}, {"G", 1, 1e4}};
}  // namespace units

// exported: by programs that know no units in headers. Columns without one are in SI, of
// lengths in what a line "% Length unit: mm" says, and a line about units that is not
// understood is refused; columns that are not known are left out (an index, a norm), and
// so is an expression such as 0.5*mf.Bz.
enum class TableStyle { strict, exported };

// The columns of a file in SI, in the order of `known`; empty where the file has none,
// which of those that are `needed` is a fault; of the others there are all or none. what:
// for messages, "magnetisation table". Throws std::invalid_argument, with file and line,
// on what is no such table: no header, no row, an unknown or repeated column, a unit that
// is not listed, another number of values, no finite number.
std::vector<std::vector<double>> read_table(std::string_view what,
                                            const std::filesystem::path& file,
                                            std::span<const ColumnKind> known,
                                            const std::vector<std::string_view>& needed,
                                            TableStyle style = TableStyle::strict);

}  // namespace magfsi::structure
