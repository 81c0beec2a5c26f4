# SPDX-License-Identifier: GPL-2.0-or-later
"""A run beside its witness: forces, moment, power and work of a metre of strip, with bars."""
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from magfsi import runs
from magfsi.witness.recorded import AXES, area

MEAN_SHARE = 80  # of these parts of a period one is the width of the means that are compared
RIGID = 0.01  # of the stroke, between a body and the best rigid motion
NOTHING = 1e-3  # of the force, and of it times the strip's length: less is none by symmetry


@dataclass
class Row:
    """A quantity: both values, their bars (None: not known), and whether they agree within them."""

    name: str
    unit: str
    witness: float
    witness_bar: float
    run: float
    run_bar: float
    size: float = 0.0  # of the quantity: what a difference is a share of

    def agrees(self):
        """None where neither has a bar."""
        bars = [b for b in (self.witness_bar, self.run_bar) if b is not None]
        return abs(self.run - self.witness) <= sum(bars) if bars else None


class OfRun:
    """The run's own series, as those of a Solution: time, force, moment (None), power (None), all a
    metre deep; `missing`: [what its probes lack]."""

    def __init__(self, recorded):
        columns = {name: np.array(values) for name, values in
                   runs.read_table(recorded.folder / "probes.csv", float).items()}
        box, body = recorded.box, recorded.body
        names = [f"{body}.fluid_force_{AXES[i]}[N]" for i in box.plane]
        self.missing = []
        self.time = columns.get("t[s]")
        self.force = self.moment = self.power = self.work = None
        if names[0] not in columns:
            self.missing.append("probes.bodies: fluid_force")
            return
        self.force = np.stack([columns[n] for n in names], axis=1) / box.depth - buoyancy(recorded)
        torque = f"{body}.fluid_torque_{AXES[box.normal]}[N m]"
        if torque in columns:
            self.moment = box.right_handed * columns[torque] / box.depth
        else:
            self.missing.append("probes.bodies: fluid_torque")
        self._work(recorded, columns)

    def _work(self, recorded, columns):
        """On the fluid: by the energy audit where it is, else that of a body that moves as a rigid one."""
        self.work = work_by_audit(recorded, columns)
        if self.work is not None:
            return
        middle, angle, off = recorded.rigid()
        if off > RIGID:
            self.missing.append("probes: energy_audit (of a body that bends)")
        elif np.ptp(angle) < 1e-6 or self.moment is not None:
            self.power = self.rigid_power(recorded, middle, angle)
            self.work = cumulative(self.time, self.power)

    def rigid_power(self, recorded, middle, angle):
        """Minus force times velocity of the centre, and moment times rate. Rows hold means over the step
        that ended there."""
        time = np.clip(self.time, recorded.time[0], recorded.time[-1])
        velocity = CubicSpline(recorded.time, middle, axis=0)(time, 1)
        power = -(self.force * velocity).sum(axis=1)
        if self.moment is not None:
            power -= self.moment * CubicSpline(recorded.time, angle)(time, 1)
        return power


def work_by_audit(recorded, columns):
    """What the bodies have given to the fluid of a run, less the energy of what its cells hold inside the
    body, which is the difference of the body's kinetic energies [J/m]; None without an audit."""
    names = [f"audit.{name}[J]" for name in ("given_to_fluid", "kinetic_whole", "kinetic")]
    if not all(name in columns for name in names):
        return None
    given, whole, own = (columns[name] for name in names)
    inside = whole - own
    return (given - inside + inside[0]) / recorded.box.depth


def buoyancy(recorded):
    """Of a metre of strip [N/m]: it is in a run's force on the body, and not in the witness, whose
    pressure is without weight."""
    gravity = recorded.scene.get("gravity")
    if not gravity:
        return np.zeros(2)
    direction = np.array(gravity["direction"], float)
    down = gravity["acceleration"] * direction / np.linalg.norm(direction)
    return -recorded.box.density * area(recorded.outline[0]) * down[recorded.box.plane]


def cumulative(time, values):
    """Integral from the first row on, by the trapezoidal rule."""
    return np.concatenate([[0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time))])


def smooth(time, values, width, at):
    """Gaussian means of this width (standard deviation [s]) at other times."""
    even = np.linspace(time[0], time[-1], 8 * int((time[-1] - time[0]) / width) + 9)
    even_values = np.stack([np.interp(even, time, column) for column in np.atleast_2d(values.T)])
    reach = max(1, int(4 * width / (even[1] - even[0])))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) * (even[1] - even[0]) / width)**2)
    weight = np.convolve(np.ones(len(even)), kernel, "same")
    means = [np.convolve(column, kernel, "same") / weight for column in even_values]
    out = np.stack([np.interp(at, even, column) for column in means], axis=-1)
    return out[:, 0] if values.ndim == 1 else out


def window(recorded, end):
    """(begin, end): the last whole period, or from the start without one."""
    period = recorded.period()
    if not period or period > end * (1 + 1e-6):
        return 0.0, end
    return end - period, end


class Series:
    """force, moment, power, work over common times in the window, smoothed but for the work."""

    def __init__(self, source, at, width):
        def of(values, time=source.time):
            return None if values is None else smooth(time, values, width, at)
        self.force, self.moment = of(source.force), of(source.moment)
        power_time = getattr(source, "power_time", source.time)
        self.power = of(source.power, power_time)
        work = getattr(source, "work", None)
        if work is None and source.power is not None:
            work = cumulative(power_time, source.power)
        self.work = None
        if work is not None:
            # The fluid is at rest at the start: OpenFOAM's first row is that of the first step.
            self.work = np.interp(at, power_time, work)
            self.work = self.work - self.work[0]


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def table(at, run, meshes, ratio, recorded, run_bar):
    """[Row]: run: Series of the run; meshes: Series of the meshes, the finest last; ratio: of the cells of
    the last two; run_bar: share of each value, or None. What is none by symmetry has no row.

    At the edges of a strip the stress is singular and the order below that of the schemes: it is taken as
    one, so that a bar is a difference of two meshes over ratio - 1. It is that of whole courses, the rms of
    a difference or the largest of an integral's: two meshes may share an end value by chance."""
    fine, coarse = meshes[-1], meshes[-2] if len(meshes) > 1 else None
    ends = recorded.outline[0, recorded.corners[:2]]
    scale = rms(np.linalg.norm(fine.force, axis=1))
    rows, span = [], at[-1] - at[0]

    def add(name, unit, mine, its, of_meshes, size):
        """of_meshes(): what the last two meshes are apart."""
        if max(abs(mine), abs(its)) < NOTHING * size:
            return
        bar = None if coarse is None else of_meshes() / (ratio - 1)
        # A mean may be small beside what it is the mean of, whose error it has.
        rows.append(Row(name, unit, mine, bar, its,
                        None if run_bar is None else run_bar * max(abs(its), size), size))

    def add_series(name, unit, of, size):
        if max(rms(of(fine)), rms(of(run))) < NOTHING * size:
            return
        own = rms(of(fine))
        add(f"rms {name}", unit, own, rms(of(run)), lambda: rms(of(fine) - of(coarse)), own)
        add(f"rms difference of the {name}", unit, 0.0, rms(of(run) - of(fine)),
            lambda: rms(of(fine) - of(coarse)), own)
    if run.work is not None:
        add("work on the fluid", "J/m", float(fine.work[-1]), float(run.work[-1]),
            lambda: np.abs(fine.work - coarse.work).max(), abs(fine.work[-1]))
    for k, word in enumerate(recorded.box.words()):
        impulse = [cumulative(at, s.force[:, k]) / span if s else None for s in (fine, run, coarse)]
        add(f"mean force along {word}", "N/m", float(impulse[0][-1]), float(impulse[1][-1]),
            lambda i=impulse: np.abs(i[0] - i[2]).max(), scale)
        add_series(f"force along {word}", "N/m", lambda s, k=k: s.force[:, k], scale)
    if run.moment is not None:
        add_series("moment", "N m/m", lambda s: s.moment, scale * np.linalg.norm(ends[1] - ends[0]))
    return rows
