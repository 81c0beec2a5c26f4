// SPDX-License-Identifier: GPL-2.0-or-later
// Options of meshes and of the parts of a body, in SI; see options.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::structure {

using magfsi::Vec3;

// --- meshes -------------------------------------------------------------------------

// Block of hexahedra along the axes. The origin of the body's frame is its lowest corner.
struct Box {
    // Edge lengths along x, y, z
    Vec3 size_m{};
    // Numbers of elements along x, y, z
    std::array<int, 3> elements{};
    bool operator==(const Box&) const = default;
};

// Plate of parallelogram cells: the crease pattern of Miura-ori before folding (zigzag
// true), or a sheared block (mesh/block_mesh.h).
struct ObliquePlate {
    std::array<int, 2> cells{};  // number along x (columns) and along y (rows)
    double length_a_m = 0;       // side of a cell along x
    double length_b_m = 0;       // the other side of a cell
    double angle_rad = 0;        // angle between the two sides, above 0 and below pi
    double thickness_m = 0;
    std::array<int, 3> elements_per_cell{1, 1, 1};  // along a, along b, layers
    bool zigzag = true;  // true: each second row is sheared the other way
    bool operator==(const ObliquePlate&) const = default;
};

// Hexahedra of a Gmsh file; its physical groups are regions and faces.
struct MeshFile {
    std::string file;
    double unit_m = 1;  // length of the file's unit
    bool operator==(const MeshFile&) const = default;
};

// Box that defines a face: the nodes inside it.
struct FaceBox {
    std::string name;
    std::array<Vec3, 2> box_m{};  // lowest and highest corner, both included
    bool operator==(const FaceBox&) const = default;
};
// Mesh of cubes: those of a regular grid whose middle lies inside the closed surface of
// an STL file (mesh/voxel_mesh.h).
struct VoxelMesh {
    std::string file;
    double spacing_m = 0;        // edge of the cubes
    double unit_m = 1;           // length of the file's unit
    std::vector<FaceBox> faces;  // further faces, by name
    bool operator==(const VoxelMesh&) const = default;
};

// Block that is bent or wound along a curve: its middle line, in the elements' first
// direction, lies on the curve (mesh/swept_mesh.h).
struct Arc {
    double radius_m = 0;
    double angle_rad = 0;               // 2 pi gives a closed ring
    std::array<double, 2> section_m{};  // width and thickness
    std::array<int, 3> elements{};      // along the curve, the width and the thickness
    bool operator==(const Arc&) const = default;
};
// Block wound along a helix: section and elements as for an arc, pitch per turn.
struct Helix {
    double radius_m = 0, pitch_m = 0, turns = 0;
    std::array<double, 2> section_m{};
    std::array<int, 3> elements{};
    bool left_handed = false;
    bool operator==(const Helix&) const = default;
};

// Round bodies (mesh/round_mesh.h). Of the elements the first number is that across the
// core, the second that of the layers from the core to the surface, the third that along.
struct BallMesh {
    double diameter_m = 0;
    std::array<int, 2> elements{};
    bool operator==(const BallMesh&) const = default;
};
struct CylinderMesh {
    double diameter_m = 0, length_m = 0;
    std::array<int, 3> elements{};
    bool operator==(const CylinderMesh&) const = default;
};
struct CapsuleMesh {
    double diameter_m = 0;
    double length_m = 0;            // with both ends
    std::array<int, 3> elements{};  // the third: along the straight part
    bool operator==(const CapsuleMesh&) const = default;
};
struct ConeMesh {
    std::array<double, 2> diameters_m{};  // at x_min and at x_max
    double length_m = 0;
    std::array<int, 3> elements{};
    bool operator==(const ConeMesh&) const = default;
};
// Head of a helix of wire, on its axis.
struct WireHead {
    double diameter_m = 0, length_m = 0;
    bool operator==(const WireHead&) const = default;
};
struct WireMesh {
    double radius_m = 0, pitch_m = 0, turns = 0;  // of the middle line
    double diameter_m = 0;                        // of the wire
    std::array<int, 3> elements{};
    bool left_handed = false;
    std::optional<WireHead> head;
    bool operator==(const WireMesh&) const = default;
};

using MeshOptions = std::variant<Box, ObliquePlate, MeshFile, VoxelMesh, Arc, Helix,
                                 BallMesh, CylinderMesh, CapsuleMesh, ConeMesh, WireMesh>;

// --- parts of a body, in its own frame ---

struct BallShape {
    Vec3 centre_m{};
    double diameter_m = 0;
    bool operator==(const BallShape&) const = default;
};
// The elements whose centre lies in each of the shapes that are given (mesh/region.h). An
// absent shape or an empty polygon does not restrict.
struct RegionShape {
    std::optional<std::array<Vec3, 2>> box_m;
    std::vector<std::array<double, 2>> polygon_xy_m;
    std::optional<BallShape> ball;
    bool operator==(const RegionShape&) const = default;
};
struct NamedRegion {
    std::string name;
    RegionShape shape;
    bool operator==(const NamedRegion&) const = default;
};

}  // namespace magfsi::structure
