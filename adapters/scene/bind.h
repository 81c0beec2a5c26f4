// Which key is stored where: one line a key, used for reading (tree_reader.h) and for
// writing (json_writer.h), so that what is stored is also dumped and hashed.
#pragma once

#include "adapters/scene/bind_coupling.h"
#include "adapters/scene/bind_motion.h"
#include "adapters/scene/names.h"

namespace magfsi::scene {

// Wrappers for integers that stand for words: "x" and "xz".
struct AxisRef {
    int& axis;
};
struct PlaneRef {
    std::array<int, 2>& axes;
};

template <class Io>
void bind_keys(Io& io, Equilibrium& equilibrium) {
    io("method", equilibrium.method);
    io("tolerance", equilibrium.tolerance);
}

template <class Io>
void bind_keys(Io& io, Time& time) {
    io("end", time.end_s);
    io("step", time.step_s);
    io("equilibrium", time.equilibrium);
}

template <class Io>
void bind_keys(Io& io, Box& box) {
    io("size", box.size_m);
    io("elements", box.elements);
}

template <class Io>
void bind_keys(Io& io, ObliquePlate& plate) {
    io("cells", plate.cells);
    io("length_a", plate.length_a_m);
    io("length_b", plate.length_b_m);
    io("angle", plate.angle_rad);
    io("thickness", plate.thickness_m);
    io("elements", plate.elements_per_cell);
    io("zigzag", plate.zigzag);
}

template <class Io>
void bind_keys(Io& io, MeshFile& mesh) {
    io("file", mesh.file);
    io("unit", mesh.unit_m);
}

template <class Io>
void bind_keys(Io& io, MeshOptions& mesh) {
    io.alternatives(mesh, {"box", "oblique", "gmsh"});
}

template <class Io>
void bind_keys(Io& io, Material& material) {
    io("shear_modulus", material.shear_modulus_pa);
    io("lame_lambda", material.lame_lambda_pa);
    io("density", material.density_kg_m3);
    io("viscosity", material.viscosity_pa_s);
}

template <class Io>
void bind_keys(Io& io, RegionMaterial& region) {
    io("region", region.regions);
    bind_keys(io, region.material);
}

template <class Io>
void bind_keys(Io& io, UniformMagnetization& uniform) {
    io.whole(uniform.vector_a_m);
}

template <class Io>
void bind_keys(Io& io, HarmonicMagnetization& harmonic) {
    io("amplitude", harmonic.amplitude_a_m);
    io("wavelength", harmonic.wavelength_m);
    io("phase", harmonic.phase_rad);
    io("along", AxisRef{harmonic.along});
    io("into", AxisRef{harmonic.into});
}

template <class Io>
void bind_keys(Io& io, MagneticDomain& domain) {
    io("box", domain.box_m);
    io("polygon", domain.polygon_xy_m);
    io("vector", domain.vector_a_m);
}

template <class Io>
void bind_keys(Io& io, DomainMagnetization& magnetization) {
    io.whole(magnetization.domains);
}

template <class Io>
void bind_keys(Io& io, RegionVector& region) {
    io("region", region.regions);
    io("vector", region.vector_a_m);
}

template <class Io>
void bind_keys(Io& io, RegionMagnetization& magnetization) {
    io.whole(magnetization.regions);
}

template <class Io>
void bind_keys(Io& io, TableMagnetization& table) {
    io("file", table.file);
}

template <class Io>
void bind_keys(Io& io, Magnetization& magnetization) {
    io.alternatives(magnetization,
                    {"uniform", "harmonic", "domains", "regions", "table"});
}

template <class Io>
void bind_keys(Io& io, PlaneRotation& rotation) {
    io("plane", PlaneRef{rotation.plane});
    io("angle", rotation.angle_rad);
}

template <class Io>
void bind_keys(Io& io, ConstantField& constant) {
    io("magnitude", constant.magnitude_t);
    io("direction", constant.direction_rad);
}

template <class Io>
void bind_keys(Io& io, Placement& initial) {
    io("position", initial.position_m);
    io("rotation", initial.rotation);
    io("relaxed", initial.relaxed);
}

template <class Io>
void bind_keys(Io& io, Roller& roller) {
    io("face", roller.faces);
    io("axis", AxisRef{roller.axis});
}

template <class Io>
void bind_keys(Io& io, Body& body) {
    io("mesh", body.mesh);
    io("element", body.element);
    io("material", body.material);
    io("material_regions", body.material_regions);
    io("magnetization", body.magnetization);
    io("clamps", body.clamps);
    io("rollers", body.rollers);
    io("prescribed_motion", body.prescribed_motion);
    io("initial", body.initial);
}

template <class Io>
void bind_keys(Io& io, FieldTable& table) {
    io("time", table.time_s);
    io("magnitude", table.magnitude_t);
    io("direction", table.direction_rad);
    io("repeat", table.repeat);
}

template <class Io>
void bind_keys(Io& io, RotatingField& rotating) {
    io("magnitude", rotating.magnitude_t);
    io("start", rotating.start_rad);
    io("frequency", rotating.frequency_hz);
}

template <class Io>
void bind_keys(Io& io, GradientInput& gradient) {
    io("matrix", gradient.matrix_t_m);
    io("origin", gradient.origin_m);
}

template <class Io>
void bind_keys(Io& io, MagneticField& field) {
    io("plane", PlaneRef{field.plane});
    io.alternatives(field.course, {"constant", "table", "rotation"});
    io("gradient", field.gradient);
}

template <class Io>
void bind_keys(Io& io, Gravity& gravity) {
    io("acceleration", gravity.acceleration_m_s2);
    io("direction", gravity.direction);
}

template <class Io>
void bind_keys(Io& io, structure::Drag& damping) {
    io("rate", damping.rate_1_s);
}

template <class Io>
void bind_keys(Io& io, Platform& platform) {
    io("point", platform.point_m);
    io("normal", platform.normal);
    io("stiffness", platform.stiffness_pa_m);
    io("friction", platform.friction);
}

template <class Io>
void bind_keys(Io& io, ContactLaw& contact) {
    io("distance", contact.distance_m);
    io("stiffness", contact.stiffness_pa_m);
}

template <class Io>
void bind_keys(Io& io, Rectangle& rectangle) {
    io("centre", rectangle.centre_m);
    io("size", rectangle.size_m);
}

template <class Io>
void bind_keys(Io& io, Disc& disc) {
    io("centre", disc.centre_m);
    io("diameter", disc.diameter_m);
}

// The map that a boundary of this kind carries.
template <class Io>
void bind_details(Io& io, Boundary& boundary) {
    if (boundary.kind == BoundaryKind::no_slip)
        io("velocity", boundary.wall_velocity_m_s);
    if (boundary.kind == BoundaryKind::velocity_inlet) {
        io("velocity", boundary.inlet.velocity_m_s);
        io("profile", boundary.inlet.profile);
        io("ramp", boundary.inlet.ramp_s);
    }
    if (boundary.kind == BoundaryKind::pressure_outlet)
        io("pressure", boundary.outlet_pressure_pa);
    if (boundary.kind == BoundaryKind::velocity_inlet ||
        boundary.kind == BoundaryKind::pressure_outlet)
        io.optional_alternatives(boundary.patch, {"rectangle", "disc"});
}

template <class Io>
void bind_keys(Io& io, Sphere& sphere) {
    io("centre", sphere.centre_m);
    io("diameter", sphere.diameter_m);
}

template <class Io>
void bind_keys(Io& io, Cylinder& cylinder) {
    io("centre", cylinder.centre_m);
    io("diameter", cylinder.diameter_m);
    io("axis", AxisRef{cylinder.axis});
    io("length", cylinder.length_m);
}

template <class Io>
void bind_keys(Io& io, Block& block) {
    std::array<Vec3, 2> corners{block.low_m, block.high_m};
    io.whole(corners);
    block = {corners[0], corners[1]};
}

template <class Io>
void bind_keys(Io& io, StlSurface& surface) {
    io("file", surface.file);
    io("unit", surface.unit_m);
    io("shift", surface.shift_m);
}

template <class Io>
void bind_keys(Io& io, Obstacle& obstacle) {
    io.alternatives(obstacle.shape, {"sphere", "cylinder", "box", "stl"});
}

template <class Io>
void bind_keys(Io& io, Grading& grading) {
    io("uniform", grading.uniform_m);
    io("growth", grading.growth);
}

template <class Io>
void bind_keys(Io& io, TaylorGreen& vortex) {
    io("speed", vortex.speed_m_s);
}

template <class Io>
void bind_keys(Io& io, Fluid& fluid) {
    io("solver", fluid.solver);
    io("box", fluid.box_m);
    io("spacing", fluid.spacing_m);
    io("density", fluid.density_kg_m3);
    io("viscosity", fluid.viscosity_m2_s);
    io("expected_speed", fluid.expected_speed_m_s);
    io("lattice_speed", fluid.lattice_speed);
    io("courant", fluid.courant);
    io("grading", fluid.grading);
    io("collision", fluid.collision);
    io("magic_number", fluid.magic_number);
    io("precision", fluid.precision);
    io.effect("smagorinsky", fluid.smagorinsky_constant > 0,
              [&](auto& inner) { inner("constant", fluid.smagorinsky_constant); });
    io("boundaries", fluid.boundaries);
    io("obstacles", fluid.obstacles);
    io("initial_velocity", fluid.initial_velocity_m_s);
    io("taylor_green", fluid.taylor_green);
    io("body_force", fluid.body_force_n_m3);
}

template <class Io>
void bind_keys(Io& io, PointProbe& point) {
    io("body", point.body);
    io("at", point.at_m);
}

template <class Io>
void bind_keys(Io& io, FluidPlane& plane) {
    io("axis", AxisRef{plane.axis});
    io("at", plane.at_m);
}

template <class Io>
void bind_keys(Io& io, BodyPart& part) {
    io("body", part.body);
    io("box", part.box_m);
}

template <class Io>
void bind_keys(Io& io, IntegralProbe& integral) {
    io.alternatives(integral.over, {"plane", "part"});
}

template <class Io>
void bind_keys(Io& io, Probes& probes) {
    io("every", probes.every_s);
    io("bodies", probes.bodies);
    io("points", probes.points);
    io("integrals", probes.integrals);
    io("fluid", probes.fluid);
    io("interface_balance", probes.interface_balance);
    io("energy_audit", probes.energy_audit);
}

template <class Io>
void bind_keys(Io& io, StructureOutput& output) {
    io("every", output.every_s);
}

template <class Io>
void bind_keys(Io& io, FluidOutput& output) {
    io("every", output.every_s);
    io("fields", output.fields);
}

template <class Io>
void bind_keys(Io& io, Output& output) {
    io("structure", output.structure);
    io("fluid", output.fluid);
}

template <class Io>
void bind_keys(Io& io, Checkpoint& checkpoint) {
    io("every", checkpoint.every_s);
    io("on_divergence", checkpoint.on_divergence);
    io("max_retries", checkpoint.max_retries);
}

template <class Io>
void bind_keys(Io& io, Scene& scene) {
    io("name", scene.name);
    io("time", scene.time);
    io("bodies", scene.bodies);
    io("magnetic_field", scene.magnetic_field);
    io("gravity", scene.gravity);
    io("damping", scene.damping);
    io("platform", scene.platform);
    io("contact", scene.contact);
    io("fluid", scene.fluid);
    io("coupling", scene.coupling);
    io("probes", scene.probes);
    io("output", scene.output);
    io("checkpoint", scene.checkpoint);
}

}  // namespace magfsi::scene
