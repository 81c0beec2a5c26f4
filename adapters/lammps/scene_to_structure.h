// The scene's bodies and loads in the terms of structure/.
#pragma once

#include "coupler/scene/scene.h"
#include "structure/lammps/script.h"
#include "structure/mesh/box_mesh.h"

namespace magfsi::lammps {

structure::Box to_box(const scene::BoxMesh& mesh);
structure::Body to_body(const scene::Scene& scene, const scene::Body& body);
structure::FieldProgram to_field(const scene::MagneticField& field);

// time_step_s: LAMMPS's own step.
structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s);

// Largest stable LAMMPS step over all bodies [s].
double stable_step_s(const scene::Scene& scene);

}  // namespace magfsi::lammps
