// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of `magnetic_field`, its laws and its sources, and of `dipoles`. A comment
// before each function names the place of its group below `magnetic_field`.
#include "adapters/scene/keys.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `table`.
template <class Io>
void keys(Io& io, FieldTable& table) {
    io(quantity("time", "s", "Times of the rows, ascending."), table.time_s);
    io(quantity("magnitude", "T",
           "Flux densities, one per row. A negative one points backwards."),
       table.magnitude_t);
    io(quantity("direction", "rad",
           "Angle of the field in the plane, one for all rows or one per row.")
           .one_or_list(),
       table.direction_rad);
    io(key("repeat",
           "If true, the table starts again after its last row. Before its first time "
           "the field holds the first value.").by_default(), table.repeat);
}

// Keys of `rotation`.
template <class Io>
void keys(Io& io, RotatingField& field) {
    io(quantity("magnitude", "T", "Flux density. A negative one points backwards."),
       field.magnitude_t);
    io(quantity("start", "rad", "Angle of the field at time 0.").by_default(), field.start_rad);
    io(quantity("frequency", "1/s",
           "Number of turns per second. A negative number turns backwards."),
       field.frequency_hz);
}

// Keys of `vector`: three components in place of a map.
template <class Io>
void keys(Io& io, VectorField& field) {
    io.whole(field.vector_t);
}

// Keys of `vector_table`.
template <class Io>
void keys(Io& io, VectorTable& table) {
    io(key("file",
           "Name of a CSV file with the columns t[s], Bx[T], By[T], Bz[T] (also ms, us, "
           "mT, uT) in place of time and vector. Its path counts from the scene's "
           "folder.").optional(), table.file);
    io(quantity("time", "s", "Times of the rows, ascending.").optional(), table.time_s);
    io(quantity("vector", "T", "Components Bx, By, Bz, one triple per row.")
           .rows(1, Field::unbounded).optional(),
       table.vector_t);
    io(key("repeat",
           "If true, the table starts again after its last row. Before its first time "
           "the field holds the first value.").by_default(), table.repeat);
}

// Keys of `oscillation`.
template <class Io>
void keys(Io& io, OscillatingField& field) {
    io(quantity("amplitude", "T", "Amplitudes of Bx, By and Bz."), field.amplitude_t);
    io(quantity("frequency", "1/s", "Number of periods per second.").above(0), field.frequency_hz);
    io(quantity("phase", "rad",
           "Phase at time 0. With 90 deg the field begins at its amplitude.").by_default(),
       field.phase_rad);
}

// Keys of `precession`.
template <class Io>
void keys(Io& io, PrecessingField& field) {
    io(quantity("magnitude", "T", "Flux density. A negative one points backwards."),
       field.magnitude_t);
    io(key("axis",
           "Axis about which the field turns, right-handed. Its length does not matter."), field.axis);
    io(quantity("frequency", "1/s",
           "Number of turns per second. A negative number turns backwards."),
       field.frequency_hz);
    io(quantity("cone", "rad",
           "Angle between axis and field. With 90 deg the field turns in the plane "
           "across the axis; less leaves a steady part along it.")
           .at_least(0).at_most(3.141593).by_default(),
       field.cone_rad);
    io(quantity("start", "rad",
           "Angle at time 0, for an axis x counted from y, for y from z, for z from x "
           "(for a slanted one from the part across it).").by_default(), field.start_rad);
    io(quantity("ramp", "s",
           "Time within which the magnitude rises from zero, by (1 - cos(pi t / ramp)) / "
           "2.").above(0).optional(), field.ramp_s);
}

// Keys of `formula`.
template <class Io>
void keys(Io& io, FormulaField& field) {
    auto& [x, y, z] = field.component_t;
    io(quantity("x", "T", "Component Bx, a formula of the time t.").by_default(), x);
    io(quantity("y", "T", "Component By, a formula of the time t.").by_default(), y);
    io(quantity("z", "T", "Component Bz, a formula of the time t.").by_default(), z);
}

// Laws of the field over time, as alternatives: exactly one for a variant, at most one
// for an optional variant.
template <class Io, class Law>
void laws(Io& io, Law& law) {
    io.alternatives(law,
        key("constant", "Field in the plane that is held still."),
        key("table",
           "Field in the plane that is linear between the rows of a table, and held "
           "before the first and after the last."),
        key("rotation", "Field in the plane that turns at constant speed."),
        quantity("vector", "T", "Components Bx, By, Bz of a field that is held still."),
        key("vector_table",
           "Field whose three components are linear between the rows of a table, and "
           "held before the first and after the last."),
        key("oscillation", "Field amplitude sin(2 pi frequency t + phase)."),
        key("precession",
           "Field that turns about an axis on a cone, or in the plane across the axis."),
        key("formula", "Formulas of the time t for the components of the field."));
}

// Keys of `plus[]`.
template <class Io>
void keys(Io& io, FieldTerm& term) {
    laws(io, term.law);
}

// Keys of `gradient`.
template <class Io>
void keys(Io& io, GradientInput& gradient) {
    io(quantity("matrix", "T/m",
           "Rows of dB_i / dx_j. The matrix must be symmetric and traceless."),
       gradient.matrix_t_m);
    io(quantity("origin", "m",
           "Point at which the gradient adds nothing to the field.").by_default(), gradient.origin_m);
}

// Keys of `sources.NAME.dipole`.
template <class Io>
void keys(Io& io, DipoleSource& dipole) {
    io(quantity("moment", "A m2", "Magnetic moment along x, y and z of the source."),
       dipole.moment_a_m2);
}

// Keys of `sources.NAME.cuboid`.
template <class Io>
void keys(Io& io, CuboidMagnet& magnet) {
    io(quantity("size", "m", "Edges along x, y and z of the source.").above(0), magnet.size_m);
    io(quantity("remanence", "T",
           "Residual flux density along x, y and z of the source."), magnet.remanence_t);
}

// Keys of `sources.NAME.cylinder`.
template <class Io>
void keys(Io& io, CylinderMagnet& magnet) {
    io(quantity("diameter", "m", "Diameter of the cylinder.").above(0), magnet.diameter_m);
    io(quantity("height", "m", "Length of the cylinder along its axis.").above(0), magnet.height_m);
    io(key("axis", "Direction of the cylinder's axis. Its length does not matter.").by_default(),
       magnet.axis);
    io(quantity("remanence", "T",
           "Residual flux density: the third value is along the axis, the first two "
           "across it (x and y where the axis is z)."), magnet.remanence_t);
}

template <class Io>
void coil_keys(Io& io, CircularCoil& coil) {
    io(quantity("diameter", "m", "Diameter of the loop.").above(0), coil.diameter_m);
    io(key("axis",
           "Direction of the loop's axis, about which the current runs right-handed. Its "
           "length does not matter.").by_default(),
       coil.axis);
    io(quantity("current", "A", "Current in each turn."), coil.current_a);
    io(key("turns", "Number of turns, all on one circle.").above(0).by_default(), coil.turns);
}

// Keys of `sources.NAME.coil`.
template <class Io>
void keys(Io& io, CircularCoil& coil) {
    coil_keys(io, coil);
}

// Keys of `sources.NAME.coil_pair`.
template <class Io>
void keys(Io& io, CoilPair& pair) {
    coil_keys(io, pair);
    io(quantity("distance", "m",
           "Distance of the two loops along the axis. Their radius makes a Helmholtz "
           "pair.").above(0), pair.distance_m);
    io(key("opposed",
           "If true, the current of the coil towards which the axis points runs the "
           "other way round, which makes a gradient.").by_default(), pair.opposed);
}

// Keys of `sources.NAME.coil_system.coils[]`.
template <class Io>
void keys(Io& io, SystemCoil& coil) {
    io(quantity("position", "m",
           "Position of the coil's centre, in the frame of the source.").by_default(),
       coil.position_m);
    io(quantity("diameter", "m", "Diameter of the loop.").above(0), coil.diameter_m);
    io(key("axis",
           "Direction of the loop's axis, about which the current runs right-handed. Its "
           "length does not matter.").by_default(),
       coil.axis);
    io(key("turns", "Number of turns, all on one circle.").above(0).by_default(), coil.turns);
    io(quantity("currents", "A",
           "Currents, one for each time, or one for the whole run. A formula in "
           "`current` can stand in its place.").optional(),
       coil.current_a);
    io(quantity("current", "A",
           "Current as a formula of the time t, in place of currents."), coil.current);
}

// Keys of `sources.NAME.coil_system`.
template <class Io>
void keys(Io& io, CoilSystem& system) {
    io(key("coils", "List of coils, each with its row of the matrix of currents."), system.coils);
    io(quantity("time", "s",
           "Times of the currents, ascending. Currents are linear between them, and held "
           "before the first and after the last.").optional(), system.time_s);
    io(key("repeat",
           "If true, the currents start again after the last time. Before the first time "
           "they hold their first values.").by_default(), system.repeat);
}

// Keys of `sources.NAME.grid`.
template <class Io>
void keys(Io& io, GridField& grid) {
    io(key("file",
           "Name of a CSV file with the columns x, y, z, Bx, By, Bz of every point of a "
           "regular grid, as Magpylib and COMSOL export them. Units stand in brackets, "
           "or are SI where there are none. Its path counts from the scene's folder."), grid.file);
}

// Keys of `sources.NAME.rotation`.
template <class Io>
void keys(Io& io, AxisRotation& rotation) {
    io(key("axis", "Axis of the rotation, right-handed. Its length does not matter."), rotation.axis);
    io(quantity("angle", "rad", "Angle by which the source is turned."), rotation.angle_rad);
}

// Keys of `sources.NAME.strength.oscillation`.
template <class Io>
void keys(Io& io, StrengthOscillation& law) {
    io(quantity("frequency", "1/s", "Number of periods per second.").above(0), law.frequency_hz);
    io(quantity("phase", "rad",
           "Phase at time 0. With 90 deg the source begins at full strength.").by_default(),
       law.phase_rad);
}

// Keys of `sources.NAME.strength.table`.
template <class Io>
void keys(Io& io, StrengthTable& law) {
    io(quantity("time", "s", "Times of the rows, ascending."), law.time_s);
    io(key("factor", "Factors of the strength, one per row."), law.factor);
    io(key("repeat",
           "If true, the table starts again after its last row. Before its first time "
           "the strength holds the first value.").by_default(), law.repeat);
}

// Keys of `sources.NAME.strength.ramp`.
template <class Io>
void keys(Io& io, StrengthRamp& law) {
    io(quantity("duration", "s", "Time that the rise takes.").above(0), law.duration_s);
}

// Keys of `sources.NAME.strength`.
template <class Io>
void keys(Io& io, StrengthLaw& law) {
    io.alternatives(law,
        key("oscillation", "Factor sin(2 pi frequency t + phase)."),
        key("table",
           "Factor that is linear between the rows of a table, and held before the first "
           "and after the last."),
        key("ramp", "Factor that rises from zero by (1 - cos(pi t / duration)) / 2."),
        quantity("formula", "", "Factor as a formula of the time t."));
}

// Keys of `sources.NAME.motion.path`.
template <class Io>
void keys(Io& io, SourcePath& path) {
    io(quantity("time", "s", "Times of the rows, ascending."), path.time_s);
    io(quantity("displacement", "m",
           "Displacements along x, y and z, one triple per row.")
           .rows(1, Field::unbounded), path.displacement_m);
    io(key("repeat",
           "If true, the table starts again after its last row. Before its first time "
           "the displacement holds the first value.").by_default(), path.repeat);
}

// Keys of `sources.NAME.motion`.
template <class Io>
void keys(Io& io, SourceMotion& motion) {
    io.alternatives(motion,
        key("oscillation",
           "Displacement amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        key("ramp",
           "Displacement that grows by (1 - cos(pi t / duration)) / 2 and is then held."),
        key("formula",
           "Formulas of the time t for the components of the displacement."),
        key("path",
           "Displacement that is linear between the rows of a table, and held before the "
           "first and after the last."));
}

// Keys of `sources.NAME.turning`.
template <class Io>
void keys(Io& io, SourceTurning& turning) {
    io(key("axis",
           "Axis about which the source turns, right-handed. Its length does not matter."),
       turning.axis);
    io.alternatives(turning.turns,
        quantity("frequency", "1/s",
           "Number of turns per second. A negative number turns backwards."),
        quantity("angle", "rad", "Angle as a formula of the time t."));
    io(quantity("about", "m",
           "Point that the source circles. Without it, the source turns about itself."),
       turning.about_m);
}

// Keys of `sources.NAME`.
template <class Io>
void keys(Io& io, FieldSource& source) {
    io.alternatives(source.shape,
        key("dipole", "Point dipole."),
        key("cuboid", "Block that is evenly magnetised, in any direction."),
        key("cylinder", "Cylinder that is evenly magnetised, in any direction."),
        key("coil", "Circular loop."),
        key("coil_pair",
           "Two circular loops on one axis: a Helmholtz pair, or opposed (Maxwell)."),
        key("coil_system",
           "List of circular loops, each with a current of its own over time."),
        key("grid",
           "Field values from a file, with cubic interpolation. A body must stay inside "
           "the grid."));
    io(quantity("position", "m", "Position of the source's centre in space.").by_default(),
       source.position_m);
    io(key("rotation",
           "Rotation of the source's frame about its centre, at the start."), source.rotation);
    io(key("strength",
           "Factor of the source's moment, remanence, currents or values over time."),
       source.strength);
    io(key("motion", "Displacement of the source from its position over time."), source.motion);
    io(key("turning",
           "Rotation of the source at constant speed or by an angle, after `rotation` "
           "and `motion`."),
       source.turning);
}

// Keys of `magnetic_field` itself. Its laws are keys beside `plane`; the optional law carries
// them in and out of `uniform` and `course`.
template <class Io>
void keys(Io& io, MagneticField& field) {
    io(key("plane",
           "Plane of the laws that act in a plane. Angles run from its first axis to its "
           "second.")
           .by_default(),
       PlaneRef{field.plane});
    std::optional<FieldLaw> law;
    if (field.uniform) law = field.course;
    laws(io, law);
    field.uniform = law.has_value();
    if (law) field.course = std::move(*law);
    io(key("plus", "List of further laws, whose fields add to the first.").optional(), field.plus);
    io(key("gradient",
           "Field gradient, which adds a field that is linear in space and constant in "
           "time."),
       field.gradient);
    io(key("sources",
           "Magnets, coils and grids by name, whose fields add and vary in space.")
           .optional(), field.sources);
}

// Keys of `dipoles`, at the top level of the scene.
template <class Io>
void keys(Io& io, DipoleOptions& dipoles) {
    io(key("within_bodies",
           "If true, dipoles also act on the elements of their own body, whose edges may "
           "then differ by a factor of 2 at most.").by_default(), dipoles.within_bodies);
}

MAGFSI_KEYS_OF(DipoleOptions)
MAGFSI_KEYS_OF(MagneticField)
MAGFSI_KEYS_OF(FieldTerm)

}  // namespace magfsi::scene
