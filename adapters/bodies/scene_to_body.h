// The scene's bodies and loads in the terms of structure/.
#pragma once

#include <optional>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Throws std::invalid_argument on what only the mesh can tell, naming the body;
// scene::SceneError on a region of material_regions that it does not have.
structure::Body to_body(const scene::Body& body);
std::optional<structure::Vec3> to_gravity(const scene::Scene& scene);

}  // namespace magfsi::bodies
