// Checks of faces that are held or moved.
#pragma once

#include <string>
#include <string_view>

#include "adapters/scene/checks.h"
#include "adapters/scene/names.h"

namespace magfsi::scene {

double largest_speed_m_s(const PrescribedMotion& motion);

// Whether the mesh has the face; those of a Gmsh file are known when it is read. list:
// what the face stands in.
void check_face(const Body& body, const std::string& face, std::string_view list,
                const Origin& here);

void check_prescribed_motion(const Scene& scene, const Body& body, const Marks& marks);

}  // namespace magfsi::scene
