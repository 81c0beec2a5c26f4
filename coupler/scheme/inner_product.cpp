#include "coupler/scheme/inner_product.h"

#include <cmath>
#include <numeric>

namespace magfsi::coupler {

double inner_product(MPI_Comm comm, std::span<const double> a,
                     std::span<const double> b) {
    const double mine = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    double all = 0;
    // MPI does not promise the same bits of a reduction on every rank.
    MPI_Reduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(&all, 1, MPI_DOUBLE, 0, comm);
    return all;
}

double norm(MPI_Comm comm, std::span<const double> a) {
    return std::sqrt(inner_product(comm, a, a));
}

}  // namespace magfsi::coupler
