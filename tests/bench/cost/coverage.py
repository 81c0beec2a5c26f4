# SPDX-License-Identifier: GPL-2.0-or-later
"""Does the true error lie within the bar that magfsi cost states? Cases that nothing was fitted to,
with answers that are known otherwise.

    ./magfsi python tests/bench/cost/coverage.py [--out FOLDER] [--only WORD]      minutes

Writes table.md, which docs/accuracy/coverage.md shows: for each case the value's true error and
stated bar, and those of the limit.
"""
import argparse
import math
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from magfsi import runs
from magfsi.cost import command
from magfsi.cost.report import percent

BUDGET_S = 40.0  # for the runs of a case, by the cost model
FEM = runs.ROOT / "tests/validation/structure/beam_LH17.5.csv"
TAYLOR_GREEN = runs.ROOT / "docs/accuracy/taylor_green"


@dataclass
class Case:
    name: str
    scene: str
    probe: str
    true: float
    reference: str
    norm: str = "final"
    known_to: float = 0.0  # the reference itself, as a part of it
    start_s: float = None
    budget_s: float = BUDGET_S


# --- beams: 3D finite elements ------------------------------------------------------


def beam(elements, element, gamma, fem):
    row = min(fem, key=lambda r: abs(float(r["gamma"]) - gamma))
    scene = f"""
name: beam
time: {{end: {gamma / 0.04:.9g} s, equilibrium: {{method: newton}}}}
bodies:
  beam:
    mesh: {{box: {{size: [17.5 mm, 5 mm, 1 mm], elements: {elements}}}}}
    element: {element}
    material: {{shear_modulus: 330 kPa, lame_lambda: 6.6 MPa, density: 1860 kg/m3}}
    magnetization: {{uniform: [100 kA/m, 0 A/m, 0 A/m]}}
    clamps: [x_min]
magnetic_field:
  plane: xz
  table: {{time: [0 s, 1 s], magnitude: [0 mT, 132 mT], direction: 90 deg}}
probes:
  every: {gamma / 0.04 / max(1, round(gamma / 0.001)):.9g} s
  points: {{tip: {{body: beam, at: [17.5 mm, 2.5 mm, 0.5 mm]}}}}
"""
    return Case(f"beam {elements}, {element}, gamma {gamma}", scene, "tip_uz[m]",
                float(row["uz_tip/L"]) * 0.0175, "3D finite elements")


def beams():
    fem = runs.read_rows(FEM)
    yield beam("[9, 3, 1]", "assumed_strain", 0.001, fem)
    yield beam("[12, 4, 1]", "assumed_strain", 0.003, fem)
    yield beam("[12, 4, 1]", "assumed_strain", 0.01, fem)
    yield beam("[18, 6, 2]", "assumed_strain", 0.02, fem)
    yield beam("[18, 5, 2]", "mean_f", 0.002, fem)
    yield beam("[18, 5, 2]", "mean_f", 0.015, fem)


# --- waves in bars: d'Alembert ------------------------------------------------------


def bar(kind, count, share):
    """A bar of lame_lambda 0 under sudden weight, along it (c^2 = 2 G / rho) or across (G / rho).
    share: of the time that a wave takes along it. The end falls freely until the clamp's wave
    arrives, and mirrors that about the static sag."""
    length, modulus, density, gravity = 0.1, 1e5, 1000.0, 1.0
    along = kind == "stretched"
    speed = math.sqrt((2 if along else 1) * modulus / density)
    crossing = length / speed
    sag = 0.5 * gravity * crossing**2
    true = (sag * share**2 if share <= 1 else 2 * sag - sag * (2 - share)**2)
    held = ("{face: [y_min, y_max], axis: y}, {face: [z_min, z_max], axis: z}" if along else
            "{face: [y_min, y_max], axis: y}, {face: [y_min, y_max], axis: x}")
    end = share * crossing
    scene = f"""
name: bar
time: {{end: {end:.9g} s}}
bodies:
  bar:
    mesh: {{box: {{size: [100 mm, 10 mm, 10 mm], elements: [{count}, 1, 1]}}}}
    material: {{shear_modulus: 100 kPa, lame_lambda: 0 Pa, density: 1000 kg/m3}}
    clamps: [x_min]
    rollers: [{held}]
gravity: {{acceleration: 1 m/s2, direction: {'[1, 0, 0]' if along else '[0, 0, 1]'}}}
probes:
  every: {end / 20:.9g} s
  points: {{tip: {{body: bar, at: [100 mm, 5 mm, 5 mm]}}}}
"""
    return Case(f"bar {kind}, {count} elements, {share:g} crossings", scene,
                f"tip_u{'x' if along else 'z'}[m]", true, "d'Alembert")


def bars():
    for kind, count, share in (("stretched", 12, 0.9), ("stretched", 12, 1.5),
                               ("stretched", 20, 1.9), ("sheared", 12, 0.8),
                               ("sheared", 16, 1.4), ("sheared", 24, 1.8)):
        yield bar(kind, count, share)


# --- flows between walls: series -----------------------------------------------------

HEIGHT, VISCOSITY, SPEED = 1.0, 0.02, 0.1
ODD = np.arange(1, 4001, 2)


def _walls(cells, end_s, more, lattice_speed, probes):
    spacing = HEIGHT / cells
    return f"""
name: channel
time: {{end: {end_s:.9g} s, step: {lattice_speed * spacing / SPEED:.9g} s}}
fluid:
  box: [{4 * spacing:.12g} m, 1 m, {4 * spacing:.12g} m]
  spacing: {spacing:.12g} m
  density: 1 kg/m3
  viscosity: {VISCOSITY} m2/s
{more}
probes: {{every: {end_s / 20:.9g} s, {probes}}}
"""


PERIODIC = "x_min: periodic, x_max: periodic, z_min: periodic, z_max: periodic"
ENERGY = "fluid: [kinetic_energy]"
FLOW = "integrals: {through: {plane: {axis: x, at: 0.001 mm}}}"


def _volume(cells):
    return (4 / cells)**2 * HEIGHT**3


def _decay(end_s):
    return VISCOSITY * (math.pi / HEIGHT)**2 * end_s


def poiseuille(cells, end_s, lattice_speed=0.05):
    """From rest."""
    force = 8 * VISCOSITY * SPEED / HEIGHT**2
    grown = 1 - np.exp(-_decay(end_s) * ODD**2)
    scene = _walls(cells, end_s, f"  body_force: [{force} N/m3, 0 N/m3, 0 N/m3]\n"
                   f"  boundaries: {{{PERIODIC}}}", lattice_speed, ENERGY)
    squares = 0.5 * np.sum((4 * force * HEIGHT**2 / (VISCOSITY * (ODD * math.pi)**3) * grown)**2)
    return Case(f"channel from rest, {cells} cells, {end_s:g} s", scene, "kinetic_energy[J]",
                0.5 * _volume(cells) * squares, "series")


def couette(cells, end_s):
    y = np.linspace(0, HEIGHT, 4001)
    u = SPEED * y / HEIGHT + sum(2 * SPEED / (k * math.pi) * (-1)**k * np.sin(k * math.pi * y)
                                 * math.exp(-_decay(end_s) * k**2) for k in range(1, 200))
    scene = _walls(cells, end_s, f"  boundaries: {{{PERIODIC}, y_max: {{no_slip: {{velocity: "
                   f"[{SPEED} m/s, 0 m/s, 0 m/s]}}}}}}", 0.05, ENERGY)
    return Case(f"wall set in motion, {cells} cells, {end_s:g} s", scene, "kinetic_energy[J]",
                0.5 * _volume(cells) * np.trapz(u**2, y), "series")


def stopping(cells, end_s):
    squares = 0.5 * np.sum((4 * SPEED / (ODD * math.pi) * np.exp(-_decay(end_s) * ODD**2))**2)
    scene = _walls(cells, end_s, f"  initial_velocity: [{SPEED} m/s, 0 m/s, 0 m/s]\n"
                   f"  boundaries: {{{PERIODIC}}}", 0.05, ENERGY)
    return Case(f"stream that walls stop, {cells} cells, {end_s:g} s", scene,
                "kinetic_energy[J]", 0.5 * _volume(cells) * squares, "series")


def walls():
    yield poiseuille(12, 5)
    yield poiseuille(16, 15)
    yield poiseuille(24, 40)
    yield couette(12, 4)
    yield couette(16, 10)
    yield couette(24, 30)
    yield stopping(12, 3)
    yield stopping(16, 6)
    yield stopping(24, 10)


# --- vortices: pseudo-spectral --------------------------------------------------------


def vortex(reynolds, cells, turns):
    table = runs.read_table(TAYLOR_GREEN / f"reference_{reynolds}.csv")
    energy = np.interp(turns, [float(t) for t in table["t k U"]],
                       [float(e) for e in table["E / (rho U^2 V)"]])
    end = turns / (2 * math.pi)
    scene = f"""
name: vortex
time: {{end: {end:.9g} s, step: {0.06 / cells:.9g} s}}
fluid:
  box: [1 m, 1 m, 1 m]
  spacing: {1 / cells:.12g} m
  density: 1 kg/m3
  viscosity: {1 / (2 * math.pi * reynolds):.9g} m2/s
  boundaries: {{x_min: periodic, x_max: periodic, y_min: periodic, y_max: periodic,
               z_min: periodic, z_max: periodic}}
  taylor_green: {{speed: 1 m/s}}
probes: {{every: {end / 20:.9g} s, {ENERGY}}}
"""
    return Case(f"vortex at {reynolds}, {cells} cells, {turns:g} turns", scene,
                "kinetic_energy[J]", energy, "pseudo-spectral")


def vortices():
    for reynolds, cells, turns in ((50, 16, 3), (50, 24, 6), (100, 20, 4), (100, 32, 6),
                                   (200, 24, 3), (200, 32, 5)):
        yield vortex(reynolds, cells, turns)


# --- drag of balls in an array, creeping: Zick and Homsy, J. Fluid Mech. 115 (1982) 13 --------


BALL = runs.ROOT / "docs/accuracy/ball.msh"  # of diameter 1, held by its surface "all"


def array(concentration, factor, cells, markers=False):
    """factor: drag over 6 pi mu a U, U the superficial velocity; the force is that of the
    pressure gradient on the whole cell, here a body force. markers: a body that is held, in place
    of an obstacle."""
    diameter = (6 * concentration / math.pi)**(1 / 3)
    viscosity, force = 1.0, 1e-3
    speed = force / (3 * math.pi * viscosity * diameter * factor)
    spacing = 1 / cells
    ball = f"""bodies:
  ball:
    mesh: {{gmsh: {{file: {BALL}, unit: {diameter:.9g} m}}}}
    material: {{shear_modulus: 0.1 Pa, lame_lambda: 0.2 Pa, density: 1000 kg/m3}}
    clamps: [all]
    initial: {{position: [0.5 m, 0.5 m, 0.5 m]}}""" if markers else ""
    obstacle = ("obstacles: {ball: {sphere: {centre: [0.5 m, 0.5 m, 0.5 m], diameter: "
                f"{diameter:.9g} m}}}}}}") if not markers else ""
    # Relaxation time 0.8; some times what viscosity takes across a gap.
    scene = f"""
name: array
time: {{end: 0.4 s, step: {0.1 * spacing**2 / viscosity:.9g} s}}
{ball}
fluid:
  box: [1 m, 1 m, 1 m]
  spacing: {spacing:.12g} m
  density: 1 kg/m3
  viscosity: {viscosity} m2/s
  expected_speed: {3 * speed:.3g} m/s
  body_force: [{force} N/m3, 0 N/m3, 0 N/m3]
  boundaries: {{x_min: periodic, x_max: periodic, y_min: periodic, y_max: periodic,
               z_min: periodic, z_max: periodic}}
  {obstacle}
probes: {{every: 20 ms, {FLOW}}}
"""
    return Case(f"{'bodies' if markers else 'balls'} in an array, {100 * concentration:.3g} %, "
                f"{cells} cells", scene, "through.flow[m3/s]", speed, "Zick and Homsy")


def arrays():
    yield array(0.125, 4.292, 16)
    yield array(0.216, 7.442, 16)
    yield array(0.343, 15.4, 20)
    for concentration, factor, cells in ((0.064, 2.810, 12), (0.125, 4.292, 16),
                                         (0.216, 7.442, 16)):
        yield array(concentration, factor, cells, markers=True)


# --- balls that settle: ten Cate et al., Phys. Fluids 14 (2002) 4012 ---------------------------

SETTLING = runs.ROOT / "tests/validation/sphere/settling.yaml"
# density, viscosity [mm2/s], speed in an unbounded tank [mm/s], its part that is reached, end [s]
TEN_CATE = {"E1": (970, 384.5, 38, 0.947, 1.6), "E2": (965, 219.7, 60, 0.953, 1.2),
            "E3": (962, 117.46, 91, 0.959, 0.9), "E4": (960, 60.4, 128, 0.955, 0.8)}


def settling(name, spacing_mm, forcing):
    density, viscosity, speed, reached, end = TEN_CATE[name]
    text = SETTLING.read_text()
    for old, new in (("gmsh: {file: ball.msh, unit: 1 m}", f"gmsh: {{file: {BALL}, unit: 15 mm}}"),
                     ("spacing: 1.25 mm", f"spacing: {spacing_mm} mm"),
                     ("density: 970", f"density: {density}"),
                     ("viscosity: 384.5", f"viscosity: {viscosity}"),
                     ("expected_speed: 40", f"expected_speed: {1.1 * speed:.3g}"),
                     ("lattice_speed: 0.01", "lattice_speed: 0.04"),
                     ("end: 1.6", f"end: {end}")):
        assert old in text, old
        text = text.replace(old, new)
    text += f"coupling: {{immersed_boundary: {{forcing: {forcing}}}}}\n"
    # Their speeds scatter by 2 %.
    return Case(f"a ball that settles, {name}, {15 / spacing_mm:.3g} cells across, {forcing}",
                text, "ball.speed_z[m/s]", -1e-3 * speed * reached, "experiment", "peak", 0.02)


def settlings():
    yield settling("E1", 5, "penalty")
    for name in TEN_CATE:
        yield settling(name, 3.75 if name == "E1" else 2.5, "no_slip")


# --- a flag behind a cylinder: S. Turek, J. Hron, LNCSE 53 (2006) 371 ---------------------------


def flag(case, column, true, **more):
    text = (runs.ROOT / f"tests/validation/turek_hron/{case}.yaml").read_text()
    text = text[:text.index("coupling:")]  # without slip, the default
    return Case(f"{case}, 10 mm, {column.split('[')[0]}", text, column, true, "benchmark", **more)


def flags():
    yield flag("fsi1", "A_uy[m]", 0.8209e-3, budget_s=120)
    yield flag("fsi2", "A_uy[m]", 80.6e-3, norm="amplitude", start_s=12, budget_s=300)


CASES = (beams, bars, walls, vortices, arrays, settlings, flags)


# --- the table ------------------------------------------------------------------------


@dataclass
class Found:
    case: Case
    probe: object = None
    seconds: float = 0.0
    fault: str = ""

    def within(self):
        """Whether the value and the limit lie within their bars, as far as the truth is known."""
        e, bar, limit, limit_bar = self.errors()
        return e <= bar + self.case.known_to, limit <= limit_bar + self.case.known_to

    def errors(self):
        """True error and bar of the value, of the limit; of the truth."""
        p, true = self.probe, self.case.true
        return [x / abs(true) for x in (abs(p.value - true), p.bar, abs(p.limit - true),
                                        p.limit_bar)]


def examine(case, out):
    folder = out / case.name.replace(" ", "_").replace("/", "_")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.yaml").write_text(case.scene)
    wish = command.Wish(folder / "scene.yaml", out=folder, budget_s=case.budget_s,
                        probes=[case.probe], norm=case.norm, start_s=case.start_s)
    began = time.monotonic()
    try:
        result = command.planned(wish)
        command.do(result, wish)
        command.conclude(result, wish)
    except command.making.CannotRun as why:
        return Found(case, fault=str(why))
    faults = result.faults + result.probes[0].faults
    return Found(case, result.probes[0], time.monotonic() - began,
                 "; ".join(f"{f.parameter}: {f.why}" for f in faults))


def page(found):
    promised = [f for f in found if f.probe and not f.fault]
    inside = [f for f in promised if f.within()[0]]
    near = [f for f in promised if f.errors()[1] <= 3 * f.errors()[0]]
    limits = [f for f in promised if f.within()[1]]
    lines = ["| case | reference | true error | bar | within | bar over error | limit's true error "
             "| its bar | within |", "|---|---|---|---|---|---|---|---|---|"]
    for f in promised:
        e, bar, limit, limit_bar = f.errors()
        words = ["yes" if inside else "**no**" for inside in f.within()]
        known = f" ({percent(f.case.known_to)})" if f.case.known_to else ""
        lines.append(f"| {f.case.name} | {f.case.reference}{known} | {percent(e)} | {percent(bar)} "
                     f"| {words[0]} | {bar / e:.1f} | {percent(limit)} | {percent(limit_bar)} | "
                     f"{words[1]} |")
    n, of = len(promised), max(1, len(promised))
    lines += ["", f"Of {n} cases for which a bar is stated, the true error of the value lies "
              f"within it in {len(inside)} ({percent(len(inside) / of)}); the bar is at most 3 times "
              f"the error in {len(near)} ({percent(len(near) / of)}); the limit lies within its own bar "
              f"in {len(limits)} ({percent(len(limits) / of)})."]
    doubtful = [f for f in found if f.fault]
    if doubtful:
        lines += ["", "No bar is stated (the fit does not hold, and the command says so):", ""]
    for f in doubtful:
        words = ""
        if f.probe:
            e, bar, *_ = f.errors()
            words = f" True error {percent(e)}; a bar would have been {percent(bar)}."
        lines.append(f"- {f.case.name}: {f.fault}.{words}")
    return "\n".join(lines) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--out", type=Path, default=Path("runs/cost_coverage"))
    options.add_argument("--only", default="", help="cases with this in their name")
    chosen = options.parse_args()
    found = []
    for case in (c for make in CASES for c in make()):
        if chosen.only in case.name:
            found.append(examine(case, chosen.out))
            f = found[-1]
            print(f"{case.name}: " + (", ".join(percent(x) for x in f.errors()) if f.probe else "")
                  + f" {f.fault}", flush=True)
    text = page(found)
    (chosen.out / "table.md").write_text(text)
    print(text)


if __name__ == "__main__":
    sys.exit(main())
