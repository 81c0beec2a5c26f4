// Fields in the cells of a regular grid as VTK XML: one .vti a piece, one .pvti that
// names the pieces. Pieces meet face to face; no cell is in two of them.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupler/output/vtk_field.h"

namespace magfsi::output {

// Half-open box of cells in global indices. VTK's extents count points: the same numbers,
// since n cells have n + 1 points.
struct CellExtent {
    std::array<int, 3> lo{}, hi{};
    std::size_t cells() const;  // 0 for an empty one
};

struct ImageGrid {
    std::array<double, 3> origin_m{};  // lowest corner of cell (0, 0, 0)
    std::array<double, 3> spacing_m{};
};

// Values with x fastest, of the extent's cells only. Throws std::invalid_argument on an
// empty extent, a spacing that is not positive or a wrong number of values; FileError on
// a failing disk.
void write_vti(const std::filesystem::path& path, const ImageGrid& grid,
               const CellExtent& extent, std::span<const Field> cell_fields);

struct ImagePiece {
    std::filesystem::path file;  // as this process would open it
    CellExtent extent;
};

// What the pieces hold; every piece must hold the same.
struct FieldType {
    std::string name;
    int components = 1;
    bool float64 = false;
};

// Throws std::invalid_argument when the pieces do not fill the whole extent exactly.
void write_pvti(const std::filesystem::path& path, const ImageGrid& grid,
                const CellExtent& whole, std::span<const ImagePiece> pieces,
                std::span<const FieldType> cell_fields);

}  // namespace magfsi::output
