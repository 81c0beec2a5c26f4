#include "coupler/output/vtu.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "coupler/output/atomic_file.h"
#include "coupler/output/vtk_appended.h"

namespace magfsi::output {
namespace {

constexpr std::uint8_t vtk_hexahedron = 12;
// VTK walks round the lower quadrilateral, then round the upper one.
constexpr std::array<int, 8> lexicographic_of_vtk{0, 1, 3, 2, 4, 5, 7, 6};

std::vector<std::int64_t> connectivity(std::span<const std::array<int, 8>> hexahedra,
                                       std::size_t points) {
    std::vector<std::int64_t> out;
    out.reserve(8 * hexahedra.size());
    for (const auto& hexahedron : hexahedra)
        for (const int a : lexicographic_of_vtk) {
            const int point = hexahedron[static_cast<std::size_t>(a)];
            if (point < 0 || static_cast<std::size_t>(point) >= points)
                throw std::invalid_argument(
                    fmt::format("hexahedron {} names point {}; there are {} points",
                                (&hexahedron - hexahedra.data()), point, points));
            out.push_back(point);
        }
    return out;
}

std::vector<std::int64_t> offsets(std::size_t cells) {
    std::vector<std::int64_t> out(cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
        out[cell] = 8 * static_cast<std::int64_t>(cell + 1);
    return out;
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const HexahedralMesh& mesh,
               std::span<const Field> point_fields, std::span<const Field> cell_fields) {
    const std::size_t points = count(mesh.points_m) / 3;
    const std::size_t cells = mesh.hexahedra.size();
    const Field position{"position", 3, mesh.points_m};
    check_size(position, points, "points");
    const auto cell_points = connectivity(mesh.hexahedra, points);
    const auto cell_ends = offsets(cells);
    const std::vector<std::uint8_t> types(cells, vtk_hexahedron);

    AppendedArrays appended;
    std::string xml = vtk_file_element("UnstructuredGrid");
    xml += fmt::format(
        "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        points, cells);
    xml += data_element("PointData", point_fields, points, "points", appended);
    xml += data_element("CellData", cell_fields, cells, "cells", appended);
    xml += "<Points>\n" + appended.add(position) + "</Points>\n<Cells>\n";
    xml += appended.add("connectivity", "Int64", 1, bytes_of(cell_points));
    xml += appended.add("offsets", "Int64", 1, bytes_of(cell_ends));
    xml += appended.add("types", "UInt8", 1, bytes_of(types));
    xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";

    AtomicFile file(path);
    file.write(xml);
    appended.write(file);
    file.write("</VTKFile>\n");
    file.commit();
}

}  // namespace magfsi::output
