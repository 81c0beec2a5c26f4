// Rows of a reference file: comma-separated, lines of # above, one line of column names.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::structure::test {

using ReferenceRow = std::map<std::string, std::string>;

inline std::vector<std::string> split_at_commas(const std::string& line) {
    std::vector<std::string> out;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
    return out;
}

inline std::vector<ReferenceRow> reference_table(const std::string& file) {
    std::ifstream stream(std::string(MAGFSI_REFERENCE_FOLDER) + "/" + file);
    if (!stream) throw std::runtime_error("cannot read " + file);
    std::vector<std::string> names;
    std::vector<ReferenceRow> out;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line[0] == '#') continue;
        const auto cells = split_at_commas(line);
        if (names.empty()) {
            names = cells;
            continue;
        }
        ReferenceRow row;
        for (std::size_t i = 0; i < cells.size(); ++i) row[names.at(i)] = cells[i];
        out.push_back(row);
    }
    return out;
}

inline double number(const ReferenceRow& row, const std::string& column) {
    return std::stod(row.at(column));
}

}  // namespace magfsi::structure::test
