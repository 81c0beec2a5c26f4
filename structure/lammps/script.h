// SPDX-License-Identifier: GPL-2.0-or-later
// From bodies and loads to a LAMMPS input: a data file, lattice files and the script's
// lines, with only the commands that the scene needs.
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

// A plane or a shape that pushes some of the bodies back: fix wall_NAME, of the
// platform's style. Its stiffness follows from the bodies.
struct Wall {
    std::string name;  // fit for an ID of LAMMPS
    Platform plane;
    std::optional<SolidShape> shape{};  // in place of the plane
    std::vector<std::size_t> bodies;    // ascending
};

struct LammpsInput {
    std::vector<Body> bodies;
    std::vector<Placement> placements;  // one a body; or none: all where their meshes are
    std::optional<FieldProgram> field;
    std::optional<GradientInput> gradient;  // with or without a field
    std::vector<FieldSource> sources;       // likewise
    std::optional<DipoleOptions> dipoles;
    std::optional<Vec3> gravity_m_s2;
    std::optional<Drag> drag;
    std::optional<Platform> platform;  // stiffness 0: that of platform_of
    std::vector<Wall> walls;
    std::vector<PrescribedMotion> motions;
    Vec3
        period_m{};  // of axes along which bodies meet each other and walls again, else 0
    std::optional<ContactLaw> contact;  // distance or stiffness 0: those of contact_law
    bool quiet = false;                 // fix quiet: how far from equilibrium
    bool reactions = false;  // with rollers: fix before_rollers keeps the forces on nodes
    double time_step_s = 0;
};

// Throws std::invalid_argument on an effect that is not in this build, and on what one
// that is asked for cannot do.
void check_effects(const LammpsInput& input);

// Stiffness [Pa/m] that effects add to a body's surface at worst.
double surface_spring_pa_m(const LammpsInput& input, const Body& body);

struct LammpsScript {
    std::vector<std::string> setup;  // up to, not including, the run command
    std::vector<int> first_node;  // atom ID (from 1) of each body's node 0; then the end
    std::vector<std::string>
        fix_id;  // each body's fix magttice (energies, work, smallest J)
};

// Writes bodies.data and each body's NAME.lattice into folder and returns the script,
// whose lines name these files as `folder` does. Call it on one rank; every rank runs the
// lines. Run them, then `run 0`, then `run N pre no post no` as often as needed: with
// neigh_modify once yes nothing but the forces and the integration is left in a step, and
// atoms keep their ranks and places. Besides fix_id there are, where asked for, the fixes
// platform, wall_NAME, quiet, drag, gravity, field, dipoles, before_rollers and the
// compute contact. A relaxed shape lies in the plane of `field` (x and z where there is
// none), and is found here, before LAMMPS starts, so that the script holds the run alone.
// Throws std::invalid_argument on bad input, std::runtime_error if a file cannot be
// written or a shape not be relaxed.
LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder);

}  // namespace magfsi::structure
