// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS input of bodies and loads: a data file, lattice files and the script's lines,
// with only the commands that the scene needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/drag_law.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/placement.h"
#include "structure/solid_shape.h"
#include "structure/source_options.h"

namespace magfsi::structure {

// Plane or shape that pushes some of the bodies back: fix wall_NAME, of the platform's
// style. Its stiffness is derived from the bodies.
struct Wall {
    std::string name;  // must be valid in an ID of LAMMPS
    Platform plane;
    std::optional<SolidShape> shape{};  // replaces the plane if given
    std::vector<std::size_t> bodies;    // numbers in LammpsInput::bodies, ascending
};

// Bodies, loads and options of a run. Absent members are effects that the run does not
// have.
struct LammpsInput {
    std::vector<Body> bodies;
    // One per body, or none: bodies start where their meshes are
    std::vector<Placement> placements;
    std::optional<FieldProgram> field;
    std::optional<GradientInput> gradient;  // independent of `field`
    std::vector<FieldSource> sources;       // independent of `field`
    std::optional<DipoleOptions> dipoles;
    std::optional<Vec3> gravity_m_s2;
    std::optional<Drag> drag;
    std::optional<Platform> platform;  // stiffness 0: with_stiffness() fills it in
    std::vector<Wall> walls;
    std::vector<PrescribedMotion> motions;
    // Length of the period along each axis across which bodies meet each other and walls;
    // 0 along axes without one
    Vec3 period_m{};
    std::optional<ContactLaw> contact;  // distance or stiffness 0: those of contact_law
    // Adds fix quiet, which measures the distance from equilibrium
    bool quiet = false;
    // Adds fix before_rollers if there are rollers: it stores the forces on nodes, for
    // reactions
    bool reactions = false;
    // Adds the fix contact_load, which tells the contact's share of these forces
    bool contact_load = false;
    double time_step_s = 0;
};

// Throws std::invalid_argument if an effect is asked for that this build lacks, or by an
// effect that cannot handle the input.
void check_effects(const LammpsInput& input);

// Sum of the stiffnesses that effects add to a body's surface at worst [Pa/m], for the
// stable step.
double surface_spring_pa_m(const LammpsInput& input, const Body& body);

// A script and the names that its user needs.
struct LammpsScript {
    // Lines up to the run command, which is left out
    std::vector<std::string> setup;
    // Atom ID of each body's node 0, from 1 on, and at the end that of the next body
    std::vector<int> first_node;
    // Each body's fix magttice, which has its energies, work and smallest J
    std::vector<std::string> fix_id;
};

// Writes bodies.data and each body's NAME.lattice into the folder and returns the script,
// whose lines name these files as `folder` does. Call it on one rank; every rank runs the
// lines, then `run 0`, then `run N pre no post no` as often as needed. With `neigh_modify
// once yes` a step consists of forces and integration only, and atoms keep their ranks
// and indices. Besides those in fix_id there are, if asked for, the fixes platform,
// wall_NAME, quiet, drag, gravity, field, sources, dipoles and before_rollers, and the
// compute contact. A relaxed shape, with its field in the plane of `field` (xz without
// one), is solved for here, before LAMMPS starts, so that the script holds the run alone.
// Throws std::invalid_argument on bad input, std::runtime_error if a file cannot be
// written or a shape cannot be relaxed.
LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder);

// The lines of the setup as the text of a file in that folder. Where only this process
// could open bodies.data by the path in the script, it is named alone: such a script is
// run from within the folder.
std::string text_of(const LammpsScript& script);

}  // namespace magfsi::structure
