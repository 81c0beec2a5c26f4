# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin of the LAMMPS styles, built against the headers that are here and loaded, as `plugin load`
does it, by a program around the unmodified library: it computes what magfsi-lammps does."""
import re
import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing

HOST = r"""
#include <dlfcn.h>
#include <mpi.h>
#include "input.h"
#include "lammps.h"
#include "library.h"
#include <cstdio>
int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    char name[] = "host", log[] = "-log", none[] = "none", screen[] = "-screen";
    char* words[] = {name, log, none, screen, none};
    {
        LAMMPS_NS::LAMMPS lammps(5, words, MPI_COMM_WORLD);
        void* plugin = dlopen(argv[1], RTLD_NOW);
        if (!plugin) return std::puts(dlerror()), 1;
        using Init = void (*)(void*, void*, void*);
        reinterpret_cast<Init>(dlsym(plugin, "lammpsplugin_init"))(&lammps, plugin, nullptr);
        lammps.input->file(argv[2]);
        std::printf("energy %.9e\n", lammps_get_thermo(&lammps, "pe"));
    }
    MPI_Finalize();
}
"""
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(host LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(MPI REQUIRED COMPONENTS CXX)
find_path(HEADERS lammps/lammps.h REQUIRED)
find_library(LIBRARY lammps REQUIRED)
add_executable(host host.cpp)
target_include_directories(host SYSTEM PRIVATE %s/structure/lammps/fmt_shim ${HEADERS}/lammps)
target_compile_definitions(host PRIVATE LAMMPS_SMALLBIG)
target_link_libraries(host PRIVATE ${LIBRARY} MPI::MPI_CXX dl)
"""


def good(*words, **named):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **named)
    if done.returncode != 0:
        raise AssertionError(f"{words}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done.stdout


class Plugin(unittest.TestCase):
    def test_it_computes_what_the_launcher_does(self):
        folder = Path(testing.new_folder())
        (folder / "host.cpp").write_text(HOST)
        (folder / "CMakeLists.txt").write_text(PROJECT % testing.ROOT)
        good("cmake", "-G", "Ninja", "-S", folder, "-B", folder / "host")
        good("ninja", "-C", folder / "host")
        good("cmake", "-G", "Ninja", "-S", testing.ROOT / "structure/lammps/plugin", "-B",
             folder / "plugin", "-DCMAKE_CXX_FLAGS_RELEASE=-O1")
        good("ninja", "-C", folder / "plugin")
        lammps = runs.BIN / "magfsi-lammps"
        good(lammps, "lattice", "beam", "--size", "4e-3", "1e-3", "1e-3", "--elements", "4", "1", "1",
             "--shear-modulus", "330e3", "--lame-lambda", "6.6e6", "--density", "1860",
             "--magnetization", "66e3", "0", "0", cwd=folder)
        script = folder / "in.beam"
        script.write_text("units si\natom_style sphere\natom_modify map array sort 0 0.0\nnewton on\n"
                          "boundary s s s\ncomm_modify mode single cutoff 3e-3 vel yes\n"
                          "neighbor 1e-4 bin\nneigh_modify once yes\nread_data beam.data\n"
                          "fix beam all magttice beam.lattice 1 330e3 6.6e6 field 0 0 5e-3\n"
                          "fix go all nve\ntimestep 5e-6\nthermo_style custom step pe\n"
                          "thermo_modify norm no format float %.9e\nrun 200\n")
        by_plugin = good(folder / "host/host", folder / "plugin/magtticeplugin.so", script, cwd=folder)
        by_launcher = good(lammps, "-in", script, "-log", "none", cwd=folder)
        (energy,) = re.findall(r"energy (\S+)", by_plugin)
        (last,) = re.findall(r"^\s*200 (\S+)", by_launcher, re.M)
        self.assertGreater(abs(float(energy)), 1e-12)
        # Another optimisation of the same sums.
        self.assertAlmostEqual(float(energy) / float(last), 1, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
