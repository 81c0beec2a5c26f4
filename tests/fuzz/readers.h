// SPDX-License-Identifier: GPL-2.0-or-later
// The readers of files, each as one function for the fuzzer and for what it has found.
#pragma once

#include <filesystem>

#include "coupler/checkpoint/state_file.h"
#include "structure/magnetics/grid_field.h"
#include "structure/mesh/gmsh_mesh.h"
#include "structure/table_file.h"
#include "structure/triangle_surface.h"

namespace magfsi::fuzz {

inline void table(const std::filesystem::path& file) {
    namespace units = structure::units;
    constexpr structure::ColumnKind columns[] = {{"t", units::time},
                                                 {"Bx", units::flux_density},
                                                 {"By", units::flux_density},
                                                 {"Bz", units::flux_density}};
    (void)structure::read_table("field table", file, columns, {"t", "Bx", "By", "Bz"});
}

// With a value in a middle: what is read is used.
inline void grid(const std::filesystem::path& file) {
    const structure::GridValues values = structure::read_grid(file);
    structure::point_fields::Point<structure::point_fields::Gradient> at{};
    for (std::size_t d = 0; d < 3; ++d)
        at[d].value = 0.5 * values.axes_m()[d].front() + 0.5 * values.axes_m()[d].back();
    (void)values.at(at);
}

inline void surface(const std::filesystem::path& file) {
    const structure::TriangleSurface read(file.string(), 1e-3, {});
    (void)read.holds({1e-3, 1e-3, 1e-3});
    (void)read.nearest({1e-3, 1e-3, 1e-3});
}

inline void mesh(const std::filesystem::path& file) {
    (void)structure::read_gmsh_mesh(file, 1e-3);
}

// The checksums are looked at last: what comes before must bear any content.
inline void state(const std::filesystem::path& file) {
    const coupler::StateReader read(file);
    for (const char* name : {"pairs", "numbers", "substeps", "energy_audit"})
        if (read.has(name)) (void)read.table(name);
    read.verify();
}

}  // namespace magfsi::fuzz
