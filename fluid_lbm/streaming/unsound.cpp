#include "fluid_lbm/streaming/unsound.h"

#include <cmath>
#include <vector>

#include "fluid_lbm/collision/watch.h"

namespace magfsi::fluid {

template <class Real>
UnsoundCell find_unsound(const RowPointers<Real>& p, const ForcePointers<Real>& force,
                         int length, MomentsKernel<Real> moments, int y, int z) {
    std::vector<double> values(4 * static_cast<std::size_t>(length));
    double* const out[4] = {&values[0], &values[length], &values[2 * length],
                            &values[3 * length]};
    const Real* outgoing[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) outgoing[q] = p.at[d3q19::opposite(q)];
    moments(outgoing, length, out);
    UnsoundCell worst;
    for (int x = 0; x < length; ++x) {
        UnsoundCell cell{z, y, x, 1 + out[0][x], 0, 0};
        for (int a = 0; a < 3; ++a) {
            const double local = force.at[a] != nullptr ? force.at[a][x] : 0;
            const double u = (out[1 + a][x] - 0.5 * local) / cell.density;
            cell.speed += u * u;
            cell.force += local * local;
        }
        cell.speed = std::sqrt(cell.speed);
        cell.force = std::sqrt(cell.force);
        if (!is_sound(cell.density, cell.speed)) return cell;
        if (x == 0 || cell.speed > worst.speed) worst = cell;
    }
    return worst;
}

template UnsoundCell find_unsound(const RowPointers<double>&,
                                  const ForcePointers<double>&, int,
                                  MomentsKernel<double>, int, int);
template UnsoundCell find_unsound(const RowPointers<float>&, const ForcePointers<float>&,
                                  int, MomentsKernel<float>, int, int);

}  // namespace magfsi::fluid
