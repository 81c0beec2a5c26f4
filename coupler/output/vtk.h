// SPDX-License-Identifier: GPL-2.0-or-later
// Field files for ParaView in VTK's XML formats with raw appended data: .vti and .pvti
// (regular grids), .vtu (hexahedra), .pvd (a series of instants).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::output {

// All structures below refer to values that they do not own, which must live until they
// are written.

// An array of values, written in its own type as Float32, Float64 or UInt8.
using Values = std::variant<std::span<const float>, std::span<const double>,
                            std::span<const std::uint8_t>>;

// A field at points or in cells: `components` consecutive values per point or cell.
struct Field {
    std::string name;
    int components = 1;
    Values values;
};

// Fields in the cells of a regular grid go to one .vti file per piece and a .pvti file
// that names the pieces. Pieces may touch but not overlap.

// A half-open box of cells in global indices. VTK's extents count points but have the
// same numbers, since n cells have n + 1 points.
struct CellExtent {
    std::array<int, 3> lo{}, hi{};
    std::size_t cells() const;  // 0 for an empty one
};

// Geometry of a regular grid [m].
struct ImageGrid {
    Vec3 origin_m{};  // lowest corner of cell (0, 0, 0)
    Vec3 spacing_m{};
};

// Writes one piece. Values are those of the extent's cells, x fastest. Throws
// std::invalid_argument for an empty extent, a spacing that is not positive or a wrong
// number of values, FileError on a failing disk. Written atomically.
void write_vti(const std::filesystem::path& path, const ImageGrid& grid,
               const CellExtent& extent, std::span<const Field> cell_fields);

// A piece of a .pvti file.
struct ImagePiece {
    std::filesystem::path file;  // path as this process would open it
    CellExtent extent;
};

// Name and type of a field, the same in all pieces.
struct FieldType {
    // Number of components, and the type: Float32 unless one of the flags is set.
    std::string name;
    int components = 1;
    bool float64 = false;
    bool uint8 = false;
};

// The field of flags by which VTK hides cells, and the flag of a hidden cell.
inline constexpr const char* ghost_cells = "vtkGhostType";
inline constexpr std::uint8_t hidden_cell = 32;  // vtkDataSetAttributes::HIDDENCELL

// Writes the file that joins the pieces. Throws std::invalid_argument if the pieces do
// not fill the whole extent exactly, FileError on a failing disk.
void write_pvti(const std::filesystem::path& path, const ImageGrid& grid,
                const CellExtent& whole, std::span<const ImagePiece> pieces,
                std::span<const FieldType> cell_fields);

// A mesh of hexahedra.
struct HexahedralMesh {
    Values points_m;  // three values per point [m]
    // Point numbers of each hexahedron in lexicographic order (a = i + 2 j + 4 k); they
    // are put into VTK's order on writing.
    std::span<const std::array<int, 8>> hexahedra;
};

// A list of words that belongs to the file and to no point or cell, such as names.
struct Words {
    std::string name;
    std::vector<std::string> words;
};

// Writes a mesh with its fields, atomically. Throws std::invalid_argument if the number
// of values of a field or a point number of a hexahedron does not fit the mesh, FileError
// on a failing disk.
void write_vtu(const std::filesystem::path& path, const HexahedralMesh& mesh,
               std::span<const Field> point_fields, std::span<const Field> cell_fields,
               std::span<const Words> lists = {});

// ParaView's .pvd collection, which lists the file of each instant. The file is valid
// after every call.
class PvdSeries {
  public:
    // Writes an empty collection, so that a folder that is not writable shows at the
    // start of a run. Throws FileError.
    explicit PvdSeries(std::filesystem::path path);

    // Adds a file at time_s [s]; it must be complete. `file` is its path as this process
    // would open it; the collection stores it relative to itself. Times must increase,
    // except that parts above 0 belong to the instant of the entry before. Throws
    // std::invalid_argument, FileError.
    void add(double time_s, const std::filesystem::path& file, int part = 0);

  private:
    void write() const;

    struct Entry {
        double time_s;
        std::string file;
        int part;
    };
    std::filesystem::path path_;
    std::vector<Entry> entries_;
};

}  // namespace magfsi::output
