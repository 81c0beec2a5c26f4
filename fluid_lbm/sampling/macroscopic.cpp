#include "fluid_lbm/sampling/macroscopic.h"

#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

namespace {

template <class Real>
RowPointers<Real> readable_row(const View& view, int y, int z) {
    const auto p =
        pointers(view.populations.rows<Real>(), view.layout, view.arrangement, y, z);
    if (view.arrangement == Arrangement::swapped) open_x_ends(p, view.layout);
    return p;
}

}  // namespace

void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments) {
    const int count = x_end - x_begin;
    moments.excess.resize(count);
    for (auto& component : moments.j) component.resize(count);
    double* const out[4] = {moments.excess.data(), moments.j[0].data(),
                            moments.j[1].data(), moments.j[2].data()};
    std::visit(
        [&]<class Real>(const ChosenKernels<Real>& kernels) {
            const RowPointers<Real> p = readable_row<Real>(view, y, z);
            const Real* at[d3q19::directions];
            for (int q = 0; q < d3q19::directions; ++q) at[q] = p.at[q] + x_begin;
            kernels.moments(at, count, out);
        },
        view.kernels);
}

double population(const View& view, int q, int x, int y, int z) {
    return view.populations.visit([&]<class Real>(const PopulationRows<Real>&) {
        return static_cast<double>(readable_row<Real>(view, y, z).at[q][x]);
    });
}

}  // namespace magfsi::fluid
