#include "structure/mesh/oblique_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "structure/mesh/structured.h"

namespace magfsi::structure {
namespace {

void check(const ObliquePlate& plate) {
    const auto [along_a, along_b, layers] = plate.elements_per_cell;
    if (plate.cells[0] < 1 || plate.cells[1] < 1 || along_a < 1 || along_b < 1 ||
        layers < 1) {
        throw std::invalid_argument(fmt::format(
            "oblique plate of {} columns and {} rows in {} x {} x {} elements a cell "
            "found; each must be at least 1",
            plate.cells[0], plate.cells[1], along_a, along_b, layers));
    }
    if (!(plate.length_a_m > 0 && plate.length_b_m > 0 && plate.thickness_m > 0)) {
        throw std::invalid_argument(
            fmt::format("oblique plate with sides of {:g} m and {:g} m and {:g} m "
                        "thickness found; each must be positive",
                        plate.length_a_m, plate.length_b_m, plate.thickness_m));
    }
    if (!(plate.angle_rad > 0 && plate.angle_rad < std::numbers::pi)) {
        throw std::invalid_argument(fmt::format(
            "oblique plate with an angle of {:g} rad between its sides found; it must be "
            "above 0 and below pi",
            plate.angle_rad));
    }
}

// Height s over the plate's lower border, in cells, to the shift of its mesh line along
// x, in units of length_b cos(angle).
double lean(const ObliquePlate& plate, double s) {
    if (!plate.zigzag) return s;
    const double in_pair = s - 2 * std::floor(s / 2);
    return in_pair <= 1 ? in_pair : 2 - in_pair;
}

void name_cells(Mesh& mesh, const ObliquePlate& plate) {
    const auto [along_a, along_b, layers] = plate.elements_per_cell;
    for (int row = 0; row < plate.cells[1]; ++row) {
        for (int column = 0; column < plate.cells[0]; ++column) {
            mesh.region_names.push_back(fmt::format("row {} column {}", row, column));
        }
    }
    const int nx = plate.cells[0] * along_a;
    const int ny = plate.cells[1] * along_b;
    for (int e = 0; e < nx * ny * layers; ++e) {
        const int row = e / nx % ny / along_b;
        mesh.region.push_back(row * plate.cells[0] + e % nx / along_a);
    }
}

}  // namespace

Mesh oblique_mesh(const ObliquePlate& plate) {
    check(plate);
    const auto [along_a, along_b, layers] = plate.elements_per_cell;
    const double step_x = plate.length_b_m * std::cos(plate.angle_rad);
    const double step_y = plate.length_b_m * std::sin(plate.angle_rad);
    const GridCounts elements{plate.cells[0] * along_a, plate.cells[1] * along_b, layers};
    const auto position = [&](int i, int j, int k) {
        const double row = static_cast<double>(j) / along_b;
        return Vec3{plate.length_a_m * i / along_a + step_x * lean(plate, row),
                    step_y * row, plate.thickness_m * k / layers};
    };
    Mesh mesh = structured_mesh(elements, position);
    name_cells(mesh, plate);
    return mesh;
}

}  // namespace magfsi::structure
