# SPDX-License-Identifier: GPL-2.0-or-later
"""The swimmer by both fluids: runs the same scene on the lattice and in OpenFOAM, draws both.

    compare.py [--spacing 0.2 0.1333333333] [--end "40 ms"] [--out runs/compare] [--draw-only]

OpenFOAM takes longer steps than the lattice (its Courant number is --courant, the lattice's
0.05). The immersed boundary's strength is raised by the same factor, so that both have the
same drag coefficient (forcing penalty: OpenFOAM has no other). Both spread by the 3-point kernel, whose smoother force OpenFOAM's
central differences resolve better. --grading makes its cells larger away from the robot, which saves three
quarters of them; without it both have the same cells. Writes compare.png and prints the
figures of the table.
"""
import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import plotting

HERE = pathlib.Path(__file__).resolve().parent
LATTICE_SPEED = 0.05  # of uniform.yaml
UNIFORM = "[[4 mm, 2.4 mm, 1.6 mm], [12 mm, 5.6 mm, 8 mm]]"  # robot and near wake
COLORS = {"lbm": "0.1", "openfoam": "#c2410c"}
NAMES = {"lbm": "lattice Boltzmann", "openfoam": "OpenFOAM"}
INSTANTS = 9


class Run:
    def __init__(self, solver, spacing_mm, folder):
        self.solver, self.spacing_mm, self.folder = solver, spacing_mm, folder
        self.probes = plotting.read_columns(folder / "probes.csv")
        self.summary = plotting.runs.read_summary(folder)
        self.time_ms = 1e3 * self.probes["t[s]"]

    def at(self, name, time_ms):
        return np.interp(time_ms, self.time_ms, plotting.column(self.probes, name))

    def rise_mm(self):
        return 1e3 * (self.at("robot.com_z[m]", self.time_ms[-1])
                      - self.at("robot.com_z[m]", 0.0))

    def label(self):
        return f"{NAMES[self.solver]}, {self.spacing_mm:.3g} mm"


def start(solver, spacing_mm, chosen):
    folder = chosen.out / f"{solver}_{spacing_mm:.3f}"
    if chosen.draw_only:
        return Run(solver, spacing_mm, folder)
    settings = {"fluid.spacing": f"{spacing_mm:.10g} mm", "time.end": chosen.end,
                "name": folder.name, "fluid.solver": solver, "output.fluid.fields": "[velocity]",
                "coupling.immersed_boundary.forcing": "penalty"}
    if solver == "openfoam":
        settings["fluid.courant"] = chosen.courant
        settings["coupling.immersed_boundary.strength"] = chosen.courant / LATTICE_SPEED
        if chosen.grading:
            settings.update({"fluid.grading.uniform": UNIFORM, "fluid.grading.growth": 1.15})
    plotting.run(HERE / "uniform.yaml", folder, [f"{key}={value}" for key, value in settings.items()])
    return Run(solver, spacing_mm, folder)


def outline(axes, run, chosen_ms, pitch_mm):
    frames = plotting.nearest_frames(plotting.frames(run.folder), 1e-3 * chosen_ms)
    for i, (time_s, file) in enumerate(frames):
        faces = plotting.side_view_mm(file)
        centre = 1e3 * run.at("robot.com_x[m]", 1e3 * time_s)
        for face in faces - [centre - i * pitch_mm, 0]:
            axes.plot(*np.append(face, face[:1], axis=0).T, lw=0.5, color=COLORS[run.solver])


def draw_gait(axes, runs, end_ms):
    instants = np.linspace(0, end_ms, INSTANTS)
    pitch = 4.2
    for run in runs:
        outline(axes, run, instants, pitch)
    axes.set(aspect="equal", ylabel="z [mm]", xticks=pitch * np.arange(INSTANTS),
             xticklabels=[f"{t:.0f} ms" for t in instants])
    plotting.clean(axes, "bottom")


def draw_course(axes, runs, name, factor, label, finest_mm):
    for run in runs:
        axes.plot(run.time_ms, factor * plotting.column(run.probes, name),
                  color=COLORS[run.solver], lw=1.2 if run.spacing_mm == finest_mm else 0.7,
                  ls="-" if run.spacing_mm == finest_mm else "--", label=run.label())
    axes.set(xlabel="time [ms]", ylabel=label)
    plotting.clean(axes)


def speed_slice(run, time_ms):
    """Speed [m/s] in the middle plane y = 4 mm, [z][x], at the stored instant nearest to the
    wanted one, and that instant."""
    series = plotting.frames(run.folder, "fluid.pvd")
    time_s, file = plotting.nearest_frames(series, [1e-3 * time_ms])[0]
    image = plotting.read_grid(file)
    nx, ny, nz = (n - 1 for n in image.GetDimensions())
    velocity = vtk_to_numpy(image.GetCellData().GetArray("velocity[m/s]")).reshape(nz, ny, nx, 3)
    return np.linalg.norm(velocity[:, ny // 2], axis=2), 1e3 * time_s


def draw_slice(axes, run, time_ms, most):
    speed, at_ms = speed_slice(run, time_ms)
    picture = axes.imshow(speed, origin="lower", extent=(0, 16, 0, 16), vmin=0, vmax=most,
                          cmap="viridis")
    axes.set(xlim=(4, 12), ylim=(1, 9), xlabel="x [mm]", ylabel="z [mm]",
             title=f"{run.label()}: speed at {at_ms:g} ms")
    return picture


def draw(runs, out):
    plt.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans", "axes.linewidth": 0.6})
    finest = min(run.spacing_mm for run in runs)
    fine = [run for run in runs if run.spacing_mm == finest]
    figure = plt.figure(figsize=(9, 10.5), constrained_layout=True)
    grid = figure.add_gridspec(4, 2, height_ratios=(0.7, 1, 1, 1.7))
    draw_gait(figure.add_subplot(grid[0, :]), fine, min(run.time_ms[-1] for run in fine))
    courses = (("robot.com_z[m]", 1e3, "height of the centre of mass [mm]"),
               ("robot.mid_rise[m]", 1e3, "mid rise [mm]"),
               ("robot.fluid_force_z[N]", 1e6, "vertical force of the fluid [\u00b5N]"),
               ("kinetic_energy[J]", 1e9, "energy of the fluid [nJ]"))
    for i, (name, factor, label) in enumerate(courses):
        axes = figure.add_subplot(grid[1 + i // 2, i % 2])
        draw_course(axes, runs, name, factor, label, finest)
        if i == 2:  # the one with room for it
            axes.legend(frameon=False, fontsize=7, loc="upper right")
    for i, run in enumerate(fine):
        axes = figure.add_subplot(grid[3, i])
        picture = draw_slice(axes, run, 28.0, 0.3)
    figure.colorbar(picture, ax=axes, label="m/s", shrink=0.8)
    figure.savefig(out, dpi=160)
    print(out)


def difference(a, b, name):
    """Largest difference over time, as a share of the stroke: the range of mid rise."""
    time_ms = np.linspace(0, min(a.time_ms[-1], b.time_ms[-1]), 400)
    stroke = np.ptp(a.at("robot.mid_rise[m]", time_ms))
    return np.abs(a.at(name, time_ms) - b.at(name, time_ms)).max() / stroke


def report(pairs):
    for lattice, foam in pairs:
        print(f"{lattice.spacing_mm:.4g} mm: mid rise differs by at most "
              f"{difference(lattice, foam, 'robot.mid_rise[m]'):.1%} of the stroke, end to end "
              f"{difference(lattice, foam, 'robot.end_to_end[m]'):.1%}")
        for run in (lattice, foam):
            cells, mlups = run.summary["fluid"]["cells"], run.summary["fluid"]["mlups"]
            print(f"  {run.label():28s} rise {run.rise_mm():+.3f} mm, {cells} cells, "
                  f"{run.summary['steps']} steps, {run.summary['wall_s']:.0f} s, "
                  f"{mlups:.3g} million cell steps a second")
        ratio = foam.summary["wall_s"] / lattice.summary["wall_s"]
        print(f"  time to solution: openfoam / lbm = {ratio:.1f}")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--spacing", type=float, nargs="+", default=[0.2, 0.4 / 3],
                         help="in mm")
    options.add_argument("--end", default="40 ms")
    options.add_argument("--courant", type=float, default=0.1)
    options.add_argument("--grading", action="store_true")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/compare"))
    options.add_argument("--figure", type=pathlib.Path, default=HERE / "compare.png")
    options.add_argument("--draw-only", action="store_true")
    chosen = options.parse_args()
    pairs = [(start("lbm", h, chosen), start("openfoam", h, chosen)) for h in chosen.spacing]
    report(pairs)
    draw([run for pair in pairs for run in pair], chosen.figure)


if __name__ == "__main__":
    main()
