// Where the rows of one rank's box lie and what is upstream of each. A row is a line of
// cells along x; rows are never cut between ranks.
#pragma once

#include <array>

namespace magfsi::fluid {

enum class Beyond {
    wrap,      // periodic, and both ends are on this rank
    wall,      // half-way bounce-back
    neighbor,  // ghost rows, filled by the halo exchange
};

// Rows upstream of a row: at[cy + 1][cz + 1] is the row that a population with velocity
// (., cy, cz) comes from, -1 if that lies behind a wall.
struct UpstreamRows {
    int at[3][3];
};

struct RowLayout {
    int nx = 0, ny = 0, nz = 0;                    // owned cells
    Beyond beyond_x = Beyond::wrap;                // both ends alike, never neighbor
    std::array<Beyond, 2> beyond_y{}, beyond_z{};  // low and high side

    // Ghost rows on each side.
    int margin_y() const;
    int margin_z() const;

    int row_count() const { return (ny + 2 * margin_y()) * (nz + 2 * margin_z()); }
    // y in [-margin_y, ny + margin_y), z alike.
    int row(int y, int z) const {
        return (z + margin_z()) * (ny + 2 * margin_y()) + y + margin_y();
    }
    UpstreamRows upstream(int y, int z) const;
};

// Where an index along a cut axis leads: the same inside the box and in ghost rows, the
// other end if periodic; meaningless if `wall`.
struct Crossing {
    int index = 0;
    bool wall = false;
};
Crossing cross(int index, int count, const std::array<Beyond, 2>& sides);

}  // namespace magfsi::fluid
