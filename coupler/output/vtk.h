// SPDX-License-Identifier: GPL-2.0-or-later
// Fields for ParaView as VTK XML with raw appended data: .vti and .pvti (a regular grid),
// .vtu (hexahedra), .pvd (a series of instants).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace magfsi::output {

// Nothing is copied: the values must live until written.

// Written as they come: as Float32, Float64 or UInt8.
using Values = std::variant<std::span<const float>, std::span<const double>,
                            std::span<const std::uint8_t>>;

// components values a point (or cell), tuples one after the other.
struct Field {
    std::string name;
    int components = 1;
    Values values;
};

// Fields in the cells of a regular grid: one .vti a piece, one .pvti that names the
// pieces. Pieces meet face to face; no cell is in two of them.

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
    bool uint8 = false;
};

// A field of flags that says which cells of a grid VTK is to draw.
inline constexpr const char* ghost_cells = "vtkGhostType";
inline constexpr std::uint8_t hidden_cell = 32;  // vtkDataSetAttributes::HIDDENCELL

// Throws std::invalid_argument when the pieces do not fill the whole extent exactly.
void write_pvti(const std::filesystem::path& path, const ImageGrid& grid,
                const CellExtent& whole, std::span<const ImagePiece> pieces,
                std::span<const FieldType> cell_fields);

struct HexahedralMesh {
    Values points_m;  // three values a point
    // Point numbers in lexicographic order (a = i + 2 j + 4 k); VTK's own order differs
    // and is made on writing.
    std::span<const std::array<int, 8>> hexahedra;
};

// A list of words that belongs to no point and no cell, such as names.
struct Words {
    std::string name;
    std::vector<std::string> words;
};

// Written atomically. Throws std::invalid_argument when the number of values of a field,
// or a point number of a hexahedron, does not fit the mesh; FileError on a failing disk.
void write_vtu(const std::filesystem::path& path, const HexahedralMesh& mesh,
               std::span<const Field> point_fields, std::span<const Field> cell_fields,
               std::span<const Words> lists = {});

// ParaView's collection: which file holds which instant. Valid after every call.
class PvdSeries {
  public:
    // Writes an empty collection, so that a folder that cannot be written to is found out
    // at the start of a run. Throws FileError.
    explicit PvdSeries(std::filesystem::path path);

    // `file` as this process would open it (the collection names it relative to itself);
    // times must rise. Parts after the first add to the last instant. Add a file only
    // once it is complete. Throws std::invalid_argument, FileError.
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
