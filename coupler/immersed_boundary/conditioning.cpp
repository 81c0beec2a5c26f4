// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/conditioning.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupler/immersed_boundary/spreading.h"

namespace magfsi::coupler {

double condition_number(const Grid& grid, Kernel kernel, std::span<const Vec3> points_m,
                        std::span<const double> volume_m3) {
    constexpr int turns = 50;
    TouchedRows rows(grid, {CellBox{{0, 0, 0}, grid.cells}}, kernel);
    rows.place(points_m);
    std::vector<double> cells(3 * rows.cells());
    std::vector<Vec3> marker(points_m.size());
    // Applies the marker system: spreads forces of these sizes, times the markers'
    // volumes, and interpolates the result back to the markers. Forces act along x only,
    // since the system is the same for each component.
    const auto felt = [&](const std::vector<double>& size) {
        for (std::size_t m = 0; m < marker.size(); ++m)
            marker[m] = {volume_m3[m] * size[m], 0, 0};
        cells.assign(cells.size(), 0);
        rows.spread(marker, 1, cells);
        rows.interpolate(cells, marker);
    };
    felt(std::vector<double>(marker.size(), 1));
    std::vector<double> row_sum, x;
    for (const Vec3& r : marker) {
        row_sum.push_back(r[0]);
        x.push_back(std::sin(1.0 + 12.9898 * static_cast<double>(x.size() * x.size())));
    }
    double least = 1;
    for (int turn = 0; turn < turns; ++turn) {
        felt(x);
        double before = 0, after = 0;
        for (std::size_t m = 0; m < x.size(); ++m) {
            before += x[m] * x[m];
            x[m] -= marker[m][0] / row_sum[m];
            after += x[m] * x[m];
        }
        const double part = std::sqrt(after / before);
        if (!(part > 0)) break;
        least = 1 - part;
        for (double& value : x) value /= std::sqrt(after);
    }
    return 1 / std::max(least, 1e-12);
}

}  // namespace magfsi::coupler
