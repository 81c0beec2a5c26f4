// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/body_markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/probe_row.h"

namespace magfsi::lammps {

namespace {

using Placed = std::vector<bodies::PlacedMarker>;

// The markers of all bodies, the same on every rank.
Placed place_all(const scene::Scene& scene, const bodies::Solids& solids) {
    Placed all;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const auto markers = bodies::place_markers(scene, b, solids[b].mesh);
        all.insert(all.end(), markers.begin(), markers.end());
    }
    return all;
}

// The marker with the local indices of its nodes on this rank. first_atom: atom ID of
// node 0 of its body.
coupler::Marker to_marker(const bodies::PlacedMarker& placed, int first_atom,
                          const Engine& engine) {
    coupler::Marker marker;
    for (std::size_t a = 0; a < 8; ++a) {
        const int atom = placed.point.node[a] + first_atom;
        marker.node[a] = engine.local_index(atom);
        if (marker.node[a] < 0) {
            throw std::logic_error(
                fmt::format("atom {} of a marker's element is not on this rank "
                            "(ghost cutoff too small)",
                            atom));
        }
    }
    marker.weight = placed.point.weight;
    marker.volume_m3 = placed.volume_m3;
    marker.displaced_m3 = placed.displaced_m3;
    marker.beyond_m3 = placed.beyond_m3;
    marker.core = placed.core;
    marker.body = placed.body;
    return marker;
}

// Subtracts from the displaced volume of each marker the part whose fluid the nodes'
// masses already lack: the marker's force of the enclosed fluid is that of the rest. Sets
// how fast that force follows the fluid in the serial scheme, by the ratio of densities.
void share_fluid_inside(const scene::Scene& scene, const bodies::Solids& solids,
                        coupler::BodyMarkers& mine) {
    mine.measures_force = bodies::needs(scene, bodies::Load::fluid_force) ||
                          (scene.probes && !scene.probes->integrals.empty());
    std::vector<double> off_kg_m3;
    for (const structure::Body& solid : solids)
        off_kg_m3.push_back(bodies::off_nodes_kg_m3(scene, solid));
    for (coupler::Marker& m : mine.markers) {
        const double off = off_kg_m3[m.body];
        if (mine.measures_force) mine.off_nodes_kg.push_back(off * m.displaced_m3);
        const double share = off / scene.fluid->density_kg_m3;
        m.displaced_m3 *= 1 - share;
        if (scene.coupling->scheme == coupler::Scheme::serial)
            m.enclosed_follow =
                coupler::enclosed_follow_of(share / bodies::largest_part_off_nodes,
                                            scene.coupling->immersed_boundary.kernel);
    }
}

// Lists for each body part of probes.integrals the markers of this rank in it.
void find_parts(const scene::Scene& scene, const bodies::Solids& solids,
                const Placed& placed, coupler::BodyMarkers& mine) {
    if (!scene.probes) return;
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        const auto* part = std::get_if<scene::BodyPart>(&integral.over);
        if (!part) continue;
        const auto body = std::ranges::find(scene.bodies, part->body, &scene::Body::name);
        const int b = body - scene.bodies.begin();
        const auto in = bodies::elements_of(*part, solids[b].mesh);
        auto& markers = mine.parts.emplace_back();
        for (std::size_t m = 0; m < mine.placed_index.size(); ++m) {
            const auto& p = placed[mine.placed_index[m]];
            if (p.body == b && in[p.point.element]) markers.push_back(m);
        }
    }
}

}  // namespace

// All ranks place all markers, so that placed_index means the same on each of them.
coupler::BodyMarkers own_markers(const scene::Scene& scene, const bodies::Solids& solids,
                                 const Engine& engine, const std::vector<int>& first_node,
                                 const coupler::Grid& grid, const coupler::Clock& clock) {
    const coupler::SolidCells solid(grid);
    const auto kernel = scene.coupling->immersed_boundary.kernel;
    const Placed placed = place_all(scene, solids);
    coupler::BodyMarkers mine;
    mine.placed = placed.size();
    mine.bodies = scene.bodies.size();
    for (const bodies::PlacedMarker& p : placed) {
        if (p.beyond_m3 != 0) mine.carries_layers = true;
        const int first_atom = first_node[p.body];
        if (!engine.owns(p.point.node[0] + first_atom)) continue;
        const coupler::Marker marker = to_marker(p, first_atom, engine);
        const auto stencil = coupler::marker_stencil(
            grid, kernel, coupler::at_marker(marker, engine.positions()));
        if (solid.fluid_share(stencil) < coupler::least_fluid_share) continue;
        if (p.first_edge != std::array<double, 8>{}) {
            mine.areas.push_back(
                {static_cast<int>(mine.markers.size()), p.first_edge, p.second_edge});
        }
        mine.markers.push_back(marker);
        mine.placed_index.push_back(&p - placed.data());
    }
    mine.gravity_m_s2 = bodies::to_gravity(scene).value_or(coupler::Vec3{});
    mine.slip_rates =
        coupler::slip_rates({scene.fluid->viscosity_m2_s, scene.fluid->expected_speed_m_s,
                             grid.spacing_m, clock.step_s()});
    mine.measures_work = scene.probes && scene.probes->energy_audit;
    // Slip is sampled with the probe rows, in a run without probes a hundred times.
    mine.steps_between_slip_samples =
        scene.probes ? clock.every(scene.probes->every_s)
                     : std::max<std::int64_t>(1, clock.steps() / 100);
    share_fluid_inside(scene, solids, mine);
    find_parts(scene, solids, placed, mine);
    return mine;
}

}  // namespace magfsi::lammps
