# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin of the LAMMPS styles computes what magfsi-lammps does: loaded by a program around Debian's
library, as `plugin load` does it, and by `plugin load` itself, in an lmp with the package PLUGIN. Debian's
has none: it is built from Debian's source package of LAMMPS, into build/lammps (MAGFSI_LAMMPS_HOME), where
it is kept; that takes some ten minutes of a core."""
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from beam_script import script
from magfsi import runs, testing
from magfsi.testing import output_of

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
target_include_directories(host SYSTEM PRIVATE ${HEADERS}/lammps)
target_compile_options(host PRIVATE "SHELL:-include %s/structure/lammps/lammps_versions.h")
target_compile_definitions(host PRIVATE LAMMPS_SMALLBIG)
target_link_libraries(host PRIVATE ${LIBRARY} MPI::MPI_CXX dl)
"""


class Plugin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(testing.new_folder())
        lammps = runs.BIN / "magfsi-lammps"
        output_of(lammps, "lattice", "beam", "--size", "4e-3", "1e-3", "1e-3", "--elements", "4", "1", "1",
             "--shear-modulus", "330e3", "--lame-lambda", "6.6e6", "--density", "1860",
             "--magnetization", "66e3", "0", "0", cwd=cls.folder)
        (cls.folder / "in.beam").write_text(script(9))
        cls.right = cls.last_energy(output_of(lammps, "-in", "in.beam", "-log", "none", cwd=cls.folder))

    @staticmethod
    def last_energy(text):
        (last,) = re.findall(r"^\s*200 +(\S+)", text, re.M)
        return float(last)

    def holds(self, energy):
        self.assertGreater(abs(energy), 1e-12)
        # Another optimisation of the same sums.
        self.assertAlmostEqual(energy / self.right, 1, delta=1e-6)

    def build(self, source, folder, *options):
        output_of("cmake", "-G", "Ninja", "-S", source, "-B", folder, *options)
        output_of("ninja", "-C", folder)

    def test_in_a_program_around_the_library(self):
        folder = self.folder
        (folder / "host.cpp").write_text(HOST)
        (folder / "CMakeLists.txt").write_text(PROJECT % testing.ROOT)
        self.build(folder, folder / "host")
        self.build(testing.ROOT / "structure/lammps/plugin", folder / "plugin",
                   "-DCMAKE_CXX_FLAGS_RELEASE=-O1")
        text = output_of(folder / "host/host", folder / "plugin/magtticeplugin.so", "in.beam", cwd=folder)
        (energy,) = re.findall(r"energy (\S+)", text)
        self.holds(float(energy))

    @unittest.skipUnless(shutil.which("apt-get"), "LAMMPS comes from Debian's source package")
    def test_by_the_command_of_an_lmp_with_the_package_plugin(self):
        home = Path(os.environ.get("MAGFSI_LAMMPS_HOME", testing.ROOT / "build/lammps"))
        if not list(home.glob("lammps/lammps-*/src/lammps.h")):
            output_of(testing.ROOT / "cmake/debian_source.sh", home / "lammps", "lammps", "liblammps-dev")
            (archive,) = home.glob("lammps/*.orig.tar.*")
            output_of("tar", "-xf", archive, "-C", home / "lammps")
        (source,) = home.glob("lammps/lammps-*/src")
        without = [f"-DWITH_{name}=off" for name in ("JPEG", "PNG", "GZIP", "FFMPEG")]
        output_of("cmake", "-G", "Ninja", "-S", source.parent / "cmake", "-B", home / "lmp",
             "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O0", "-DPKG_PLUGIN=on",
             "-DBUILD_SHARED_LIBS=on", "-DBUILD_MPI=on", "-DBUILD_OMP=off", *without)
        output_of("ninja", "-C", home / "lmp", "lmp")
        lmp = home / "lmp/lmp"
        self.assertIn("PLUGIN", output_of(lmp, "-h").split("Installed packages")[1].split("\n\n")[1])
        # As docs/fix_magttice.md says.
        self.build(testing.ROOT / "structure/lammps/plugin", self.folder / "for_lmp",
                   "-DCMAKE_CXX_FLAGS_RELEASE=-O1", f"-DLAMMPS_SOURCE={source}")
        load = f"plugin load {self.folder}/for_lmp/magtticeplugin.so\n"
        (self.folder / "in.plugin").write_text(load + script(9))
        words = ("-in", "in.plugin", "-log", "none")
        self.holds(self.last_energy(output_of(lmp, *words, cwd=self.folder)))
        # On two ranks, each of which loads it.
        as_root = ["--allow-run-as-root"] if os.getuid() == 0 else []
        self.holds(self.last_energy(output_of("mpirun", "-n", "2", "--oversubscribe", *as_root, lmp, *words,
                                         cwd=self.folder)))
        # The styles come with the plugin alone.
        done = subprocess.run([lmp, "-in", "in.beam", "-log", "none"], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("magttice", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
