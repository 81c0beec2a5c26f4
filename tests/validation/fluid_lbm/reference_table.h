// Rows of a comma-separated reference file: comments (#) and the line of titles are left
// out.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::fluid {

inline std::vector<std::vector<std::string>> read_table(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file);
    std::vector<std::vector<std::string>> rows;
    std::string line, field;
    bool titles = true;
    while (std::getline(in, line)) {
        if (line.empty() || line[0] == '#') continue;
        if (titles) {
            titles = false;
            continue;
        }
        std::istringstream fields(line);
        rows.emplace_back();
        while (std::getline(fields, field, ',')) rows.back().push_back(field);
    }
    return rows;
}

}  // namespace magfsi::fluid
