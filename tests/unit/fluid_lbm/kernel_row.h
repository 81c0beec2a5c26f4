// One row of cells run through a row kernel with natural pointers.
#pragma once

#include <vector>

#include "fluid_lbm/streaming/kernels.h"
#include "tests/unit/fluid_lbm/reference_collision.h"

namespace magfsi::fluid {

// Populations after collision, each under its own direction.
template <class Real>
std::vector<reference::Cell> collide(RowKernel<Real> kernel,
                                     const std::vector<reference::Cell>& cells,
                                     const std::vector<reference::Vec3>& force,
                                     const CollisionParameters& parameters) {
    using namespace d3q19;
    const std::size_t n = cells.size();
    std::vector<Real> rows[directions], force_rows[3];
    Real* at[directions];
    const Real* force_at[3];
    for (int q = 0; q < directions; ++q) {
        rows[q].resize(n);
        for (std::size_t x = 0; x < n; ++x) rows[q][x] = static_cast<Real>(cells[x][q]);
        at[q] = rows[q].data();
    }
    for (int a = 0; a < 3; ++a) {
        force_rows[a].resize(n);
        for (std::size_t x = 0; x < n; ++x)
            force_rows[a][x] = static_cast<Real>(force[x][a]);
        force_at[a] = force_rows[a].data();
    }
    kernel(at, force_at, static_cast<std::ptrdiff_t>(n), parameters);
    std::vector<reference::Cell> out(n);
    for (int q = 0; q < directions; ++q) {
        for (std::size_t x = 0; x < n; ++x) out[x][q] = rows[opposite(q)][x];
    }
    return out;
}

}  // namespace magfsi::fluid
