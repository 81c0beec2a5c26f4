// The raw appended section of a VTK XML file: every array is a byte count (UInt64)
// followed by the bytes; the XML above refers to it by its offset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "coupler/output/atomic_file.h"
#include "coupler/output/vtk_field.h"

namespace magfsi::output {

class AppendedArrays {
  public:
    // Both return the <DataArray .../> element. The bytes are read when written.
    std::string add(std::string_view name, std::string_view type, int components,
                    std::span<const std::byte> data);
    std::string add(const Field& field);

    void write(AtomicFile& file) const;

  private:
    std::vector<std::span<const std::byte>> arrays_;
    std::uint64_t offset_bytes_ = 0;
};

// <VTKFile type="..."> with the byte order of this machine.
std::string vtk_file_element(std::string_view type);

// <PointData> or <CellData> with its arrays; `what` is "points" or "cells".
std::string data_element(std::string_view element, std::span<const Field> fields,
                         std::size_t tuples, std::string_view what,
                         AppendedArrays& appended);

}  // namespace magfsi::output
