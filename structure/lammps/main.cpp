// magfsi-lammps: the LAMMPS command line with our styles, for plain input scripts; and
// `magfsi-lammps lattice ...`, which makes the files of a block for them.
#include <mpi.h>
#include "input.h"
#include "lammps.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>

#include "structure/lammps/lattice_command.h"
#include "structure/lammps/register_styles.h"

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "lattice") == 0) {
        return magfsi::structure::lattice_command(argc - 1, argv + 1);
    }
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
