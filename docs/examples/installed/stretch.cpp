// SPDX-License-Identifier: GPL-2.0-or-later
// The magttice's styles in a program that drives the LAMMPS library itself:
//   stretch SCRIPT
// runs the script as magfsi-lammps does and prints the potential energy at its end.
#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "library.h"

#include <cstdio>

#include "structure/lammps/register_styles.h"

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    char name[] = "stretch", log[] = "-log", none[] = "none", screen[] = "-screen";
    char* words[] = {name, log, none, screen, none};
    {
        LAMMPS_NS::LAMMPS lammps(5, words, MPI_COMM_WORLD);
        magfsi::structure::register_styles(lammps);  // before the first line of input
        if (argc > 1) lammps.input->file(argv[1]);
        std::printf("energy: %.6e J\n", lammps_get_thermo(&lammps, "pe"));
    }
    MPI_Finalize();
}
