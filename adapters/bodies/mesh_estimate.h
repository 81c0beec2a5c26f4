// SPDX-License-Identifier: GPL-2.0-or-later
// What the mesh of a scene's body does to its displacements, before the run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Of the run, at 200 times of it; the scene must have a field.
structure::Vec3 strongest_field_t(const scene::Scene& scene);

struct MeshEstimate {
    std::string not_made;  // why, and what to do instead; empty where it is made
    std::string loads;     // in words
    std::string against;   // what counts as right, in words
    double largest = 0;    // error of the largest displacement over it
    std::vector<std::pair<std::string, double>> points;  // of the body's point probes
};

// By structure/equilibrium/mesh_error.h, for blocks of more than 750 elements against
// what they and half as many elements along each axis extrapolate to, under the strongest
// field of the run and the weight; without either, of a held body, under its weight
// across the thickness. Of other meshes of more than 750 elements, only what their
// element does to them. Not made of a free body without field, of one that is not stable
// without loads, and of meshes that take more than about a second.
MeshEstimate estimate_mesh_error(const scene::Scene& scene, const scene::Body& body,
                                 const structure::Body& solid);

}  // namespace magfsi::bodies
