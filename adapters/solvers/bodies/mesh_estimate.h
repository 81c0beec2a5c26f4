// SPDX-License-Identifier: GPL-2.0-or-later
// An estimate, before the run, of the error that the mesh of a body makes in its
// displacements.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// The strongest uniform field of the run [T]: the longest vector at 201 equidistant
// times, both ends included. The scene must have a magnetic_field.
structure::Vec3 strongest_field_t(const scene::Scene& scene);

struct MeshEstimate {
    // The reason why there is no estimate and what to do instead; empty if there is one.
    std::string not_made;
    std::string loads;    // the loads, in words
    std::string against;  // the reference that the mesh is compared with, in words
    // Relative error of the largest displacement [-] (structure::displacement_error).
    double largest = 0;
    // Relative error [-] at each point probe of the body, by the probe's name; probes
    // that hardly move are left out.
    std::vector<std::pair<std::string, double>> points;
};

// Estimates the error by the linear response of the undeformed body
// (structure/equilibrium/mesh_error.h) to the strongest field of the run and the weight;
// a held body without either is loaded by a weight across its thickness. The reference:
//   up to 750 elements   the mesh refined once, or twice if that leaves at most 6000
//                        elements
//   larger blocks        Richardson extrapolation from the mesh and one of half as many
//                        elements along each axis
//   other larger meshes  elements assumed_strain on the same mesh: the error of the
//                        element alone
// No estimate is made of meshes of more than 6000 elements, which take more than about a
// second, of larger meshes of elements assumed_strain that are no block, of a free body
// without field, and of a body that is not stable without loads; not_made says so. solid:
// to_body of `body`.
MeshEstimate estimate_mesh_error(const scene::Scene& scene, const scene::Body& body,
                                 const structure::Body& solid);

// Largest difference of a node's displacement between a magnetisation that follows the
// deformation and one that follows the rotation, over the largest displacement, in the
// linear response to the strongest uniform field and the weight. Nothing where the body
// has no field, or not a uniform one alone, or too many elements.
std::optional<double> difference_of_follows(const scene::Scene& scene,
                                            const structure::Body& solid);

}  // namespace magfsi::bodies
