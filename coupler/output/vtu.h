// A hexahedral mesh with its fields as VTK XML (.vtu, raw appended), for ParaView.
#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "coupler/output/vtk_field.h"

namespace magfsi::output {

struct HexahedralMesh {
    Values points_m;  // three values a point
    // Point numbers in lexicographic order (a = i + 2 j + 4 k); VTK's own order differs
    // and is made on writing.
    std::span<const std::array<int, 8>> hexahedra;
};

// Written atomically. Throws std::invalid_argument when the number of values of a field,
// or a point number of a hexahedron, does not fit the mesh; FileError on a failing disk.
void write_vtu(const std::filesystem::path& path, const HexahedralMesh& mesh,
               std::span<const Field> point_fields, std::span<const Field> cell_fields);

}  // namespace magfsi::output
