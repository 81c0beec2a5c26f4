// SPDX-License-Identifier: GPL-2.0-or-later
// What the validations share: orders of convergence and tables of references.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::fluid {

// Order of convergence from errors on grids that are refined by two.
struct Refinement {
    int cells = 0;
    double error = 0;
};

// Prints the errors with the order between neighbouring grids; returns the order over the
// whole refinement, which errors of opposite sign and higher order sway less.
inline double observed_order(const char* what, const std::vector<Refinement>& grids) {
    const auto order = [](const Refinement& coarse, const Refinement& fine) {
        return std::log(coarse.error / fine.error) /
               std::log(static_cast<double>(fine.cells) / coarse.cells);
    };
    std::printf("%s:", what);
    for (std::size_t i = 0; i < grids.size(); ++i) {
        std::printf("  n %d error %.3e", grids[i].cells, grids[i].error);
        if (i > 0) std::printf(" (order %.2f)", order(grids[i - 1], grids[i]));
    }
    const double overall = order(grids.front(), grids.back());
    std::printf("  overall order %.2f\n", overall);
    return overall;
}

// Rows of a comma-separated reference file: comments (#) and the line of titles are left
// out.
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
