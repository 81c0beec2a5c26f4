// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/openfoam/obstacles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "adapters/solvers/openfoam/inlet.h"
#include "adapters/solvers/openfoam/mesh.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::openfoam {

namespace {

// Part of a spacing within which a face is on a plane of the mesh.
constexpr double on_plane = 1e-6;

// The obstacles as the lattice sees them, in cells of the uniform grid.
fluid::Solids solids_of(const scene::Fluid& fluid) {
    fluid::FluidConfig config;
    static_cast<fluid::Options&>(config) = fluid;
    config.spacing_m = fluid.spacing_m;
    for (std::size_t d = 0; d < 3; ++d)
        config.cells[d] = static_cast<int>(std::lround(fluid.box_m[d] / fluid.spacing_m));
    return fluid::make_solids(config);
}

// The plane of the mesh at a coordinate; the sides of the box stand for all beyond.
std::optional<int> plane_at(const std::vector<double>& planes_m, double at_m,
                            double spacing_m) {
    const double at = std::clamp(at_m, planes_m.front(), planes_m.back());
    for (std::size_t i = 0; i < planes_m.size(); ++i)
        if (std::abs(planes_m[i] - at) <= on_plane * spacing_m) return i;
    return {};
}

// The box between planes of the mesh, if all its faces are some.
std::optional<CutBox> cut_box(const scene::Fluid& fluid, const BoxMesh& mesh,
                              std::size_t number) {
    const auto* block = std::get_if<fluid::Block>(&fluid.obstacles[number].shape);
    if (!block) return {};
    CutBox box{number, {}, {}};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto low = plane_at(mesh.planes_m[d], block->low_m[d], fluid.spacing_m);
        const auto high = plane_at(mesh.planes_m[d], block->high_m[d], fluid.spacing_m);
        if (!low || !high || *low >= *high) return {};
        box.low[d] = *low;
        box.high[d] = *high;
    }
    return box;
}

// Across a periodic side the fluid's faces must match: an obstacle either keeps away from
// both sides or goes through the box.
void check_periodic(const scene::Fluid& fluid, const BoxMesh& mesh,
                    const fluid::Bounds& bounds, const std::string& name) {
    for (std::size_t d = 0; d < 3; ++d) {
        if (mesh.sides[2 * d] != SideType::periodic) continue;
        const double length = fluid.box_m[d] / fluid.spacing_m;
        const bool low = bounds.low[d] < on_plane;
        const bool high = bounds.high[d] > length - on_plane;
        if (low == high) continue;
        throw std::invalid_argument(fmt::format(
            "fluid.obstacles.{}: found a body across the periodic side {}; with "
            "fluid.solver openfoam allowed are bodies away from periodic sides or "
            "through the whole box: move it, or take solver: lbm",
            name, fluid::side_name[2 * d + (low ? 0 : 1)]));
    }
}

}  // namespace

ObstaclePlan plan_obstacles(const scene::Fluid& fluid, const BoxMesh& mesh) {
    ObstaclePlan plan;
    if (fluid.obstacles.empty()) return plan;
    const fluid::Solids solids = solids_of(fluid);
    for (std::size_t i = 0; i < fluid.obstacles.size(); ++i) {
        check_periodic(fluid, mesh, solids[i]->bounds(), fluid.obstacles[i].name);
        if (const auto box = cut_box(fluid, mesh, i))
            plan.cut.push_back(*box);
        else
            plan.snapped.push_back(i);
    }
    return plan;
}

std::string patch_name(const scene::Obstacle& obstacle) {
    const bool taken = std::ranges::find(scene::names<scene::Face>, obstacle.name) !=
                       scene::names<scene::Face>.end();
    return taken ? obstacle.name + "_obstacle" : obstacle.name;
}

// Cells are looked through in the order of their distance from the inlet. The point is
// not the cell's centre, for snappyHexMesh wants none on a face of any mesh.
scene::Vec3 point_in_fluid(const scene::Fluid& fluid) {
    const fluid::Solids solids = solids_of(fluid);
    std::array<int, 3> n{};
    for (std::size_t d = 0; d < 3; ++d)
        n[d] = static_cast<int>(std::lround(fluid.box_m[d] / fluid.spacing_m));
    std::size_t first = 0;  // axis along which the search goes, and from its far end?
    bool backwards = false;
    for (std::size_t side = 0; side < 6; ++side) {
        if (fluid.boundaries[side].kind != fluid::BoundaryKind::velocity_inlet) continue;
        first = side / 2;
        backwards = side % 2 == 1;
    }
    const std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
    const auto is_free = [&](const std::array<int, 3>& cell) {
        for (int k = 0; k < 27; ++k) {
            const scene::Vec3 point{cell[0] + k % 3 - 0.5, cell[1] + k / 3 % 3 - 0.5,
                                    cell[2] + k / 9 - 0.5};
            for (const auto& solid : solids)
                if (solid->holds(point)) return false;
        }
        return true;
    };
    for (int i = 0; i < n[first]; ++i) {
        for (int j = 0; j < n[second]; ++j) {
            for (int k = 0; k < n[third]; ++k) {
                std::array<int, 3> cell{};
                cell[first] = backwards ? n[first] - 1 - i : i;
                cell[second] = (j + n[second] / 2) % n[second];  // from the middle
                cell[third] = (k + n[third] / 2) % n[third];
                if (is_free(cell))
                    return fluid.spacing_m *
                           scene::Vec3{cell[0] + 0.47, cell[1] + 0.53, cell[2] + 0.49};
            }
        }
    }
    throw std::invalid_argument(
        "fluid.obstacles: found no cell of fluid without an obstacle beside it; take a "
        "finer fluid.spacing");
}

// Looks half a cell inside of each face through which something enters.
void refuse_inlets_behind_obstacles(const scene::Fluid& fluid, const BoxMesh& mesh) {
    const fluid::Solids solids = solids_of(fluid);
    for (int side = 0; side < 6; ++side) {
        if (fluid.boundaries[side].kind != fluid::BoundaryKind::velocity_inlet) continue;
        const int axis = side / 2, first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
        const auto &a = mesh.planes_m[first], &b = mesh.planes_m[second];
        scene::Vec3 point{};
        point[axis] = side % 2 == 0 ? 0.5 : fluid.box_m[axis] / fluid.spacing_m - 0.5;
        const auto shape = slab_shape(fluid, mesh, side);
        bool open = false;
        for (std::size_t face = 0; face < shape.size(); ++face) {
            const std::size_t i = face % (a.size() - 1), j = face / (a.size() - 1);
            point[first] = 0.5 * (a[i] + a[i + 1]) / fluid.spacing_m;
            point[second] = 0.5 * (b[j] + b[j + 1]) / fluid.spacing_m;
            open = open || (shape[face] > 0 &&
                            std::ranges::none_of(solids, [&](const auto& solid) {
                                return solid->holds(point);
                            }));
        }
        if (!open)
            throw std::invalid_argument(fmt::format(
                "fluid inlet at {} lies behind fluid.obstacles, which let none of its "
                "flow into the box; move them, or give the inlet an opening beside them",
                fluid::side_name[side]));
    }
}

}  // namespace magfsi::openfoam
