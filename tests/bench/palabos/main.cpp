// SPDX-License-Identifier: GPL-2.0-or-later
// Palabos on the box of magfsi-bench-lbm: D3Q19 in double, periodic, 1 / omega = 0.6.
//   magfsi-bench-palabos bgk|trt|guo NX NY NZ SECONDS
// prints million cells stepped per second by all ranks.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "palabos3D.h"
#include "palabos3D.hh"

namespace {

using plb::descriptors::D3Q19Descriptor;
using plb::descriptors::ForcedD3Q19Descriptor;

constexpr double omega = 1 / 0.6;

// Steps for about the given time after two to warm up. Takes the dynamics over.
template <template <class> class Descriptor>
double mlups(plb::Dynamics<double, Descriptor>* dynamics, const plb::plint (&n)[3],
             double seconds) {
    plb::MultiBlockLattice3D<double, Descriptor> lattice(n[0], n[1], n[2], dynamics);
    lattice.periodicity().toggleAll(true);
    lattice.toggleInternalStatistics(false);  // its reductions cost, ours has none
    plb::initializeAtEquilibrium(lattice, lattice.getBoundingBox(), 1.0,
                                 plb::Array<double, 3>(0.01, 0, 0));
    lattice.initialize();
    for (int i = 0; i < 2; ++i) lattice.collideAndStream();
    const double start = MPI_Wtime();
    double elapsed = 0;
    long steps = 0;
    do {
        lattice.collideAndStream();
        ++steps;
        elapsed = MPI_Wtime() - start;
        plb::global::mpi().bCast(&elapsed, 1);
    } while (elapsed < seconds);
    return 1e-6 * static_cast<double>(n[0] * n[1] * n[2]) * steps / elapsed;
}

}  // namespace

int main(int argc, char** argv) {
    plb::plbInit(&argc, &argv);
    if (argc != 6) {
        std::fprintf(stderr, "usage: %s bgk|trt|guo NX NY NZ SECONDS\n", argv[0]);
        return 2;
    }
    const std::string kind = argv[1];
    const plb::plint n[3] = {std::atol(argv[2]), std::atol(argv[3]), std::atol(argv[4])};
    const double seconds = std::atof(argv[5]);
    double rate = 0;
    if (kind == "bgk") {
        rate = mlups<D3Q19Descriptor>(
            new plb::BGKdynamics<double, D3Q19Descriptor>(omega), n, seconds);
    } else if (kind == "trt") {
        rate = mlups<D3Q19Descriptor>(
            new plb::TRTdynamics<double, D3Q19Descriptor>(omega), n, seconds);
    } else if (kind == "guo") {
        rate = mlups<ForcedD3Q19Descriptor>(
            new plb::GuoExternalForceBGKdynamics<double, ForcedD3Q19Descriptor>(omega), n,
            seconds);
    } else {
        std::fprintf(stderr, "\"%s\" is none of bgk, trt, guo\n", kind.c_str());
        return 2;
    }
    if (plb::global::mpi().isMainProcessor()) std::printf("%.3f\n", rate);
    return 0;
}
