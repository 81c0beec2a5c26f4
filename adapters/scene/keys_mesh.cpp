// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of `bodies.NAME.mesh`, stored in structure/options.h. A comment before each
// function names the place of its group below `mesh`.
#include "adapters/scene/keys.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `box`.
template <class Io>
void keys(Io& io, Box& box) {
    io(quantity("size", "m", "Lengths of the block along x, y and z.").above(0), box.size_m);
    io(key("elements", "Numbers of elements along x, y and z.").at_least(1).at_most(100000),
       box.elements);
}

// Keys of `oblique`.
template <class Io>
void keys(Io& io, ObliquePlate& plate) {
    io(key("cells", "Numbers of cells along x and y.").at_least(1).at_most(10000), plate.cells);
    io(quantity("length_a", "m", "Length of a cell's side along x.").above(0), plate.length_a_m);
    io(quantity("length_b", "m", "Length of a cell's other side.").above(0), plate.length_b_m);
    io(quantity("angle", "rad", "Angle between the two sides of a cell.").above(0).at_most(3.14159),
       plate.angle_rad);
    io(quantity("thickness", "m", "Thickness of the plate.").above(0), plate.thickness_m);
    io(key("elements",
           "Numbers of elements in a cell: along side a, along side b, and layers.")
           .at_least(1).at_most(100000),
       plate.elements_per_cell);
    io(key("zigzag",
           "If true, rows lean right and left in turn, as in Miura-ori. If false, all "
           "lean the same way.")
           .by_default(), plate.zigzag);
}

// Keys of `gmsh`.
template <class Io>
void keys(Io& io, MeshFile& mesh) {
    io(key("file", "Name of a .msh file. Its path counts from the scene's folder."), mesh.file);
    io(quantity("unit", "m", "Length that one unit of the file stands for.").above(0).by_default(),
       mesh.unit_m);
}

// Keys of `voxels.faces.NAME`.
template <class Io>
void keys(Io& io, FaceBox& face) {
    io(quantity("box", "m",
           "Lower and upper corner of a box in the file's frame. All nodes inside belong "
           "to the face."), face.box_m);
}

// Keys of `voxels`.
template <class Io>
void keys(Io& io, VoxelMesh& mesh) {
    io(key("file",
           "Name of an STL file, ASCII or binary, with a closed surface. Its path counts "
           "from the scene's folder."), mesh.file);
    io(quantity("spacing", "m",
           "Edge of the cubes. A whole part of the body's thickness is best.")
           .above(0), mesh.spacing_m);
    io(quantity("unit", "m", "Length that one unit of the file stands for.").above(0).by_default(),
       mesh.unit_m);
    io(key("faces",
           "Names of further faces that can be clamped, each with the box that holds its "
           "nodes.").optional(), mesh.faces);
}

// Keys of `arc`.
template <class Io>
void keys(Io& io, Arc& arc) {
    io(quantity("radius", "m", "Radius of the middle line.").above(0), arc.radius_m);
    io(quantity("angle", "rad",
           "Angle of the arc from end to end. With 360 deg it is a ring, whose ends are "
           "joined.").above(0)
           .at_most(6.2831853071796), arc.angle_rad);
    io(quantity("section", "m",
           "Width of the section along y, and its thickness towards the centre.").above(0),
       arc.section_m);
    io(key("elements",
           "Numbers of elements along the arc, the width and the thickness.")
           .at_least(1).at_most(100000),
       arc.elements);
}

// Keys of `helix`.
template <class Io>
void keys(Io& io, Helix& helix) {
    io(quantity("radius", "m", "Radius of the middle line.").above(0), helix.radius_m);
    io(quantity("pitch", "m", "Length of one turn along x.").above(0), helix.pitch_m);
    io(key("turns", "Number of turns.").above(0).at_most(1000), helix.turns);
    io(quantity("section", "m",
           "Width of the section along the surface of the cylinder, and its thickness "
           "away from the cylinder's axis.").above(0),
       helix.section_m);
    io(key("elements",
           "Numbers of elements along the helix, the width and the thickness.")
           .at_least(1).at_most(100000),
       helix.elements);
    io(key("left_handed",
           "If true, the helix is left-handed. A right-handed one turns from y to z as x "
           "grows.").by_default(),
       helix.left_handed);
}

// Doc lines of the numbers of elements of round bodies.
constexpr const char* round_elements =
    "Numbers of elements across the core, from the core to the surface, and along the body.";

// Keys of `ball`.
template <class Io>
void keys(Io& io, BallMesh& ball) {
    io(quantity("diameter", "m", "Diameter of the ball.").above(0), ball.diameter_m);
    io(key("elements", "Numbers of elements across the core, and from it to the surface.")
           .at_least(1).at_most(1000),
       ball.elements);
}

// Keys of `cylinder`.
template <class Io>
void keys(Io& io, CylinderMesh& cylinder) {
    io(quantity("diameter", "m", "Diameter of the cylinder.").above(0), cylinder.diameter_m);
    io(quantity("length", "m", "Length along x.").above(0), cylinder.length_m);
    io(key("elements", round_elements).at_least(1).at_most(100000), cylinder.elements);
}

// Keys of `capsule`.
template <class Io>
void keys(Io& io, CapsuleMesh& capsule) {
    io(quantity("diameter", "m", "Diameter of the capsule and of its two half balls.").above(0),
       capsule.diameter_m);
    io(quantity("length", "m", "Length along x, with both ends.").above(0), capsule.length_m);
    io(key("elements",
           "Numbers of elements across the core (even), from the core to the surface, and "
           "along the straight part.").at_least(1).at_most(100000), capsule.elements);
}

// Keys of `cone`.
template <class Io>
void keys(Io& io, ConeMesh& cone) {
    io(quantity("diameters", "m", "Diameters at the lower and the upper end of x.").above(0),
       cone.diameters_m);
    io(quantity("length", "m", "Length along x.").above(0), cone.length_m);
    io(key("elements", round_elements).at_least(1).at_most(100000), cone.elements);
}

// Keys of `wire.head`.
template <class Io>
void keys(Io& io, WireHead& head) {
    io(quantity("diameter", "m", "Diameter of the head.").above(0), head.diameter_m);
    io(quantity("length", "m", "Length of its straight part along x.").above(0), head.length_m);
}

// Keys of `wire`.
template <class Io>
void keys(Io& io, WireMesh& wire) {
    io(quantity("radius", "m", "Radius of the middle line.").above(0), wire.radius_m);
    io(quantity("pitch", "m", "Length of one turn along x.").above(0), wire.pitch_m);
    io(key("turns", "Number of turns.").above(0).at_most(1000), wire.turns);
    io(quantity("diameter", "m", "Diameter of the wire.").above(0), wire.diameter_m);
    io(key("elements",
           "Numbers of elements across the core, from the core to the surface, and along "
           "the wire with its head.").at_least(1).at_most(100000), wire.elements);
    io(key("left_handed",
           "If true, the helix is left-handed. A right-handed one turns from y to z as x "
           "grows.").by_default(),
       wire.left_handed);
    io(key("head",
           "Head at the upper end of x: in one turn more the wire comes to the axis, grows to "
           "this diameter within half a turn, and then has this length."), wire.head);
}

MAGFSI_KEYS_OF(Box)
MAGFSI_KEYS_OF(ObliquePlate)
MAGFSI_KEYS_OF(MeshFile)
MAGFSI_KEYS_OF(VoxelMesh)
MAGFSI_KEYS_OF(Arc)
MAGFSI_KEYS_OF(Helix)
MAGFSI_KEYS_OF(BallMesh)
MAGFSI_KEYS_OF(CylinderMesh)
MAGFSI_KEYS_OF(CapsuleMesh)
MAGFSI_KEYS_OF(ConeMesh)
MAGFSI_KEYS_OF(WireMesh)

}  // namespace magfsi::scene
