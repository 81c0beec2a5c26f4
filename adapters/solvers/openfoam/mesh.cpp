// SPDX-License-Identifier: GPL-2.0-or-later
// Graded axes: from the uniform part outwards the cells grow as a geometric series whose
// ratio fits the rest of the axis.
#include "adapters/solvers/openfoam/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace magfsi::openfoam {

namespace {

// Length of `cells` cells in spacings: the sum of growth^1 to growth^cells.
double reach(double growth, int cells) {
    double sum = 0, width = 1;
    for (int i = 0; i < cells; ++i) sum += width *= growth;
    return sum;
}

// Widths in spacings of cells that fill `gap` spacings, the finest first. The number of
// cells is the smallest that max_growth allows, their ratio is found by bisection.
std::vector<double> growing(double gap, double max_growth) {
    std::vector<double> widths;
    if (gap < 0.5) return widths;  // gap is a whole number
    int cells = 1;
    while (reach(max_growth, cells) < gap) ++cells;
    cells = std::min<int>(cells, std::lround(gap));
    double low = 1, high = max_growth;
    for (int i = 0; i < 60; ++i) {  // bisection to the last bit
        const double middle = (low + high) / 2;
        (reach(middle, cells) < gap ? low : high) = middle;
    }
    double width = 1;
    for (int i = 0; i < cells; ++i) widths.push_back(width *= high);
    const double stretch = gap / reach(high, cells);
    for (double& w : widths) w *= stretch;
    return widths;
}

}  // namespace

// Planes below the uniform part are built downwards and reversed. The first and last one
// are set to the exact ends of the box.
std::vector<double> axis_planes(double length_m, double spacing_m,
                                const UniformPart* uniform) {
    const int cells = std::lround(length_m / spacing_m);
    int from = 0, to = cells;
    constexpr double rounding = 1e-6;  // in cells
    if (uniform) {
        from = static_cast<int>(std::floor(uniform->from_m / spacing_m + rounding));
        to = static_cast<int>(std::ceil(uniform->to_m / spacing_m - rounding));
    }
    std::vector<double> below, planes;
    if (from > 0) below = growing(from, uniform->growth);
    double at = from;
    for (const double width : below) planes.push_back((at -= width) * spacing_m);
    std::reverse(planes.begin(), planes.end());
    for (int i = from; i <= to; ++i) planes.push_back(i * spacing_m);
    at = to;
    if (to < cells) {
        for (const double width : growing(cells - to, uniform->growth))
            planes.push_back((at += width) * spacing_m);
    }
    planes.front() = 0;
    planes.back() = length_m;
    return planes;
}

// Both lists ascend, so one pass over the planes finds all cells.
std::vector<int> cell_of_uniform(const std::vector<double>& planes_m, double spacing_m) {
    const auto cells = std::lround(planes_m.back() / spacing_m);
    std::vector<int> cell(cells);
    int at = 0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const double centre = (static_cast<double>(i) + 0.5) * spacing_m;
        while (planes_m[at + 1] < centre) ++at;
        cell[i] = at;
    }
    return cell;
}

namespace {

// Throws for boundary conditions of the lattice that OpenFOAM's adapter lacks.
SideType to_side(fluid::BoundaryKind kind) {
    using enum fluid::BoundaryKind;
    if (kind == periodic) return SideType::periodic;
    if (kind == no_slip) return SideType::wall;
    if (kind == free_slip) return SideType::symmetry;
    if (kind == velocity_inlet || kind == pressure_outlet) return SideType::open;
    throw std::invalid_argument(fmt::format(
        "fluid.boundaries: {} with fluid.solver openfoam; only with the solver "
        "lbm",
        scene::name_of(kind)));
}

}  // namespace

// There is one plane more than cells along each axis.
std::array<int, 3> mesh_cells(const BoxMesh& mesh) {
    std::array<int, 3> cells{};
    for (std::size_t d = 0; d < 3; ++d)
        cells[d] = static_cast<int>(mesh.planes_m[d].size()) - 1;
    return cells;
}

// Layers of cells are distributed as evenly as whole numbers allow.
BoxMesh to_mesh(const scene::Fluid& fluid, int rank, int ranks) {
    BoxMesh mesh;
    for (std::size_t d = 0; d < 3; ++d) {
        UniformPart part;
        if (fluid.grading) {
            const auto& corners = fluid.grading->uniform_m;
            part = {corners[0][d], corners[1][d], fluid.grading->growth};
        }
        mesh.planes_m[d] =
            axis_planes(fluid.box_m[d], fluid.spacing_m, fluid.grading ? &part : nullptr);
    }
    for (std::size_t side = 0; side < 6; ++side)
        mesh.sides[side] = to_side(fluid.boundaries[side].kind);
    const auto cells = mesh_cells(mesh);
    // The last of axes with equally many cells is cut: its slabs are contiguous in
    // memory.
    for (int d = 0; d < 3; ++d) {
        if (cells[d] >= cells[mesh.cut_axis]) mesh.cut_axis = d;
    }
    const int long_side = cells[mesh.cut_axis];
    if (ranks > long_side) {
        throw std::invalid_argument(
            fmt::format("--ranks fluid={}: the mesh has {} layers of cells along its "
                        "longest side; take at most that many",
                        ranks, long_side));
    }
    if (!fluid.obstacles.empty() && ranks > 1) {
        throw std::invalid_argument(fmt::format(
            "--ranks fluid={}: allowed is 1 with fluid.obstacles and fluid.solver "
            "openfoam: the mesh around them is not cut into parts",
            ranks));
    }
    for (int r = 0; r <= ranks; ++r) mesh.first_cell.push_back(r * long_side / ranks);
    mesh.rank = rank;
    return mesh;
}

// `cell` ascends, so that the uniform cells of a rank are the range between two lower
// bounds.
coupler::Grid to_grid(const scene::Fluid& fluid, const BoxMesh& mesh) {
    coupler::Grid grid;
    grid.spacing_m = fluid.spacing_m;
    for (std::size_t d = 0; d < 3; ++d) {
        grid.cells[d] = std::lround(fluid.box_m[d] / fluid.spacing_m);
        grid.periodic[d] = mesh.sides[2 * d] == SideType::periodic;
    }
    const std::size_t axis = mesh.cut_axis;
    const auto cell = cell_of_uniform(mesh.planes_m[axis], fluid.spacing_m);
    for (std::size_t r = 0; r + 1 < mesh.first_cell.size(); ++r) {
        coupler::CellBox box{{}, grid.cells};
        const auto index = [&](int first) {
            return static_cast<int>(std::ranges::lower_bound(cell, first) - cell.begin());
        };
        box.lo[axis] = index(mesh.first_cell[r]);
        box.hi[axis] = index(mesh.first_cell[r + 1]);
        grid.owned_by_rank.push_back({box});
    }
    return grid;
}

}  // namespace magfsi::openfoam
