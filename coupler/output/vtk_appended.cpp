#include "coupler/output/vtk_appended.h"

#include <fmt/format.h>

#include <bit>

namespace magfsi::output {

std::string AppendedArrays::add(std::string_view name, std::string_view type,
                                int components, std::span<const std::byte> data) {
    const std::uint64_t offset = offset_bytes_;
    arrays_.push_back(data);
    offset_bytes_ += sizeof(std::uint64_t) + data.size();
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
        "format=\"appended\" "
        "offset=\"{}\"/>\n",
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

std::string vtk_file_element(std::string_view type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"UInt64\">\n",
        type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
}

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

}  // namespace magfsi::output
