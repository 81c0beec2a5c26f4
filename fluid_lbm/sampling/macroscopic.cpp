#include "fluid_lbm/sampling/macroscopic.h"

#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

namespace {

RowPointers readable_row(const View& view, int y, int z) {
    const RowPointers p = pointers(view.populations, view.layout, view.arrangement, y, z);
    if (view.arrangement == Arrangement::swapped) open_x_ends(p, view.layout);
    return p;
}

}  // namespace

void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments) {
    const int count = x_end - x_begin;
    moments.excess.resize(count);
    for (auto& component : moments.j) component.resize(count);
    const RowPointers p = readable_row(view, y, z);
    const double* at[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) at[q] = p.at[q] + x_begin;
    double* const out[4] = {moments.excess.data(), moments.j[0].data(),
                            moments.j[1].data(), moments.j[2].data()};
    view.kernel(at, count, out);
}

double population(const View& view, int q, int x, int y, int z) {
    return readable_row(view, y, z).at[q][x];
}

}  // namespace magfsi::fluid
