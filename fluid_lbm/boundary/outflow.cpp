// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/boundary/outflow.h"

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

using namespace d3q19;

std::vector<OutflowCell> outflow_cells(const SideContext& in, int side,
                                       const std::vector<Cell>& cells) {
    std::vector<OutflowCell> out(cells.size());
    in.populations.visit([&](const auto& rows) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            Cell inner = cells[i];
            inner[axis_of(side)] += inward(side);
            for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
                const auto which = static_cast<int>(a);
                out[i].slots[which] = cell_slots(rows, in.layout, a, cells[i]);
                out[i].inner_slots[which] = cell_slots(rows, in.layout, a, inner);
            }
        }
    });
    return out;
}

void check_depth(const Decomposition& decomposition, int side) {
    const int axis = axis_of(side);
    for (const CellBox& box : decomposition.boxes) {
        if (box.hi[axis] - box.lo[axis] > 1) continue;
        refuse("fluid box is cut into parts of one cell along ", axis_name[axis],
               ", and the outflow at ", side_name[side],
               " needs two; choose fewer fluid ranks");
    }
}

void rebuild(double (&f)[directions], int axis, int outward, const LocalFlow& flow) {
    double balance[directions], stress[3][3] = {};
    for (int q = 0; q < directions; ++q) {
        balance[q] = weight(q) * equilibrium_over_weight(q, flow);
        if (c[q][axis] * outward < 0) continue;
        // Populations that enter are not known. Their part beyond equilibrium is taken to
        // be that of the opposite population, which has the same c c: it counts twice.
        const double both = c[q][axis] == 0 ? 1 : 2;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                stress[a][b] += both * c[q][a] * c[q][b] * (f[q] - balance[q]);
            }
        }
    }
    for (int q = 0; q < directions; ++q) {
        double off = 0;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                off += (c[q][a] * c[q][b] - (a == b ? cs2 : 0)) * stress[a][b];
            }
        }
        f[q] = balance[q] + 4.5 * weight(q) * off;
    }
}

}  // namespace magfsi::fluid
