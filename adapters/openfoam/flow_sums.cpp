#include "adapters/openfoam/flow_sums.h"

#include <cmath>
#include <limits>

namespace magfsi::openfoam {

namespace {

double half_square(const double* v) {
    return (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
}

}  // namespace

std::size_t cell_count(const Widths& width_m) {
    return width_m[0].size() * width_m[1].size() * width_m[2].size();
}

std::array<std::size_t, 3> index_of(const Widths& width_m, std::size_t cell) {
    const std::size_t row = cell / width_m[0].size();
    return {cell % width_m[0].size(), row % width_m[1].size(), row / width_m[1].size()};
}

double volume(const Widths& width_m, std::size_t cell) {
    const auto i = index_of(width_m, cell);
    return width_m[0][i[0]] * width_m[1][i[1]] * width_m[2][i[2]];
}

FlowSums flow_sums(MPI_Comm comm, const Widths& width_m, const double* velocity,
                   std::span<const double> vorticity) {
    enum { space, energy, enstrophy, count };
    std::array<double, count> sum{};
    double most = 0;
    for (std::size_t cell = 0; cell < cell_count(width_m); ++cell) {
        const double v = volume(width_m, cell);
        const double e = half_square(velocity + 3 * cell);
        sum[space] += v;
        sum[energy] += v * e;
        most = std::fmax(most, e);
        if (!vorticity.empty())
            sum[enstrophy] += v * half_square(vorticity.data() + 3 * cell);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), count, MPI_DOUBLE, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm);
    return {sum[space], sum[energy], sum[enstrophy] / sum[space], std::sqrt(2 * most)};
}

FastestCell fastest_cell(std::size_t cells, const double* velocity) {
    FastestCell fastest;
    double most = -1;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double e = half_square(velocity + 3 * cell);
        if (e <= most) continue;
        most = e;
        fastest.cell = cell;
        if (std::isnan(e)) break;
    }
    fastest.speed_m_s = std::sqrt(2 * most);
    return fastest;
}

}  // namespace magfsi::openfoam
