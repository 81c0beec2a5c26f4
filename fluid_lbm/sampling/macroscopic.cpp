#include "fluid_lbm/sampling/macroscopic.h"

#include <algorithm>

#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

using namespace d3q19;

namespace {

void add_cells(RowMoments& m, int q, const double* f, int first, int count) {
    double* excess = m.excess.data() + first;
    for (int i = 0; i < count; ++i) excess[i] += f[i];
    for (int axis = 0; axis < 3; ++axis) {
        if (c[q][axis] == 0) continue;
        const double sign = c[q][axis];
        double* j = m.j[axis].data() + first;
        for (int i = 0; i < count; ++i) j[i] += sign * f[i];
    }
}

// The cell at a row's end whose value is not behind at[q] but at its partner, see
// x_ends.h.
struct End {
    int x = -1;
    const double* value = nullptr;
};

End row_end(const View& view, const RowPointers& p, int q) {
    if (view.arrangement == Arrangement::natural) return {};
    const double* partner = x_end_partner(p, view.layout, q);
    if (partner == nullptr) return {};
    return {c[q][0] > 0 ? 0 : view.layout.nx - 1, partner};
}

}  // namespace

void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments) {
    const int count = x_end - x_begin;
    moments.excess.assign(count, 0);
    for (auto& component : moments.j) component.assign(count, 0);
    const RowPointers p = pointers(view.populations, view.layout, view.arrangement, y, z);
    for (int q = 0; q < directions; ++q) {
        const End end = row_end(view, p, q);
        int lo = x_begin, hi = x_end;
        if (end.x >= x_begin && end.x < x_end) {
            add_cells(moments, q, end.value, end.x - x_begin, 1);
            (end.x == 0 ? lo : hi) += end.x == 0 ? 1 : -1;
        }
        add_cells(moments, q, p.at[q] + lo, lo - x_begin, hi - lo);
    }
}

double population(const View& view, int q, int x, int y, int z) {
    const RowPointers p = pointers(view.populations, view.layout, view.arrangement, y, z);
    const End end = row_end(view, p, q);
    return end.x == x ? *end.value : p.at[q][x];
}

}  // namespace magfsi::fluid
