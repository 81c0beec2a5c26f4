// SPDX-License-Identifier: GPL-2.0-or-later
// Writes into the folder argv[1] the files that read_back.py checks against the same
// formulas: a sheared block of hexahedra, an image in three pieces, and their collection.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "coupler/output/vtk.h"

namespace fs = std::filesystem;
using namespace magfsi::output;

namespace {

constexpr int nx = 4, ny = 3, nz = 2;

void write_block(const fs::path& path) {
    std::vector<double> position, displacement;
    std::vector<float> temperature;
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i) {
                const double x = 0.5 * i, y = 1.0 * j, z = 2.0 * k;
                position.insert(position.end(), {x + 0.25 * z, y, z});
                displacement.insert(displacement.end(), {0.25 * z, 0, -1e-300});
                temperature.push_back(static_cast<float>(x + 10 * y + 100 * z));
            }
    std::vector<std::array<int, 8>> cells;
    std::vector<double> energy;
    std::vector<float> magnetization;
    const auto node = [](int i, int j, int k) {
        return i + (nx + 1) * (j + (ny + 1) * k);
    };
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                cells.push_back({node(i, j, k), node(i + 1, j, k), node(i, j + 1, k),
                                 node(i + 1, j + 1, k), node(i, j, k + 1),
                                 node(i + 1, j, k + 1), node(i, j + 1, k + 1),
                                 node(i + 1, j + 1, k + 1)});
                energy.push_back(1.0 / (1 + i + nx * (j + ny * k)));
                magnetization.insert(magnetization.end(), {1.0f * i, 2.0f * j, 3.0f * k});
            }
    const std::vector<Field> of_points{{"displacement", 3, displacement},
                                       {"a < b & c", 1, temperature}};
    const std::vector<Field> of_cells{{"energy", 1, energy},
                                      {"magnetization", 3, magnetization}};
    write_vtu(path, {position, cells}, of_points, of_cells);
}

// Float and double fields of the global cell number and the cell's centre.
void write_piece(const fs::path& path, const ImageGrid& grid, const CellExtent& extent) {
    std::vector<float> velocity;
    std::vector<double> density;
    for (int k = extent.lo[2]; k < extent.hi[2]; ++k)
        for (int j = extent.lo[1]; j < extent.hi[1]; ++j)
            for (int i = extent.lo[0]; i < extent.hi[0]; ++i) {
                velocity.insert(velocity.end(), {1.0f * i, 1.0f * j, 1.0f * k});
                density.push_back(1000 + 1.0 / (1 + i + 10 * j + 100 * k));
            }
    const std::vector<Field> fields{{"velocity", 3, velocity}, {"density", 1, density}};
    write_vti(path, grid, extent, fields);
}

void write_image(const fs::path& folder) {
    const ImageGrid grid{{-1, 0, 0.1}, {0.25, 0.5, 0.1}};
    const CellExtent whole{{0, 0, 0}, {6, 5, 4}};
    // One rank's piece over the full width, two others side by side: not a product grid.
    const std::vector<ImagePiece> pieces{
        {folder / "image_0.vti", {{0, 0, 0}, {6, 5, 1}}},
        {folder / "image_1.vti", {{0, 0, 1}, {2, 5, 4}}},
        {folder / "image_2.vti", {{2, 0, 1}, {6, 5, 4}}}};
    for (const auto& [file, extent] : pieces) write_piece(file, grid, extent);
    const std::vector<FieldType> types{{"velocity", 3, false}, {"density", 1, true}};
    write_pvti(folder / "image.pvti", grid, whole, pieces, types);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const fs::path folder = argv[1];
    fs::create_directories(folder / "block");
    write_block(folder / "block/0.vtu");
    write_image(folder);
    PvdSeries series(folder / "block.pvd");
    series.add(0.1, folder / "block/0.vtu");
    return 0;
}
