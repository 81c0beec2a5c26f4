// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of bodies, `platform` and `contact`, stored in structure/options.h. Meshes are
// in keys_mesh.cpp, regions and magnetisations in keys_magnetization.cpp. A comment
// before each function names the place of its group below `bodies.NAME`.
#include "adapters/scene/keys.h"
#include "adapters/scene/presets.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `material.gent`.
template <class Io>
void keys(Io& io, Gent& gent) {
    io(key("limit",
           "Largest I1 - 3 of the stretches, called J_m. A bar then stretches up to L with L^2 + "
           "2 / L - 3 = J_m: 5.6 times for 30.").above(0),
       gent.limit);
}

// Keys of `material.yeoh`.
template <class Io>
void keys(Io& io, Yeoh& yeoh) {
    io(quantity("c2", "Pa", "Constant of (I1 - 3)^2, of either sign."), yeoh.c2_pa);
    io(quantity("c3", "Pa", "Constant of (I1 - 3)^3.").at_least(0).by_default(), yeoh.c3_pa);
}

// Keys of `material.arruda_boyce`.
template <class Io>
void keys(Io& io, ArrudaBoyce& chains) {
    io(key("locking_stretch",
           "Largest stretch of a chain, the root of I1 / 3: the root of its number of segments.").above(1),
       chains.locking_stretch);
}

// Keys of `material.maxwell[]`.
template <class Io>
void keys(Io& io, MaxwellBranch& branch) {
    io(quantity("modulus", "Pa", "Shear modulus that the branch adds at once.").above(0),
       branch.modulus_pa);
    io(quantity("time", "s", "Time in which the stress of the branch falls to 1/e.").above(0),
       branch.time_s);
}

// Keys of `material`, and an item of material_regions. Reading converts E and nu to G and lambda;
// writing has G and lambda only.
template <class Io>
void keys(Io& io, Material& material) {
    std::optional<MaterialPreset> preset;  // becomes the constants when read
    io(key("preset",
           "A material that was measured, in place of the other keys, which may replace single "
           "constants of it. zhao_2019: printed elastomer with magnetic powder; tan_2022: that of a "
           "bistable arch; vhb_4910: acrylic elastomer."), preset);
    if (preset) material = material_of(*preset);
    io(quantity("shear_modulus", "Pa",
           "Shear modulus G. It goes with lame_lambda; youngs_modulus and poissons_ratio "
           "can stand in place of both.").above(0)
           .optional(), material.shear_modulus_pa);
    io(quantity("lame_lambda", "Pa", "First Lame constant, called K in the paper.").at_least(0)
           .optional(), material.lame_lambda_pa);
    double e = 0, nu = 0;  // converted to the first two when read
    io(quantity("youngs_modulus", "Pa",
           "Young's modulus E at small strains. It goes with poissons_ratio: G = E / (2 "
           "(1 + nu)), K = 2 G nu / (1 - 2 nu).").above(0).optional(), e);
    io(key("poissons_ratio",
           "Poisson's ratio nu at small strains. With 0.476 K is 20 G.")
           .at_least(0).at_most(0.4999).optional(),
       nu);
    if (e > 0) {
        material.shear_modulus_pa = e / (2 * (1 + nu));
        material.lame_lambda_pa = e * nu / ((1 + nu) * (1 - 2 * nu));
    }
    io(quantity("density", "kg/m3", "Mass per volume. Needed without a preset.").above(0).optional(),
       material.density_kg_m3);
    io(quantity("viscosity", "Pa s",
           "Kelvin-Voigt viscosity: the viscous stress is twice this times the rate of "
           "strain.").above(0).optional(),
       material.viscosity_pa_s);
    io.alternatives(material.stiffening,
        key("gent",
           "Stiffening by Gent's energy, which has a limit of stretch: -G/2 J_m ln(1 - (I1 - 3) / "
           "J_m) in place of G/2 (I1 - 3)."),
        key("yeoh",
           "Stiffening by Yeoh's energy: G/2 (I1 - 3) + c2 (I1 - 3)^2 + c3 (I1 - 3)^3."),
        key("arruda_boyce",
           "Stiffening by Arruda and Boyce's eight chains, with the inverse Langevin function. "
           "shear_modulus is that at rest."));
    io(key("maxwell",
           "Viscoelasticity: a list of branches, each a spring and a dashpot in series beside the "
           "elastic material. shear_modulus is that of slow loads.").optional(),
       material.branches);
}

// Keys of `material_regions[]`.
template <class Io>
void keys(Io& io, RegionMaterial& region) {
    io(key("region", "Name of a region of the mesh, or a list of names.").one_or_list(),
       region.regions);
    keys(io, region.material);
}

// Keys of `rollers[]`.
template <class Io>
void keys(Io& io, Roller& roller) {
    io(key("face", "Name of a face as in `clamps`, or a list of names.").one_or_list(), roller.faces);
    io(key("axis",
           "Axis of space, not of a turned body, along which the face is held."), AxisRef{roller.axis});
}

// Keys of an oscillation of any quantity.
template <class Io, class Course>
void periods(Io& io, Course& oscillation) {
    io(quantity("frequency", "1/s", "Number of periods per second.").above(0),
       oscillation.frequency_hz);
    io(quantity("phase", "rad",
           "Phase of the oscillation. With 0 it starts at full speed, to both sides of "
           "the start; with -90 deg it starts from rest, to one side.").by_default(),
       oscillation.phase_rad);
}

// Keys of `prescribed_motion[].oscillation`, of `moved`, and the motion of a field source.
template <class Io>
void keys(Io& io, Oscillation& oscillation) {
    io(quantity("amplitude", "m", "Amplitudes along x, y and z."), oscillation.amplitude_m);
    periods(io, oscillation);
}

// Keys of `prescribed_motion[].formula`, and the motion of a field source.
template <class Io>
void keys(Io& io, FormulaMotion& motion) {
    auto& [x, y, z] = motion.component_m;
    io(quantity("x", "m", "Displacement along x, a formula of the time t.").by_default(), x);
    io(quantity("y", "m", "Displacement along y, a formula of the time t.").by_default(), y);
    io(quantity("z", "m", "Displacement along z, a formula of the time t.").by_default(), z);
}

// Keys of `prescribed_motion[].ramp`, and the motion of a field source.
template <class Io>
void keys(Io& io, DisplacementRamp& ramp) {
    io(quantity("displacement", "m", "Displacements along x, y and z at the end."),
       ramp.displacement_m);
    io(quantity("duration", "s", "Time that the displacement takes.").above(0), ramp.duration_s);
}

// Keys of `prescribed_motion[].turning.oscillation`.
template <class Io>
void keys(Io& io, AngleOscillation& oscillation) {
    io(quantity("amplitude", "rad", "Amplitude of the angle."), oscillation.amplitude_rad);
    periods(io, oscillation);
}

// Keys of `prescribed_motion[].turning`.
template <class Io>
void keys(Io& io, TurningMotion& turning) {
    io(key("axis",
           "Axis about which the face or the part turns, right-handed. Its length does not "
           "matter."),
       turning.axis);
    io(quantity("about", "m",
           "A point of the axis in space, where the body has been placed."), turning.about_m);
    io.alternatives(turning.angle,
        key("oscillation",
           "Angle amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        quantity("angle", "rad",
           "Angle as a formula of the time t, which counts from its value at time 0."));
}

// Keys of `prescribed_motion[].displacement`: a vector in place of a map.
template <class Io>
void keys(Io& io, HeldDisplacement& held) {
    io.whole(held.displacement_m);
}

// Keys of `prescribed_motion[]`.
template <class Io>
void keys(Io& io, PrescribedMotion& motion) {
    io(key("face", "Name of a face as in `clamps`, or a list of names.").one_or_list(), motion.faces);
    io.alternatives(motion.course,
        key("oscillation",
           "Displacement amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        key("ramp",
           "Displacement that grows by (1 - cos(pi t / duration)) / 2 and is then held."),
        key("formula",
           "Formulas of the time t for the components of the displacement, which counts "
           "from its value at time 0."),
        key("turning",
           "Turn about an axis that is fixed in space. It needs a run over time."),
        quantity("displacement", "m",
           "Displacement along x, y and z at which the face is held from time 0 on. It needs "
           "time.start: equilibrium, or a path of equilibria."));
}

// Keys of `initial.rotation`.
template <class Io>
void keys(Io& io, PlaneRotation& rotation) {
    io(key("plane",
           "Plane of the rotation. The angle runs from the plane's first axis to its "
           "second.").by_default(),
       PlaneRef{rotation.plane});
    io(quantity("angle", "rad", "Angle by which the body is turned."), rotation.angle_rad);
}

// Keys of `initial.relaxed`, and magnetic_field.constant.
template <class Io>
void keys(Io& io, ConstantField& field) {
    io(quantity("magnitude", "T", "Flux density. A negative one points backwards."),
       field.magnitude_t);
    io(quantity("direction", "rad",
           "Angle of the field in the plane of `magnetic_field`."),
       field.direction_rad);
}

// Keys of `initial`.
template <class Io>
void keys(Io& io, Placement& initial) {
    io(quantity("position", "m",
           "Position of the body's centre of volume. A body in a fluid needs it."),
       initial.position_m);
    io(key("rotation", "Rotation of the body about its centre of volume."), initial.rotation);
    io(key("relaxed",
           "Constant field in whose shape at rest the body starts, without fluid and "
           "gravity, before the rotation."), initial.relaxed);
    io(quantity("velocity", "m/s", "Velocity of a rigid body's centre of mass, without a fluid."),
       initial.velocity_m_s);
    io(quantity("angular_velocity", "rad/s",
           "Angular velocity of a rigid body, along axes of space, without a fluid. One that "
           "is held takes of it what its hold allows."), initial.angular_velocity_rad_s);
}

// Keys of `hinge`.
template <class Io>
void keys(Io& io, Hinge& hinge) {
    io(key("axis", "Axis of space about which the rigid part turns. Its length does not matter."),
       hinge.axis);
    io(quantity("about", "m", "A point of the axis in space, where the body has been placed."),
       hinge.about_m);
}

// Keys of `pivot`.
template <class Io>
void keys(Io& io, Pivot& pivot) {
    io(quantity("about", "m",
           "The point in space, where the body has been placed, about which the rigid part turns."),
       pivot.about_m);
}

// Keys of `moved`.
template <class Io>
void keys(Io& io, RigidCourse& moved) {
    io.alternatives(moved.way,
        key("oscillation",
           "Displacement amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        key("ramp",
           "Displacement that grows by (1 - cos(pi t / duration)) / 2 and is then kept."),
        key("formula",
           "Formulas of the time t for the components of the displacement, which counts "
           "from its value at time 0."));
    io(key("turning",
           "Turn about an axis whose direction is fixed in space. With a displacement the axis "
           "is moved by it, too."), moved.turning);
}

// Keys of `bodies.NAME` itself.
template <class Io>
void keys(Io& io, Body& body) {
    io.group(key("mesh",
           "Mesh of hexahedra. The origin of a block or a plate is its lowest corner."), true,
             [&](auto& mesh) {
        mesh.alternatives(body.mesh,
            key("box", "Mesh of a block."),
            key("oblique",
           "Mesh of a plate of parallelogram cells, each a region \"row R column C\"."),
            key("gmsh",
           "Mesh of hexahedra from a Gmsh file. Its physical volumes are regions, its "
           "physical surfaces faces to clamp."),
            key("voxels",
           "Mesh of the cubes whose middle is inside a closed surface. The faces x_min "
           "to z_max are what lies furthest out along the axes; the frame is the file's."),
            key("arc",
           "Mesh of a block bent in the plane xz about the origin, with its ends up. Its "
           "faces are named as a block's."),
            key("helix",
           "Mesh of a block wound about the axis x, from x = 0 and the side of y. Its "
           "faces are named as a block's."),
            key("ball", "Mesh of a ball about the origin."),
            key("cylinder", "Mesh of a cylinder along x, its middle at the origin."),
            key("capsule",
           "Mesh of a cylinder along x with two half balls as ends, its middle at the origin."),
            key("cone", "Mesh of a truncated cone along x, its middle at the origin."),
            key("wire",
           "Mesh of a helix of round wire about the axis x, from x = 0 and the side of y, "
           "with or without a head."));
    });
    io(key("regions",
           "Parts of the mesh by shapes, for other materials and magnetizations. An element "
           "belongs to the region whose shape holds its centre, the first by name; those in "
           "none keep the mesh's own region, or are called rest.").optional(),
       body.regions);
    io(key("element", "full: the paper's element, for four and more layers; assumed_strain: accurate "
           "in every mode with one layer, for elements of any proportion.").by_default(),
       body.element);
    io(key("inertia", "lumped: elements spread evenly on their nodes, moments of inertia are "
           "2 / n^2 too large along an axis of n elements; corrected: they are right from two "
           "elements on, for a stable step that is 3 to 17 % shorter.").by_default(),
       body.inertia);
    io(key("material",
           "Material of the body: neo-Hookean, eq. (1), unless it has a key for stiffening."),
       body.material);
    io(key("material_regions",
           "Other materials, by the mesh's regions. A region that is not named is of "
           "`material`.").optional(),
       body.material_regions);
    io(key("magnetization", "Remanent magnetization of the undeformed body."),
       body.magnetization);
    io(key("clamps",
           "Names of faces that are held still: x_min to z_max, or names of the Gmsh "
           "file.").optional(),
       body.clamps);
    io(key("rollers",
           "List of faces that are held along one axis and free along the others: both "
           "faces across the depth for plane strain, one for a plane of symmetry.").optional(),
       body.rollers);
    io(key("prescribed_motion",
           "List of faces that something outside holds, and moves along axes of space or "
           "turns about one, from where they start.").optional(),
       body.prescribed_motion);
    io(key("rigid",
           "What does not deform: true for the whole body, or the names of regions, each a "
           "rigid part that carries its soft neighbours along.").true_or_list().optional(),
       body.rigid);
    io.alternatives(body.hold,
        key("hinge", "Holds the body's one rigid part on an axis."),
        key("pivot", "Holds the body's one rigid part at a point."),
        key("moved",
           "Moves and turns the body's one rigid part as prescribed, from where it starts, "
           "whatever the forces on it."));
    io(key("initial",
           "State of the body at time 0: it is relaxed first, then rotated, then placed.").optional(),
       body.initial);
}

// --- loads --------------------------------------------------------------------------

// Keys of `platform`, at the top level of the scene.
template <class Io>
void keys(Io& io, Platform& platform) {
    io(quantity("point", "m", "A point of the plane.").by_default(), platform.point_m);
    io(key("normal",
           "Direction of the normal towards the bodies. Its length does not matter.").by_default(),
       platform.normal);
    io(quantity("stiffness", "Pa/m",
           "Contact pressure over penetration. Without it, bodies sink in by far less "
           "than their thickness.").above(0).optional(),
       platform.stiffness_pa_m);
    io(key("friction",
           "Coulomb's coefficient of friction. Without it there is no friction.").above(0).at_most(10)
           .optional(),
       platform.friction);
}

// Keys of `contact`, at the top level of the scene.
template <class Io>
void keys(Io& io, ContactLaw& contact) {
    io(quantity("distance", "m",
           "Distance of surfaces at which their nodes begin to repel. Without it, the "
           "thickness of the thinnest body.").above(0).optional(),
       contact.distance_m);
    io(quantity("stiffness", "Pa/m",
           "Contact pressure over approach, between bodies and in a fluid with the sides of "
           "its box and its obstacles. Without it, it follows from the bodies; sides and "
           "obstacles take more where the bodies ask for it.")
           .above(0).optional(),
       contact.stiffness_pa_m);
    io(key("friction",
           "Coulomb's coefficient of friction between bodies, and in a fluid with the "
           "sides of its box and its obstacles. Without it there is no friction.")
           .above(0).at_most(10).optional(),
       contact.friction);
}

MAGFSI_KEYS_OF(Body)
MAGFSI_KEYS_OF(ConstantField)
MAGFSI_KEYS_OF(Oscillation)
MAGFSI_KEYS_OF(DisplacementRamp)
MAGFSI_KEYS_OF(FormulaMotion)
MAGFSI_KEYS_OF(Platform)
MAGFSI_KEYS_OF(ContactLaw)

}  // namespace magfsi::scene
