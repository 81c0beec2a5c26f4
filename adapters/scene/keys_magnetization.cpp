// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of a body's regions and of its magnetisation, stored in structure/options.h. A
// comment before each function names the place of its group below `bodies.NAME`.
#include "adapters/scene/keys.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `magnetization.uniform`: a vector in place of a map.
template <class Io>
void keys(Io& io, UniformMagnetization& uniform) {
    io.whole(uniform.vector_a_m);
}

// Keys of `magnetization.harmonic`.
template <class Io>
void keys(Io& io, HarmonicMagnetization& wave) {
    io(quantity("amplitude", "A/m", "Strength of the magnetization.").above(0), wave.amplitude_a_m);
    io(quantity("wavelength", "m",
           "Length of one turn of the magnetization. Without it, one turn fits the "
           "body's length along `along`.").above(0).optional(),
       wave.wavelength_m);
    io(quantity("phase", "rad", "Angle of the magnetization at s = 0.").by_default(), wave.phase_rad);
    io(key("along", "Axis along which s runs.").by_default(), AxisRef{wave.along});
    io(key("into", "Second axis of the plane in which the magnetization turns.").by_default(),
       AxisRef{wave.into});
}

// Keys of `regions.NAME.ball` and `magnetization.domains[].ball`.
template <class Io>
void keys(Io& io, BallShape& ball) {
    io(quantity("centre", "m", "Centre of the ball, in the body's frame."), ball.centre_m);
    io(quantity("diameter", "m", "Diameter of the ball.").above(0), ball.diameter_m);
}

// Keys of `regions.NAME`, and of an item of magnetization.domains.
template <class Io>
void keys(Io& io, RegionShape& shape) {
    io(quantity("box", "m", "Lower and upper corner of a box, in the body's frame.").alternative(),
       shape.box_m);
    io(quantity("polygon", "m", "Corners of a polygon in the x-y plane, in the body's frame.")
           .rows(3, 10000).alternative(),
       shape.polygon_xy_m);
    io(key("ball", "Ball that holds the centres of the elements.").alternative(), shape.ball);
}

// Keys of `regions.NAME`.
template <class Io>
void keys(Io& io, NamedRegion& region) {
    keys(io, region.shape);
}

// Keys of `magnetization.domains[]`.
template <class Io>
void keys(Io& io, MagneticDomain& domain) {
    keys(io, domain.shape);
    io(quantity("vector", "A/m", "Magnetization vector of the domain."), domain.vector_a_m);
}

// Keys of `magnetization.domains`.
template <class Io>
void keys(Io& io, DomainMagnetization& magnetization) {
    io.whole(magnetization.domains);
}

// Keys of `magnetization.regions[]`.
template <class Io>
void keys(Io& io, RegionVector& region) {
    io(key("region", "Name of a region of the mesh, or a list of names.").one_or_list(),
       region.regions);
    io(quantity("vector", "A/m", "Magnetization vector of the region."), region.vector_a_m);
}

// Keys of `magnetization.regions`.
template <class Io>
void keys(Io& io, RegionMagnetization& magnetization) {
    io.whole(magnetization.regions);
}

// Keys of `magnetization.table`.
template <class Io>
void keys(Io& io, TableMagnetization& table) {
    io(key("file",
           "Name of a CSV file with the columns x[m], y[m], z[m], Mx[A/m], My[A/m], "
           "Mz[A/m]. Its path counts from the scene's folder."), table.file);
}

// Keys of `magnetization.curve`.
template <class Io>
void keys(Io& io, CurveMagnetization& curve) {
    io(quantity("strength", "A/m", "Strength of the magnetization.").above(0), curve.strength_a_m);
    io(quantity("points", "m",
           "Points of the curve, in the body's frame. Without them, the curve is the "
           "centre line of the mesh: of a block, an arc, a helix, or what the Gmsh file "
           "calls so.")
           .rows(2, 10000).optional(), curve.points_m);
    io(quantity("wavelength", "m",
           "Length along the curve in which the magnetization turns once. Without it, it "
           "does not turn.").above(0)
           .optional(), curve.wavelength_m);
    io(quantity("phase", "rad",
           "Angle between the magnetization and the tangent at the start of the curve.").by_default(),
       curve.phase_rad);
    io(key("plane",
           "Plane in which the magnetization turns, from the plane's first axis to its "
           "second.").by_default(),
       PlaneRef{curve.plane});
}

// Keys of `magnetization.radial`.
template <class Io>
void keys(Io& io, RadialMagnetization& radial) {
    io(quantity("strength", "A/m",
           "Strength of the magnetization. A negative one points to the centre."),
       radial.strength_a_m);
    io(quantity("centre", "m", "Centre of the magnetization, in the body's frame.").by_default(),
       radial.centre_m);
    io(key("axis",
           "Direction of an axis through the centre. With it the magnetization points "
           "away from that axis in place of the centre. Its length does not matter.").optional(),
       radial.axis);
}

// Keys of `magnetization`.
template <class Io>
void keys(Io& io, Remanence& remanence) {
    io(key("follows",
           "What the magnetization of a deformed body does: deformation, as in the paper, turns and "
           "stretches it with the material; rotation turns it and leaves its strength. Both agree "
           "where a body bends without being stretched.").by_default(),
       remanence.follows);
    io.alternatives(static_cast<Magnetization&>(remanence),
        quantity("uniform", "A/m", "Magnetization vector of the whole body."),
        key("harmonic",
           "Magnetization that turns along an axis: amplitude [cos(2 pi s / wavelength + "
           "phase) along + sin(...) into], where s counts from the lower end."),
        key("domains",
           "List of domains. Elements whose centre lies in a domain carry its vector; "
           "the first domain wins. Elements in no domain carry none."),
        key("regions",
           "List of vectors for regions of the mesh. A region that is not named carries "
           "none."),
        key("table",
           "Table of points and vectors. Each element takes the vector of the nearest "
           "point."),
        key("curve",
           "Magnetization along the tangent of a curve, at the curve's point nearest to "
           "the element, turned by phase + 2 pi s / wavelength, where s runs along the "
           "curve."),
        key("radial", "Magnetization that points away from a point or an axis."));
}

MAGFSI_KEYS_OF(NamedRegion)
MAGFSI_KEYS_OF(Remanence)

}  // namespace magfsi::scene
