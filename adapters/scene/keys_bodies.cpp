// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of structure/options.h: bodies and what they touch.
#include "adapters/scene/keys.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

template <class Io>
void keys(Io& io, Box& box) {
    io(quantity("size", "m", "Length along x, y and z.").above(0), box.size_m);
    io(key("elements", "Elements along x, y and z.").at_least(1).at_most(100000),
       box.elements);
}

template <class Io>
void keys(Io& io, ObliquePlate& plate) {
    io(key("cells", "Cells along x and y.").at_least(1).at_most(10000), plate.cells);
    io(quantity("length_a", "m", "A cell's side along x.").above(0), plate.length_a_m);
    io(quantity("length_b", "m", "Its side at the angle.").above(0), plate.length_b_m);
    io(quantity("angle", "rad", "Between the two.").above(0).at_most(3.14159),
       plate.angle_rad);
    io(quantity("thickness", "m", "Of the plate.").above(0), plate.thickness_m);
    io(key("elements", "In a cell: along a, along b, layers.").at_least(1).at_most(100000),
       plate.elements_per_cell);
    io(key("zigzag", "Rows lean right and left in turn, as in Miura-ori; else all alike.")
           .by_default(), plate.zigzag);
}

template <class Io>
void keys(Io& io, MeshFile& mesh) {
    io(key("file", "A .msh file; its path counts from the scene's folder."), mesh.file);
    io(quantity("unit", "m", "Length of the file's unit.").above(0).by_default(),
       mesh.unit_m);
}

template <class Io>
void keys(Io& io, FaceBox& face) {
    io(quantity("box", "m", "Lower and upper corner, in the file's frame; all nodes inside are of the "
                "face."), face.box_m);
}

template <class Io>
void keys(Io& io, VoxelMesh& mesh) {
    io(key("file", "A closed surface, ASCII or binary STL; its path counts from the scene's "
           "folder."), mesh.file);
    io(quantity("spacing", "m", "Edge of the cubes; best a whole part of the body's thickness.")
           .above(0), mesh.spacing_m);
    io(quantity("unit", "m", "Length of the file's unit.").above(0).by_default(),
       mesh.unit_m);
    io(key("faces", "More faces to clamp, by their names.").optional(), mesh.faces);
}

template <class Io>
void keys(Io& io, Arc& arc) {
    io(quantity("radius", "m", "Of the middle line.").above(0), arc.radius_m);
    io(quantity("angle", "rad", "From end to end; 360 deg is a ring, whose ends are joined.").above(0)
           .at_most(6.2831853071796), arc.angle_rad);
    io(quantity("section", "m", "Width, along y, and thickness, towards the centre.").above(0),
       arc.section_m);
    io(key("elements", "Along the arc, the width and the thickness.").at_least(1).at_most(100000),
       arc.elements);
}

template <class Io>
void keys(Io& io, Helix& helix) {
    io(quantity("radius", "m", "Of the middle line.").above(0), helix.radius_m);
    io(quantity("pitch", "m", "Along x, of one turn.").above(0), helix.pitch_m);
    io(key("turns", "How many.").above(0).at_most(1000), helix.turns);
    io(quantity("section", "m", "Width, along the surface of the cylinder, and thickness, away from "
                "its axis.").above(0),
       helix.section_m);
    io(key("elements", "Along the helix, the width and the thickness.").at_least(1).at_most(100000),
       helix.elements);
    io(key("left_handed", "A right-handed one turns from y to z as x grows.").by_default(),
       helix.left_handed);
}

template <class Io>
void keys(Io& io, Material& material) {
    io(quantity("shear_modulus", "Pa", "G, with lame_lambda; or the next two.").above(0)
           .optional(), material.shear_modulus_pa);
    io(quantity("lame_lambda", "Pa", "Lame's first constant, the paper's K.").at_least(0)
           .optional(), material.lame_lambda_pa);
    double e = 0, nu = 0;  // become the first two as they are read
    io(quantity("youngs_modulus", "Pa", "E, with poissons_ratio, at small strains: "
                "G = E / (2 (1 + nu)), K = 2 G nu / (1 - 2 nu).").above(0).optional(), e);
    io(key("poissons_ratio", "nu; 0.476 makes K = 20 G.").at_least(0).at_most(0.4999).optional(),
       nu);
    if (e > 0) {
        material.shear_modulus_pa = e / (2 * (1 + nu));
        material.lame_lambda_pa = e * nu / ((1 + nu) * (1 - 2 * nu));
    }
    io(quantity("density", "kg/m3", "Mass by volume.").above(0), material.density_kg_m3);
    io(quantity("viscosity", "Pa s", "Kelvin-Voigt damping: viscous stress over rate of "
                "strain is twice this.").above(0).optional(),
       material.viscosity_pa_s);
}

template <class Io>
void keys(Io& io, RegionMaterial& region) {
    io(key("region", "One name, or a list.").one_or_list(), region.regions);
    keys(io, region.material);
}

template <class Io>
void keys(Io& io, UniformMagnetization& uniform) {
    io.whole(uniform.vector_a_m);
}

template <class Io>
void keys(Io& io, HarmonicMagnetization& wave) {
    io(quantity("amplitude", "A/m", "Strength.").above(0), wave.amplitude_a_m);
    io(quantity("wavelength", "m", "Length of one turn; without it, the body's length along "
                "`along`.").above(0).optional(),
       wave.wavelength_m);
    io(quantity("phase", "rad", "Angle at s = 0.").by_default(), wave.phase_rad);
    io(key("along", "Axis of s.").by_default(), AxisRef{wave.along});
    io(key("into", "Second axis of the magnetization's plane.").by_default(),
       AxisRef{wave.into});
}

template <class Io>
void keys(Io& io, MagneticDomain& domain) {
    io(quantity("box", "m", "Lower and upper corner, in the body's frame.").alternative(),
       domain.box_m);
    io(quantity("polygon", "m", "Corners in the x-y plane, in the body's frame.")
           .rows(3, 10000).alternative(),
       domain.polygon_xy_m);
    io(quantity("vector", "A/m", "Magnetization vector."), domain.vector_a_m);
}

template <class Io>
void keys(Io& io, DomainMagnetization& magnetization) {
    io.whole(magnetization.domains);
}

template <class Io>
void keys(Io& io, RegionVector& region) {
    io(key("region", "One name, or a list.").one_or_list(), region.regions);
    io(quantity("vector", "A/m", "Magnetization vector."), region.vector_a_m);
}

template <class Io>
void keys(Io& io, RegionMagnetization& magnetization) {
    io.whole(magnetization.regions);
}

template <class Io>
void keys(Io& io, TableMagnetization& table) {
    io(key("file", "CSV with the columns x[m], y[m], z[m], Mx[A/m], My[A/m], Mz[A/m]; its "
           "path counts from the scene's folder."), table.file);
}

template <class Io>
void keys(Io& io, CurveMagnetization& curve) {
    io(quantity("strength", "A/m", "Strength.").above(0), curve.strength_a_m);
    io(quantity("points", "m", "Of the curve, in the body's frame; without them, the centre line of the "
                "mesh: of a block, an arc, a helix, or what the Gmsh file calls so.")
           .rows(2, 10000).optional(), curve.points_m);
    io(quantity("wavelength", "m", "Length along the curve of one turn; without it, none.").above(0)
           .optional(), curve.wavelength_m);
    io(quantity("phase", "rad", "Angle at the start of the curve.").by_default(), curve.phase_rad);
    io(key("plane", "The angle runs from its first axis to its second.").by_default(),
       PlaneRef{curve.plane});
}

template <class Io>
void keys(Io& io, RadialMagnetization& radial) {
    io(quantity("strength", "A/m", "Strength; a negative one points to the centre."),
       radial.strength_a_m);
    io(quantity("centre", "m", "In the body's frame.").by_default(), radial.centre_m);
    io(key("axis", "Away from the axis of this direction through the centre, in place of from the centre; any "
           "length.").optional(),
       radial.axis);
}

template <class Io>
void keys(Io& io, Magnetization& magnetization) {
    io.alternatives(magnetization,
        quantity("uniform", "A/m", "Magnetization vector."),
        key("harmonic", "amplitude [cos(2 pi s / wavelength + phase) along + sin(...) into], "
            "s from the lower end."),
        key("domains", "Elements whose centre lies in a domain carry its vector; the first "
            "domain wins."),
        key("regions", "By the mesh's regions; one that is not named carries none."),
        key("table", "Each element takes the vector of the nearest point."),
        key("curve", "Along the tangent of a curve, at its point nearest to the element, turned by "
            "phase + 2 pi s / wavelength; s runs along the curve."),
        key("radial", "Away from a point or an axis."));
}

template <class Io>
void keys(Io& io, Roller& roller) {
    io(key("face", "As in `clamps`; one name, or a list.").one_or_list(), roller.faces);
    io(key("axis", "Of space, not of a turned body."), AxisRef{roller.axis});
}

template <class Io>
void keys(Io& io, Oscillation& oscillation) {
    io(quantity("amplitude", "m", "Along x, y and z."), oscillation.amplitude_m);
    io(quantity("frequency", "1/s", "Periods per second.").above(0),
       oscillation.frequency_hz);
    io(quantity("phase", "rad", "0: at full speed at once, to both sides of the start; "
                "-90 deg: from rest, to one side.").by_default(),
       oscillation.phase_rad);
}

template <class Io>
void keys(Io& io, FormulaMotion& motion) {
    auto& [x, y, z] = motion.component_m;
    io(quantity("x", "m", "Along x.").by_default(), x);
    io(quantity("y", "m", "Along y.").by_default(), y);
    io(quantity("z", "m", "Along z.").by_default(), z);
}

template <class Io>
void keys(Io& io, DisplacementRamp& ramp) {
    io(quantity("displacement", "m", "Along x, y and z."), ramp.displacement_m);
    io(quantity("duration", "s", "Of the displacement.").above(0), ramp.duration_s);
}

template <class Io>
void keys(Io& io, PrescribedMotion& motion) {
    io(key("face", "As in `clamps`; one name, or a list.").one_or_list(), motion.faces);
    io.alternatives(motion.course,
        key("oscillation", "amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        key("ramp", "By (1 - cos(pi t / duration)) / 2, then held there."),
        key("formula", "Of the time t, by component, counted from its value at time 0."));
}

template <class Io>
void keys(Io& io, PlaneRotation& rotation) {
    io(key("plane", "The angle runs from its first axis to its second.").by_default(),
       PlaneRef{rotation.plane});
    io(quantity("angle", "rad", "How far."), rotation.angle_rad);
}

template <class Io>
void keys(Io& io, ConstantField& field) {
    io(quantity("magnitude", "T", "Flux density; a negative one points backwards."),
       field.magnitude_t);
    io(quantity("direction", "rad", "Angle in the plane of `magnetic_field`."),
       field.direction_rad);
}

template <class Io>
void keys(Io& io, Placement& initial) {
    io(quantity("position", "m", "Where the centre of volume goes; needed in a fluid."),
       initial.position_m);
    io(key("rotation", "Turn about the centre of volume."), initial.rotation);
    io(key("relaxed", "Start from the shape at rest in this constant field, without fluid and "
           "gravity, before the rotation."), initial.relaxed);
}

template <class Io>
void keys(Io& io, Body& body) {
    io.group(key("mesh", "Hexahedra; a block's or a plate's origin is its lowest corner."), true,
             [&](auto& mesh) {
        mesh.alternatives(body.mesh,
            key("box", "A block."),
            key("oblique", "A plate of parallelogram cells, each a region \"row R column C\"."),
            key("gmsh", "Hexahedra from a Gmsh file; physical volumes are regions, physical "
                "surfaces faces to clamp."),
            key("voxels", "Cubes that fill a closed surface: those whose middle is inside. Faces "
                "x_min to z_max are what lies furthest out along the axes; the frame is the file's."),
            key("arc", "A block bent in the plane xz about the origin, its ends up; faces as a block's."),
            key("helix", "A block wound about the axis x, from x = 0 and the side of y; faces as a "
                "block's."));
    });
    io(key("element", "full: the paper's element, for four and more layers; mean_f: accurate in bending with few layers; "
           "assumed_strain: in every mode, for elements of any proportion.").by_default(),
       body.element);
    io(key("inertia", "lumped: elements spread evenly on their nodes, moments of inertia are "
           "2 / n^2 too large along an axis of n elements; corrected: they are right from two "
           "elements on, for a stable step that is 3 to 17 % shorter.").by_default(),
       body.inertia);
    io(key("material", "Neo-Hookean solid, eq. (1)."), body.material);
    io(key("material_regions", "Other materials, by the mesh's regions; one that is not named "
           "is of `material`.").optional(),
       body.material_regions);
    io(key("magnetization", "Remanent magnetization of the undeformed body."),
       body.magnetization);
    io(key("clamps", "Faces held still: x_min to z_max, or names of the Gmsh file.").optional(),
       body.clamps);
    io(key("rollers", "Faces held along one axis, free along the others: both faces across the "
           "depth for plane strain, one for a plane of symmetry.").optional(),
       body.rollers);
    io(key("prescribed_motion", "Faces held and moved by something outside, along axes of "
           "space, from where they start.").optional(),
       body.prescribed_motion);
    io(key("initial", "State at time 0: relaxed first, then rotated, then placed.").optional(),
       body.initial);
}

// --- loads --------------------------------------------------------------------------

template <class Io>
void keys(Io& io, Platform& platform) {
    io(quantity("point", "m", "A point of it.").by_default(), platform.point_m);
    io(key("normal", "Towards the bodies; any length.").by_default(), platform.normal);
    io(quantity("stiffness", "Pa/m", "Pressure over penetration; without it, so that bodies "
                "sink in by far less than their thickness.").above(0).optional(),
       platform.stiffness_pa_m);
    io(key("friction", "Coulomb's coefficient; without it, none.").above(0).at_most(10)
           .optional(),
       platform.friction);
}

template <class Io>
void keys(Io& io, ContactLaw& contact) {
    io(quantity("distance", "m", "Where surfaces of nodes begin to repel; without it, the "
                "thickness of the thinnest body.").above(0).optional(),
       contact.distance_m);
    io(quantity("stiffness", "Pa/m", "Pressure over approach; without it, from the bodies.")
           .above(0).optional(),
       contact.stiffness_pa_m);
    io(key("friction", "Coulomb's coefficient between bodies, and in a fluid with the sides of its "
           "box and its obstacles; without it, none.").above(0).at_most(10).optional(),
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
