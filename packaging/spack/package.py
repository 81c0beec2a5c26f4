# SPDX-License-Identifier: GPL-2.0-or-later
"""Spack's recipe of magfsi: see docs/howto/cluster.md."""
from spack.package import *


class Magfsi(CMakePackage):
    """Co-simulation of hard-magnetic soft robots in a fluid: soft bodies in LAMMPS, a
    lattice-Boltzmann fluid, and an immersed boundary between them."""

    # Archives of releases go here as version("0.2.0", sha256=...); until then a checkout:
    #   spack develop --path /path/to/magfsi magfsi@main
    version("main")

    license("GPL-2.0-or-later")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    generator("ninja")

    depends_on("mpi")
    depends_on("lammps@20210929:20220623 +lib +mpi")
    depends_on("eigen@3.4:")
    depends_on("suite-sparse")
    depends_on("openblas threads=none")
    depends_on("yaml-cpp@0.6:")
    depends_on("muparser@2.3:")
    depends_on("cli11")
    depends_on("fmt@8:9")
    depends_on("spdlog +fmt_external")
    depends_on("nlohmann-json")
    depends_on("gmsh@4.8: +shared")
    depends_on("hdf5 ~mpi")
    depends_on("python@3.11:", type="run")
    for library in ("numpy", "scipy", "pyyaml", "matplotlib"):
        depends_on(f"py-{library}", type="run")
    depends_on("vtk +python", type="run")

    def cmake_args(self):
        return [
            self.define("MAGFSI_TESTS", False),
            self.define("MAGFSI_PYTHON_DIR", "lib/python3/site-packages"),
        ]

    def setup_run_environment(self, env):
        env.prepend_path("PYTHONPATH", self.prefix.lib.python3.join("site-packages"))
