// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of the magnetic field: its laws and its sources.
#include "adapters/scene/keys.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

template <class Io>
void keys(Io& io, FieldTable& table) {
    io(quantity("time", "s", "Times of the rows, ascending."), table.time_s);
    io(quantity("magnitude", "T", "One per row; the sign flips the field."),
       table.magnitude_t);
    io(quantity("direction", "rad", "Angle in the plane: one for all, or one per row.")
           .one_or_list(),
       table.direction_rad);
    io(key("repeat", "Start again after the last row; the first is held before.").by_default(), table.repeat);
}

template <class Io>
void keys(Io& io, RotatingField& field) {
    io(quantity("magnitude", "T", "Flux density; a negative one points backwards."),
       field.magnitude_t);
    io(quantity("start", "rad", "Angle at time 0.").by_default(), field.start_rad);
    io(quantity("frequency", "1/s", "Turns per second; negative turns backwards."),
       field.frequency_hz);
}

template <class Io>
void keys(Io& io, VectorField& field) {
    io.whole(field.vector_t);
}

template <class Io>
void keys(Io& io, VectorTable& table) {
    io(key("file", "CSV with the columns t[s], Bx[T], By[T], Bz[T] (also ms, us, mT, uT) in place of "
           "time and vector; its path counts from the scene's folder.").optional(), table.file);
    io(quantity("time", "s", "Times of the rows, ascending.").optional(), table.time_s);
    io(quantity("vector", "T", "Bx, By, Bz: one per row.").rows(1, Field::unbounded).optional(),
       table.vector_t);
    io(key("repeat", "Start again after the last row; the first is held before.").by_default(), table.repeat);
}

template <class Io>
void keys(Io& io, OscillatingField& field) {
    io(quantity("amplitude", "T", "Bx, By, Bz."), field.amplitude_t);
    io(quantity("frequency", "1/s", "Periods per second.").above(0), field.frequency_hz);
    io(quantity("phase", "rad", "At time 0; 90 deg begins at the amplitude.").by_default(),
       field.phase_rad);
}

template <class Io>
void keys(Io& io, PrecessingField& field) {
    io(quantity("magnitude", "T", "Flux density; a negative one points backwards."),
       field.magnitude_t);
    io(key("axis", "About which it turns, right-handed; any length."), field.axis);
    io(quantity("frequency", "1/s", "Turns per second; negative turns backwards."),
       field.frequency_hz);
    io(quantity("cone", "rad", "Between axis and field: 90 deg turns in the plane across the axis, "
                "less leaves a steady part along it.").at_least(0).at_most(3.141593).by_default(),
       field.cone_rad);
    io(quantity("start", "rad", "Angle at time 0, of an axis x from y, of y from z, of z from x "
                "(of a slanted one from the part across it).").by_default(), field.start_rad);
    io(quantity("ramp", "s", "Within this time the magnitude rises from zero, by "
                "(1 - cos(pi t / ramp)) / 2.").above(0).optional(), field.ramp_s);
}

template <class Io>
void keys(Io& io, FormulaField& field) {
    auto& [x, y, z] = field.component_t;
    io(quantity("x", "T", "Bx.").by_default(), x);
    io(quantity("y", "T", "By.").by_default(), y);
    io(quantity("z", "T", "Bz.").by_default(), z);
}

// One, or at most one.
template <class Io, class Law>
void laws(Io& io, Law& law) {
    io.alternatives(law,
        key("constant", "In the plane, held still."),
        key("table", "In the plane, linear between rows; before the first and after the last, "
            "held."),
        key("rotation", "In the plane, turns at constant speed."),
        quantity("vector", "T", "Bx, By, Bz, held still."),
        key("vector_table", "Of three components, linear between rows, held before and after."),
        key("oscillation", "amplitude sin(2 pi frequency t + phase)."),
        key("precession", "Turns about an axis on a cone, or in the plane across it."),
        key("formula", "Of the time t, by component."));
}

template <class Io>
void keys(Io& io, FieldTerm& term) {
    laws(io, term.law);
}

template <class Io>
void keys(Io& io, GradientInput& gradient) {
    io(quantity("matrix", "T/m", "Rows of dB_i / dx_j; symmetric and traceless."),
       gradient.matrix_t_m);
    io(quantity("origin", "m", "Where it adds nothing.").by_default(), gradient.origin_m);
}

template <class Io>
void keys(Io& io, DipoleSource& dipole) {
    io(quantity("moment", "A m2", "Along x, y and z of the source."), dipole.moment_a_m2);
}

template <class Io>
void keys(Io& io, CuboidMagnet& magnet) {
    io(quantity("size", "m", "Edges along x, y and z of the source.").above(0), magnet.size_m);
    io(quantity("remanence", "T", "Along x, y and z of the source."), magnet.remanence_t);
}

template <class Io>
void keys(Io& io, CylinderMagnet& magnet) {
    io(quantity("diameter", "m", "Of the cylinder.").above(0), magnet.diameter_m);
    io(quantity("height", "m", "Along its axis.").above(0), magnet.height_m);
    io(key("axis", "Of the cylinder; any length.").by_default(), magnet.axis);
    io(quantity("remanence", "T", "The third value along the axis, the first two across it (x and y "
                "where the axis is z)."), magnet.remanence_t);
}

template <class Io>
void coil_keys(Io& io, CircularCoil& coil) {
    io(quantity("diameter", "m", "Of the loop.").above(0), coil.diameter_m);
    io(key("axis", "The current runs right-handed about it; any length.").by_default(),
       coil.axis);
    io(quantity("current", "A", "In each turn."), coil.current_a);
    io(key("turns", "All on one circle.").above(0).by_default(), coil.turns);
}

template <class Io>
void keys(Io& io, CircularCoil& coil) {
    coil_keys(io, coil);
}

template <class Io>
void keys(Io& io, CoilPair& pair) {
    coil_keys(io, pair);
    io(quantity("distance", "m", "Between the two loops, along the axis; their radius makes a "
                "Helmholtz pair.").above(0), pair.distance_m);
    io(key("opposed", "The current of the coil towards which the axis points runs the other way "
           "round: a gradient.").by_default(), pair.opposed);
}

template <class Io>
void keys(Io& io, SystemCoil& coil) {
    io(quantity("position", "m", "Of its centre, in the frame of the source.").by_default(),
       coil.position_m);
    io(quantity("diameter", "m", "Of the loop.").above(0), coil.diameter_m);
    io(key("axis", "The current runs right-handed about it; any length.").by_default(),
       coil.axis);
    io(key("turns", "All on one circle.").above(0).by_default(), coil.turns);
    io(quantity("currents", "A", "One for each time, or one for good; or current.").optional(),
       coil.current_a);
    io(quantity("current", "A", "Of the time t, in place of currents."), coil.current);
}

template <class Io>
void keys(Io& io, CoilSystem& system) {
    io(key("coils", "Each with its row of the matrix of currents."), system.coils);
    io(quantity("time", "s", "Of the currents, ascending; linear in between, held before and "
                "after.").optional(), system.time_s);
    io(key("repeat", "Start again after the last time; the first is held before.").by_default(), system.repeat);
}

template <class Io>
void keys(Io& io, GridField& grid) {
    io(key("file", "CSV with the columns x, y, z, Bx, By, Bz of every point of a regular grid, as "
           "Magpylib and COMSOL export them; units in brackets, SI where there are none. Its "
           "path counts from the scene's folder."), grid.file);
}

template <class Io>
void keys(Io& io, AxisRotation& rotation) {
    io(key("axis", "Right-handed; any length."), rotation.axis);
    io(quantity("angle", "rad", "How far."), rotation.angle_rad);
}

template <class Io>
void keys(Io& io, StrengthOscillation& law) {
    io(quantity("frequency", "1/s", "Periods per second.").above(0), law.frequency_hz);
    io(quantity("phase", "rad", "At time 0; 90 deg begins at full strength.").by_default(),
       law.phase_rad);
}

template <class Io>
void keys(Io& io, StrengthTable& law) {
    io(quantity("time", "s", "Times of the rows, ascending."), law.time_s);
    io(key("factor", "One per row."), law.factor);
    io(key("repeat", "Start again after the last row; the first is held before.").by_default(), law.repeat);
}

template <class Io>
void keys(Io& io, StrengthRamp& law) {
    io(quantity("duration", "s", "Of the rise.").above(0), law.duration_s);
}

template <class Io>
void keys(Io& io, StrengthLaw& law) {
    io.alternatives(law,
        key("oscillation", "sin(2 pi frequency t + phase)."),
        key("table", "Linear between rows, held before and after."),
        key("ramp", "From zero, by (1 - cos(pi t / duration)) / 2."),
        quantity("formula", "", "Of the time t."));
}

template <class Io>
void keys(Io& io, SourcePath& path) {
    io(quantity("time", "s", "Times of the rows, ascending."), path.time_s);
    io(quantity("displacement", "m", "One per row, along x, y and z.")
           .rows(1, Field::unbounded), path.displacement_m);
    io(key("repeat", "Start again after the last row; the first is held before.").by_default(), path.repeat);
}

template <class Io>
void keys(Io& io, SourceMotion& motion) {
    io.alternatives(motion,
        key("oscillation", "amplitude (sin(2 pi frequency t + phase) - sin(phase))."),
        key("ramp", "By (1 - cos(pi t / duration)) / 2, then held there."),
        key("formula", "Of the time t, by component."),
        key("path", "Linear between rows, held before and after."));
}

template <class Io>
void keys(Io& io, SourceTurning& turning) {
    io(key("axis", "About which it turns, right-handed; any length."), turning.axis);
    io.alternatives(turning.turns,
        quantity("frequency", "1/s", "Turns per second; negative turns backwards."),
        quantity("angle", "rad", "Of the time t."));
    io(quantity("about", "m", "A point that it circles; without it, it turns about itself."),
       turning.about_m);
}

template <class Io>
void keys(Io& io, FieldSource& source) {
    io.alternatives(source.shape,
        key("dipole", "A point."),
        key("cuboid", "A block that is evenly magnetised."),
        key("cylinder", "Likewise, of any direction of its magnetisation."),
        key("coil", "A circular loop."),
        key("coil_pair", "Two on one axis: Helmholtz, or opposed (Maxwell)."),
        key("coil_system", "Circular loops, each with a current of its own over time."),
        key("grid", "Values from a file, cubic between them; a body must stay inside."));
    io(quantity("position", "m", "Of its centre, in space.").by_default(), source.position_m);
    io(key("rotation", "Of its frame about its centre, at the start."), source.rotation);
    io(key("strength", "Factor of its moment, remanence, currents or values over time."),
       source.strength);
    io(key("motion", "Displacement from its position over time."), source.motion);
    io(key("turning", "Turns at constant speed or by an angle, after the rotation and the motion."),
       source.turning);
}

template <class Io>
void keys(Io& io, MagneticField& field) {
    io(key("plane", "Of laws in a plane; angles run from its first axis to its second.")
           .by_default(),
       PlaneRef{field.plane});
    std::optional<FieldLaw> law;
    if (field.uniform) law = field.course;
    laws(io, law);
    field.uniform = law.has_value();
    if (law) field.course = std::move(*law);
    io(key("plus", "Further laws, whose fields add to the first.").optional(), field.plus);
    io(key("gradient", "Adds a field that is linear in space and constant in time."),
       field.gradient);
    io(key("sources", "Magnets, coils and grids by name, whose fields add and vary in space.")
           .optional(), field.sources);
}

template <class Io>
void keys(Io& io, DipoleOptions& dipoles) {
    io(key("within_bodies", "Also on the elements of their own body, whose edges may then differ by a "
           "factor of 2 at most.").by_default(), dipoles.within_bodies);
}

MAGFSI_KEYS_OF(DipoleOptions)
MAGFSI_KEYS_OF(MagneticField)
MAGFSI_KEYS_OF(FieldTerm)

}  // namespace magfsi::scene
