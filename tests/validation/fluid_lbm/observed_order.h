// Order of convergence from errors on grids that are refined by two.
#pragma once

#include <cmath>
#include <cstdio>
#include <vector>

namespace magfsi::fluid {

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

}  // namespace magfsi::fluid
