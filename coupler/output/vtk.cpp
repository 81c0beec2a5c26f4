// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "coupler/output/file.h"

namespace magfsi::output {

namespace {

std::string_view vtk_type(const Values& values) {
    constexpr std::string_view types[] = {"Float32", "Float64", "UInt8"};
    return types[values.index()];
}

// Number of values, and their bytes.
std::size_t count(const Values& values) {
    return std::visit([](auto span) { return span.size(); }, values);
}

std::span<const std::byte> bytes(const Values& values) {
    return std::visit(
        [](auto span) -> std::span<const std::byte> { return std::as_bytes(span); },
        values);
}

// Throws std::invalid_argument if the field has no name, no components, or not
// components * tuples values; `what` names the tuples ("cells") in the message.
void check_size(const Field& field, std::size_t tuples, std::string_view what) {
    if (field.name.empty()) throw std::invalid_argument("a VTK field must have a name");
    if (field.components < 1)
        throw std::invalid_argument(
            fmt::format("VTK field '{}' has {} components; at least 1", field.name,
                        field.components));
    const std::size_t wanted = tuples * field.components;
    if (count(field.values) != wanted)
        throw std::invalid_argument(fmt::format(
            "VTK field '{}' has {} values; {} {} of {} components need {}", field.name,
            count(field.values), tuples, what, field.components, wanted));
}

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

// The raw appended section of a VTK XML file. Each array is its number of bytes (UInt64)
// followed by the bytes; the XML above refers to it by its offset in the section.
class AppendedArrays {
  public:
    // Register an array and return its <DataArray .../> element. The bytes are read when
    // write() is called.
    std::string add(std::string_view name, std::string_view type, int components,
                    std::span<const std::byte> data);
    std::string add(const Field& field);

    void write(AtomicFile& file) const;

  private:
    std::vector<std::span<const std::byte>> arrays_;
    std::uint64_t offset_bytes_ = 0;
};

std::string AppendedArrays::add(std::string_view name, std::string_view type,
                                int components, std::span<const std::byte> data) {
    const std::uint64_t offset = offset_bytes_;
    arrays_.push_back(data);
    offset_bytes_ += sizeof(std::uint64_t) + data.size();
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
        "format=\"appended\" offset=\"{}\"/>\n",
        type, xml_escaped(name), components, offset);
}

std::string AppendedArrays::add(const Field& field) {
    return add(field.name, vtk_type(field.values), field.components, bytes(field.values));
}

void AppendedArrays::write(AtomicFile& file) const {
    file.write("<AppendedData encoding=\"raw\">\n_");
    for (const auto& data : arrays_) {
        const std::uint64_t size = data.size();
        file.write(std::as_bytes(std::span(&size, 1)));
        file.write(data);
    }
    file.write("\n</AppendedData>\n");
}

// The element <VTKFile type="..."> with the byte order of this machine.
std::string vtk_file_element(std::string_view type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"UInt64\">\n",
        type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
}

// A <PointData> or <CellData> element with its arrays; `what` is "points" or "cells".
std::string data_element(std::string_view element, std::span<const Field> fields,
                         std::size_t tuples, std::string_view what,
                         AppendedArrays& appended) {
    std::string xml = fmt::format("<{}>\n", element);
    for (const auto& field : fields) {
        check_size(field, tuples, what);
        xml += appended.add(field);
    }
    return xml + fmt::format("</{}>\n", element);
}

// Writes the XML, the arrays and the end of the file.
void write_file(const std::filesystem::path& path, const std::string& xml,
                const AppendedArrays& appended) {
    AtomicFile file(path);
    file.write(xml);
    appended.write(file);
    file.write("</VTKFile>\n");
    file.commit();
}

std::string extent_text(const CellExtent& e) {
    return fmt::format("{} {} {} {} {} {}", e.lo[0], e.hi[0], e.lo[1], e.hi[1], e.lo[2],
                       e.hi[2]);
}

// The attributes WholeExtent, Origin and Spacing. Throws std::invalid_argument for an
// empty extent or a spacing that is not positive.
std::string grid_attributes(const ImageGrid& grid, const CellExtent& whole) {
    for (const double h : grid.spacing_m)
        if (!(h > 0))
            throw std::invalid_argument(
                fmt::format("grid spacing {} m must be positive", to_text(h)));
    if (whole.cells() == 0)
        throw std::invalid_argument(
            fmt::format("grid extent {} holds no cell", extent_text(whole)));
    const auto triple = [](const Vec3& v) {
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

// Throws unless the pieces cover the whole grid once: all inside, none overlapping, and
// as many cells.
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
    for (std::size_t d = 0; d < 3; ++d) product *= std::max(0, hi[d] - lo[d]);
    return product;
}

void write_vti(const std::filesystem::path& path, const ImageGrid& grid,
               const CellExtent& extent, std::span<const Field> cell_fields) {
    AppendedArrays appended;
    // The extent of the piece is the whole extent of its file, so that the file opens on
    // its own, too.
    std::string xml = vtk_file_element("ImageData") +
                      fmt::format("<ImageData {}>\n<Piece Extent=\"{}\">\n",
                                  grid_attributes(grid, extent), extent_text(extent));
    xml += data_element("CellData", cell_fields, extent.cells(), "cells", appended);
    xml += "</Piece>\n</ImageData>\n";
    write_file(path, xml, appended);
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
            field.uint8     ? "UInt8"
            : field.float64 ? "Float64"
                            : "Float32",
            xml_escaped(field.name), field.components);
    xml += "</PCellData>\n";
    for (const auto& piece : pieces)
        xml += fmt::format("<Piece Extent=\"{}\" Source=\"{}\"/>\n",
                           extent_text(piece.extent),
                           xml_escaped(relative_to(piece.file, path)));
    write_atomically(path, xml + "</PImageData>\n</VTKFile>\n");
}

namespace {

constexpr std::uint8_t vtk_hexahedron = 12;
// VTK goes round the lower quadrilateral, then round the upper one.
constexpr std::array<int, 8> lexicographic_of_vtk{0, 1, 3, 2, 4, 5, 7, 6};

// Points of all hexahedra in VTK's order.
std::vector<std::int64_t> connectivity(std::span<const std::array<int, 8>> hexahedra,
                                       std::size_t points) {
    std::vector<std::int64_t> out;
    out.reserve(8 * hexahedra.size());
    for (const auto& hexahedron : hexahedra)
        for (const int a : lexicographic_of_vtk) {
            const int point = hexahedron[a];
            if (point < 0 || static_cast<std::size_t>(point) >= points)
                throw std::invalid_argument(
                    fmt::format("hexahedron {} names point {}; there are {} points",
                                (&hexahedron - hexahedra.data()), point, points));
            out.push_back(point);
        }
    return out;
}

// Ends of the hexahedra in the list of points.
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

// The <FieldData> element: each word as the codes of its bytes and a final zero.
std::string words_element(std::span<const Words> lists) {
    if (lists.empty()) return "";
    std::string xml = "<FieldData>\n";
    for (const Words& list : lists) {
        xml += fmt::format(
            "<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" "
            "format=\"ascii\">\n",
            xml_escaped(list.name), list.words.size());
        for (const std::string& word : list.words) {
            for (const char c : word)
                xml += fmt::format("{} ", static_cast<unsigned char>(c));
            xml += "0\n";
        }
        xml += "</Array>\n";
    }
    return xml + "</FieldData>\n";
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const HexahedralMesh& mesh,
               std::span<const Field> point_fields, std::span<const Field> cell_fields,
               std::span<const Words> lists) {
    const std::size_t points = count(mesh.points_m) / 3;
    const std::size_t cells = mesh.hexahedra.size();
    const Field position{"position", 3, mesh.points_m};
    check_size(position, points, "points");
    const auto cell_points = connectivity(mesh.hexahedra, points);
    const auto cell_ends = offsets(cells);
    const std::vector<std::uint8_t> types(cells, vtk_hexahedron);

    AppendedArrays appended;
    std::string xml = vtk_file_element("UnstructuredGrid");
    xml += "<UnstructuredGrid>\n" + words_element(lists);
    xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points,
                       cells);
    xml += data_element("PointData", point_fields, points, "points", appended);
    xml += data_element("CellData", cell_fields, cells, "cells", appended);
    xml += "<Points>\n" + appended.add(position) + "</Points>\n<Cells>\n";
    xml += appended.add("connectivity", "Int64", 1, bytes_of(cell_points));
    xml += appended.add("offsets", "Int64", 1, bytes_of(cell_ends));
    xml += appended.add("types", "UInt8", 1, bytes_of(types));
    xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    write_file(path, xml, appended);
}

PvdSeries::PvdSeries(std::filesystem::path path) : path_(std::move(path)) {
    write();
}

void PvdSeries::add(double time_s, const std::filesystem::path& file, int part) {
    const bool goes_on =
        part > 0 && !entries_.empty() && time_s == entries_.back().time_s;
    if (!entries_.empty() && !(time_s > entries_.back().time_s) && !goes_on)
        throw std::invalid_argument(fmt::format("{}: time {} s does not come after {} s",
                                                path_.string(), to_text(time_s),
                                                to_text(entries_.back().time_s)));
    entries_.push_back({time_s, relative_to(file, path_), part});
    write();
}

void PvdSeries::write() const {
    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
        "<Collection>\n";
    for (const auto& [time_s, file, part] : entries_)
        xml += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n",
                           to_text(time_s), part, xml_escaped(file));
    write_atomically(path_, xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace magfsi::output
