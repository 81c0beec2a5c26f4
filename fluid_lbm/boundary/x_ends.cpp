#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

using namespace d3q19;

namespace {

// The partner of population q's ghost, or null if q has none: no velocity along x, or
// bounced at a wall along y or z.
template <class Real>
Real* x_end_partner(const RowPointers<Real>& p, const RowLayout& layout, int q) {
    if (c[q][0] == 0 || p.bounced[q]) return nullptr;
    const bool low = c[q][0] > 0;  // enters at the low end
    if (layout.beyond_x == Beyond::wall) return p.own[q] + (low ? 0 : layout.nx - 1);
    return p.at[q] + (low ? layout.nx : -1);
}

}  // namespace

template <class Real>
void open_x_ends(const RowPointers<Real>& p, const RowLayout& layout) {
    for (int q = 1; q < directions; ++q) {
        const Real* partner = x_end_partner(p, layout, q);
        if (partner != nullptr) p.at[q][c[q][0] > 0 ? 0 : layout.nx - 1] = *partner;
    }
}

template <class Real>
void close_x_ends(const RowPointers<Real>& p, const RowLayout& layout) {
    for (int q = 1; q < directions; ++q) {
        Real* partner = x_end_partner(p, layout, q);
        if (partner != nullptr) *partner = p.at[q][c[q][0] > 0 ? 0 : layout.nx - 1];
    }
}

template void open_x_ends(const RowPointers<double>&, const RowLayout&);
template void open_x_ends(const RowPointers<float>&, const RowLayout&);
template void close_x_ends(const RowPointers<double>&, const RowLayout&);
template void close_x_ends(const RowPointers<float>&, const RowLayout&);

}  // namespace magfsi::fluid
