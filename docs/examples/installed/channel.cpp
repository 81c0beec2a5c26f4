// SPDX-License-Identifier: GPL-2.0-or-later
// Flow between two plates, driven by a force: the fluid alone, without scene and
// coupling. Prints the speed in the middle over that of theory, f h^2 / (8 rho nu).
#include <cstdio>

#include "fluid_lbm/fluid.h"

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    {
        using namespace magfsi;
        fluid::FluidConfig config;
        config.cells = {4, 4, 20};
        config.spacing_m = 1e-4;
        config.time_step_s = 1e-3;
        config.density_kg_m3 = 1000;
        config.viscosity_m2_s = 1e-6;
        config.body_force_n_m3 = {1e-2, 0, 0};
        for (int side : {4, 5})
            config.boundaries[side].kind = fluid::BoundaryKind::no_slip;
        fluid::Fluid flow(MPI_COMM_WORLD, config);
        for (int step = 0; step < 20000; ++step) flow.step();
        const double height = 20 * config.spacing_m;
        const double theory = 1e-2 * height * height / (8 * 1000 * 1e-6);
        const double largest = flow.totals().max_speed_m_s;
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        if (rank == 0) std::printf("middle over theory: %.4f\n", largest / theory);
    }
    MPI_Finalize();
}
