#include "fluid_lbm/lattice/row_layout.h"

namespace magfsi::fluid {

namespace {

int margin(const std::array<Beyond, 2>& sides) {
    return sides[0] == Beyond::neighbor || sides[1] == Beyond::neighbor ? 1 : 0;
}

}  // namespace

int RowLayout::margin_y() const {
    return margin(beyond_y);
}
int RowLayout::margin_z() const {
    return margin(beyond_z);
}

Crossing cross(int index, int count, const std::array<Beyond, 2>& sides) {
    if (index >= 0 && index < count) return {index, false};
    const Beyond side = index < 0 ? sides[0] : sides[1];
    if (side == Beyond::wall) return {index, true};
    if (side == Beyond::wrap) return {index < 0 ? index + count : index - count, false};
    return {index, false};
}

UpstreamRows RowLayout::upstream(int y, int z) const {
    UpstreamRows rows{};
    Crossing across_y[3], across_z[3];
    for (int c = -1; c <= 1; ++c) {
        across_y[c + 1] = cross(y - c, ny, beyond_y);
        across_z[c + 1] = cross(z - c, nz, beyond_z);
    }
    for (int cy = 0; cy < 3; ++cy) {
        for (int cz = 0; cz < 3; ++cz) {
            const bool wall = across_y[cy].wall || across_z[cz].wall;
            rows.at[cy][cz] = wall ? -1 : row(across_y[cy].index, across_z[cz].index);
        }
    }
    return rows;
}

}  // namespace magfsi::fluid
