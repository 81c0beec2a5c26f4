// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS ends the process on an error: MPI_Finalize and exit, or MPI_Abort. Inside a
// coupled job the first would wait for the partner forever. While control is inside
// LAMMPS, our MPI_Finalize (the MPI profiling interface) turns that into a named end of
// the whole job.
#pragma once

#include <filesystem>

namespace magfsi::lammps {

// The log whose last ERROR line names the cause.
void watch_lammps_exit(const std::filesystem::path& log);

struct InsideLammps {
    InsideLammps();
    ~InsideLammps();
    InsideLammps(const InsideLammps&) = delete;
    InsideLammps& operator=(const InsideLammps&) = delete;
};

}  // namespace magfsi::lammps
