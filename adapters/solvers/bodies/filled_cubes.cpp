// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/filled_cubes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/words/likely_unit.h"
#include "fluid_lbm/obstacle/solid.h"
#include "structure/mesh/voxel_mesh.h"

namespace magfsi::bodies {

namespace {

// Largest number of cubes of the grid, filled or not. They take 0.1 GB of memory while
// the mesh is made.
constexpr double most_cubes = 2e6;

// Number of cubes along each axis of the grid around a surface: the extent of the surface
// rounded up to whole cubes. Throws std::invalid_argument on more than most_cubes.
std::array<int, 3> cubes_around(const fluid::Bounds& bounds_m,
                                const structure::VoxelMesh& voxels) {
    constexpr double rounding = 1e-5;  // a file has its lengths to seven digits
    std::array<int, 3> cubes{};
    const Vec3 size_m = bounds_m.high - bounds_m.low;
    double all = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        const double extent = size_m[d] / voxels.spacing_m - rounding;
        const double whole = std::max(1.0, std::ceil(extent));
        all *= whole;
        if (!(all <= most_cubes))
            throw std::invalid_argument(fmt::format(
                "{}, {:.4g} x {:.4g} x {:.4g} m large, lies in more than {:g} cubes of "
                "{:g} m; take a larger spacing, or {}",
                voxels.file, size_m[0], size_m[1], size_m[2], most_cubes,
                voxels.spacing_m,
                words::likely_unit(std::ranges::max(size_m), voxels.unit_m,
                                   2 * voxels.spacing_m, 500 * voxels.spacing_m)));
        cubes[d] = whole;
    }
    return cubes;
}

using Place = std::array<int, 3>;

// The grid of cubes, x fastest. filled: 1 if the centre of the cube lies inside the
// surface; held: fraction of the cube's volume inside.
struct Cubes {
    Place count{};
    std::vector<char> filled{};
    std::vector<double> held{};

    std::size_t number(const Place& p) const {
        return p[0] + count[0] * (p[1] + count[1] * p[2]);
    }
    // Calls act(number) for each of the up to 26 neighbours of a cube; with `faces` only
    // for the up to 6 that share a face with it.
    template <class Do>
    void around(const Place& p, bool faces, const Do& act) const {
        for (int n = 0; n < 27; ++n) {
            const Place way{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            const int steps = std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]);
            Place q = p;
            bool inside = steps > 0 && (!faces || steps == 1);
            for (std::size_t d = 0; d < 3; ++d) {
                q[d] += way[d];
                inside = inside && q[d] >= 0 && q[d] < count[d];
            }
            if (inside) act(number(q));
        }
    }
    template <class Do>
    void each(const Do& act) const {
        for (int k = 0; k < count[2]; ++k)
            for (int j = 0; j < count[1]; ++j)
                for (int i = 0; i < count[0]; ++i) act(Place{i, j, k});
    }
};

// Fills the cubes whose centres lie inside the surface.
void mark(const fluid::Solid& solid, Cubes& cubes) {
    const auto [width, depth, height] = cubes.count;
    const std::size_t row = width;
    cubes.filled.resize(row * static_cast<std::size_t>(depth) *
                        static_cast<std::size_t>(height));
    for (int k = 0; k < height; ++k) {
        for (int j = 0; j < depth; ++j)
            solid.mark_row(j + 0.5, k + 0.5, 0,
                           std::span(cubes.filled).subspan(cubes.number({0, j, k}), row));
    }
}

// Sample points along each edge of a cube for the fraction that lies inside. They are by
// an odd bit nearer to the middle than even ones, whose places are round fractions of the
// cube: a face through them would be inside at one end of a body, outside at the other.
constexpr int points_of_edge = 4;
constexpr double points_apart = (1 - 1.3e-5) / points_of_edge;

// Number of points of a cube that lie inside, `count` of them along each edge.
int points_inside(const fluid::Solid& solid, const Place& p, int count, double apart) {
    const auto at = [&](int i, int low) {
        return low + 0.5 + (i - 0.5 * (count - 1)) * apart;
    };
    int inside = 0;
    for (int n = 0; n < count * count * count; ++n)
        inside += solid.holds({at(n % count, p[0]), at(n / count % count, p[1]),
                               at(n / count / count, p[2])});
    return inside;
}

// Determines `held` of each cube. Only cubes that the surface may cut are sampled: those
// with a neighbour of the other kind, and filled ones at the edge of the grid. A cube
// with the surface through its centre is filled from a half on, on both sides of a body
// alike.
void measure(const fluid::Solid& solid, Cubes& cubes) {
    cubes.held.assign(cubes.filled.begin(), cubes.filled.end());
    std::vector<std::size_t> on_surface;
    cubes.each([&](const Place& p) {
        const std::size_t number = cubes.number(p);
        const char mine = cubes.filled[number];
        bool cut = std::ranges::any_of(std::array{0, 1, 2}, [&](int d) {
            return mine != 0 && (p[d] == 0 || p[d] + 1 == cubes.count[d]);
        });
        cubes.around(p, false,
                     [&](std::size_t q) { cut = cut || cubes.filled[q] != mine; });
        if (!cut) return;
        cubes.held[number] = points_inside(solid, p, points_of_edge, points_apart) /
                             std::pow(points_of_edge, 3);
        const int at_centre = points_inside(solid, p, 2, 2e-5);
        if (at_centre != 0 && at_centre != 8) on_surface.push_back(number);
    });
    for (const std::size_t number : on_surface)
        cubes.filled[number] = cubes.held[number] >= 0.5;
}

// Weight of each cube: its own fraction inside plus equal shares of the fractions of
// omitted neighbours. An omitted cube gives its fraction to the filled cubes at its
// faces, or without any to all filled cubes around it. volume: that inside the surface,
// in volumes of a cube. The weights of cut cubes are scaled so that the sum is this
// volume, for the few sample points are inexact where the surface runs along the grid.
std::vector<double> weights(const Cubes& cubes, double volume) {
    // Limit of the scale: a larger one means that a part of the body has no cube at all.
    constexpr double most = 1.25;
    std::vector<double> out = cubes.held;
    cubes.each([&](const Place& p) {
        const std::size_t mine = cubes.number(p);
        if (cubes.filled[mine] || cubes.held[mine] == 0) return;
        out[mine] = 0;
        for (const bool faces : {true, false}) {
            int takers = 0;
            cubes.around(p, faces, [&](std::size_t q) { takers += cubes.filled[q]; });
            if (takers == 0) continue;
            cubes.around(p, faces, [&](std::size_t q) {
                if (cubes.filled[q]) out[q] += cubes.held[mine] / takers;
            });
            return;
        }
    });
    double whole = 0, cut = 0;
    for (std::size_t i = 0; i < out.size(); ++i) (out[i] == 1 ? whole : cut) += out[i];
    const double scale = cut > 0 ? std::clamp((volume - whole) / cut, 1 / most, most) : 1;
    for (double& weight : out)
        if (weight != 1) weight *= scale;
    return out;
}

// Weights are taken together that round to the same multiple of 1/16 of a cube, so that
// there are few materials: the elements of one material are computed together.
constexpr int parts_of_cube = 16;

// Gives elements whose weights round alike the mean of these; none if all cubes are
// whole. So the sum of the weights is kept, and cubes that are alike remain so. A cube
// has at least one part.
void add_shares(structure::Mesh& mesh, const std::vector<double>& weight,
                const Cubes& cubes, double spacing_m) {
    constexpr double rounding = 1e-9;
    constexpr int whole = 0;
    struct Kind {
        double sum = 0;
        int count = 0;
    };
    std::map<int, Kind> kinds;
    std::vector<int> of;
    for (const structure::Hexahedron& element : mesh.elements) {
        const structure::Vec3& corner = mesh.nodes[element[0]];
        Place p{};
        for (std::size_t d = 0; d < 3; ++d) p[d] = std::lround(corner[d] / spacing_m);
        const double exact = weight[cubes.number(p)];
        const double held = std::max(1.0 / parts_of_cube, exact);
        of.push_back(
            exact == 1 ? whole
                       : static_cast<int>(std::lround(parts_of_cube * held + rounding)));
        kinds[of.back()].sum += held;
        ++kinds[of.back()].count;
    }
    if (kinds.size() == 1 && kinds.contains(whole)) return;
    for (const int kind : of)
        mesh.solid_share.push_back(kinds[kind].sum / kinds[kind].count);
}

}  // namespace

structure::Mesh filled_mesh(const structure::VoxelMesh& voxels) {
    fluid::StlSurface surface{voxels.file, voxels.unit_m, {}};
    const fluid::StlExtent extent = fluid::stl_extent(surface);
    const fluid::Bounds& bounds = extent.bounds_m;
    Cubes cubes{cubes_around(bounds, voxels)};
    for (std::size_t d = 0; d < 3; ++d)
        surface.shift_m[d] =
            0.5 * (cubes.count[d] * voxels.spacing_m - bounds.low[d] - bounds.high[d]);
    const auto solid = fluid::make_stl_solid(
        surface, voxels.spacing_m,
        {{}, {1.0 * cubes.count[0], 1.0 * cubes.count[1], 1.0 * cubes.count[2]}});
    mark(*solid, cubes);
    measure(*solid, cubes);
    structure::Mesh mesh =
        structure::voxel_mesh(cubes.count, voxels.spacing_m, cubes.filled);
    add_shares(mesh, weights(cubes, extent.volume_m3 / std::pow(voxels.spacing_m, 3)),
               cubes, voxels.spacing_m);
    for (Vec3& x : mesh.nodes) x -= surface.shift_m;
    return mesh;
}

void weigh(structure::Body& body) {
    const std::vector<double>& shares = body.mesh.solid_share;
    if (shares.empty()) return;
    if (body.element_material.empty()) body.element_material.assign(shares.size(), 0);
    std::map<std::pair<int, double>, int> numbers;  // by whole material and share
    for (std::size_t e = 0; e < shares.size(); ++e) {
        const double share = shares[e];
        if (share == 1) continue;
        const auto [found, is_new] =
            numbers.try_emplace({body.element_material[e], share},
                                static_cast<int>(body.other_materials.size()) + 1);
        if (is_new) {
            structure::Material material = structure::material_of(body, e);
            material.shear_modulus_pa *= share;
            material.lame_lambda_pa *= share;
            material.density_kg_m3 *= share;
            material.viscosity_pa_s *= share;
            body.other_materials.push_back(material);
        }
        body.element_material[e] = found->second;
        if (!body.magnetization_a_m.empty()) body.magnetization_a_m[e] *= share;
    }
}

double surface_volume_m3(const structure::VoxelMesh& voxels) {
    return fluid::stl_extent({voxels.file, voxels.unit_m, {}}).volume_m3;
}

}  // namespace magfsi::bodies
