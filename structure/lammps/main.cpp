// magfsi-lammps: the LAMMPS command line with our styles, for plain input scripts.
#include <mpi.h>
#include "input.h"
#include "lammps.h"

#include <cstdio>
#include <exception>
#include <memory>

#include "structure/lammps/register_styles.h"

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    try {
        const auto lammps =
            std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
        magfsi::structure::register_styles(*lammps);
        lammps->input->file();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "magfsi-lammps: %s\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return 0;
}
