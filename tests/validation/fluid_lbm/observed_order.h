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

// Prints the errors and returns the order between the last two grids.
inline double observed_order(const char* what, const std::vector<Refinement>& grids) {
    double order = 0;
    std::printf("%s:", what);
    for (std::size_t i = 0; i < grids.size(); ++i) {
        std::printf("  n %d error %.3e", grids[i].cells, grids[i].error);
        if (i == 0) continue;
        order = std::log(grids[i - 1].error / grids[i].error) /
                std::log(static_cast<double>(grids[i].cells) / grids[i - 1].cells);
        std::printf(" (order %.2f)", order);
    }
    std::printf("\n");
    return order;
}

}  // namespace magfsi::fluid
