# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases of coverage.py without a body that moves in a fluid."""
import math

import numpy as np

from magfsi import runs

from case import BALL, Case

FEM = runs.ROOT / "tests/validation/structure/beam_LH17.5.csv"
TAYLOR_GREEN = runs.ROOT / "docs/accuracy/taylor_green"


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


CASES = (beams, bars, walls, vortices, arrays)
