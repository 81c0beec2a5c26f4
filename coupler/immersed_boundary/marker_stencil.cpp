#include "coupler/immersed_boundary/marker_stencil.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

[[noreturn]] void left_the_box(const Grid& grid, const Vec3& point_m) {
    throw Diverged(fmt::format(
        "the body left the fluid: a marker is at ({:.4g}, {:.4g}, {:.4g}) mm, the box is "
        "{:.4g} x {:.4g} x {:.4g} mm; make fluid.box larger or end the run earlier",
        point_m[0] * 1e3, point_m[1] * 1e3, point_m[2] * 1e3,
        grid.cells[0] * grid.spacing_m * 1e3, grid.cells[1] * grid.spacing_m * 1e3,
        grid.cells[2] * grid.spacing_m * 1e3));
}

Stencil1D cut_at_walls(const Stencil1D& s, int cells) {
    Stencil1D cut;
    cut.first = std::max(s.first, 0);
    cut.count = std::min(s.first + s.count, cells) - cut.first;
    double sum = 0;
    for (int k = 0; k < cut.count; ++k) {
        const auto from = static_cast<std::size_t>(cut.first - s.first + k);
        cut.weight[static_cast<std::size_t>(k)] = s.weight[from];
        sum += s.weight[from];
    }
    for (double& w : cut.weight) w /= sum;
    return cut;
}

}  // namespace

void set_stencil(MarkerStencil& stencil, const Grid& grid, Kernel kernel,
                 const Vec3& point_m) {
    for (std::size_t d = 0; d < 3; ++d) {
        const int n = grid.cells[d];
        double position = point_m[d] / grid.spacing_m;
        if (grid.periodic[d]) position -= n * std::floor(position / n);
        if (!(position >= 0 && position <= n)) left_the_box(grid, point_m);
        Stencil1D& s = stencil[d];
        set_stencil(s, kernel, position);
        const bool inside = s.first >= 0 && s.first + s.count <= n;
        if (!inside && !grid.periodic[d]) s = cut_at_walls(s, n);
    }
}

MarkerStencil marker_stencil(const Grid& grid, Kernel kernel, const Vec3& point_m) {
    MarkerStencil stencil;
    set_stencil(stencil, grid, kernel, point_m);
    return stencil;
}

}  // namespace magfsi::coupler
