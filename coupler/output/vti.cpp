#include "coupler/output/vti.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "coupler/output/atomic_file.h"
#include "coupler/output/number.h"
#include "coupler/output/relative_path.h"
#include "coupler/output/vtk_appended.h"

namespace magfsi::output {
namespace {

std::string extent_text(const CellExtent& e) {
    return fmt::format("{} {} {} {} {} {}", e.lo[0], e.hi[0], e.lo[1], e.hi[1], e.lo[2],
                       e.hi[2]);
}

std::string grid_attributes(const ImageGrid& grid, const CellExtent& whole) {
    for (const double h : grid.spacing_m)
        if (!(h > 0))
            throw std::invalid_argument(
                fmt::format("grid spacing {} m must be positive", to_text(h)));
    if (whole.cells() == 0)
        throw std::invalid_argument(
            fmt::format("grid extent {} holds no cell", extent_text(whole)));
    const auto triple = [](const std::array<double, 3>& v) {
        return to_text(v[0]) + ' ' + to_text(v[1]) + ' ' + to_text(v[2]);
    };
    return fmt::format("WholeExtent=\"{}\" Origin=\"{}\" Spacing=\"{}\"",
                       extent_text(whole), triple(grid.origin_m), triple(grid.spacing_m));
}

bool overlap(const CellExtent& a, const CellExtent& b) {
    for (std::size_t d = 0; d < 3; ++d)
        if (a.hi[d] <= b.lo[d] || b.hi[d] <= a.lo[d]) return false;
    return true;
}

bool inside(const CellExtent& inner, const CellExtent& outer) {
    for (std::size_t d = 0; d < 3; ++d)
        if (inner.lo[d] < outer.lo[d] || inner.hi[d] > outer.hi[d]) return false;
    return true;
}

void check_partition(const CellExtent& whole, std::span<const ImagePiece> pieces) {
    std::size_t cells = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& piece = pieces[i].extent;
        cells += piece.cells();
        if (piece.cells() == 0 || !inside(piece, whole))
            throw std::invalid_argument(
                fmt::format("piece {} is empty or leaves the grid {}", extent_text(piece),
                            extent_text(whole)));
        for (const auto& other : pieces.first(i))
            if (overlap(piece, other.extent))
                throw std::invalid_argument(fmt::format("pieces {} and {} overlap",
                                                        extent_text(other.extent),
                                                        extent_text(piece)));
    }
    if (cells != whole.cells())
        throw std::invalid_argument(fmt::format(
            "the pieces hold {} of the grid's {} cells", cells, whole.cells()));
}

}  // namespace

std::size_t CellExtent::cells() const {
    std::size_t product = 1;
    for (std::size_t d = 0; d < 3; ++d)
        product *= static_cast<std::size_t>(std::max(0, hi[d] - lo[d]));
    return product;
}

void write_vti(const std::filesystem::path& path, const ImageGrid& grid,
               const CellExtent& extent, std::span<const Field> cell_fields) {
    AppendedArrays appended;
    // The piece's extent is the whole of its file, so that it opens alone, too.
    std::string xml = vtk_file_element("ImageData") +
                      fmt::format("<ImageData {}>\n<Piece Extent=\"{}\">\n",
                                  grid_attributes(grid, extent), extent_text(extent));
    xml += data_element("CellData", cell_fields, extent.cells(), "cells", appended);
    xml += "</Piece>\n</ImageData>\n";

    AtomicFile file(path);
    file.write(xml);
    appended.write(file);
    file.write("</VTKFile>\n");
    file.commit();
}

void write_pvti(const std::filesystem::path& path, const ImageGrid& grid,
                const CellExtent& whole, std::span<const ImagePiece> pieces,
                std::span<const FieldType> cell_fields) {
    check_partition(whole, pieces);
    std::string xml = vtk_file_element("PImageData");
    xml += fmt::format("<PImageData {} GhostLevel=\"0\">\n<PCellData>\n",
                       grid_attributes(grid, whole));
    for (const auto& field : cell_fields)
        xml += fmt::format(
            "<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
            field.float64 ? "Float64" : "Float32", xml_escaped(field.name),
            field.components);
    xml += "</PCellData>\n";
    for (const auto& piece : pieces)
        xml += fmt::format("<Piece Extent=\"{}\" Source=\"{}\"/>\n",
                           extent_text(piece.extent),
                           xml_escaped(relative_to(piece.file, path)));
    write_atomically(path, xml + "</PImageData>\n</VTKFile>\n");
}

}  // namespace magfsi::output
