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

MAGFSI_KEYS_OF(Box)
MAGFSI_KEYS_OF(ObliquePlate)
MAGFSI_KEYS_OF(MeshFile)
MAGFSI_KEYS_OF(VoxelMesh)
MAGFSI_KEYS_OF(Arc)
MAGFSI_KEYS_OF(Helix)

}  // namespace magfsi::scene
